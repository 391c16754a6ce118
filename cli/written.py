"""Files that a command wrote: named among its words, or bare and alone on stdout where it is to say nothing else."""

import contextlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

# Where paths go while a command says nothing else; empty otherwise.
ALONE: list[TextIO] = []


@contextlib.contextmanager
def files_alone() -> Iterator[None]:
    """Of all that is printed to stdout only paths of written files arrive, one a line, for scripts."""
    ALONE.append(sys.stdout)
    try:
        with open(os.devnull, "w", encoding="utf-8") as nowhere, contextlib.redirect_stdout(nowhere):
            yield
    finally:
        ALONE.pop()


def say_file(path: Path | str, label: str = "", more: str = "") -> None:
    """A file that was written, between a label and what else is said of it."""
    if ALONE:
        only_file(path)
    else:
        print(f"{label}{path}{more}")


def only_file(path: Path | str) -> None:
    """A file that is said among other words anyway: alone only where these are not printed."""
    if ALONE:
        print(path, file=ALONE[-1])
