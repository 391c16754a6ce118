"""Which files of a folder may hold measurements: the same for the command line and the workbench."""

import os
from collections.abc import Iterator
from pathlib import Path

from discrepancy.campaign.readers import kind_of

# Folders that hold what was made of measurements.
MADE = ("fmus", "results")


def measurement_files(root: Path) -> Iterator[Path]:
    """Files whose ending tells a format, in a folder and those below it, in the order of their names.

    Left out: names that begin with a dot, folders that begin with ``_`` or hold results, and links that lead out of the folder.
    """
    inside = root.resolve()
    for here, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if not name.startswith((".", "_")) and name not in MADE)
        for name in sorted(names):
            path = Path(here) / name
            if kind_of(path) and not name.startswith(".") and path.resolve().is_relative_to(inside):
                yield path
