"""Errors that a user can mend."""

from collections.abc import Iterable


class InputFault(ValueError):
    """Bad input: says where, what, and how to mend it."""


class MissingPart(InputFault):
    """A package of an optional part of the installation that is not there: ``what`` cannot be done without it."""

    def __init__(self, what: str, package: str, part: str):
        super().__init__(f'{what} needs {package}, which is not installed: pip install "rvwear[{part}]"')


class RunFault(RuntimeError):
    """A run that cannot go on: says which unit, when, and what to do."""


def nearest(name: str, known: Iterable[str], most: int = 3) -> str:
    """The names that were perhaps meant, as the end of a message; empty if none is near."""
    import difflib

    close = difflib.get_close_matches(name, list(known), most)
    return f"; did you mean {', '.join(close)}?" if close else ""
