"""Reading files that others wrote: whatever is wrong with one becomes an InputFault that names it, the place and what to do.

Nothing in a file decides how much memory or time it takes: there are limits of size, depth and number, all of them far beyond what is
meant to be read (assumed).
"""

import contextlib
import re
import stat
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from fmu_src.checked_file import Damaged, write_fault
from fmu_src.faults import InputFault, MissingPart, RunFault, nearest_path

# Bytes of a file that people write by hand, and how deep tables may stand in tables.
MOST_TEXT, DEEPEST = 20_000_000, 20
# Of an archive: members, bytes when unpacked, and how deep folders may be.
MOST_MEMBERS, MOST_UNPACKED, MOST_FOLDERS = 20_000, 4_000_000_000, 40
BLOCK = 1 << 20
# A number with a decimal comma where TOML wants one number: at the end of a line, or before the next key of a table.
DECIMAL_COMMA = re.compile(r"=[ \t]*([+-]?\d+,\d+)[ \t]*(?:$|#|\}|,[ \t]*[\w\"])")
# How much of a value or message stands in a fault.
SHOWN = 200
# Signs of a whole fault.
LONGEST = 2500


@contextlib.contextmanager
def reading(path: Path, what: str, remedy: str = "check the file, or get it anew") -> Iterator[None]:
    """Whatever goes wrong in the block is a fault of the file: ``what`` it should be and the ``remedy`` are said."""
    try:
        yield
    except (InputFault, RunFault) as fault:
        text = str(fault)
        if isinstance(fault, MissingPart) or (path.name in text and len(text) <= LONGEST):
            raise
        kind = next(kind for kind in (Damaged, InputFault, RunFault) if isinstance(fault, kind))
        # Said deeper down, where the file was not known; and what a file holds may be long.
        raise kind((text if path.name in text else f"{path}: {text}")[:LONGEST]) from None
    except ModuleNotFoundError:
        # A part of the installation that is missing is no fault of the file.
        raise
    except MemoryError:
        raise InputFault(f"{path}: not readable as {what}: it asks for more memory than there is; {remedy}") from None
    except RecursionError:
        raise InputFault(f"{path}: not readable as {what}: nested too deeply; {remedy}") from None
    # The libraries' own exceptions on broken files are of every kind (struct, key, value, runtime errors).
    except Exception as problem:  # noqa: BLE001
        said = problem.strerror if isinstance(problem, OSError) and problem.strerror else str(problem)
        raise InputFault(f"{path}: not readable as {what}: {type(problem).__name__}: {shown(said)}; {remedy}") from None


def shown(text: str) -> str:
    """A text of a file or about it as a fault shows it: short, on one line."""
    text = " ".join(text.split())
    return text if len(text) <= SHOWN else text[:SHOWN] + " ..."


def quoted(value: object) -> str:
    """A value of a file as a fault shows it."""
    try:
        return shown(repr(value))
    except ValueError:
        # Python writes no integers of more than some thousand digits.
        return f"a {type(value).__name__} that is too long to be shown"


def require_size(path: Path, most: int) -> None:
    size = path.stat().st_size
    if size > most:
        raise InputFault(f"{path}: {size} bytes, more than the {most} that are read of such a file")


def read_text(path: Path, what: str, remedy: str, most: int = MOST_TEXT) -> str:
    """The text of a file in UTF-8, with or without a byte order mark."""
    if not path.is_file():
        raise InputFault(f"no {what} at {path}{nearest_path(path)}; {remedy}")
    with reading(path, f"a {what} in UTF-8", remedy):
        require_size(path, most)
        content = path.read_bytes()
        try:
            return content.decode("utf-8-sig").replace("\r\n", "\n")
        except UnicodeDecodeError as problem:
            line = content.count(b"\n", 0, problem.start) + 1
            raise InputFault(f"{path}: line {line}: the byte {content[problem.start]:#04x} is no UTF-8; save the file as UTF-8") from None


def read_toml(path: Path, what: str, remedy: str) -> dict[str, Any]:
    """The content of a TOML file; ``what`` says which, ``remedy`` what to do where there is none or it is broken."""
    return parse_toml(read_text(path, what, remedy), path, remedy)


