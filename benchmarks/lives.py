"""Lives of 10,000 h: error control against fixed segments and against stepping through every cycle.

Cost is processor time of the run alone, units loaded.  Error is that of the deepest wear of each kind of
surface at the end, the worst of them, against a life at a tolerance of 0.03 %.
"""

import math
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import process_time

import numpy as np

from benchmarks.ratios import Curve, Figure, Measured, Ratio, cost_at
from fmu_src.package import build_native
from orchestrator.settings import Setting
from reducers.reducer import Reducer, load_reducer
from rv_plant.faults import DYNAMIC
from studies.coupled_master import CoupledMaster
from studies.life import Life, LifeSettings, live
from studies.meshing_cycle import HOUR, run_cycle
from studies.pair import Pair, make_pair
from studies.wear_figures import depths

TOLERANCE = 0.01
TOLERANCES = (0.1, 0.03, TOLERANCE, 0.003)
REFERENCE_TOLERANCE = 0.0003
# Hours of a fixed segment, from the one used in the literature to one finer.
SEGMENTS = (2000.0, 500.0, 100.0)
PUBLISHED_FACTOR = 4000.0
# Cycles stepped one by one, from which all are extrapolated.
MEASURED_CYCLES = 10


def in_process(reducer: Reducer) -> Pair:
    """As ``rvwear life`` runs it."""
    return make_pair(reducer, master_kind=CoupledMaster)


def in_motion(reducer: Reducer) -> Pair:
    """Bodies in motion with the reducer's own damping."""
    return make_pair(reducer, [Setting("fidelity", DYNAMIC)], master_kind=CoupledMaster)


def timed(function: Callable[[], object]) -> float:
    begun = process_time()
    function()
    return process_time() - begun


def controlled(pair: Pair, hours: float, tolerance: float) -> tuple[np.ndarray, float]:
    """(depths at the end [um], seconds)."""
    settings = LifeSettings(hours, tolerance)
    seconds = timed(lambda: live(pair, Life(settings), lambda _: None, lambda _: None))
    return depths(pair), seconds


def segments(pair: Pair, hours: float, length: float) -> tuple[np.ndarray, float]:
    """The same life in equal segments, each one meshing cycle at the rate of its start."""
    count = max(1, round(hours / length))

    def run() -> None:
        for _ in range(count):
            run_cycle(pair, hours / count)

    seconds = timed(run)
    return depths(pair), seconds


def every_cycle(pair: Pair, hours: float) -> tuple[float, float]:
    """(seconds for all cycles of a life, extrapolated from some; how many there are)."""
    steps = pair.reducer.topology.lobes * pair.positions
    pair.wear.set("acceleration", 1.0)
    seconds = min(timed(lambda: pair.master.run(steps)) for _ in range(MEASURED_CYCLES))
    cycles = hours * HOUR / (steps * pair.master.step_size)
    return seconds * cycles, cycles


def error_of(found: np.ndarray, reference: np.ndarray) -> float:
    return float(np.max(np.abs(found - reference) / reference))


def through_native(reducer: Reducer, hours: float) -> tuple[np.ndarray, float] | None:
    """The same life through native FMUs of FMI 2.0; None without a C compiler."""
    from fmu_src.native import NativeFault

    with tempfile.TemporaryDirectory() as folder:
        try:
            for name, unit in (("RvPlant", "rv_plant"), ("RvWear", "wear_fmu")):
                build_native(name, reducer.specification(unit), 1e-3, "benchmark", Path(folder), ("2",))
        except NativeFault:
            return None
        pair = make_pair(reducer, fmus=Path(folder) / "fmi2")
        found = controlled(pair, hours, TOLERANCE)
        pair.master.close()
    return found


def measure(quick: bool = False) -> Measured:
    found = Measured()
    for name in ("RV20E-121",) if quick else ("RV20E-121", "BX-40E"):
        measure_one(found, name, quick)
    return found


def measure_one(found: Measured, name: str, quick: bool) -> None:
    hours = 400.0 if quick else 10_000.0
    reducer = load_reducer(name)
    work = f"{name}, {hours:,.0f} h"
    reference, _ = controlled(in_process(reducer), hours, TOLERANCE / 3.0 if quick else REFERENCE_TOLERANCE)
    ours = []
    for tolerance in (TOLERANCE,) if quick else TOLERANCES:
        runs = [controlled(in_process(reducer), hours, tolerance) for _ in range(2 if tolerance == TOLERANCE else 1)]
        ours.append((tolerance, error_of(runs[0][0], reference), min(s for _, s in runs)))
    _, error, seconds = next(row for row in ours if row[0] == TOLERANCE)
    fixed = []
    for length in SEGMENTS[1:] if quick else SEGMENTS:
        end, spent = segments(in_process(reducer), hours, min(length, hours / 2))
        fixed.append((error_of(end, reference), spent))
        if length in SEGMENTS:
            found.ratios.append(Ratio("life", work, f"fixed segments of {length:g} h", seconds, spent,
                                      f"ours {error:.2%}, segments {fixed[-1][0]:.2%}",
                                      note="not at equal error"))
    equal = cost_at(fixed, error)
    found.ratios.append(Ratio("life", work, "fixed segments as short as our error needs", seconds, equal,
                              f"both {error:.2%}", note="" if math.isfinite(equal) else "finer than 100 h"))
    stepping, cycles = every_cycle(in_process(reducer), hours)
    found.ratios.append(Ratio("life", work, "stepping through every meshing cycle", seconds, stepping, f"ours {error:.2%}",
                              PUBLISHED_FACTOR, note=f"extrapolated: {cycles:.3g} cycles from {MEASURED_CYCLES}"))
    found.figures.append(Figure("life", f"{work}, in process, error control at {TOLERANCE:.0%}", seconds, "s",
                                at_most=5.0, note=f"error {error:.2%}"))
    if not quick:
        moved, seconds = controlled(in_motion(reducer), hours, TOLERANCE)
        finer, _ = controlled(in_motion(reducer), hours, TOLERANCE / 10.0)
        found.figures.append(Figure("life", f"{work}, in motion, error control at {TOLERANCE:.0%}", seconds, "s", at_most=60.0,
                                    note=f"{error_of(moved, finer):.2%} from a life at a tenth of the tolerance"))
    native = through_native(reducer, hours)
    if native is not None:
        found.figures.append(Figure("life", f"{work}, native FMUs", native[1], "s", at_most=10.0,
                                    note=f"error {error_of(native[0], reference):.2%}"))
    found.curves.append(Curve(f"Life of the {name}: cost against error", "error of the deepest wear", "s", {
        "error control": [(e, s) for _, e, s in ours], "fixed segments": fixed,
    }))
