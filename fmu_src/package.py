"""Pack a unit as an FMU, byte for byte the same every time, and validate it.

Three flavours: editable (pythonfmu: the Python sources, run by the importer's Python),
native (shared libraries, nothing else needed) and source (C99, no binaries).
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from dataclasses import asdict
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import fmpy
from fmpy.model_description import ValidationError
from fmpy.validation import validate_model_description

from fmu_src.capabilities import declare
from fmu_src.checked_file import replacing
from fmu_src.description import guid, model_description
from fmu_src.description3 import model_description3
from fmu_src.faults import InputFault, RunFault
from fmu_src.link import PLATFORMS, Platform, host_platform, library_of_sources, shared_library, universal
from fmu_src.manifest import with_manifest
from fmu_src.native import host_triple, object_code, object_codes
from fmu_src.presentation import files_for_people
from fmu_src.project import project
from fmu_src.reading import reading
from fmu_src.slaves.kernel_slave import OBJECT_CODE
from fmu_src.source_code import declare_sources, kernels_source, source_files
from fmu_src.source_hash import KERNEL_PACKAGES, ROOT, STAMP, source_hash, user_effect_files
from fmu_src.unit import Specification, Unit, make_unit
from fmu_src.unit_table import c_source
from fmu_src.wasm.component import component
from fmu_src.wasm.linking import TRIPLE, core_module

# pythonfmu's builder writes its own defaults over the description unless told so.
CAPABILITIES = ("--no-external-tool", "--handle-state", "--serialize-state")
# The earliest time a zip archive can hold.
EPOCH = (1980, 1, 1, 0, 0, 0)
VERSIONS = {"2": "2.0", "3": "3.0"}


class PackageFault(RunFault):
    """An FMU that does not validate."""


def stamp_of(specification: Specification, step_size: float, tool: str, flavour: str) -> dict[str, Any]:
    """What this project writes into its FMUs, to know them again."""
    code_hash = source_hash()
    return {
        "specification": specification, "source_hash": code_hash, "guid": guid(specification, code_hash),
        "triple": host_triple(), "step_size": step_size, "tool": tool, "flavour": flavour, "made_by": asdict(project()),
    }  # fmt: skip


def build_fmu(
    name: str, specification: Specification, step_size: float, tool: str, target: Path, code: bytes | None = None
) -> Path:
    """Build ``target``/``name``.fmu (FMI 2.0, pythonfmu) from a unit's specification.

    ``step_size`` [s] is the default experiment's.  The FMU carries the sources, so it
    can be edited, and their object code for this machine (``code``, made here unless
    given), so it starts at once.
    """
    stamp = stamp_of(specification, step_size, tool, "python")
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        script = folder / f"{name}_slave.py"
        shutil.copy(ROOT / "fmu_src" / "slaves" / script.name, script)
        for package in KERNEL_PACKAGES:
            shutil.copytree(ROOT / package, folder / package, ignore=shutil.ignore_patterns("__pycache__"))
            for place, file in user_effect_files(package):
                shutil.copy(file, folder / place)
        (folder / STAMP).write_bytes(stamp_bytes(stamp))
        (folder / OBJECT_CODE).write_bytes(code or object_code(specification))
        contents = [folder / package for package in KERNEL_PACKAGES] + [folder / STAMP, folder / OBJECT_CODE]
        # In a process of its own: pythonfmu imports the slave and leaves it in sys.modules.
        command: list[str | Path] = [
            sys.executable, "-m", "pythonfmu", "build", "-f", script, "-d", folder / "raw", *CAPABILITIES, *contents,
        ]  # fmt: skip
        done = subprocess.run(command, cwd=folder, capture_output=True, encoding="utf-8", errors="replace")
        if done.returncode != 0:
            raise PackageFault(f"pythonfmu could not pack {name}: {done.stderr.strip()}")
        with zipfile.ZipFile(folder / "raw" / f"{name}.fmu") as raw:
            files = {entry.replace("\\", "/"): raw.read(entry) for entry in raw.namelist()}
    files |= files_for_people(make_unit(specification).table, "2.0", stamp["guid"], project())
    return write_archive(files, target / f"{name}.fmu")


def build_native(
    name: str, specification: Specification, step_size: float, tool: str, target: Path,
    versions: tuple[str, ...] = tuple(VERSIONS), all_platforms: bool = False, codes: dict[str, bytes] | None = None, wasm: bool = False,
) -> list[Path]:  # fmt: skip
    """Build ``target``/fmi2/``name``.fmu and ``target``/fmi3/``name``.fmu, which need no Python.

    ``codes`` is object code by LLVM triple; made here unless given.  With ``wasm`` those of FMI 3.0 have a WebAssembly
    component besides.
    """
    stamp = stamp_of(specification, step_size, tool, "native")
    unit = make_unit(specification)
    codes = codes or object_codes(specification, triples_for(all_platforms, wasm))
    platforms = tuple(PLATFORMS.values()) if all_platforms else (host_platform(),)
    table = c_source(unit, stamp["guid"])
    libraries = {p: shared_library(name, table, codes[p.triple], p, all_platforms) for p in platforms}
    made = []
    for version in versions:
        folders = folders2 if version == "2" else folders3
        files = described(described_unit(unit, stamp, version), unit, stamp, version)
        files |= {f"binaries/{folder}/{name}{suffix}": data for (folder, suffix), data in folders(libraries).items()}
        if wasm and version == "3":
            files |= wasm_files(name, table, codes[TRIPLE])
        made.append(write_archive(files, target / f"fmi{version}" / f"{name}.fmu"))
    return made


def build_source(
    name: str, specification: Specification, step_size: float, tool: str, target: Path, versions: tuple[str, ...] = tuple(VERSIONS)
) -> list[Path]:
    """Build ``target``/source/fmi2/``name``.fmu and ``target``/source/fmi3/``name``.fmu: C99 and no binaries."""
    stamp = stamp_of(specification, step_size, tool, "source")
    unit = make_unit(specification)
    kernels = kernels_source(unit)
    made = []
    for version in versions:
        root = described_unit(unit, stamp, version)
        if version == "2":
            declare_sources(root)
        files = described(root, unit, stamp, version) | source_files(unit, kernels, stamp["guid"], version)
        made.append(write_archive(files, target / "source" / f"fmi{version}" / f"{name}.fmu"))
    return made


def compile_sources(fmu: Path, target: Path) -> Path:
    """Write an FMU of sources with this machine's library besides, by the C compiler that is here."""
    with reading(fmu, "an FMU"):
        with zipfile.ZipFile(fmu) as archive:
            files = {entry: archive.read(entry) for entry in archive.namelist()}
        if "sources/all.c" not in files:
            raise InputFault(f"{fmu} has no sources/all.c; build one that has: rvwear build --flavour source")
        description = fmpy.read_model_description(str(fmu))
    name, here = description.coSimulation.modelIdentifier, host_platform()
    library = library_of_sources({Path(n).name: data for n, data in files.items() if n.startswith("sources/")}, name, here)
    folder = here.fmi2_folder if description.fmiVersion == "2.0" else here.name
    return write_archive(files | {f"binaries/{folder}/{name}{here.suffix}": library}, target)


