"""Errors that a user can mend."""


class InputFault(ValueError):
    """Bad input: says where, what, and how to mend it."""


class RunFault(RuntimeError):
    """A run that cannot go on: says which unit, when, and what to do."""
