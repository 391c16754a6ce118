"""The co-simulation master: vectors between units, Gauss-Seidel or Jacobi, fixed or controlled steps.

    master = Master({"plant": plant, "wear": wear}, PAIR, step=1e-3)
    master.initialise()
    master.run(1000)

Within a step the components stand in the order given.  Gauss-Seidel hands each
one what those before it have just computed; Jacobi gives all of them the values of the
step's start.  A component with ratio k steps every k-th base step, over k base steps at
once, after the others have reached the end of that interval.  Time is start + n h.
"""

from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Any, Protocol

import numpy as np

from fmu_src.faults import InputFault
from orchestrator.component import Component, Snapshot
from orchestrator.master.connections import (
    Connection,
    Link,
    Transfer,
    check_connections,
    group_links,
    make_transfer,
)
from orchestrator.master.extrapolation import HIGHEST_ORDER, ExtrapolatedTransfer, History, extrapolation_options
from orchestrator.master.loops import Loop, LoopSettings, Settling, has_feedthrough
from orchestrator.master.power import THRESHOLD, PowerBond, find_pairs, make_bond, pair_of
from orchestrator.master.step_control import Controller, StepControl
from orchestrator.schemes import SCHEMES


class Remembering(Protocol):
    """A part of the master that carries something from step to step."""

    def save(self) -> Any: ...

    def restore(self, saved: Any) -> None: ...


# What one plain step calls: transfers, then components; each with the time and duration of the step.
Stages = list[tuple[list[Callable[[], None]], list[Callable[[float, float], None]]]]
# Snapshots of the components, and of what the master remembers.
Kept = tuple[dict[str, Snapshot], list[tuple[Remembering, Any]]]


