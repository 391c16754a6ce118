"""Cost and memory against pins, rollers, bins of the surfaces and hours, with fitted exponents.

Sizes go from small to well past real ones; the exponent is fitted over the larger half.  Work grows with the
number of contacts and bins, so an exponent above 1 (with a margin for the fit) tells that something grows faster.
"""

import math
from collections.abc import Callable
from dataclasses import replace

from benchmarks.lives import controlled
from benchmarks.ratios import Curve, Figure, Measured, cost, exponent
from orchestrator.coupled import run_pair
from orchestrator.pair import Pair, make_pair
from orchestrator.reducer import Reducer, load_reducer
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


def step_cost(pair: Pair) -> float:
    """One communication step of the pair in compiled code [s]."""
    plant, wear, h = pair.plant.records, pair.wear.records, pair.master.step_size
    run_pair(plant, wear, 2, h)
    return cost(lambda: run_pair(plant, wear, STEPS, h), 3) / STEPS


def grow(found: Measured, what: str, sizes: tuple[int, ...], make: Callable[[int], Reducer]) -> None:
    seconds, memory = [], []
    for size in sizes:
        pair = make_pair(make(size))
        seconds.append((size, step_cost(pair)))
        memory.append((size, float(pair.plant.records.nbytes + pair.wear.records.nbytes)))
    for kind, points, unit in (("cost of a coupled step", seconds, "s"), ("memory of both units", memory, "byte")):
        power = exponent(points)
        found.figures.append(Figure("growth", f"{kind} against {what}, exponent", power, "1", at_most=MOST,
                                    note=f"{what} {sizes[0]} to {sizes[-1]}: {points[0][1]:.3g} to {points[-1][1]:.3g} {unit}"))
        found.curves.append(Curve(f"{kind} against {what}", what, unit, {kind: points}, {kind: power}))


def measure(quick: bool = False) -> Measured:
    found, reducer = Measured(), load_reducer("RV20E-121")
    # Each size is compiled anew, which takes longer than what is measured.
    grow(found, "pins", (20, 40) if quick else (10, 20, 40, 80, 160), lambda n: with_pins(reducer, n))
    if not quick:
        grow(found, "rollers", (8, 16, 32, 64), lambda n: with_rollers(reducer, n))
        grow(found, "bins of a surface", (90, 180, 720, 2880), lambda n: with_bins(reducer, n))
    hours = (100.0, 200.0) if quick else (300.0, 1000.0, 3000.0, 10_000.0, 30_000.0)
    lives = [(h, controlled(make_pair(reducer), h, 0.03)[1]) for h in hours]
    power = exponent(lives)
    found.figures.append(Figure("growth", "cost of a life against hours, exponent", power, "1", at_most=1.0,
                                note=f"{hours[0]:g} to {hours[-1]:g} h: {lives[0][1]:.3g} to {lives[-1][1]:.3g} s"))
    found.curves.append(Curve("cost of a life against hours", "h", "s", {"life": lives}, {"life": power}))
    return found
