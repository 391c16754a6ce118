"""Folders for files that are needed as long as something else is there."""

import shutil
import tempfile
import weakref
from pathlib import Path


class Scratch:
    """A temporary folder; it goes when it is removed, when nobody has this object any more, or with the process."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="rvwear-"))
        # Systems may refuse files that a unit still has open.
        self.remove = weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)
