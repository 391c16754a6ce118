"""Writes measurement campaigns of a reducer with a hidden truth.

Shares no effect code with the catalogue: the plain kernels give the ideal reducer, everything
hidden is implemented here, from textbooks and in other functional forms.
"""
