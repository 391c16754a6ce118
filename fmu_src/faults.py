"""Errors that a user can mend."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType


class InputFault(ValueError):
    """Bad input: says where, what, and how to mend it."""


class OldName(FutureWarning):
    """A name that will no longer be known in the version after the next."""


class BeyondRated(UserWarning):
    """A torque that no reducer takes: the model answers, its figures are of no real one."""


class MissingPart(InputFault):
    """A package of an optional part of the installation that is not there: ``what`` cannot be done without it."""

    def __init__(self, what: str, package: str, part: str):
        super().__init__(f'{what} needs {package}, which is not installed: pip install "rvwear[{part}]"')
        self.what, self.package, self.part = what, package, part


class MissingParts(InputFault):
    """Several of them, so that one installation brings them all."""

    def __init__(self, missing: Iterable[MissingPart]):
        missing = list(missing)
        needs = ", ".join(f"{one.what} needs {one.package}" for one in missing)
        super().__init__(f'{needs}, which are not installed: pip install "rvwear[{",".join(dict.fromkeys(one.part for one in missing))}]"')


class RunFault(RuntimeError):
    """A run that cannot go on: says which unit, when, and what to do."""


def nearest(name: str, known: Iterable[str], most: int = 3, old: Mapping[str, str] = MappingProxyType({})) -> str:
    """The names that were perhaps meant, as the end of a message; empty if none is near.

    Of structured names the last part is enough, and ``old`` ones, which people may still write, lead to what they are now.
    """
    import difflib

    names = list(known)
    meant = {name.rpartition(".")[2]: name for name in names} | dict(old) | {name: name for name in names}
    close = dict.fromkeys(meant[k] for k in difflib.get_close_matches(name, meant, most))
    return f"; did you mean {', '.join(close)}?" if close else ""


def nearest_path(path: Path) -> str:
    """The same for a path: what was perhaps meant by the first part of it that is not there."""
    missing = path
    while not missing.parent.exists():
        missing = missing.parent
    try:
        there = {beside.name: str(beside) for beside in missing.parent.iterdir() if not beside.name.startswith(".")}
    except OSError:
        return ""
    return nearest(missing.name, (), old=there)
