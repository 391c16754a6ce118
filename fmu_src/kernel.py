"""The one decorator of every kernel.

A kernel is a Python function in the subset that numba compiles to machine code
without allocating: scalars, loops, record fields, array element access.  Set
``NUMBA_DISABLE_JIT=1`` and the same functions run as plain Python.
"""

import os
import shutil
import time
from pathlib import Path

import numba

from fmu_src.source_hash import LOADED_HASH

KEPT_DAYS = 30


def use_cache_folder(folder: Path) -> None:
    """Note that the folder is in use; when it is new, remove those beside it that were not used for a month.

    Nothing here may end a run: a cache that cannot be written is for numba to tell, and another
    process may be doing the same.
    """
    try:
        is_new = not folder.is_dir()
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        if not is_new:
            return
        for other in folder.parent.iterdir():
            if time.time() - other.stat().st_mtime > KEPT_DAYS * 86400.0:
                shutil.rmtree(other, ignore_errors=True)
    except OSError:
        pass


# Compiled code is kept per user, so that a second process starts in a second.
# numba looks only at the file of the outermost function to see whether its cache is
# stale; a folder per state of all kernel sources makes that safe.  Set before any
# kernel exists; an explicit choice of the user stands.
if not os.environ.get("NUMBA_CACHE_DIR"):
    cache_home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    cache_folder = Path(cache_home) / "rvwear" / LOADED_HASH[:16]
    use_cache_folder(cache_folder)
    numba.config.CACHE_DIR = str(cache_folder)

CACHE_FOLDER = Path(numba.config.CACHE_DIR)

# The "numpy" error model: a division by zero gives inf as in C, no exception.
kernel = numba.njit(cache=True, error_model="numpy")
