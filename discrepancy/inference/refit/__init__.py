"""Candidates fitted with their parameters and the nuisances together, and which of them this campaign cannot tell apart."""
