"""Object code and the C shell to shared libraries, for this machine or for all platforms.

This machine's library is made with whatever C compiler is there; the others with zig
(the package ``ziglang``), which carries the system libraries of all of them.
"""

import importlib.util
import os
import platform
import shutil
import struct
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import fmpy

from fmu_src.audit import require_only_system_libraries
from fmu_src.glibc import LINK_FLAGS, can_name_versions, old_mathematics
from fmu_src.native import NativeFault

SHELL = Path(__file__).parent / "shell"
FMI_HEADERS = Path(fmpy.__file__).parent / "c-code"
FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-fvisibility=hidden", "-Wall", "-Wextra", "-Werror")


@dataclass(frozen=True)
class Platform:
    """One kind of machine; the name is FMI 3.0's."""

    name: str
    triple: str
    zig_target: str
    fmi2_folder: str
    suffix: str
    link_flags: tuple[str, ...]


ELF_FLAGS = ("-shared", "-s", "-Wl,--build-id=none", "-Wl,-z,defs", "-lm", "-lc")
# Without an install name the library would carry the path it was built at.
DARWIN_FLAGS = ("-dynamiclib", "-Wl,-install_name,@rpath/{file}", "-Wl,-S,-x")
# FMI 2.0 has no folder for Arm under Linux: importers that know one use FMI 3.0's name.
PLATFORMS = {
    p.name: p
    for p in (
        Platform("x86_64-linux", "x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17", "linux64", ".so", ELF_FLAGS),
        Platform("aarch64-linux", "aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17", "aarch64-linux", ".so", ELF_FLAGS),
        Platform("x86_64-windows", "x86_64-w64-windows-gnu", "x86_64-windows-gnu", "win64", ".dll", ("-shared", "-s")),
        Platform("x86_64-darwin", "x86_64-apple-macosx13.0.0", "x86_64-macos.13.0", "darwin64", ".dylib", DARWIN_FLAGS),
        Platform("aarch64-darwin", "arm64-apple-macosx13.0.0", "aarch64-macos.13.0", "darwin64", ".dylib", DARWIN_FLAGS),
    )
}


def host_platform() -> Platform:
    """The platform of this machine; NativeFault if it is none of ``PLATFORMS``."""
    machine = {"amd64": "x86_64", "arm64": "aarch64"}.get(platform.machine().lower(), platform.machine().lower())
    name = f"{machine}-{platform.system().lower()}"
    if name not in PLATFORMS:
        raise NativeFault(f"no native FMUs for {name}; there are {', '.join(PLATFORMS)}")
    return PLATFORMS[name]


@cache
def zig() -> tuple[str, ...] | None:
    """The command of zig's C compiler, if it is installed."""
    if importlib.util.find_spec("ziglang") is not None:
        return (sys.executable, "-m", "ziglang", "cc")
    found = shutil.which("zig")
    return (found, "cc") if found else None


def compiler(target: Platform, portable: bool) -> tuple[str, ...]:
    """The C compiler for a platform; ``portable`` asks for zig even for this machine."""
    if not portable and target == host_platform():
        for name in (os.environ.get("CC"), "cc", "gcc", "clang"):
            if name and shutil.which(name):
                # Start files would add symbols of the compiler's own library.
                return (name, "-nostartfiles") if target.suffix == ".so" else (name,)
    command = zig()
    if command is None:
        what = "for all platforms zig is needed" if portable else "there is no C compiler (cc, gcc, clang or zig)"
        raise NativeFault(f"{what}; install it with: pip install \"rvwear[build]\"")
    return (*command, "-target", target.zig_target, "-fno-sanitize=all")


def shared_library(name: str, table: str, code: bytes, target: Platform, portable: bool) -> bytes:
    """The shared library of a unit: shell, table (C source) and object code; offers FMI 2.0 and 3.0."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "unit_table.c").write_text(table, encoding="utf-8")
        (folder / "unit.o").write_bytes(code)
        for source in sorted(SHELL.iterdir()):
            shutil.copy(source, folder / source.name)
        link = list(target.link_flags)
        driver = compiler(target, portable)
        if can_name_versions(target.name) and "-target" not in driver:
            # zig is told the C library's version in its target.
            (folder / "old_mathematics.c").write_text(old_mathematics(target.name), encoding="utf-8")
            link += LINK_FLAGS
        sources = sorted(p.name for p in folder.glob("*.c"))
        file = f"{name}{target.suffix}"
        link = [flag.format(file=file) for flag in link]
        command = [*driver, *FLAGS, f"-I{FMI_HEADERS}", *sources, "unit.o", "-o", file, *link]
        done = subprocess.run(command, cwd=folder, capture_output=True, encoding="utf-8", errors="replace")
        if done.returncode != 0:
            raise NativeFault(f"{name} for {target.name}: {command[0]} failed: {done.stderr.strip()[-2000:]}")
        library = (folder / file).read_bytes()
    require_only_system_libraries(library, f"{name} for {target.name}")
    return library


def universal(slices: list[bytes]) -> bytes:
    """One Mach-O file of libraries for several processors, each at a page of 16 kB."""
    page, place, headers, body = 14, 1 << 14, b"", b""
    for data in slices:
        processor, subtype = struct.unpack_from("<II", data, 4)
        headers += struct.pack(">IIIII", processor, subtype, place, len(data), page)
        padding = -len(data) % (1 << page)
        body += data + bytes(padding)
        place += len(data) + padding
    head = struct.pack(">II", 0xCAFEBABE, len(slices)) + headers
    return head + bytes((1 << page) - len(head)) + body
