"""Power residual of a pair of connections: does the coupling make or lose energy?

Two connections between the same two units that run in opposite directions and carry an
effort and a flow (torque and speed, force and velocity, voltage and current) transmit the
power e f.  Each side computes it with its own output and the input that the master holds
for it.  The two differ by the residual: power that no model accounts for and that the
coupling alone adds or removes.  Sadjina et al., Engineering with Computers 33 (2017).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from fmu_src.percent import percent
from fmu_src.units import UnitError, parse, registry
from orchestrator.component import Component
from orchestrator.master.connections import Link, Transfer

THRESHOLD = 0.01
# Residual, its energy, energy exchanged, steps, outputs at the last communication point.
Account = tuple[float, float, float, int, list[Floats]]


@dataclass
class PowerBond:
    """An effort and a flow connection, watched; energies in J (or the product of their units)."""

    there: Link
    back: Link
    transfers: tuple[Transfer, Transfer]
    places: tuple[slice, slice]
    scale: tuple[float, float]
    sides: tuple[tuple[Callable[[], None], Floats], ...]
    threshold: float = THRESHOLD
    residual: float = 0.0
    residual_energy: float = 0.0
    exchanged_energy: float = 0.0
    steps: int = 0
    before: list[Floats] = field(default_factory=list)

    def __str__(self) -> str:
        links = (self.there.connection, self.back.connection)
        return ", ".join(f"{c.source} -> {c.target}" for c in links)

    def outputs(self) -> list[Floats]:
        for read, _ in self.sides:
            read()
        return [buffer.copy() for _, buffer in self.sides]

    def begin(self) -> None:
        """Outputs at the first communication point."""
        self.before = self.outputs()

    def observe(self, duration: float) -> None:
        """Account for a step that was just made."""
        after = self.outputs()
        mean = [0.5 * (a + b) for a, b in zip(self.before, after)]
        (there, back), (there_place, back_place) = self.transfers, self.places
        given = self.scale[0] * float(mean[0] @ back.held[back_place])
        taken = self.scale[1] * float(mean[1] @ there.held[there_place])
        self.residual = given - taken
        self.residual_energy += abs(self.residual) * duration
        self.exchanged_energy += 0.5 * (abs(given) + abs(taken)) * duration
        self.steps += 1
        self.before = after

    @property
    def share(self) -> float:
        """Residual over exchanged energy so far."""
        return self.residual_energy / self.exchanged_energy if self.exchanged_energy > 0.0 else 0.0

    def warning(self) -> str | None:
        """What the user should know; None while the share is below the threshold."""
        if self.share <= self.threshold:
            return None
        return (
            f"power residual {percent(self.share)} on {self}: the coupling itself adds or removes"
            f" {self.residual_energy:.3g} J of {self.exchanged_energy:.3g} J exchanged (threshold"
            f" {100.0 * self.threshold:g} %). What you see there is the coupling, not the model: take a smaller step,"
            " extrapolation = 1 or step control; if it stays, the connection itself is lossy (factor, units, sign)"
        )

    def save(self) -> Account:
        return self.residual, self.residual_energy, self.exchanged_energy, self.steps, [b.copy() for b in self.before]

    def restore(self, saved: Account) -> None:
        self.residual, self.residual_energy, self.exchanged_energy, self.steps, self.before = saved


@cache
def watts(first: str, second: str) -> float | None:
    """Factor from the product of two units to watts; None if it is no power."""
    try:
        product = registry().Quantity(1.0, parse(first) * parse(second)).to_base_units()
        watt = registry().Quantity(1.0, "watt").to_base_units()
    except UnitError:
        return None
    # The radian has no dimension for pint, so that N m rad/s is a power.
    return float(product.magnitude) if product.dimensionality == watt.dimensionality else None


def find_pairs(links: Sequence[Link]) -> list[tuple[Link, Link]]:
    """Pairs of opposite connections whose units make watts, where there is no doubt which belong together."""
    candidates = [
        (a, b)
        for i, a in enumerate(links) for b in links[i + 1 :]
        if (a.source_name, a.target_name) == (b.target_name, b.source_name)
        and a.source.dtype == b.source.dtype == "f8" and a.source.shape == b.source.shape
        and watts(a.source.unit, b.target.unit) is not None and watts(a.target.unit, b.source.unit) is not None
    ]  # fmt: skip
    used = [id(link) for pair in candidates for link in pair]
    return [pair for pair in candidates if all(used.count(id(link)) == 1 for link in pair)]


def pair_of(links: Sequence[Link], names: tuple[str, str]) -> tuple[Link, Link]:
    """The pair that a user names by the two outputs."""
    found = []
    for name in names:
        matching = [link for link in links if link.connection.source == name]
        if len(matching) != 1:
            raise InputFault(f"power bond {names}: {name} is the source of {len(matching)} connections, not of one")
        found.append(matching[0])
    there, back = found
    if (there.source_name, there.target_name) != (back.target_name, back.source_name):
        raise InputFault(f"power bond {names}: the two connections do not join the same two units in both directions")
    if there.source.shape != back.source.shape:
        raise InputFault(f"power bond {names}: the shapes {there.source.shape} and {back.source.shape} differ")
    return there, back


def make_bond(
    components: dict[str, Component], transfers: Sequence[Transfer], pair: tuple[Link, Link], threshold: float
) -> PowerBond:
    def carried(link: Link) -> tuple[Transfer, slice]:
        """What moves a link's values, and where they stand in it."""
        return next((t, place) for t in transfers if (place := t.place(link)) is not None)

    there, back = pair
    (onward, there_place), (homeward, back_place) = carried(there), carried(back)
    sides = []
    for link in pair:
        buffer = link.source.new_buffer()
        sides.append((components[link.source_name].reader(link.source.references, buffer), buffer))
    # A reaction torque changes its sign on the way: that is no loss.
    sign = np.sign(there.factor * back.factor)
    scale = (watts(there.source.unit, back.target.unit) or 1.0, sign * (watts(there.target.unit, back.source.unit) or 1.0))
    return PowerBond(there, back, (onward, homeward), (there_place, back_place), scale, tuple(sides), threshold)
