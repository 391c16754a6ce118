"""Reducer files: the library of reducers, and how a file is read, checked and completed."""
