"""What to do where the measured reducer is stiffer than the model by a factor, which no effect makes it, or softer than one on rigid supports."""

from collections.abc import Container, Mapping, Sequence

import numpy as np

from discrepancy.figures.key_figures import CLEARLY, SOFTER, STIFFNESS, KeyFigure
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.units import Condition

SUPPORTS = ("crank_seat_compliance", "carrier_seat_compliance", "carrier_twist_compliance", "ring_seat_compliance", "tooth_compliance")
# Of the rated torque; of the compliance that a file gives, where a support hardly yields.
FROM, TO, HARDLY = 0.5, 1.0, 1e-3
# End of the names of library reducers whose supports do not yield; the same reducer with supports has the name without it.
RIGID = "-rigid"


def out_of_reach(figures: Sequence[KeyFigure], bench: Bench) -> str:
    """Where no spring of the base, anywhere in its range, makes the model nearly as stiff as what was measured: what there is to do, else empty."""
    if not (times := times_as_stiff(figures)):
        return ""
    ranges = bench.reducer.ranges
    stiffest = times_with(bench, {name: ranges[name][0] for name in SUPPORTS if name in ranges})
    return too_soft(figures, bench)[0] if float(np.median(times)) > SOFTER * stiffest else ""


def times_as_stiff(figures: Sequence[KeyFigure]) -> list[float]:
    """Measured torsional stiffness over the model's, of conditions where it is clearly larger by a factor."""
    return [f.measured / f.model for f in figures if f.name == STIFFNESS and f.off > CLEARLY and f.measured > SOFTER * f.model > 0.0]


def too_soft(figures: Sequence[KeyFigure], bench: Bench) -> list[str]:
    """Stiffer supports, as far as these go; beyond, what else makes a reducer seem stiff."""
    if not (times := times_as_stiff(figures)):
        return []
    measured, most = float(np.median(times)), times_with(bench, {name: HARDLY * bench.starts[0][name] for name in SUPPORTS})
    first = f"the measured reducer is {measured:.2g} times as stiff as the model: effects add springs, none takes one away, so none can be named from here"
    if measured > most:
        beyond = f"with supports that do not yield the model is {most:.2g} times as stiff:" if most > 1.01 else "its supports do not yield:"
        return [f"{first}; {beyond} look at the units of torque and turning, and whether the torque is that of the output"]
    return [
        f"{first}; take a reducer file with stiffer supports (crank.support_compliance, carrier.compliance, housing.compliance ...; the library's"
        f" RV20E-121-rigid and BX-40E-rigid have none, and this reducer without would be {most:.2g} times as stiff)"
    ]


def too_rigid(figures: Sequence[KeyFigure], bench: Bench, library: Container[str]) -> list[str]:
    """Of a diagnosis that leaves something: supports that yield and friction belong to the base; one spring, or one seat with memory, that stands for all of
    them takes what a part that is off makes of the loops, and beside it that part does not show."""
    times = [f.model / f.measured for f in figures if f.name == STIFFNESS and f.off < -CLEARLY and f.model > SOFTER * f.measured > 0.0]
    if not times or any(bench.starts[0][name] for name in SUPPORTS):
        return []
    soft = bench.reducer.name.removesuffix(RIGID)
    known = soft != bench.reducer.name and soft in library
    own = "a reducer file with crank.support_compliance, carrier.compliance, housing.compliance and mesh.friction"
    take = f"{soft} of the library" if known else own
    return [
        f"the measured reducer is {float(np.median(times)):.2g} times as soft as the model, whose supports do not yield: before parts are looked for, begin"
        f" with a base that yields and rubs as real ones do (take {take}, and diagnose again); one effect that stands for all springs and friction here"
        " hides what a part that is off makes of the same curves"
    ]


def times_with(bench: Bench, supports: Mapping[str, float]) -> float:
    """Torsional stiffness with other compliances of the supports, over that of the model."""
    torques = bench.rated_load * np.array([FROM, TO])
    rated = Condition(bench.rated_speed, bench.rated_load)
    soft, stiff = (np.diff(bench.held(rated, values, torques))[0] for values in ({}, supports))
    return float(soft / stiff)
