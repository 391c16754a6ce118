"""Step-size control: each base step is divided as far as the coupling error asks.

Steps are the base step over a power of two, and begin at a multiple of themselves: time
stays start + n h / 2^k, every base step is met exactly, and a step can double only where
its pair is complete.

Two estimates of the local error, per connected value and relative to the largest value
that its signal has had:

- *doubling*: one step against two half as long.  Needs state that can be restored; costs
  three steps for two, and goes on with the better result.
- *extrapolation*: what the inputs were foretold to be at the end of the step against what
  they are.  One step for one.  With units that cannot restore their state nothing can be
  taken back: the estimate then only sets the length of the next step.

The tolerance is the error allowed per base step: for doubling, whose estimate is that of the
units' states, shared by its parts in proportion to their length; for extrapolation, whose
estimate is that of the inputs (states feel it times the step), for each part in full.  In
both cases the error at the end falls with the tolerance.  The estimate sees connected values
only: where positions are exchanged but the error enters velocities, name these in ``watch``.
"""

from dataclasses import dataclass
from itertools import groupby
from typing import Any, Protocol

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, RunFault
from orchestrator.component import Component, Signal
from orchestrator.master.connections import Link, resolve
from orchestrator.master.extrapolation import History, Samples

METHODS = ("auto", "doubling", "extrapolation")
# A step doubles only if the error foreseen for it is this part of the allowed one.
SAFETY = 0.8
# Level of division, samples, sizes of the signals.
Progress = tuple[int, Samples, Floats]


@dataclass(frozen=True)
class StepControl:
    """``tolerance`` relative error per base step; at most ``halvings`` divisions of it by two.

    ``watch`` names outputs (``component.variable``) whose error counts beside the connected ones'.
    """

    tolerance: float = 1e-4
    method: str = "auto"
    halvings: int = 12
    watch: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            raise InputFault(f"step control by {self.method!r}: choose one of {', '.join(METHODS)}")
        if not 0.0 < self.tolerance < 1.0:
            raise InputFault(f"step control tolerance = {self.tolerance}: a number between 0 and 1 is needed")
        if not 0 <= self.halvings <= 40:
            raise InputFault(f"step control halvings = {self.halvings}: between 0 and 40")


class Probe:
    """Outputs as one vector, with the size that their errors are measured by."""

    def __init__(self, components: dict[str, Component], outputs: list[tuple[str, Signal]]):
        chosen = list({(name, signal.name): (name, signal) for name, signal in outputs if signal.dtype == "f8"}.values())
        # All of a component together: a package of FMI 2 connects hundreds of scalars, each a signal of its own.
        chosen.sort(key=lambda pair: pair[0])
        self.values = np.zeros(sum(len(signal.references) for _, signal in chosen))
        self.size = np.array([signal.nominal or 0.0 for _, signal in chosen])
        self.lengths = [len(signal.references) for _, signal in chosen]
        self.firsts = np.cumsum([0, *self.lengths[:-1]], dtype=int)
        self.reads = []
        first = 0
        for name, group in groupby(chosen, key=lambda pair: pair[0]):
            references = tuple(r for _, signal in group for r in signal.references)
            self.reads.append(components[name].reader(references, self.values[first : first + len(references)]))
            first += len(references)

    def read(self) -> Floats:
        for read in self.reads:
            read()
        if self.values.size:
            np.maximum(self.size, np.maximum.reduceat(np.abs(self.values), self.firsts), out=self.size)
        return self.values.copy()

    def error(self, one: Floats, other: Floats) -> float:
        """Largest difference relative to the signal's size."""
        size = np.repeat(self.size, self.lengths)
        difference = np.abs(one - other)
        return float((difference / np.where(size > 0.0, size, 1.0)).max(initial=0.0))


class Stepped(Protocol):
    """What the control needs of a master."""

    components: dict[str, Component]
    ratios: dict[str, int]
    step_size: float
    extrapolation: int

    @property
    def time(self) -> float: ...

    @property
    def coupling_order(self) -> int: ...

    def advance(self, start: float, duration: float) -> None: ...

    def snapshot(self) -> Any: ...

    def revert(self, snapshot: Any) -> None: ...

    def forget(self, snapshot: Any) -> None: ...

    def warn(self, text: str) -> None: ...