def described_unit(unit: Unit, stamp: dict[str, Any], version: str) -> Element:
    """The model description of a native unit or one of sources."""
    describe = model_description if version == "2" else model_description3
    root = describe(unit.table, stamp["guid"], stamp["source_hash"], stamp["step_size"], stamp["tool"], project())
    declare(root, version, unit)
    return root


def described(root: Element, unit: Unit, stamp: dict[str, Any], version: str) -> dict[str, bytes]:
    """What an FMU has besides sources and binaries."""
    ElementTree.indent(root)
    files = {
        "modelDescription.xml": bytes(ElementTree.tostring(root, "utf-8", xml_declaration=True)),
        f"resources/{STAMP}": stamp_bytes(stamp),
    }
    return files | files_for_people(unit.table, VERSIONS[version], stamp["guid"], project())


def wasm_files(name: str, table: str, code: bytes) -> dict[str, bytes]:
    """What the draft FMI-LS-WASM adds to an FMU: the component, and the layered standard's manifest."""
    return {f"binaries/wasm32-wasip2/{name}.wasm": component(core_module(name, table, code)), "extra/org.modelica.fmi-ls-wasm/manifest.xml": LAYER}


LAYER = b"""<?xml version="1.0" encoding="UTF-8"?>
<fmiLayeredStandardManifest xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest" fmi-ls:fmi-ls-name="org.modelica.fmi-ls-wasm"
  fmi-ls:fmi-ls-version="0.1.0" fmi-ls:fmi-ls-description="FMI Layered Standard for WebAssembly"/>
"""


def triples_for(all_platforms: bool, wasm: bool = False) -> tuple[str, ...]:
    """LLVM triples of everything that is built: this machine as llvmlite names it, and the platforms."""
    platforms = PLATFORMS.values() if all_platforms else (host_platform(),)
    return tuple(dict.fromkeys((host_triple(), *(p.triple for p in platforms), *([TRIPLE] if wasm else []))))


def folders2(libraries: dict[Platform, bytes]) -> dict[tuple[str, str], bytes]:
    """Libraries by FMI 2.0 folder; Darwin has one for both processors."""
    joined: dict[tuple[str, str], list[bytes]] = {}
    for p, library in libraries.items():
        joined.setdefault((p.fmi2_folder, p.suffix), []).append(library)
    return {place: parts[0] if len(parts) == 1 else universal(parts) for place, parts in joined.items()}


def folders3(libraries: dict[Platform, bytes]) -> dict[tuple[str, str], bytes]:
    return {(p.name, p.suffix): library for p, library in libraries.items()}


def stamp_bytes(stamp: dict[str, Any]) -> bytes:
    return json.dumps(stamp, sort_keys=True, indent=1).encode()


def write_archive(files: dict[str, bytes], target: Path) -> Path:
    """The FMU, its manifest included: sorted names and fixed times, so that equal contents give equal bytes."""
    files = with_manifest(files)
    with replacing(target) as partial, zipfile.ZipFile(partial, "w") as archive:
        for name in sorted(files):
            info = zipfile.ZipInfo(name, EPOCH)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
            archive.writestr(info, files[name])
    return target


def validate(fmu: Path) -> None:
    """Raise PackageFault with every problem that fmpy's validation finds."""
    try:
        description = fmpy.read_model_description(str(fmu), validate_model_structure=True)
    except ValidationError as fault:
        raise PackageFault(f"{fmu}: " + "; ".join(fault.problems)) from None
    # Names that differ in numbers alone are built alike; parsing every element of every array takes ten seconds.
    alike = {re.sub(r"\d+", "1", v.name): v for v in description.modelVariables}
    new = set(alike) - _good_names
    # A description without time would be a fault of its own.
    description.modelVariables = [v for pattern, v in alike.items() if pattern in new or v.causality == "independent"]
    problems = validate_model_description(description, validate_variable_names=True)
    if problems:
        raise PackageFault(f"{fmu}: " + "; ".join(problems))
    _good_names.update(new)


# Flavours of one unit share theirs.
_good_names: set[str] = set()
