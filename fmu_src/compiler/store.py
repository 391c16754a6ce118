"""Object code on disk: checked before it is used, made again when it is not sound.

An entry is a checked file: a header (JSON: what it was made from) and the object code.
"""

import hashlib
import json
import sys
from functools import cache
from pathlib import Path
from typing import Any

from fmu_src import checked_file
from fmu_src.cache_folder import cache_folder, own_folder

MARK = b"rvwear object code 1\n"


@cache
def folder() -> Path:
    """In a virtual environment of one's own, with the packages whose code it is; else in the user's cache."""
    own = own_folder(Path(sys.prefix, "share", "rvwear", "code")) if sys.prefix != sys.base_prefix else None
    return own or cache_folder("code")


def place_of(name: str) -> Path:
    return folder() / name


def read(name: str) -> tuple[dict[str, Any], bytes] | None:
    """(header, object code) of an entry, or None where there is none that is whole and one's own."""
    content = checked_file.read(place_of(name), MARK)
    if content is None:
        return None
    header, _, code = content.partition(b"\n")
    return json.loads(header), code


def write(name: str, header: dict[str, Any], code: bytes) -> None:
    """At once or not at all; a folder that cannot be written, or a full disk, ends nothing."""
    checked_file.write(place_of(name), MARK, json.dumps(header, sort_keys=True).encode() + b"\n" + code)


def key(*parts: object) -> str:
    """File name of what is made from these."""
    return hashlib.sha256(json.dumps([str(part) for part in parts]).encode()).hexdigest()[:40]
