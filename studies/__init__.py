"""What one does with a reducer: a crank turn, a life, stiffness and modes, many lives, its FMUs, and the reports of these."""