def parse_toml(text: str, path: Path, remedy: str) -> dict[str, Any]:
    with reading(path, "a TOML file", remedy):
        try:
            content = tomllib.loads(text)
        except tomllib.TOMLDecodeError as problem:
            raise InputFault(f"{path}: not a TOML file: {shown(str(problem))}; {comma_in(text) or remedy}") from None
        require_plain(content, path, "", 0)
        return content


def comma_in(text: str) -> str:
    """What to do about the first number with a decimal comma; empty if there is none."""
    for number, line in enumerate(text.splitlines(), 1):
        if match := DECIMAL_COMMA.search(line[:LONGEST]):
            return f"line {number} has {match[1]}: write {match[1].replace(',', '.')}, with a point"
    return ""


def require_plain(item: object, path: Path, place: str, depth: int) -> None:
    """Nothing but tables of some depth, lists, texts, truths and numbers that fit into eight bytes."""
    if depth > DEEPEST:
        raise InputFault(f"{path}: {shown(place)}: nested more than {DEEPEST} deep; write it flat")
    if isinstance(item, dict):
        for key, value in item.items():
            require_plain(value, path, f"{place}.{key}".lstrip("."), depth + 1)
    elif isinstance(item, list):
        for number, value in enumerate(item, 1):
            require_plain(value, path, f"{place}[{number}]", depth + 1)
    elif isinstance(item, int) and not -(2**63) <= item < 2**63:
        raise InputFault(f"{path}: {shown(place)}: a whole number beyond 64 bits; write it as 1e30, or correct it")
    elif not isinstance(item, (str, int, float)):
        raise InputFault(f"{path}: {shown(place)} = {item}: a date or time, where a text or a number is meant; put it in quotes")


def unpack_archive(path: Path, folder: Path, what: str, most: int = MOST_UNPACKED) -> None:
    """Unpack a zip archive into a folder: no member leaves it, and together they take no more than ``most`` bytes."""
    left = most
    with reading(path, what), zipfile.ZipFile(path) as archive:
        members = archive.infolist()
        if len(members) > MOST_MEMBERS:
            raise InputFault(f"{path}: {len(members)} files in it, more than {MOST_MEMBERS}: no {what} needs so many")
        for member in members:
            require_inside(path, member)
        for member in members:
            left -= unpack_member(archive, member, folder, left, path)


def require_inside(path: Path, member: zipfile.ZipInfo) -> None:
    """InputFault for a member whose name leads elsewhere, or that is a link."""
    name = member.filename
    parts = PurePosixPath(name.replace("\\", "/")).parts
    absolute = PureWindowsPath(name).drive or name.startswith(("/", "\\"))
    if absolute or ".." in parts or "\0" in name or len(parts) > MOST_FOLDERS:
        raise InputFault(f"{path}: the archive holds {quoted(name)}, a path that leads out of it: it is damaged, or made to do harm")
    if stat.S_ISLNK(member.external_attr >> 16):
        raise InputFault(f"{path}: the archive holds {quoted(name)}, a link; pack the file that it leads to")
    if member.flag_bits & 1:
        raise InputFault(f"{path}: {quoted(name)} in the archive is encrypted; pack it without a password")


def unpack_member(archive: zipfile.ZipFile, member: zipfile.ZipInfo, folder: Path, left: int, path: Path) -> int:
    """Bytes that were written, counted while they are: what an archive says of its sizes need not be true."""
    if not member.filename.replace("\\", "/").strip("/"):
        return 0
    target = folder / member.filename.replace("\\", "/")
    if member.is_dir():
        target.mkdir(parents=True, exist_ok=True)
        return 0
    written = 0
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        file = target.open("wb")
    except OSError as problem:
        raise write_fault(target, problem) from None
    with archive.open(member) as source, file:
        while block := source.read(BLOCK):
            written += len(block)
            if written > left:
                raise InputFault(f"{path}: unpacked it is larger than {MOST_UNPACKED / 1e9:g} GB at {quoted(member.filename)}; it is not unpacked")
            file.write(block)
    return written
