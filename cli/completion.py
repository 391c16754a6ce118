"""What the shell offers while a command is typed."""

import argparse
import os
from collections.abc import Callable
from pathlib import Path

from discrepancy.refused_file import only_refused
from reducers.library import available

# The shell sets it when it asks what may follow.
ASKED = "_ARGCOMPLETE"


def completed_by(action: argparse.Action, completer: Callable[..., list[str]]) -> None:
    """What may stand for an argument; argcomplete reads it there."""
    action.completer = completer  # type: ignore[attr-defined]


def reducer_completions(prefix: str, **_: object) -> list[str]:
    """Reducers of the library, and reducer and model files, but for those in which nothing but refused effects stands."""
    from argcomplete.completers import FilesCompleter

    files = [name for name in FilesCompleter(["toml"])(prefix) if not holds_refused(Path(name))]
    return [*(name for name in available() if name.startswith(prefix)), *files]


def holds_refused(path: Path) -> bool:
    """One that cannot be read is offered: who chooses it is told why."""
    import tomllib

    try:
        return path.is_file() and only_refused(tomllib.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, AttributeError):
        return False


def answer_shell(parser: argparse.ArgumentParser) -> None:
    """Answer and end, if it is the shell that asks."""
    if ASKED in os.environ:
        import argcomplete

        argcomplete.autocomplete(parser)
