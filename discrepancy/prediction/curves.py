"""What the bench shows at a record's samples: computed at nodes as fine as the noise asks for, and interpolated.

A prediction is the base model's, at fine nodes and once, and what the values change in it, at nodes of their own.
"""

from collections.abc import Callable
from typing import Protocol, TypeVar

import numpy as np

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import Values
from discrepancy.prediction.fineness import EVERY_SAMPLE, ErrsAt
from discrepancy.prediction.support import AngleNodes, SplineNodes, TorqueNodes
from discrepancy.problem import Record
from fmu_src.arrays import Floats

# Where parameters do nearly the same, their derivatives differ by little: 2 % of errors were 20 times that.
LEVEL_OF_SLOPES = 6

Nodes = TypeVar("Nodes", AngleNodes, TorqueNodes)


class Curve(Protocol[Nodes]):
    """A signal of the bench over the axis of a record."""

    @property
    def bench(self) -> Bench: ...

    @property
    def record(self) -> Record: ...

    def nodes(self, level: int) -> Nodes | None:
        """Nodes for the record's samples; None where every sample is computed."""
        ...

    def exact(self) -> "Curve[Nodes]":
        """The same of a bench that is not rough, where that matters between nodes, too."""
        ...

    def between(self, nodes: Nodes) -> Nodes | None:
        """Places at which what is interpolated from ``nodes`` is looked at; None where the nodes themselves tell."""
        ...

    def places(self, values: Values) -> Floats:
        """Where the samples lie on the axis."""
        ...

    def unchanged(self, values: Values) -> dict[str, float]:
        """Of the values those that say where the samples lie."""
        ...

    def run(self, values: Values, nodes: Nodes) -> Floats:
        """The signal at nodes."""
        ...

    def directly(self, values: Values) -> Floats:
        """The signal at every sample."""
        ...

    def seen(self, at: Callable[[Floats | float], Floats]) -> Floats:
        """What the record shows of a signal that is known ``at`` any distance ahead of its samples."""
        ...


def moved(angles: Floats, series: Floats, by: Floats | float) -> Floats:
    """What a ``series`` at ``angles`` [rad], in any order, is ``by`` [rad], one distance or each its own, further on."""
    if not np.any(by):
        return series
    order = np.argsort(angles, kind="stable")
    return SplineNodes(angles[order]).samples(series[order], angles + by)


def signal(curve: Curve[Nodes], values: Values) -> Floats:
    """What the record's samples show with ``values``."""
    fine, coarse = nodes_of(curve, {}), nodes_of(curve, values)
    changed, exact = bool(curve.bench.relevant(values, True)), curve.exact()
    places = curve.places(values)
    if coarse is None or (fine is None and not changed):
        direct = exact.directly(values)
        return curve.seen(lambda ahead: moved(places, direct, ahead))
    change = curve.run(values, coarse) - curve.run({}, coarse) if changed else None
    # The base model's is had but once at every sample.
    base = exact.directly(curve.unchanged(values)) if fine is None else exact.run({}, fine)

    def at(ahead: Floats | float) -> Floats:
        found = moved(places, base, ahead) if fine is None else fine.samples(base, places + ahead)
        return found if change is None else found + coarse.samples(change, places + ahead)

    return curve.seen(at)


def nodes_of(curve: Curve[Nodes], values: Values) -> Nodes | None:
    """Nodes at which ``values`` change the signal smoothly enough; of the signal itself where none are given."""
    return curve.nodes(level_of(curve, values))


def level_of(curve: Curve[Nodes], values: Values) -> int:
    """The level of ``nodes_of``."""
    fineness, away = curve.bench.fineness, curve.bench.away(values)
    shown = fineness.largest(values) if fineness else values

    def change(nodes: Nodes) -> Floats:
        return curve.run(shown, nodes) - (curve.run({}, nodes) if away else 0.0)

    return fineness.level(curve.record, away, errors_by_level(curve, change)) if fineness else EVERY_SAMPLE


def nodes_of_slopes(curve: Curve[Nodes], values: Values, base: Values, change: Callable[[Nodes], Floats]) -> Nodes | None:
    """Nodes for what ``values`` ``change`` next to ``base`` to first order, which jumps where the signal has a kink."""
    fineness = curve.bench.fineness
    if fineness and fineness.rough:
        return curve.nodes(fineness.level_of_slopes(curve.record, curve.bench.away({**base, **values}), errors_by_level(curve, change)))
    return curve.nodes(max(level_of(curve, {**base, **values}), LEVEL_OF_SLOPES))


def errors_by_level(curve: Curve[Nodes], change: Callable[[Nodes], Floats]) -> ErrsAt:
    """What interpolation errs of a ``change``, and its size."""

    def errs(level: int) -> tuple[float, float] | None:
        nodes = curve.nodes(level)
        if nodes is None:
            return None
        # One turn is like the others.
        nodes = nodes.beginning()
        at = change(nodes)
        size, fineness = float(np.std(at)), curve.bench.fineness
        between = None if fineness and fineness.rough else curve.between(nodes)
        if between is None:
            return nodes.error(at), size
        # Nodes that a wave is too fast for do not show it.
        off = change(between) - nodes.samples(at, between.places)
        return float(np.sqrt(np.mean(off**2))), size

    return errs
