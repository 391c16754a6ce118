"""How much of a difference is noise: runs that repeat each other, outliers, correlation, and maps that make all noise alike."""
