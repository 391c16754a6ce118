"""The list of an FMU's members with their hashes, which it carries in ``extra/``."""

import hashlib
import json
import os
import platform
import subprocess
from functools import cache
from importlib.metadata import version

from fmu_src.link import compiler, host_platform
from fmu_src.native import NativeFault

# FMI leaves ``extra/`` to whoever makes the FMU, a folder each.
MANIFEST = "extra/rvwear/manifest.json"
FORMAT = 1
# Whose versions decide the bytes of an FMU, besides the sources.
PACKAGES = ("fmpy", "llvmlite", "numpy", "pythonfmu")


def with_manifest(files: dict[str, bytes]) -> dict[str, bytes]:
    """The files of an FMU by name, and the manifest of them all."""
    content = {"format": FORMAT, "made_with": made_with(), "sha256": hashes(files)}
    return files | {MANIFEST: (json.dumps(content, sort_keys=True, indent=1) + "\n").encode()}


def hashes(files: dict[str, bytes]) -> dict[str, str]:
    """SHA-256 of every member but the manifest."""
    return {name: hashlib.sha256(files[name]).hexdigest() for name in sorted(files) if name != MANIFEST}


@cache
def made_with() -> dict[str, str]:
    """Tool -> version, of all that has a part in the bytes."""
    versions = {name: version(name) for name in PACKAGES}
    return versions | {"python": platform.python_version(), "compiler": compiler_version(os.environ.get("CC"))}


@cache
def compiler_version(chosen: str | None) -> str:
    """What this machine's C compiler says of itself; ``chosen`` is the environment's, by which it goes."""
    del chosen
    try:
        command = [*compiler(host_platform(), False)[:1], "--version"]
        said = subprocess.run(command, capture_output=True, encoding="utf-8", errors="replace", timeout=60).stdout
    except (NativeFault, OSError, subprocess.TimeoutExpired):
        return "none"
    return said.partition("\n")[0].strip() or "unknown"
