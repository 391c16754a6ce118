"""The one decorator of every kernel.

A kernel is a Python function in the subset that numba compiles to machine code
without allocating: scalars, loops, record fields, array element access.  Set
``NUMBA_DISABLE_JIT=1`` and the same functions run as plain Python.
"""

import os
from pathlib import Path

import numba

from fmu_src.source_hash import LOADED_HASH

# Compiled code is kept per user, so that a second process starts in a second.
# numba looks only at the file of the outermost function to see whether its cache is
# stale; a folder per state of all kernel sources makes that safe.  Set before any
# kernel exists; an explicit choice of the user stands.
if not os.environ.get("NUMBA_CACHE_DIR"):
    cache_home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    numba.config.CACHE_DIR = str(Path(cache_home) / "rvwear" / LOADED_HASH[:16])

# The "numpy" error model: a division by zero gives inf as in C, no exception.
kernel = numba.njit(cache=True, error_model="numpy")
