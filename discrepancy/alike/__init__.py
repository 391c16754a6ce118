"""What shows the same as what is named: other parts, opposite signs, directions, causes that no run tells apart."""
