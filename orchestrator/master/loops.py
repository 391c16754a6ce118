"""Algebraic loops: found from the declared dependencies, solved at communication points.

An output that depends at once on an input passes a value on within a communication point.
Chains of such values are moved in the order of their dependence, so that none is a step
old.  A chain that closes is an algebraic loop: its inputs v must equal the outputs that
they bring about, R(v) = outputs(v) - v = 0.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, RunFault
from orchestrator.component import Component
from orchestrator.master.connections import Link, Transfer, group_links, make_transfer

METHODS = ("newton", "fixed-point")
# Iterations that the relaxation looks back on.
DEPTH = 5


@dataclass(frozen=True)
class LoopSettings:
    """How loops are solved: to ``tolerance`` relative to the values, in at most ``iterations``."""

    method: str = "newton"
    tolerance: float = 1e-10
    iterations: int = 50

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            raise InputFault(f"loop method {self.method!r}: choose one of {', '.join(METHODS)}")


class Loop:
    """One set of links that depend on each other."""

    def __init__(self, components: dict[str, Component], links: list[Link], settings: LoopSettings):
        self.transfers = [make_transfer(components, group) for group in group_links(links).values()]
        self.links, self.settings = links, settings
        if any(link.source.dtype != "f8" for link in links):
            raise InputFault(f"the algebraic loop {self} holds integers or Booleans; put a delay into it")
        self.values = np.zeros(sum(t.values.size for t in self.transfers))
        self.evaluations = 0
        self.jacobian: Floats | None = None

    def __str__(self) -> str:
        return ", ".join(dict.fromkeys(f"{k.connection.source} -> {k.connection.target}" for k in self.links))

    def gather(self, time: float) -> Floats:
        """What the outputs are with the inputs as they stand."""
        for transfer in self.transfers:
            transfer.fetch(time)
        return np.concatenate([t.values for t in self.transfers])

    def spread(self, values: Floats) -> None:
        first = 0
        for transfer in self.transfers:
            transfer.values[:] = values[first : first + transfer.values.size]
            transfer.deliver_present()
            first += transfer.values.size

    def residual(self, values: Floats, time: float) -> Floats:
        self.evaluations += 1
        self.spread(values)
        return self.gather(time) - values

    def solve(self, time: float) -> None:
        """Find inputs that agree with the outputs, from those of the last point."""
        self.evaluations = 0
        values = self.gather(time) if not self.values.any() else self.values
        solver = self.newton if self.settings.method == "newton" else self.fixed_point
        self.values = solver(values.copy(), time)

    def is_solved(self, values: Floats, residual: Floats) -> bool:
        return bool(np.abs(residual).max() <= self.settings.tolerance * max(1e-12, np.abs(values).max()))

    def fixed_point(self, values: Floats, time: float) -> Floats:
        """Iteration relaxed by what the last ones showed (Anderson's mixing), so that a diverging one turns round."""
        tried: list[Floats] = []
        residuals: list[Floats] = []
        for _ in range(self.settings.iterations):
            residual = self.residual(values, time)
            if self.is_solved(values, residual):
                return values
            tried, residuals = [*tried, values][-DEPTH:], [*residuals, residual][-DEPTH:]
            values = values + residual
            if len(tried) > 1:
                differences = np.diff(residuals, axis=0).T
                share = np.linalg.lstsq(differences, residual, rcond=None)[0]
                values = values - (np.diff(tried, axis=0).T + differences) @ share
        raise self.fault(time, residual)

    def newton(self, values: Floats, time: float) -> Floats:
        """Newton with differences; the matrix is kept and mended (Broyden) while that converges."""
        residual = self.residual(values, time)
        for _ in range(self.settings.iterations):
            if self.is_solved(values, residual):
                return values
            if self.jacobian is None:
                self.jacobian = self.differences(values, residual, time)
            step = np.linalg.lstsq(self.jacobian, -residual, rcond=None)[0]
            values = values + step
            before, residual = residual, self.residual(values, time)
            if not np.isfinite(residual).all():
                break
            if np.abs(residual).max() > 0.5 * np.abs(before).max():
                self.jacobian = None
            else:
                change = residual - before - self.jacobian @ step
                self.jacobian += np.outer(change, step) / max(float(step @ step), 1e-300)
        self.jacobian = None
        raise self.fault(time, residual)

    def differences(self, values: Floats, residual: Floats, time: float) -> Floats:
        matrix = np.empty((values.size, values.size))
        for i in range(values.size):
            step = 1e-6 * max(1.0, abs(values[i]))
            shifted = values.copy()
            shifted[i] += step
            matrix[:, i] = (self.residual(shifted, time) - residual) / step
        return matrix

    def fault(self, time: float, residual: Floats) -> RunFault:
        return RunFault(
            f"the algebraic loop {self} found no solution at time {time:.9g} s: after {self.evaluations} evaluations"
            f" it is {np.abs(residual).max():.3g} off. Try the other method ({' or '.join(METHODS)}), more"
            " iterations, or break the loop with a unit that holds its output for a step"
        )


class Settling:
    """Brings a communication point into agreement: transfers and loops in order of dependence."""

    def __init__(self, components: dict[str, Component], links: Sequence[Link], settings: LoopSettings):
        elements = [element for link in links for element in link.elements()]
        self.stages: list[Callable[[float], None]] = []
        self.loops: list[Loop] = []
        for level in order_of_dependence(components, elements):
            plain = [elements[members[0]] for members, closed in level if not closed]
            for group in group_links(plain).values():
                self.stages.append(Move(make_transfer(components, group)))
            for members, closed in level:
                if closed:
                    self.loops.append(Loop(components, [elements[i] for i in members], settings))
                    self.stages.append(self.loops[-1].solve)

    def __call__(self, time: float) -> None:
        for stage in self.stages:
            stage(time)


@dataclass
class Move:
    """A transfer at a communication point."""

    transfer: Transfer

    def __call__(self, time: float) -> None:
        self.transfer.fetch(time)
        self.transfer.deliver_present()


def order_of_dependence(
    components: dict[str, Component], links: list[Link]
) -> list[list[tuple[list[int], bool]]]:
    """Levels of (links that belong together, whether they are a loop), each after those it depends on."""
    through = {name: component.feedthrough() for name, component in components.items()}
    by_target = {(link.target_name, link.target.elements[0]): i for i, link in enumerate(links)}
    edges = [
        (by_target[link.source_name, cause], i)
        for i, link in enumerate(links)
        for cause in through[link.source_name].get(link.source.elements[0], ())
        if (link.source_name, cause) in by_target
    ]
    if not edges:
        return [[([i], False) for i in range(len(links))]] if links else []
    # Here, because few systems have such chains and SciPy takes its time to load.
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    causes, effects = np.array(edges).T
    graph = coo_matrix((np.ones(len(edges)), (causes, effects)), shape=(len(links), len(links)))
    count, label = connected_components(graph, directed=True, connection="strong")
    members: list[list[int]] = [[] for _ in range(count)]
    for i, group in enumerate(label.tolist()):
        members[group].append(i)
    closed = {label[a] for a, b in edges if label[a] == label[b]}
    between = {(label[a], label[b]) for a, b in edges if label[a] != label[b]}
    level = np.zeros(count, int)
    # The longest path to each group; as many rounds as there are levels.
    while any(level[b] <= level[a] for a, b in between):
        for a, b in between:
            level[b] = max(level[b], level[a] + 1)
    return [
        [(members[g], g in closed) for g in range(count) if level[g] == depth]
        for depth in range(int(level.max(initial=-1)) + 1)
    ]


def has_feedthrough(components: dict[str, Component], links: Sequence[Link]) -> bool:
    """Whether any connected output depends at once on a connected input."""
    driven = {(link.target_name, element) for link in links for element in link.target.elements}
    read = {(link.source_name, element) for link in links for element in link.source.elements}
    return any(
        (name, output) in read and any((name, cause) in driven for cause in causes)
        for name, component in components.items()
        for output, causes in component.feedthrough().items()
    )