class Master:
    """Steps components by connections ``("plant.mesh_force", "wear.mesh_force")``.

    ``extrapolation`` is the order of the polynomial that inputs follow (0, 1, 2);
    ``step_control`` divides base steps by their error; ``loops`` says how algebraic loops
    are solved; ``power_bonds`` names pairs of outputs (effort, flow) to watch, beside
    those whose units make watts; ``power_threshold`` is the share of power at which
    ``warnings`` speaks up.
    """

    def __init__(
        self,
        components: dict[str, Component],
        connections: Iterable[Connection | tuple[str, str]],
        step: float,
        ratios: dict[str, int] | None = None,
        scheme: str = "gauss-seidel",
        start_time: float = 0.0,
        extrapolation: int = 0,
        step_control: StepControl | None = None,
        loops: LoopSettings | None = None,
        power_bonds: Sequence[tuple[str, str]] = (),
        power_threshold: float = THRESHOLD,
    ):
        if scheme not in SCHEMES:
            raise InputFault(f"scheme {scheme!r}: choose one of {', '.join(SCHEMES)}")
        if not 0.0 < step < np.inf:
            raise InputFault(f"step = {step} s: the base step must be positive and finite")
        if extrapolation not in range(HIGHEST_ORDER + 1):
            raise InputFault(f"extrapolation of order {extrapolation}: choose 0 (hold), 1 (linear) or 2 (quadratic)")
        self.components = components
        self.ratios = dict.fromkeys(components, 1) | (ratios or {})
        for name, ratio in self.ratios.items():
            if name not in components:
                raise InputFault(f"ratio for {name!r}, which is no component; there are {', '.join(components)}")
            if ratio != int(ratio) or ratio < 1:
                raise InputFault(f"ratio {ratio} of {name}: a whole number of base steps, 1 or more, is needed")
        self.single_rate = all(ratio == 1 for ratio in self.ratios.values())
        self.step_size, self.scheme, self.start_time = step, scheme, start_time
        self.extrapolation = extrapolation
        self.steps_done = 0
        self.notes: list[str] = []
        links = check_connections(components, connections)
        self.incoming = self.make_transfers(links)
        self.settle = Settling(components, links, loops or LoopSettings()) if has_feedthrough(components, links) else None
        self.bonds = self.make_bonds(links, power_bonds, power_threshold)
        self.controller = Controller(self, step_control, links) if step_control is not None else None

    @property
    def time(self) -> float:
        return self.start_time + self.steps_done * self.step_size

    @property
    def transfers(self) -> list[Transfer]:
        return [transfer for transfers in self.incoming.values() for transfer in transfers]

    @property
    def coupling_order(self) -> int:
        """Power of the step with which the coupling error at a given time falls."""
        if self.extrapolation == 0:
            return 1
        taken = min((self.components[t.target].input_derivatives for t in self.transfers), default=0)
        return 1 + min(self.extrapolation, max(taken, 1))

    @property
    def loops(self) -> list[Loop]:
        """Algebraic loops among the connections."""
        return self.settle.loops if self.settle is not None else []

    @property
    def warnings(self) -> list[str]:
        """What the user should know of this run: each thing once."""
        residuals = [warning for bond in self.bonds if (warning := bond.warning()) is not None]
        of_units = [text for component in self.components.values() for text in component.cautions()]
        return [*self.notes, *residuals, *of_units]

    def warn(self, text: str) -> None:
        # The same kind of warning again and again would bury the others.
        kind = text.partition(":")[0]
        if all(note.partition(":")[0] != kind for note in self.notes):
            self.notes.append(text)

    def make_transfers(self, links: list[Link]) -> dict[str, list[Transfer]]:
        incoming: dict[str, list[Transfer]] = {name: [] for name in self.components}
        for (_, target), group in group_links(links).items():
            if self.extrapolation:
                options = extrapolation_options(self.components[target], group, self.extrapolation)
                transfer = make_transfer(self.components, group, ExtrapolatedTransfer, **options)
            else:
                transfer = make_transfer(self.components, group)
            incoming[target].append(transfer)
        return incoming

    def make_bonds(self, links: list[Link], named: Sequence[tuple[str, str]], threshold: float) -> list[PowerBond]:
        pairs = [pair_of(links, names) for names in named]
        known = {id(link) for pair in pairs for link in pair}
        pairs += [pair for pair in find_pairs(links) if not known & {id(link) for link in pair}]
        return [make_bond(self.components, self.transfers, pair, threshold) for pair in pairs]

    def initialise(self) -> None:
        """Initialise all components in order; each gets the outputs of those before it."""
        for component in self.components.values():
            component.enter_initialisation(self.start_time)
        ready: set[str] = set()
        for name, component in self.components.items():
            for transfer in self.incoming[name]:
                if transfer.source in ready:
                    transfer.fetch(self.start_time)
                    transfer.deliver_present()
            component.exit_initialisation()
            ready.add(name)
        for transfer in self.transfers:
            transfer.fetch(self.start_time)
            transfer.deliver_present()
        if self.settle is not None:
            self.settle(self.start_time)
        for bond in self.bonds:
            bond.begin()
        if self.controller is not None:
            self.controller.start()

    def step(self) -> None:
        """One base step, in controlled parts if so asked."""
        if self.controller is not None:
            self.controller.base_step()
        else:
            self.advance(self.start_time + self.steps_done * self.step_size, self.step_size)
        self.steps_done += 1

    def advance(self, start: float, duration: float) -> None:
        """Step all components that are due from ``start``."""
        incoming, ratios, components = self.incoming, self.ratios, self.components
        due: Collection[str] = components
        if not self.single_rate:
            due = [name for name in components if (self.steps_done + 1) % ratios[name] == 0]
        end = start + duration
        if self.scheme == "jacobi":
            for name in due:
                for transfer in incoming[name]:
                    transfer.fetch(start)
            for name in due:
                for transfer in incoming[name]:
                    transfer.deliver(start - (ratios[name] - 1) * duration, end)
            for name in due:
                components[name].begin_step(start - (ratios[name] - 1) * duration, ratios[name] * duration)
            for name in due:
                components[name].end_step()
        else:
            reached = []
            for name in due:
                first = start - (ratios[name] - 1) * duration
                for transfer in incoming[name]:
                    transfer.fetch(end if transfer.source in reached else start)
                    transfer.deliver(first, end)
                components[name].step(first, ratios[name] * duration)
                reached.append(name)
        if self.settle is not None:
            self.settle(end)
        for bond in self.bonds:
            bond.observe(duration)

    def run(self, steps: int, each_step: Callable[[], None] | None = None) -> None:
        """``steps`` base steps; ``each_step`` is called after each."""
        stages = self.plain_stages()
        for _ in range(steps):
            if stages is None:
                self.step()
            else:
                start = self.start_time + self.steps_done * self.step_size
                for moves, due in stages:
                    for move in moves:
                        move()
                    for step in due:
                        step(start, self.step_size)
                self.steps_done += 1
            if each_step is not None:
                each_step()

    def plain_stages(self) -> Stages | None:
        """What ``step`` comes to where every component steps as often, once, and gets what another has computed as it is; else None.

        Half of the master's own share of a step of native units went into finding that out again and again.
        """
        transfers, components = self.transfers, self.components.values()
        plain = all(type(t) is Transfer and not t.factors for t in transfers) and all(type(c).end_step is Component.end_step for c in components)
        if not (plain and self.single_rate) or type(self) is not Master or self.controller is not None or self.settle is not None or self.bonds:
            return None
        if self.scheme == "jacobi":
            moves = [read for t in transfers for read in t.reads] + [write for t in transfers for write in t.writes]
            return [(moves, [component.begin_step for component in components])]
        into = {name: [move for t in self.incoming[name] for move in (*t.reads, *t.writes)] for name in self.components}
        return [(into[name], [component.step]) for name, component in self.components.items()]

    def rebase(self, step: float) -> None:
        """Go on from the present time with another base step."""
        self.start_time, self.steps_done, self.step_size = self.time, 0, step

    def save(self) -> dict[str, Any]:
        """Complete state of all components and of the clock, and what the master remembers."""
        clock = {"start_time": self.start_time, "steps_done": self.steps_done, "step_size": self.step_size}
        saved = {"clock": clock, "states": {name: c.save() for name, c in self.components.items()}}
        memory = self.memory()
        return saved | {"memory": memory} if memory else saved

    def restore(self, saved: dict[str, Any]) -> None:
        for key, value in saved["clock"].items():
            setattr(self, key, value)
        for name, state in saved["states"].items():
            self.components[name].restore(state)
        self.recall(saved.get("memory", []))

    @property
    def histories(self) -> list[History]:
        return [t.history for t in self.transfers if isinstance(t, ExtrapolatedTransfer)]

    def remembering(self) -> list[Remembering]:
        """The parts of the master that carry something from step to step."""
        controller = [self.controller] if self.controller is not None else []
        return [*self.histories, *self.bonds, *controller]

    def memory(self) -> list[Any]:
        return [part.save() for part in self.remembering()]

    def recall(self, memory: list[Any]) -> None:
        for part, saved in zip(self.remembering(), memory):
            part.restore(saved)

    def snapshot(self) -> Kept:
        """State for ``revert`` within a base step."""
        kept: list[Remembering] = [*self.histories, *self.bonds]
        return {name: c.snapshot() for name, c in self.components.items()}, [(part, part.save()) for part in kept]

    def revert(self, snapshot: Kept) -> None:
        for name, state in snapshot[0].items():
            self.components[name].revert(state)
        for part, saved in snapshot[1]:
            part.restore(saved)

    def forget(self, snapshot: Kept) -> None:
        for name, state in snapshot[0].items():
            self.components[name].forget(state)

    def close(self) -> None:
        for component in self.components.values():
            component.close()
