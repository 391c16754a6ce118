"""From parameter values to what a bench would have measured."""
