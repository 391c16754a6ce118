"""What of a result is doubted, and why: calibrated numbers, scales, positions, whose angle it is."""
