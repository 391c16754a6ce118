"""What the shell offers while a command is typed."""

import argparse
import os
from collections.abc import Callable

from reducers.library import available

# The shell sets it when it asks what may follow.
ASKED = "_ARGCOMPLETE"


def completed_by(action: argparse.Action, completer: Callable[..., list[str]]) -> None:
    """What may stand for an argument; argcomplete reads it there."""
    action.completer = completer  # type: ignore[attr-defined]


def reducer_completions(prefix: str, **_: object) -> list[str]:
    """Reducers of the library, and reducer files."""
    from argcomplete.completers import FilesCompleter

    return [*(name for name in available() if name.startswith(prefix)), *FilesCompleter(["toml"])(prefix)]


def answer_shell(parser: argparse.ArgumentParser) -> None:
    """Answer and end, if it is the shell that asks."""
    if ASKED in os.environ:
        import argcomplete

        argcomplete.autocomplete(parser)
