"""Object code on disk: per user, private, checked before it is used, made again when it is not sound.

An entry is a line that says what it is, the checksum of the rest, a header (JSON: what it
was made from) and the object code.  Entries that nobody used for a month are removed.
"""

import hashlib
import json
import os
import stat
import sys
import tempfile
import time
from functools import cache
from pathlib import Path

MARK = b"rvwear object code 1\n"
KEPT_DAYS = 30


@cache
def folder() -> Path:
    """``$XDG_CACHE_HOME/rvwear`` or ``~/.cache/rvwear``; where that is no place of one's own, a temporary folder."""
    try:
        home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
        place = Path(home) / "rvwear" / "code"
        place.mkdir(parents=True, exist_ok=True, mode=0o700)
        require_private(place)
        remove_unused(place)
        return place
    except (OSError, RuntimeError) as problem:
        temporary = Path(tempfile.mkdtemp(prefix="rvwear-"))
        print(f"rvwear: no cache of compiled code ({problem}); it is kept in {temporary} for now", file=sys.stderr)
        return temporary


def require_private(place: Path) -> None:
    """OSError unless the folder is one's own, nobody else can write there, and one can oneself."""
    if os.name == "posix":
        status = place.stat()
        if status.st_uid != os.getuid():
            raise PermissionError(f"{place} belongs to somebody else")
        if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
            raise PermissionError(f"others can write to {place}; chmod 700 it")
    if not os.access(place, os.W_OK | os.X_OK):
        raise PermissionError(f"{place} cannot be written")


def remove_unused(place: Path) -> None:
    """Entries older than a month go, and what older versions left: folders of their own beside this one."""
    oldest = time.time() - KEPT_DAYS * 86400.0
    for entry in place.iterdir():
        try:
            if entry.is_file() and entry.stat().st_mtime < oldest:
                entry.unlink()
        except OSError:
            # Another process was faster.
            continue


def read(name: str) -> tuple[dict, bytes] | None:
    """(header, object code) of an entry, or None where there is none that is whole and one's own."""
    path = folder() / name
    try:
        with path.open("rb") as file:
            if os.name == "posix" and os.fstat(file.fileno()).st_uid != os.getuid():
                return None
            content = file.read()
    except OSError:
        return None
    start = len(MARK) + 65
    if not content.startswith(MARK) or hashlib.sha256(content[start:]).hexdigest().encode() + b"\n" != content[len(MARK) : start]:
        return None
    header, _, code = content[start:].partition(b"\n")
    try:
        os.utime(path)
    except OSError:
        # The age decides only about its removal.
        pass
    return json.loads(header), code


def write(name: str, header: dict, code: bytes) -> None:
    """At once or not at all; a folder that cannot be written ends nothing."""
    rest = json.dumps(header, sort_keys=True).encode() + b"\n" + code
    content = MARK + hashlib.sha256(rest).hexdigest().encode() + b"\n" + rest
    try:
        handle, partial = tempfile.mkstemp(dir=folder(), prefix="new-")
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.replace(partial, folder() / name)
    except OSError:
        return


def key(*parts: object) -> str:
    """File name of what is made from these."""
    return hashlib.sha256(json.dumps([str(part) for part in parts]).encode()).hexdigest()[:40]