class Controller:
    """Makes the base steps of a master in controlled parts."""

    def __init__(self, master: Stepped, settings: StepControl, links: list[Link]):
        self.master, self.settings = master, settings
        stuck = [name for name, c in master.components.items() if not c.can_vary_step]
        if stuck:
            raise InputFault(f"step control: {', '.join(stuck)} cannot vary the communication step; run with fixed steps")
        if any(ratio != 1 for ratio in master.ratios.values()):
            raise InputFault("step control: all units step together, ratios other than 1 do not fit")
        final = [name for name, c in master.components.items() if not c.can_restore]
        if final and settings.method == "doubling":
            raise InputFault(f"step control by doubling: {', '.join(final)} cannot restore its state; use extrapolation")
        self.can_reject = not final
        if final:
            master.warn(
                f"step control: {', '.join(final)} cannot restore its state; no step is taken back, the error only"
                " sets the length of the next one"
            )
        method = settings.method
        self.doubles = method == "doubling" or (method == "auto" and self.can_reject)
        # Power of the step by which estimate over allowance changes.
        self.order = master.coupling_order if self.doubles else master.extrapolation + 1
        watched = [resolve(master.components, path) for path in settings.watch]
        self.probe = Probe(master.components, [(k.source_name, k.source) for k in links] + watched)
        self.history = History(master.extrapolation, self.probe.values.size)
        # Without a way back the first step must be a careful one.
        self.level = 0 if self.can_reject else settings.halvings
        self.accepted = self.rejected = 0

    def start(self) -> None:
        self.history.times = []
        self.history.add(self.master.time, self.probe.read())

    def base_step(self) -> None:
        start, duration = self.master.time, self.master.step_size
        ticks = 2**self.settings.halvings
        done = 0
        while done < ticks:
            length = ticks >> self.level
            at, step = start + duration * done / ticks, duration * length / ticks
            allowed = self.allowed(step)
            error = self.attempt(at, step)
            if error > allowed and self.can_reject and self.level < self.settings.halvings:
                self.rejected += 1
                self.level += 1
                continue
            self.keep(at, error, allowed)
            self.accepted += 1
            done += length
            if error > allowed:
                self.level = min(self.level + 1, self.settings.halvings)
            elif error <= SAFETY * allowed / 2.0**self.order and self.level > 0 and done % (2 * length) == 0:
                self.level -= 1

    def allowed(self, step: float) -> float:
        return self.settings.tolerance * (step / self.master.step_size if self.doubles else 1.0)

    def attempt(self, at: float, step: float) -> float:
        """Try a step; its error.  On return the units stand at its end, ``undo`` holds the way back."""
        master = self.master
        self.undo = master.snapshot() if self.can_reject else None
        try:
            error = self.doubled(at, step) if self.doubles else self.foretold(at, step)
        except RunFault:
            if self.undo is None or self.level >= self.settings.halvings:
                raise
            error = np.inf
        if self.undo is not None:
            if error > self.allowed(step) and self.level < self.settings.halvings:
                master.revert(self.undo)
            master.forget(self.undo)
        return error

    def doubled(self, at: float, step: float) -> float:
        self.master.advance(at, step)
        coarse = self.probe.read()
        self.master.revert(self.undo)
        for k in range(2):
            self.master.advance(at + 0.5 * k * step, 0.5 * step)
        return self.probe.error(coarse, self.probe.read()) / (2.0**self.order - 1.0)

    def foretold(self, at: float, step: float) -> float:
        expected = np.empty_like(self.probe.values)
        self.history.derivative(at + step, 0, expected)
        self.master.advance(at, step)
        return self.probe.error(expected, self.probe.read())

    def keep(self, at: float, error: float, allowed: float) -> None:
        """The step stands: remember where it ended."""
        if not self.doubles:
            length = self.master.step_size / 2**self.level
            self.history.add(at + length, self.probe.values)
        if error > allowed and self.can_reject:
            self.master.warn(
                f"step control: error {error:.3g} at time {at:.9g} s is above the {allowed:.3g} allowed even with the"
                f" smallest step ({self.master.step_size / 2**self.level:.3g} s): allow more halvings or a larger tolerance"
            )

    def save(self) -> Progress:
        return self.level, self.history.save(), self.probe.size.copy()

    def restore(self, saved: Progress) -> None:
        self.level, size = saved[0], saved[2]
        self.history.restore(saved[1])
        self.probe.size[:] = size
