"""Plant and wear of one reducer as one unit."""
