"""The master and what is run with it."""
