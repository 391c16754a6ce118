"""Cost and memory against pins, rollers, bins of the surfaces, hours and lives, with fitted exponents.

Sizes go from small to well past real ones; the exponent is fitted over the larger half.  Work grows with the
number of contacts and bins, so an exponent above 1 (with a margin for the fit) tells that something grows faster.
"""

import math
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks import memory
from benchmarks.lives import in_process, timed
from benchmarks.many import TEXT
from benchmarks.ratios import Curve, Figure, Measured, cost, exponent
from orchestrator.component import Component, InProcess
from reducers.reducer import Reducer, load_reducer
from studies.coupled import run_pair
from studies.ensemble.ensemble_file import load_ensemble
from studies.ensemble.member import run
from studies.ensemble.sampling import tasks_of
from studies.ensemble.store import Store
from studies.life import Life, LifeSettings, live
from studies.pair import Pair, make_pair
from wear_fmu.variables import Resolution

# The fit's margin; caches of the processor overflow with size.
MOST = 1.2
STEPS = 150


def with_pins(reducer: Reducer, pins: int) -> Reducer:
    """Eccentricity and pins shrink with their number, so that the profile keeps its shape."""
    share = reducer.topology.pins / pins
    scaled = {k: reducer.starts[k] * share for k in ("eccentricity", "pin_radius")}
    return replace(reducer, topology=replace(reducer.topology, pins=pins, lobes=pins - 1), starts=reducer.starts | scaled)


def with_rollers(reducer: Reducer, rollers: int) -> Reducer:
    """Rollers thin enough to fit side by side in the same inner race."""
    radius = min(reducer.starts["roller_radius"], 0.8 * math.pi * reducer.starts["inner_race_radius"] / rollers)
    races = {"roller_radius": radius, "outer_race_radius": reducer.starts["inner_race_radius"] + 2.0 * radius}
    return replace(reducer, topology=replace(reducer.topology, rollers=rollers), starts=reducer.starts | races)


def with_bins(reducer: Reducer, bins: int) -> Reducer:
    return replace(reducer, resolution=Resolution(bins, bins, 2 * bins))


def records_of(unit: Component) -> np.ndarray:
    assert isinstance(unit, InProcess)
    return unit.records


def step_cost(pair: Pair) -> float:
    """One communication step of the pair in compiled code [s]."""
    plant, wear, h = records_of(pair.plant), records_of(pair.wear), pair.master.step_size
    run_pair(plant, wear, 2, h)
    return cost(lambda: run_pair(plant, wear, STEPS, h), 3) / STEPS


def grow(found: Measured, what: str, sizes: tuple[int, ...], make: Callable[[int], Reducer]) -> None:
    seconds, memory = [], []
    for size in sizes:
        pair = make_pair(make(size))
        seconds.append((size, step_cost(pair)))
        memory.append((size, float(records_of(pair.plant).nbytes + records_of(pair.wear).nbytes)))
    for kind, points, unit in (("cost of a coupled step", seconds, "s"), ("memory of both units", memory, "byte")):
        note(found, kind, what, unit, points, MOST)


def note(found: Measured, kind: str, what: str, unit: str, points: Sequence[tuple[float, float]], most: float) -> None:
    """Figure and curve of what is known for each size."""
    power = exponent(points)
    found.figures.append(Figure("growth", f"{kind} against {what}, exponent", power, "1", at_most=most,
                                note=f"{what} {points[0][0]:g} to {points[-1][0]:g}: {points[0][1]:.3g} to {points[-1][1]:.3g} {unit}"))
    found.curves.append(Curve(f"{kind} against {what}", what, unit, {kind: list(points)}, {kind: power}))


def lives(found: Measured, reducer: Reducer, hours: tuple[float, ...]) -> None:
    """Cost of a life at 3 %, and what its recorded hours hold."""
    seconds, memory = [], []
    for h in hours:
        life, pair = Life(LifeSettings(h, 0.03)), in_process(reducer)
        seconds.append((h, timed(lambda: live(pair, life, lambda _: None, lambda _: None))))
        arrays = [a for rows in (life.surfaces, [turn.series for turn in life.turns]) for row in rows for a in row.values()]
        memory.append((h, float(sum(a.nbytes for a in arrays))))
    note(found, "cost of a life", "hours", "s", seconds, 1.0)
    note(found, "memory of a life's records", "hours", "byte", memory, 1.0)


def ensembles(found: Measured, sizes: tuple[int, ...]) -> None:
    """Cost of an ensemble in this process, bytes of its file of finished lives, and memory that the process gained."""
    with tempfile.TemporaryDirectory() as temporary:
        (file := Path(temporary) / "e.toml").write_text(TEXT)
        tasks = tasks_of(load_ensemble(file, max(sizes)))
        run(tasks[0])
        seconds, size, peak = [], [], []
        for count in sizes:
            store = Store(Path(temporary) / f"{count}.lives", {})
            seconds.append((count, timed(lambda: [store.add(run(task)) for task in tasks[:count]])))
            size.append((count, float(store.path.stat().st_size)))
            peak.append((count, memory.most()))
    note(found, "cost of an ensemble", "lives", "s", seconds, MOST)
    note(found, "file of finished lives", "lives", "byte", size, MOST)
    note(found, "most memory of the process", "lives", "byte", peak, MOST)


def measure(quick: bool = False) -> Measured:
    found, reducer = Measured(), load_reducer("RV20E-121")
    # Each size is compiled anew, which takes longer than what is measured.
    grow(found, "pins", (20, 40) if quick else (10, 20, 40, 80, 160), lambda n: with_pins(reducer, n))
    if not quick:
        grow(found, "rollers", (8, 16, 32, 64), lambda n: with_rollers(reducer, n))
        grow(found, "bins of a surface", (90, 180, 720, 2880), lambda n: with_bins(reducer, n))
    lives(found, reducer, (100.0, 200.0) if quick else (300.0, 1000.0, 3000.0, 10_000.0, 30_000.0))
    ensembles(found, (1, 2) if quick else (2, 4, 8, 16))
    return found
