"""Pack a unit as an FMU, byte for byte the same every time, and validate it."""

import json
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import fmpy.validation

from fmu_src.description import guid
from fmu_src.native import host_triple, object_code
from fmu_src.slaves.kernel_slave import OBJECT_CODE
from fmu_src.source_hash import KERNEL_PACKAGES, ROOT, STAMP, source_hash, user_effect_files

# pythonfmu's builder writes its own defaults over the description unless told so.
CAPABILITIES = ("--no-external-tool", "--handle-state", "--serialize-state")
# The earliest time a zip archive can hold.
EPOCH = (1980, 1, 1, 0, 0, 0)


class PackageFault(RuntimeError):
    """An FMU that does not validate."""


def build_fmu(name: str, specification: dict, step_size: float, tool: str, target: Path) -> Path:
    """Build ``target``/``name``.fmu (FMI 2.0, pythonfmu) from a unit's specification.

    ``step_size`` [s] is the default experiment's.  The FMU carries the sources, so it
    can be edited, and their object code for this machine, so it starts at once.
    """
    code_hash = source_hash()
    stamp = {
        "specification": specification, "source_hash": code_hash, "guid": guid(specification, code_hash),
        "triple": host_triple(), "step_size": step_size, "tool": tool,
    }
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        script = folder / f"{name}_slave.py"
        shutil.copy(ROOT / "fmu_src" / "slaves" / script.name, script)
        for package in KERNEL_PACKAGES:
            shutil.copytree(ROOT / package, folder / package, ignore=shutil.ignore_patterns("__pycache__"))
            for name, file in user_effect_files(package):
                shutil.copy(file, folder / name)
        (folder / STAMP).write_text(json.dumps(stamp, sort_keys=True, indent=1), encoding="utf-8")
        (folder / OBJECT_CODE).write_bytes(object_code(specification))
        contents = [folder / package for package in KERNEL_PACKAGES] + [folder / STAMP, folder / OBJECT_CODE]
        # In a process of its own: pythonfmu imports the slave and leaves it in sys.modules.
        command = [sys.executable, "-m", "pythonfmu", "build", "-f", script, "-d", folder / "raw", *CAPABILITIES, *contents]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise PackageFault(f"pythonfmu could not pack {name}: {done.stderr.strip()}")
        rewrite(folder / "raw" / f"{name}.fmu", target / f"{name}.fmu")
    return target / f"{name}.fmu"


def rewrite(source: Path, target: Path) -> None:
    """Copy an archive with sorted names and fixed times: equal contents, equal bytes."""
    # Written beside the target and moved: an interrupted build leaves no half FMU.
    partial = target.with_suffix(".part")
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(partial, "w") as new:
        for entry in sorted(old.namelist()):
            info = zipfile.ZipInfo(entry.replace("\\", "/"), EPOCH)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            new.writestr(info, old.read(entry))
    partial.replace(target)


def validate(fmu: Path) -> None:
    """Raise PackageFault with every problem that fmpy's validation finds."""
    problems = fmpy.validation.validate_fmu(str(fmu))
    if problems:
        raise PackageFault(f"{fmu}: " + "; ".join(problems))
