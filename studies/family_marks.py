"""What a size of a series fails in, by name: each figure of the model beside the mark that the catalogue, or a source, sets for it."""

from collections.abc import Sequence
from dataclasses import dataclass

from reducers.completion.dials import Dial
from studies.family import DIALS, FITTED, FIXED, MEASURED, SCATTER, SIZES, SPEEDS, Member, completed, dial_of

# Typical start-up efficiencies stand in the table in steps of five points.
START_UP = 5.0
# Read off catalogue charts in general [%], and of no-load torque at the input [N m] of RV reducers.
AT_RATED, AT_A_TENTH, NO_LOAD = (80.0, 90.0), (50.0, 60.0), (0.1, 0.6)


@dataclass(frozen=True)
class Mark:
    """A figure's mark, in words, and the sizes that fail it, each with what the model says beside the catalogue."""

    figure: str
    mark: str
    failed: tuple[str, ...]


def marks(members: Sequence[Member]) -> list[Mark]:
    """All marks, each with who fails it."""
    def outside(value: float, span: tuple[float, float]) -> bool:
        return not span[0] <= value <= span[1]

    rated, tenth = (1.0, SPEEDS[1]), (0.1, SPEEDS[1])
    return [
        Mark("stiffness", f"within {100 * SCATTER:.0f} % of the catalogue's (assumed)",
             tuple(f"{one.size.name} ({one.over_catalogue:.3f} of it)" for one in members if abs(one.over_catalogue - 1.0) > SCATTER)),
        Mark("stiffness", f"within {100 * MEASURED:.0f} %, as measured RV-40E are",
             tuple(f"{one.size.name} ({one.over_catalogue:.3f} of it)" for one in members if abs(one.over_catalogue - 1.0) > MEASURED)),
        Mark("lost motion", "below the catalogue's limit",
             tuple(f"{one.size.name} ({one.lost_motion:.2f}')" for one in members if one.lost_motion > one.size.lost_motion)),
        Mark("start-up efficiency", f"within {START_UP:g} points of the catalogue's typical one",
             tuple(f"{one.size.name} ({one.start_up:.0f} against {one.size.start_up:g} %)"
                   for one in members if abs(one.start_up - one.size.start_up) > START_UP)),
        Mark("efficiency at rated load", f"{AT_RATED[0]:g} to {AT_RATED[1]:g} %, read off charts in general",
             tuple(f"{one.size.name} ({one.efficiency[rated]:.0f} %)" for one in members if outside(one.efficiency[rated], AT_RATED))),
        Mark("efficiency at a tenth of it", f"{AT_A_TENTH[0]:g} to {AT_A_TENTH[1]:g} %, likewise",
             tuple(f"{one.size.name} ({one.efficiency[tenth]:.0f} %)" for one in members if outside(one.efficiency[tenth], AT_A_TENTH))),
        Mark("no-load torque at the input", f"{NO_LOAD[0]:g} to {NO_LOAD[1]:g} N m, of RV reducers in general",
             tuple(f"{one.size.name} ({one.no_load:.3f} N m)" for one in members if outside(one.no_load, NO_LOAD))),
    ]  # fmt: skip


def passed(mark: Mark, members: Sequence[Member]) -> str:
    return f"{len(members) - len(mark.failed)} of {len(members)}"


def range_from(dial: Dial) -> str:
    """Where a dial's range comes from: a source, or nothing but good sense."""
    if dial.name == FITTED:
        return "value fitted to the stiffness of all sizes together; range assumed, about what single sizes would want"
    return dial.source


def fixed() -> list[tuple[Dial, float]]:
    """What stands at one end of its range for all sizes, and is no dial: (dial, value)."""
    return [(dial_of(name), value) for name, value in FIXED.items()]


def in_the_middle() -> int:
    """How many dials of the completion stand where its rules put them, untouched."""
    return len([dial for dial in completed(SIZES[1]).dials if dial.name not in {*DIALS, *FIXED}])
