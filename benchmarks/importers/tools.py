"""Where importers are on this machine: ``--tool NAME=PATH``, the environment's RVWEAR_NAME, or the search path."""

import importlib.metadata
import os
import re
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from fmu_src.faults import InputFault

# Programs by the name of the option, with what they are called, and where they come from.
PROGRAMS = {
    "fmusim": ("fmusim", "modelica/fmusim, before 0.7 in modelica/Reference-FMUs"),
    "mastersim": ("mastersim", "ghorwin/MasterSim"),
    "omsimulator": ("OMSimulator", "OpenModelica/OMSimulator"),
    "openmcx": ("openmcx", "eclipse-openmcx/openmcx"),
    "fmucheck": ("fmuCheck.linux64", "modelica-tools/FMUComplianceChecker"),
}
PACKAGES = {"fmpy": "fmpy", "ecos": "ecospy", "libcosim": "libcosimpy"}


@dataclass
class Tools:
    """Paths given on the command line."""

    given: dict[str, Path] = field(default_factory=dict)

    @classmethod
    def of(cls, options: list[str]) -> "Tools":
        given = {}
        for option in options:
            name, equals, path = option.partition("=")
            if name not in PROGRAMS or not equals:
                raise InputFault(f"--tool {option}: write NAME=PATH, NAME one of {', '.join(PROGRAMS)}")
            if not os.access(path, os.X_OK) or Path(path).is_dir():
                raise InputFault(f"--tool {option}: {path} is no program")
            given[name] = Path(path).resolve()
        return cls(given)

    def path(self, name: str) -> Path | None:
        found = self.given.get(name) or os.environ.get(f"RVWEAR_{name.upper()}") or shutil.which(PROGRAMS[name][0])
        return Path(found) if found else None

    def missing(self, name: str) -> str:
        """How to get it, where it is not there."""
        if name in PACKAGES:
            return f"not installed: pip install {PACKAGES[name]}"
        return f"not found: build {PROGRAMS[name][1]}, then --tool {name}=PATH or RVWEAR_{name.upper()}=PATH"


def package_version(name: str) -> str | None:
    try:
        return importlib.metadata.version(PACKAGES[name])
    except importlib.metadata.PackageNotFoundError:
        return None


def said_by(command: list[str | Path]) -> str:
    """First line of what a program says of itself."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=60, errors="replace")
    lines = [line.strip() for line in (done.stdout + done.stderr).splitlines() if line.strip()]
    return lines[0] if lines else "unknown"


class ToolFault(RuntimeError):
    """An importer that could not be run: what it said last."""


def run(command: list[str | Path], folder: Path, seconds: float = 300.0) -> str:
    """What a program prints; ToolFault with its first errors, or else its last lines, if it fails."""
    folder.mkdir(parents=True, exist_ok=True)
    try:
        done = subprocess.run(
            [str(part) for part in command], cwd=folder, capture_output=True, text=True, timeout=seconds, errors="replace",
            env=os.environ | {"TMPDIR": str(folder)},
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise ToolFault(f"ended after {seconds:g} s") from None
    if done.returncode != 0:
        lines = [" ".join(line.split()) for line in (done.stdout + "\n" + done.stderr).splitlines() if line.strip()]
        told = [line for line in lines if re.match(r"\W*error\b", line, re.IGNORECASE)][:2] or lines[-2:]
        raise ToolFault(f"exit code {done.returncode}: {' / '.join(told)}"[:240])
    return done.stdout + done.stderr
