"""Object code on disk: checked before it is used, made again when it is not sound.

An entry is a line that says what it is, the checksum of the rest, a header (JSON: what it
was made from) and the object code.
"""

import hashlib
import json
import os
import tempfile
from pathlib import Path
from typing import Any

from fmu_src.cache_folder import cache_folder

MARK = b"rvwear object code 1\n"
START = len(MARK) + 65


def place_of(name: str) -> Path:
    return cache_folder("code") / name


def read(name: str) -> tuple[dict[str, Any], bytes] | None:
    """(header, object code) of an entry, or None where there is none that is whole and one's own."""
    try:
        with place_of(name).open("rb") as file:
            if os.name == "posix" and os.fstat(file.fileno()).st_uid != os.getuid():
                return None
            content = file.read()
        # Its age says when it was last of use.
        os.utime(place_of(name))
    except OSError:
        return None
    if not content.startswith(MARK) or content[len(MARK) : START] != checksum_line(content[START:]):
        return None
    header, _, code = content[START:].partition(b"\n")
    return json.loads(header), code


def write(name: str, header: dict[str, Any], code: bytes) -> None:
    """At once or not at all; a folder that cannot be written, or a full disk, ends nothing."""
    rest = json.dumps(header, sort_keys=True).encode() + b"\n" + code
    partial = None
    try:
        handle, partial = tempfile.mkstemp(dir=place_of(name).parent, prefix="new-")
        with os.fdopen(handle, "wb") as file:
            file.write(MARK + checksum_line(rest) + rest)
        os.replace(partial, place_of(name))
    except OSError:
        if partial is not None:
            Path(partial).unlink(missing_ok=True)


def checksum_line(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode() + b"\n"


def key(*parts: object) -> str:
    """File name of what is made from these."""
    return hashlib.sha256(json.dumps([str(part) for part in parts]).encode()).hexdigest()[:40]
