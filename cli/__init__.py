"""The command line tool ``rvwear``."""
