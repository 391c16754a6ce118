"""In which order units exchange values within a step."""

# Each unit is handed what those before it have just computed, or all get the values of the step's start.
SCHEMES = ("gauss-seidel", "jacobi")
