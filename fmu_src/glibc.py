"""Linux libraries that load beside the C library of 2012, whatever machine links them.

The C library keeps several versions of some functions, and a linker takes the newest:
a unit linked today would ask for ``exp`` of 2018 and not load on a long-lived system.
Calls of these functions go through one-line functions that name the oldest version.
It computes what the newest does (exp, log and pow differ in how they report errors, which
nobody here asks for; hypot and fmod likewise), so numbers do not change.
"""

import platform as machine

from fmu_src.native import NativeFault

# What the tool chains of manylinux2014 and of zig's targets in ``link`` promise as well.
OLDEST = (2, 17)
# Version of everything that a machine had from its first C library on.
FIRST_VERSION = {"x86_64-linux": "GLIBC_2.2.5", "aarch64-linux": "GLIBC_2.17"}
# Mathematics of which there are several versions, and how many numbers it takes.
RENEWED = {"exp": 1, "exp2": 1, "log": 1, "log2": 1, "pow": 2, "fmod": 2, "hypot": 2}


def can_name_versions(platform: str) -> bool:
    """Whether this machine's linker finds several versions: not where the C library is another one (musl)."""
    return platform in FIRST_VERSION and machine.libc_ver()[0] == "glibc"


def old_mathematics(platform: str) -> str:
    """C source of the functions that ``LINK_FLAGS`` put in the place of the renewed ones; one that nobody calls is left out."""
    parts = []
    for name, count in RENEWED.items():
        takes, passes = ("double x", "x") if count == 1 else ("double x, double y", "x, y")
        parts.append(
            f'__asm__(".symver first_{name}, {name}@{FIRST_VERSION[platform]}");\n'
            f"double first_{name}({takes});\ndouble __wrap_{name}({takes});\n"
            f"double __wrap_{name}({takes})\n{{\n    return first_{name}({passes});\n}}\n"
        )
    return "\n".join(parts)


LINK_FLAGS = ("-ffunction-sections", "-Wl,--gc-sections", *(f"-Wl,--wrap={name}" for name in RENEWED))


def require_old_library(versions: dict[str, list[str]], name: str) -> None:
    """NativeFault if a library needs a newer C library than ``OLDEST``; ``versions`` are those it asks for, each with its symbols."""
    newer = sorted(f"{version} ({', '.join(symbols) or 'its form'})" for version, symbols in versions.items() if number_of(version) > OLDEST)
    if newer:
        raise NativeFault(
            f"{name} needs {', '.join(newer)}: it would not load where the C library is older, and units are to load from"
            f" {'.'.join(map(str, OLDEST))} on. Link it with zig, which knows the old ones: pip install \"rvwear[build]\","
            " rvwear build --all-platforms"
        )


def number_of(version: str) -> tuple[int, ...]:
    """GLIBC_2.2.5 as numbers; one without numbers (GLIBC_ABI_DT_RELR) is newer than any, a version of something else older."""
    kind, _, digits = version.partition("_")
    if kind != "GLIBC":
        return ()
    return tuple(map(int, digits.split("."))) if digits.replace(".", "").isdigit() else (99,)
