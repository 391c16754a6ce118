"""Building the FMUs of a reducer, and what of them is up to date."""

import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import fmpy

from fmu_src.description import guid
from fmu_src.faults import InputFault
from fmu_src.held_file import held
from fmu_src.link import compiler, host_platform
from fmu_src.native import NativeFault, host_triple, object_codes
from fmu_src.package import VERSIONS, build_fmu, build_native, build_source, triples_for, validate
from fmu_src.progress import task
from fmu_src.project import NAME, project
from fmu_src.reading import reading
from fmu_src.references import MANIFEST
from fmu_src.source_hash import source_hash
from fmu_src.wasm.linking import require_zig
from orchestrator.component import InProcess
from orchestrator.ssp.exporter import Experiment, export_ssp
from reducers.reducer import Reducer
from studies.pair import CONNECTIONS, POSITIONS_PER_TURN, crank_turn_time
from studies.reference_material import add_references

UNITS = {"RvPlant": "rv_plant", "RvWear": "wear_fmu", "RvReducer": "rv_reducer"}


@dataclass(frozen=True)
class Wanted:
    """Which FMUs: ``flavour`` python, native, both or source; ``fmi`` 2, 3 or both; for all platforms or this one.

    ``inline`` packages have their values in the system's description instead of files beside the FMUs; ``wasm``
    gives native FMUs of FMI 3.0 a WebAssembly component besides.
    """

    flavour: str = "both"
    fmi: str = "both"
    all_platforms: bool = False
    inline: bool = False
    wasm: bool = False


def build_units(reducer: Reducer, folder: Path, wanted: Wanted = Wanted()) -> tuple[list[dict[str, Any]], list[Path]]:
    """(one entry per FMU, SSP packages): FMUs of both units and of the unit of both, validated; those that are up to date stay.

    InputFault if another process builds there: a package must not hold units of two reducers.
    """
    with held(folder / "FMUs"):
        return built_units(reducer, folder, wanted)


def built_units(reducer: Reducer, folder: Path, wanted: Wanted) -> tuple[list[dict[str, Any]], list[Path]]:
    if wanted.flavour == "source":
        return build_sources(reducer, folder, wanted), []
    plant = InProcess("plant", reducer.specification("rv_plant"))
    step = crank_turn_time(reducer, plant) / POSITIONS_PER_TURN
    tool = tool_name()
    native = native_versions(wanted)
    built: list[dict[str, Any]] = []
    for name, unit in UNITS.items():
        specification = reducer.specification(unit)
        identity = guid(specification, source_hash())
        editable = folder / f"{name}.fmu"
        ours = [folder / f"fmi{version}" / f"{name}.fmu" for version in native]
        stale = [path for path in ours if not is_current(path, identity, wanted.all_platforms, wanted.wasm and path.parent.name == "fmi3")]
        paths = ([] if wanted.flavour == "native" else [editable]) + ours
        if editable in paths and not is_current(editable, identity):
            stale.append(editable)
        if stale:
            with task(f"packing {name}"):
                codes = object_codes(specification, triples_for(wanted.all_platforms, wanted.wasm))
                if editable in stale:
                    build_fmu(name, specification, step, tool, folder, codes[host_triple()])
                if versions := tuple(v for v, path in zip(native, ours) if path in stale):
                    build_native(name, specification, step, tool, folder, versions, wanted.all_platforms, codes, wanted.wasm)
                add_references(stale, reducer, unit, step)
        for path in paths:
            validate(path)
            entry = {"fmu": str(path), "bytes": path.stat().st_size, "built": path in stale, "problems": 0}
            built.append(entry | {"flavour": "python" if path == editable else "native"})
    places = dict.fromkeys(Path(entry["fmu"]).parent for entry in built)
    return built, [export_pair(reducer, place, step, tool, wanted.inline) for place in places]


def build_sources(reducer: Reducer, folder: Path, wanted: Wanted) -> list[dict[str, Any]]:
    """FMUs of C99 and no binaries, validated; those that are up to date stay."""
    step = crank_turn_time(reducer, InProcess("plant", reducer.specification("rv_plant"))) / POSITIONS_PER_TURN
    built: list[dict[str, Any]] = []
    for name, unit in UNITS.items():
        specification = reducer.specification(unit)
        identity = guid(specification, source_hash())
        paths = {version: folder / "source" / f"fmi{version}" / f"{name}.fmu" for version in versions_of(wanted)}
        stale = tuple(version for version, path in paths.items() if not is_current(path, identity))
        if stale:
            with task(f"writing the sources of {name}"):
                build_source(name, specification, step, tool_name(), folder, stale)
                add_references([paths[version] for version in stale], reducer, unit, step)
        for version, path in paths.items():
            validate(path)
            built.append({"fmu": str(path), "bytes": path.stat().st_size, "built": version in stale, "problems": 0, "flavour": "source"})
    return built


def tool_name() -> str:
    return f"{NAME} {project().version}"


def versions_of(wanted: Wanted) -> tuple[str, ...]:
    return tuple(VERSIONS) if wanted.fmi == "both" else (wanted.fmi,)


def native_versions(wanted: Wanted) -> tuple[str, ...]:
    """FMI versions of the native FMUs to build; none if nobody asked for them and there is no C compiler."""
    if wanted.flavour == "python":
        return ()
    try:
        compiler(host_platform(), wanted.all_platforms)
        if wanted.wasm:
            require_zig()
    except NativeFault as fault:
        if wanted.flavour == "native" or wanted.all_platforms or wanted.wasm:
            raise InputFault(str(fault)) from None
        print(f"no native FMUs: {fault}", file=sys.stderr)
        return ()
    return versions_of(wanted)


def is_current(path: Path, identity: str, all_platforms: bool = False, wasm: bool = False) -> bool:
    """Whether an FMU of this identity, version and licence, for all platforms and as WebAssembly if need be, is there already."""
    if not path.exists():
        return False
    try:
        with reading(path, "an FMU"):
            description = fmpy.read_model_description(str(path))
    except InputFault:
        # Damaged, or something else: it is built anew.
        return False
    known = description.guid if description.fmiVersion == "2.0" else description.instantiationToken
    makers = project().attributes(source_hash())
    if known != identity or any(getattr(description, name) != value for name, value in makers.items()):
        return False
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
    if wasm and not any(name.endswith(".wasm") for name in names):
        return False
    libraries = [name for name in names if name.startswith("binaries/") and not name.endswith(".wasm")]
    # Four folders in FMI 2.0, where Darwin has one library for both processors.
    return MANIFEST in names and (not all_platforms or len(libraries) >= 4)


def export_pair(reducer: Reducer, folder: Path, step: float, tool: str = "rvwear", inline: bool = False) -> Path:
    """Write RvReducer.ssp, the pair through one crank turn, beside its FMUs; SSP 1.0 of FMI 2 units, 2.0 of FMI 3 units."""
    return export_ssp(
        folder / "RvReducer.ssp", "RvReducer", {"plant": folder / "RvPlant.fmu", "wear": folder / "RvWear.fmu"},
        CONNECTIONS, Experiment(step, POSITIONS_PER_TURN * step), {}, f"RV reducer {reducer.name} and its wear", tool, inline,
    )  # fmt: skip
