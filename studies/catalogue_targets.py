"""What a catalogue says of a completed reducer that its numbers were made for, and what the stiffness test reads of it."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from fmu_src.faults import RunFault
from fmu_src.unit_words import unit_on_screen
from reducers.checking import Check
from reducers.completion.again import command, given_again
from reducers.completion.given import GAP, PLAY, Given
from reducers.reducer import Reducer
from studies.hysteresis import Hysteresis, hysteresis

STIFFNESS, LOST_MOTION = "torsional stiffness", "lost motion"
# A figure this share off the catalogue's is that.
SAME = 0.02


@dataclass(frozen=True)
class Target:
    """A figure of the catalogue in its unit, ``asked`` and as the stiffness test reads it."""

    name: str
    unit: str
    asked: float
    reached: float

    @property
    def miss(self) -> float:
        return self.reached - self.asked

    @property
    def is_met(self) -> bool:
        return abs(self.miss) <= SAME * abs(self.asked)

    @property
    def miss_words(self) -> str:
        return f"{abs(self.miss):.3g} too {'much' if self.miss > 0.0 else 'little'}"

    @property
    def words(self) -> str:
        return f"{self.name} {self.asked:g} {unit_on_screen(self.unit)} asked, {self.reached:.3g} reached"


def asked_of(given: Given | None) -> dict[str, float]:
    """What the catalogue says, by name."""
    if given is None:
        return {}
    stiff = {} if given.stiffness is None else {STIFFNESS: given.stiffness}
    return stiff | ({LOST_MOTION: given.lost_motion} if given.asks_lost_motion else {})


def tested(reducer: Reducer) -> Hysteresis | None:
    """The stiffness test of it; None where it does not stand that, which its check says."""
    try:
        return hysteresis(reducer, [])
    except RunFault:
        return None


def targets_of(test: Hysteresis | None, asked: Mapping[str, float]) -> list[Target]:
    """All that a catalogue asks for as the ``test`` reads it."""
    if test is None:
        return []
    reached = {STIFFNESS: ("N.m/arcmin", test.stiffness_Nm_per_arcmin), LOST_MOTION: ("arcmin", test.lost_motion_arcmin)}
    return [Target(name, reached[name][0], value, reached[name][1]) for name, value in asked.items()]


def held_against(found: Check) -> tuple[Check, list[Target]]:
    """A checked file with a doubt for each figure of its catalogue that it misses and the command that comes as near as it goes; and all such figures."""
    given = None if found.faults else given_again(found.reducer)
    asked = asked_of(given)
    if given is None or not asked:
        return found, []
    targets = targets_of(tested(found.reducer), asked)
    missed = [target for target in targets if not target.is_met]
    nearer = any(target.name != LOST_MOTION or not is_narrowest(given) for target in missed)
    doubts = [
        f"{target.name} {target.reached:.3g} {(unit := unit_on_screen(target.unit))} misses the catalogue's {target.asked:g} {unit}, {target.miss_words}: "
        + ("it was not made for it, or other numbers were changed since; complete it anew" if nearer else
           f"of {', '.join(PLAY)} each is given or the least of its range; look at what is given, or measure one of them")
        for target in missed
    ]  # fmt: skip
    return replace(found, doubts=[*found.doubts, *doubts], completing=found.completing or (command(found.reducer) if nearer else "")), targets


def is_narrowest(given: Given) -> bool:
    """Whether completing anew would leave gap, clearance and play as they are; a gap that is given is no reason to make the others smaller."""
    return GAP in given.known or all(name in given.made or name in given.known for name in PLAY)


def as_json(targets: Collection[Target]) -> list[dict[str, object]]:
    return [vars(target) | {"miss": target.miss, "met": target.is_met} for target in targets]
