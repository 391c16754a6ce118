"""Is it enough: what the fit leaves, and the error on runs that were never used."""
