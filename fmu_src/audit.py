"""What a shared library needs from outside: read from the binary itself.

Native FMUs must load on a machine that has nothing but its system libraries, so every
library is audited as it is built.
"""

import struct

from fmu_src.glibc import require_old_library
from fmu_src.native import NativeFault

# Shared libraries that every machine of the kind has: C and mathematics.
SYSTEM = (
    "libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1",
    "/usr/lib/libSystem.B.dylib", "kernel32.dll", "api-ms-win-crt-", "ucrtbase.dll", "msvcrt.dll", "ntdll.dll",
)  # fmt: skip


def require_only_system_libraries(library: bytes, name: str) -> None:
    """NativeFault if the library needs more than C and mathematics, those of a newer system, or shows more than FMI's functions."""
    foreign = sorted(n for n in needed_libraries(library) if not n.lower().startswith(tuple(s.lower() for s in SYSTEM)))
    if foreign:
        raise NativeFault(f"{name} needs {', '.join(foreign)}; only the C and mathematics libraries are sure to be there")
    shown = sorted(s for s in exported_symbols(library) if not s.lstrip("_").startswith(("fmi2", "fmi3")))
    if shown:
        raise NativeFault(f"{name} exports {', '.join(shown[:5])}, which could collide with other units")


    if isinstance(binary := kind_of(library)(library), Elf):
        require_old_library(binary.versions, name)


def needed_libraries(library: bytes) -> set[str]:
    return kind_of(library)(library).needed


def imported_symbols(library: bytes) -> set[str]:
    return kind_of(library)(library).imported


def exported_symbols(library: bytes) -> set[str]:
    return kind_of(library)(library).exported


def kind_of(library: bytes) -> "type[Elf | Pe | MachO]":
    for magic, kind in ((b"\x7fELF", Elf), (b"MZ", Pe), (b"\xcf\xfa\xed\xfe", MachO)):
        if library.startswith(magic):
            return kind
    raise NativeFault("a shared library of unknown format")


def text_at(data: bytes, place: int) -> str:
    return data[place : data.index(b"\0", place)].decode("ascii", "replace")


class Elf:
    """64-bit little-endian ELF, by its section headers."""

    def __init__(self, data: bytes):
        first, size, count = (struct.unpack_from("<Q", data, 0x28)[0], *struct.unpack_from("<HH", data, 0x3A))
        sections = [struct.unpack_from("<IIQQQQIIQQ", data, first + k * size) for k in range(count)]
        dynamic = next(s for s in sections if s[1] == 6)
        symbols = next(s for s in sections if s[1] == 11)
        names = sections[dynamic[6]][4]
        tags = struct.iter_unpack("<qQ", data[dynamic[4] : dynamic[4] + dynamic[5]])
        self.needed = {text_at(data, names + value) for tag, value in tags if tag == 1}
        self.imported: set[str] = set()
        self.exported: set[str] = set()
        names = sections[symbols[6]][4]
        wanted = self.wanted_versions(data, sections)
        # Versions wanted of other libraries, where these keep several, each with its symbols.
        self.versions: dict[str, list[str]] = {version: [] for version in wanted.values()}
        marks = next((s for s in sections if s[1] == 0x6FFFFFFF), None)
        for k, symbol in enumerate(struct.iter_unpack("<IBBHQQ", data[symbols[4] : symbols[4] + symbols[5]])):
            name, section = text_at(data, names + symbol[0]), symbol[3]
            if k == 0:
                # The first symbol of every table is none.
                continue
            (self.exported if section else self.imported).add(name)
            if marks is not None and not section:
                mark = struct.unpack_from("<H", data, marks[4] + 2 * k)[0] & 0x7FFF
                if mark in wanted:
                    self.versions[wanted[mark]].append(name)

    @staticmethod
    def wanted_versions(data: bytes, sections: list[tuple[int, ...]]) -> dict[int, str]:
        """Names of the versions that are wanted of other libraries, by the number that symbols refer to."""
        section = next((s for s in sections if s[1] == 0x6FFFFFFE), None)
        if section is None:
            return {}
        found, names, library = {}, sections[section[6]][4], section[4]
        while True:
            _, count, _, first, following = struct.unpack_from("<HHIII", data, library)
            place = library + first
            for _ in range(count):
                _, _, number, name, distance = struct.unpack_from("<IHHII", data, place)
                found[number] = text_at(data, names + name)
                place += distance
            if not following:
                return found
            library += following


class Pe:
    """64-bit Windows library: import and export directories."""

    def __init__(self, data: bytes):
        self.data = data
        head = struct.unpack_from("<I", data, 0x3C)[0] + 4
        count, optional = struct.unpack_from("<H", data, head + 2)[0], struct.unpack_from("<H", data, head + 16)[0]
        self.sections: list[tuple[int, int, int, int]] = [
            struct.unpack_from("<IIII", data, head + 20 + optional + 40 * k + 8) for k in range(count)
        ]
        exports, _, imports = struct.unpack_from("<III", data, head + 20 + 112)
        self.needed: set[str] = set()
        self.imported: set[str] = set()
        self.exported: set[str] = set()
        place = self.offset(imports)
        while any(entry := struct.unpack_from("<IIIII", data, place)):
            self.needed.add(text_at(data, self.offset(entry[3])))
            lookup = self.offset(entry[0] or entry[4])
            while address := struct.unpack_from("<Q", data, lookup)[0]:
                self.imported.add(text_at(data, self.offset(address) + 2))
                lookup += 8
            place += 20
        directory = self.offset(exports)
        names = struct.unpack_from("<I", data, directory + 24)[0]
        table = self.offset(struct.unpack_from("<I", data, directory + 32)[0])
        for k in range(names):
            self.exported.add(text_at(data, self.offset(struct.unpack_from("<I", data, table + 4 * k)[0])))

    def offset(self, address: int) -> int:
        for size, start, _, place in self.sections:
            if start <= address < start + size:
                return place + address - start
        raise NativeFault("a damaged Windows library")


class MachO:
    """64-bit Darwin library: load commands and symbol table."""

    def __init__(self, data: bytes):
        self.needed: set[str] = set()
        self.imported: set[str] = set()
        self.exported: set[str] = set()
        place = 32
        for _ in range(struct.unpack_from("<I", data, 16)[0]):
            command, size = struct.unpack_from("<II", data, place)
            if command & 0x7FFFFFFF in (0x0C, 0x18, 0x1F):
                self.needed.add(text_at(data, place + struct.unpack_from("<I", data, place + 8)[0]))
            elif command == 0x02:
                symbols, count, names, _ = struct.unpack_from("<IIII", data, place + 8)
                for name, kind, _, _, _ in struct.iter_unpack("<IBBHQ", data[symbols : symbols + 16 * count]):
                    symbol = text_at(data, names + name)
                    # The linker's own marks are external by name only.
                    if kind & 1 and not kind & 0x10 and symbol not in ("__mh_dylib_header", "___dso_handle"):
                        (self.exported if kind & 0x0E else self.imported).add(symbol)
            place += size
