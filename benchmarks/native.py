"""Native FMUs: start, cost per communication step, many instances; beside pythonfmu and the kernels in process.

    .venv/bin/python benchmarks/native.py [--reducer NAME]

Times are the smallest of several runs, side by side in one run: read them as ratios.
Starts are taken in fresh processes, from the call that loads the unpacked FMU to the end
of the first step; the importer (fmpy) is loaded before.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from time import perf_counter
from typing import Any

from benchmarks import memory
from fmu_src.native import host_triple, object_codes
from fmu_src.package import build_fmu, build_native, triples_for
from orchestrator.fmu import Fmu
from reducers.reducer import load_reducer
from studies.pair import Pair, make_pair

UNITS = {"RvPlant": "rv_plant", "RvWear": "wear_fmu"}

# With fmpy's own classes: the FMU's cost, not our component's.
START = """
import sys, time
import fmpy.fmi2, fmpy.fmi3
folder, name, identity, version = sys.argv[1:]
start = time.perf_counter()
kind = fmpy.fmi3.FMU3Slave if version == "fmi3" else fmpy.fmi2.FMU2Slave
for attempt in range(2):
    unit = kind(guid=identity, modelIdentifier=name, unzipDirectory=folder, instanceName=str(attempt))
    unit.instantiate()
    if version != "fmi3":
        unit.setupExperiment()
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    unit.doStep(0.0, 1e-3)
    print(time.perf_counter() - start)
    start = time.perf_counter()
"""


def start_times(fmu: Path, version: str) -> tuple[float, float]:
    """(first, second instance) from loading to the end of the first step [s], smallest of five processes."""
    unit = Fmu("unit", fmu)
    identity = unit.description.guid or unit.description.instantiationToken
    times = []
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(folder)
        for _ in range(5):
            done = subprocess.run(
                [sys.executable, "-c", START, folder, fmu.stem, identity, version], capture_output=True, text=True, check=True
            )
            times.append(tuple(map(float, done.stdout.split())))
    unit.close()
    return min(t[0] for t in times), min(t[1] for t in times)


def step_times(pairs: dict[str, Pair], rounds: int = 60, steps: int = 100) -> dict[str, float]:
    """One communication step of each pair, all contacts exchanged [s]; in turns, so that all see the same machine."""
    times = {name: float("inf") for name in pairs}
    for _ in range(rounds):
        for name, pair in pairs.items():
            start = perf_counter()
            pair.master.run(steps)
            times[name] = min(times[name], (perf_counter() - start) / steps)
    return times


def memory_mb() -> float:
    """Resident memory of this process now."""
    return memory.present() / 1e6


def many_instances(fmu: Path) -> dict[str, float]:
    """Instances of one library one after the other, and at once; each initialised and stepped."""

    def one(unit: Fmu) -> Any:
        unit.calls.instantiate()
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        unit.step(0.0, 1e-3)
        return unit.slave.component

    def free(unit: Fmu, component: Any) -> None:
        unit.slave.component = component
        unit.slave.fmi2FreeInstance(component)

    unit = Fmu("many", fmu)
    first = unit.slave.component
    for _ in range(20):
        free(unit, one(unit))
    before, start = memory_mb(), perf_counter()
    for _ in range(1000):
        free(unit, one(unit))
    seconds, after = perf_counter() - start, memory_mb()
    together = []
    for _ in range(50):
        together.append(one(unit))
    most = memory_mb()
    for component in together:
        free(unit, component)
    unit.slave.component = first
    unit.close()
    return {
        "thousand_instances_s": seconds, "thousand_instances_grew_by_mb": after - before,
        "fifty_at_once_took_mb_each": (most - after) / 50, "grew_after_those_by_mb": memory_mb() - before,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reducer", default="RV20E-121")
    reducer = load_reducer(parser.parse_args().reducer)
    figures: dict[str, str | float] = {"reducer": reducer.name}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, unit in UNITS.items():
            specification = reducer.specification(unit)
            start = perf_counter()
            codes = object_codes(specification, triples_for(False))
            figures[f"{name}_kernels_to_objects_s"] = perf_counter() - start
            start = perf_counter()
            made = build_native(name, specification, 1e-3, "benchmark", folder, codes=codes)
            figures[f"{name}_link_and_pack_s"] = perf_counter() - start
            build_fmu(name, specification, 1e-3, "benchmark", folder, codes[host_triple()])
            with zipfile.ZipFile(made[0]) as archive:
                library = next(i for i in archive.infolist() if i.filename.startswith("binaries/"))
            figures[f"{name}_library_kb"] = library.file_size / 1e3
        flavours = {"native_fmi2": folder / "fmi2", "native_fmi3": folder / "fmi3", "pythonfmu": folder}
        for flavour, place in flavours.items():
            for name in UNITS:
                first, second = start_times(place / f"{name}.fmu", place.name)
                figures[f"{flavour}_{name}_start_ms"] = 1e3 * first
                figures[f"{flavour}_{name}_second_instance_ms"] = 1e3 * second
        pairs = {"in_process": make_pair(reducer)} | {k: make_pair(reducer, fmus=v) for k, v in flavours.items()}
        times = step_times(pairs)
        for flavour, pair in pairs.items():
            figures[f"{flavour}_pair_step_us"] = 1e6 * times[flavour]
            figures[f"{flavour}_over_in_process"] = times[flavour] / times["in_process"]
            pair.master.close()
        for name in UNITS:
            figures |= {f"{name}_{k}": v for k, v in many_instances(folder / "fmi2" / f"{name}.fmu").items()}
    print(json.dumps(figures, indent=1))


if __name__ == "__main__":
    main()
