"""Files of a cache: whole and one's own, or as if they were not there.

A file is a line that says what it is, the checksum of the rest, and the rest.
"""

import hashlib
import os
import tempfile
from pathlib import Path


def read(place: Path, mark: bytes) -> bytes | None:
    """What ``write`` put there under the same mark, or None where there is none that is whole and one's own."""
    try:
        with place.open("rb") as file:
            if os.name == "posix" and os.fstat(file.fileno()).st_uid != os.getuid():
                return None
            content = file.read()
        # Its age says when it was last of use.
        os.utime(place)
    except OSError:
        return None
    start = len(mark) + len(checksum_line(b""))
    if not content.startswith(mark) or content[len(mark) : start] != checksum_line(content[start:]):
        return None
    return content[start:]


def write(place: Path, mark: bytes, content: bytes) -> None:
    """At once or not at all; a folder that cannot be written, or a full disk, ends nothing."""
    partial = None
    try:
        handle, partial = tempfile.mkstemp(dir=place.parent, prefix="new-")
        with os.fdopen(handle, "wb") as file:
            file.write(mark + checksum_line(content) + content)
        os.replace(partial, place)
    except OSError:
        if partial is not None:
            Path(partial).unlink(missing_ok=True)


def checksum_line(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode() + b"\n"
