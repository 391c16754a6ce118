"""Memory of this process [byte], as far as its system tells; NaN where it does not."""

import math
import sys
from pathlib import Path

if sys.platform != "win32":
    import resource


def most() -> float:
    """Most that was resident so far."""
    if sys.platform == "win32":
        return math.nan
    # Darwin counts bytes, the others kilobytes.
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1.0 if sys.platform == "darwin" else 1024.0)


def present() -> float:
    """Resident now."""
    pages = Path("/proc/self/statm")
    if sys.platform == "win32" or not pages.exists():
        return math.nan
    return float(int(pages.read_text(encoding="ascii").split()[1]) * resource.getpagesize())
