"""The co-simulation master: a fixed base step, vectors between units, Gauss-Seidel or Jacobi.

    master = Master({"plant": plant, "wear": wear}, PAIR, step=1e-3)
    master.initialise()
    master.run(1000)

Within a base step the components stand in the order given.  Gauss-Seidel hands each
one what those before it have just computed; Jacobi gives all of them the values of the
step's start.  A component with ratio k steps every k-th base step, over k base steps at
once, after the others have reached the end of that interval.  Time is start + n h.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from fmu_src.units import UnitError, conversion
from orchestrator.component import Component
from orchestrator.faults import InputFault

SCHEMES = ("gauss-seidel", "jacobi")


@dataclass(frozen=True)
class Transfer:
    """All connections from one component to another, moved through one buffer."""

    source: str
    read: list[Callable[[], None]]
    write: list[Callable[[], None]]
    factors: list[tuple[np.ndarray, float, float]]

    def fetch(self) -> None:
        for read in self.read:
            read()
        for buffer, factor, offset in self.factors:
            buffer *= factor
            buffer += offset

    def deliver(self) -> None:
        for write in self.write:
            write()


class Master:
    """Steps components by a list of connections ``("plant.mesh_force", "wear.mesh_force")``."""

    def __init__(
        self,
        components: dict[str, Component],
        connections: Iterable[tuple[str, str]],
        step: float,
        ratios: dict[str, int] | None = None,
        scheme: str = "gauss-seidel",
        start_time: float = 0.0,
    ):
        if scheme not in SCHEMES:
            raise InputFault(f"scheme {scheme!r}: choose one of {', '.join(SCHEMES)}")
        if not 0.0 < step < np.inf:
            raise InputFault(f"step = {step} s: the base step must be positive and finite")
        self.components = components
        self.ratios = {name: 1 for name in components} | (ratios or {})
        for name, ratio in self.ratios.items():
            if name not in components:
                raise InputFault(f"ratio for {name!r}, which is no component; there are {', '.join(components)}")
            if ratio != int(ratio) or ratio < 1:
                raise InputFault(f"ratio {ratio} of {name}: a whole number of base steps, 1 or more, is needed")
        self.step_size, self.scheme, self.start_time = step, scheme, start_time
        self.steps_done = 0
        self.incoming = self.make_transfers(list(connections))

    @property
    def time(self) -> float:
        return self.start_time + self.steps_done * self.step_size

    def make_transfers(self, connections: list[tuple[str, str]]) -> dict[str, list[Transfer]]:
        """Check every connection and prepare the buffers, grouped by target and source."""
        grouped: dict[tuple[str, str], list] = {}
        driven: dict[tuple[str, int], str] = {}
        for source_path, target_path in connections:
            source_name, source = self.resolve(source_path)
            target_name, target = self.resolve(target_path)
            link = f"connection {source_path} -> {target_path}"
            if target.causality != "input":
                raise InputFault(f"{link}: {target_path} is a {target.causality}, not an input")
            if source.causality != "output":
                raise InputFault(f"{link}: {source_path} is a {source.causality}, not an output")
            if source.shape != target.shape:
                raise InputFault(f"{link}: the shapes {source.shape} and {target.shape} differ")
            if source.is_integer != target.is_integer:
                raise InputFault(f"{link}: one is an integer, the other is not")
            for reference in target.references:
                if (target_name, reference) in driven:
                    raise InputFault(f"{link}: {target_path} is already driven by {driven[target_name, reference]}")
                driven[target_name, reference] = source_path
            try:
                factor, offset = conversion(source.unit, target.unit)
            except UnitError as problem:
                raise InputFault(f"{link}: {problem}") from None
            grouped.setdefault((target_name, source_name), []).append((source, target, factor, offset))
        incoming: dict[str, list[Transfer]] = {name: [] for name in self.components}
        for (target_name, source_name), links in grouped.items():
            incoming[target_name].append(self.make_transfer(source_name, target_name, links))
        return incoming

    def make_transfer(self, source_name: str, target_name: str, links: list) -> Transfer:
        """One buffer for all real links, one for all integer links."""
        source, target = self.components[source_name], self.components[target_name]
        reads, writes, factors = [], [], []
        for kind in (False, True):
            chosen = sorted((k for k in links if k[0].is_integer is kind), key=lambda k: k[0].references)
            if not chosen:
                continue
            buffer = np.zeros(sum(len(k[0].references) for k in chosen), "i8" if kind else "f8")
            reads.append(source.reader(tuple(r for k in chosen for r in k[0].references), buffer))
            writes.append(target.writer(tuple(r for k in chosen for r in k[1].references), buffer))
            first = 0
            for signal, _, factor, offset in chosen:
                if (factor, offset) != (1.0, 0.0):
                    factors.append((buffer[first : first + len(signal.references)], factor, offset))
                first += len(signal.references)
        return Transfer(source_name, reads, writes, factors)

    def resolve(self, path: str):
        name, _, variable = path.partition(".")
        if name not in self.components:
            raise InputFault(f"{path}: no component {name!r}; there are {', '.join(self.components)}")
        return name, self.components[name].signal(variable)

    def initialise(self) -> None:
        """Initialise all components in order; each gets the outputs of those before it."""
        for component in self.components.values():
            component.enter_initialisation(self.start_time)
        ready: set[str] = set()
        for name, component in self.components.items():
            for transfer in self.incoming[name]:
                if transfer.source in ready:
                    transfer.fetch()
                    transfer.deliver()
            component.exit_initialisation()
            ready.add(name)
        for name in self.components:
            for transfer in self.incoming[name]:
                transfer.fetch()
                transfer.deliver()

    def step(self) -> None:
        """One base step."""
        n, h = self.steps_done, self.step_size
        due = [name for name in self.components if (n + 1) % self.ratios[name] == 0]
        if self.scheme == "jacobi":
            for name in due:
                for transfer in self.incoming[name]:
                    transfer.fetch()
            for name in due:
                for transfer in self.incoming[name]:
                    transfer.deliver()
        for name in due:
            if self.scheme == "gauss-seidel":
                for transfer in self.incoming[name]:
                    transfer.fetch()
                    transfer.deliver()
            ratio = self.ratios[name]
            self.components[name].step(self.start_time + (n + 1 - ratio) * h, ratio * h)
        self.steps_done += 1

    def run(self, steps: int, each_step: Callable[[], None] | None = None) -> None:
        """``steps`` base steps; ``each_step`` is called after each."""
        for _ in range(steps):
            self.step()
            if each_step is not None:
                each_step()

    def rebase(self, step: float) -> None:
        """Go on from the present time with another base step."""
        self.start_time, self.steps_done, self.step_size = self.time, 0, step

    def save(self) -> dict:
        """Complete state of all components and of the clock."""
        clock = {"start_time": self.start_time, "steps_done": self.steps_done, "step_size": self.step_size}
        return {"clock": clock, "states": {name: c.save() for name, c in self.components.items()}}

    def restore(self, saved: dict) -> None:
        for key, value in saved["clock"].items():
            setattr(self, key, value)
        for name, state in saved["states"].items():
            self.components[name].restore(state)

    def close(self) -> None:
        for component in self.components.values():
            component.close()
