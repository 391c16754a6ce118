"""What to measure next, at what price, and what a campaign could not tell apart."""
