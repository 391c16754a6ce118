"""Where what can be made again is kept between runs: per user, private, and never in the way of a run."""

import atexit
import os
import shutil
import stat
import sys
import tempfile
import time
from functools import cache
from pathlib import Path

KEPT_DAYS = 30


@cache
def cache_folder(name: str) -> Path:
    """A folder in ``$XDG_CACHE_HOME/rvwear`` or ``~/.cache/rvwear``; where that is no place of one's own, a temporary one."""
    return root() / name if usable(root() / name) else temporary(f"rvwear-{name}-")


@cache
def root() -> Path:
    try:
        # A user without a home and without an entry among the users has none.
        chosen = os.environ.get("XDG_CACHE_HOME")
        if not chosen and not Path.home().is_dir():
            raise FileNotFoundError(f"there is no {Path.home()}")
        place = Path(chosen or Path.home() / ".cache") / "rvwear"
        place.mkdir(parents=True, exist_ok=True, mode=0o700)
        require_private(place)
        return place
    except (OSError, RuntimeError) as problem:
        print(f"rvwear: no cache between runs ({problem}); set XDG_CACHE_HOME to a folder of your own", file=sys.stderr)
        return temporary("rvwear-")


def temporary(prefix: str) -> Path:
    """A new folder that goes when this process ends."""
    folder = Path(tempfile.mkdtemp(prefix=prefix))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def usable(place: Path) -> bool:
    try:
        keep_in(place)
    except OSError as problem:
        print(f"rvwear: {problem}; nothing is kept there", file=sys.stderr)
        return False
    return True


def own_folder(place: Path) -> Path | None:
    """A folder elsewhere that is kept like one of the cache; None where it is no place of one's own."""
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        keep_in(place)
    except OSError:
        return None
    return place


def keep_in(place: Path) -> None:
    """Make a folder one's own; OSError where it is not."""
    place.mkdir(exist_ok=True, mode=0o700)
    require_private(place)
    remove_unused(place)


def require_private(place: Path) -> None:
    """OSError unless the folder is one's own, nobody else can write there, and one can oneself."""
    if os.name == "posix":
        status = place.stat()
        if status.st_uid != os.getuid():
            raise PermissionError(f"{place} belongs to somebody else")
        if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
            raise PermissionError(f"others can write to {place}: chmod go-w it")
    if not os.access(place, os.W_OK | os.X_OK):
        raise PermissionError(f"{place} cannot be written")


def remove_unused(place: Path) -> None:
    """Files that nobody used for a month go."""
    oldest = time.time() - KEPT_DAYS * 86400.0
    for entry in place.iterdir():
        try:
            if entry.is_file() and entry.stat().st_mtime < oldest:
                entry.unlink()
        except FileNotFoundError:
            # Another process was faster.
            continue
