"""Files that are written whole or not at all, and that tell when they are damaged.

``replacing`` writes beside a file's place under a name of its own and moves it there.  A checked file is a line that says what it is,
the checksum of the rest, and the rest; what has a format of its own (NetCDF) gets the checksum at its end (``seal``).
"""

import contextlib
import errno
import hashlib
import os
import secrets
import time
from collections.abc import Iterator
from pathlib import Path

from fmu_src.faults import InputFault, RunFault

# What a disk does, against what a user chose.
OF_THE_DISK = (errno.ENOSPC, errno.EIO, errno.EDQUOT, errno.EFBIG)
# What a killed process left beside a file goes when it is so old [s] (assumed: nobody writes one file for so long).
LEFT_BEHIND = 86400.0
SEAL = b"\nrvwear sha256 "
SEAL_SIZE = len(SEAL) + 64 + 1
BLOCK = 1 << 20


class Damaged(InputFault):
    """A file whose checksum does not fit, or that lacks a part."""


# Written whole


@contextlib.contextmanager
def replacing(place: Path) -> Iterator[Path]:
    """Where to write what is to stand at ``place``: moved there at the end of the block, removed where that fails.

    InputFault or RunFault (a full disk) if it cannot be written; what stood at ``place`` is unharmed then.
    """
    place = Path(place)
    partial = place.with_name(f".{place.name}.{secrets.token_hex(6)}.part")
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        remove_left_behind(place)
        yield partial
        with partial.open("rb+") as file:
            os.fsync(file.fileno())
        os.replace(partial, place)
        keep_names(place.parent)
    except OSError as problem:
        raise write_fault(place, problem) from None
    finally:
        with contextlib.suppress(OSError):
            partial.unlink(missing_ok=True)


def write_fault(place: Path, problem: OSError) -> InputFault | RunFault:
    """What is to be said where a file cannot be written."""
    why = problem.strerror or str(problem)
    if problem.errno in OF_THE_DISK:
        return RunFault(f"{place} was not written: {why}; what stood there before is unharmed. Make room, or choose another place")
    return InputFault(f"{place} cannot be written: {why}; choose another place")


def keep_names(folder: Path) -> None:
    """Also after a power failure a file that was moved is where it is now; some systems know no such thing for folders."""
    if os.name != "posix":
        return
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def remove_left_behind(place: Path) -> None:
    oldest = time.time() - LEFT_BEHIND
    for path in place.parent.iterdir():
        if path.name.startswith(f".{place.name}.") and path.suffix == ".part":
            with contextlib.suppress(OSError):
                if path.stat().st_mtime < oldest:
                    path.unlink()


def write_text(place: Path, text: str) -> None:
    """A text in UTF-8, lines ended by a line feed on every system."""
    with replacing(place) as partial:
        partial.write_text(text, encoding="utf-8", newline="\n")


def set_aside(place: Path) -> Path:
    """Moves a damaged file out of the way; where it is now."""
    for number in range(1, 1000):
        aside = place.with_name(f"{place.name}.damaged" + (f"-{number}" if number > 1 else ""))
        if not aside.exists():
            try:
                os.replace(place, aside)
            except OSError as problem:
                raise write_fault(aside, problem) from None
            return aside
    raise InputFault(f"{place} is damaged, and so are many before it: remove {place.name}.damaged*")


# Checked


def checksum_line(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode() + b"\n"


def checked(content: bytes, mark: bytes) -> bytes:
    """The content of a checked file with its head."""
    return mark + checksum_line(content) + content


def unchecked(whole: bytes, mark: bytes, place: Path) -> bytes:
    """What ``checked`` was given; Damaged if it is not that any more."""
    start = len(mark) + len(checksum_line(b""))
    if not whole.startswith(mark):
        raise Damaged(f"{place} does not begin like a file of this kind ({mark.decode().strip()}): it is damaged, or of another kind or version")
    if whole[len(mark) : start] != checksum_line(whole[start:]):
        raise Damaged(f"{place} is damaged: its checksum does not fit")
    return whole[start:]


def seal(place: Path) -> None:
    """Append the checksum to a file whose format lets something stand behind its end."""
    line = SEAL + sum_of(place, place.stat().st_size) + b"\n"
    with place.open("ab") as file:
        file.write(line)


def require_seal(place: Path) -> None:
    """Damaged unless the file ends with the checksum of what stands before."""
    size = place.stat().st_size
    with place.open("rb") as file:
        file.seek(max(0, size - SEAL_SIZE))
        last = file.read()
    if not (last.startswith(SEAL) and last.endswith(b"\n") and len(last) == SEAL_SIZE):
        raise Damaged(f"{place} is damaged: it does not end with its checksum; it was cut off, or another program wrote to it")
    if last[len(SEAL) : -1] != sum_of(place, size - SEAL_SIZE):
        raise Damaged(f"{place} is damaged: its checksum does not fit")


def sum_of(place: Path, size: int) -> bytes:
    """Checksum of the first ``size`` bytes."""
    found = hashlib.sha256()
    with place.open("rb") as file:
        while size > 0 and (block := file.read(min(BLOCK, size))):
            found.update(block)
            size -= len(block)
    return found.hexdigest().encode()


# Of a cache: whole and one's own, or as if they were not there


def read(place: Path, mark: bytes) -> bytes | None:
    """What ``write`` put there under the same mark, or None where there is none that is whole and one's own."""
    try:
        with place.open("rb") as file:
            if os.name == "posix" and os.fstat(file.fileno()).st_uid != os.getuid():
                return None
            content = file.read()
        # Its age says when it was last of use.
        os.utime(place)
        return unchecked(content, named(mark, place), place)
    except (OSError, Damaged):
        return None


def write(place: Path, mark: bytes, content: bytes) -> None:
    """At once or not at all; a folder that cannot be written, or a full disk, ends nothing."""
    with contextlib.suppress(InputFault, RunFault), replacing(place) as partial:
        partial.write_bytes(checked(content, named(mark, place)))


def named(mark: bytes, place: Path) -> bytes:
    """A mark that holds for one name alone: an entry under another's name, however sound, is foreign there."""
    return mark + place.name.encode() + b"\n"
