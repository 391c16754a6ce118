"""Which stated numbers are not what reducers of this kind have: the ranges of the design rules, a share scaled by the size that the others have.

Nothing is refused for it: somebody may have such a reducer.
"""

from collections.abc import Collection, Mapping
from dataclasses import replace

from fmu_src.display import read_in
from fmu_src.faults import InputFault
from reducers.completion.complete import RULES, UNITS, Completion, dials_for, numbers_of
from reducers.completion.dials import ASSUMED, Dial
from reducers.completion.doubts import FREE
from reducers.completion.given import GAP, SHIFT, Given
from reducers.completion.supports import SUPPORT_ASSUMED

# So much of its range a number may lie beyond it before it is unusual (assumed: the discs of an RV-40E are 8 % wider than the handbooks have them, the pins
# of an RV-20E 2 % thinner).
BEYOND = 0.1
# Numbers that are the same in all reducers of this kind.
ALONE = {dial.name: dial for dial in (*ASSUMED, *SUPPORT_ASSUMED)}
# What of races and rollers is left open where one of them is looked at: it would follow from the others.
LEFT_OPEN = {"outer_race.radius": ("inner_race.radius", "roller.radius"), "roller.radius": ("inner_race.radius",)}


def unusual_alone(have: Mapping[str, float], stated: Collection[str]) -> dict[str, str]:
    """Of ``ALONE`` what was ``stated`` and is not usual, in words by name; ``have`` in the units of a completion."""
    return {name: said(name, have[name], dial.low, dial.high, dial.source) for name, dial in ALONE.items()
            if name in stated and is_beyond(have[name], dial.low, dial.high)}  # fmt: skip


def unusual(given: Given, have: Mapping[str, float], stated: Collection[str]) -> dict[str, str]:
    """The same of all numbers that a rule has a range for, with the sizes and the torque that there are."""
    dials = {dial.name: dial for dial in dials_for(given)}
    found = unusual_alone(have, stated)
    for name in (name for name in have if name in stated and name not in found and name in RULES and name not in (GAP, SHIFT)):
        own = dials.get(RULES[name][1])
        span = own and usual_range(given, have, name, own, dials)
        if own and span and is_beyond(have[name], *span):
            share = f"{own.meaning} {own.low:.3g} to {own.high:.3g}{'' if own.unit == '1' else f' {own.unit}'}"
            found[name] = said(name, have[name], *span, f"{share}; {own.source}")
    if {GAP, SHIFT} & {*stated} and (gap := unusual_gap(given, have, dials)):
        found[GAP] = gap
    return found


def usual_range(given: Given, have: Mapping[str, float], name: str, own: Dial, dials: Mapping[str, Dial]) -> tuple[float, float] | None:
    """What the rule makes of a number at either end of its own dial, all else as it is; None where it makes nothing of that."""
    known = {one: value for one, value in have.items() if one not in (name, *LEFT_OPEN.get(name, ()))}
    middle = {dial.name: dial.value for dial in dials.values()}
    try:
        low, high = sorted(numbers_of(replace(given, known=known), middle | {own.name: end})[name] for end in (own.low, own.high))
    except (InputFault, ArithmeticError, ValueError):
        return None
    return low, high


def unusual_gap(given: Given, have: Mapping[str, float], dials: Mapping[str, Dial]) -> str:
    """Of the gap of the flanks that both modifications make together, for one may take back what the other adds; empty where it is usual."""
    spans = [usual_range(given, have, name, dials[own], dials) for name, own in ((GAP, "gap"), (SHIFT, "shift"))]
    if spans[0] is None or spans[1] is None:
        return ""
    gap, most = have[GAP] - have[SHIFT], spans[0][1] - spans[1][0]
    if not is_beyond(gap, 0.0, most):
        return ""
    return (f"{GAP} = {have[GAP]:.5g} um and {SHIFT} = {have[SHIFT]:.5g} um leave a gap of {gap:.4g} um at the flanks, where 0 to {most:.3g} um is usual"
            f" ({dials['gap'].source}, here {given.lost_motion:g} arcmin): look at both, and at their units")  # fmt: skip


def is_beyond(value: float, low: float, high: float) -> bool:
    return low < high and not low - BEYOND * abs(low) <= value <= high + BEYOND * abs(high)


def said(name: str, value: float, low: float, high: float, why: str) -> str:
    unit, (shown, least, most) = read_in(UNITS[name], value, low, high)
    unit = "" if unit == "1" else f" {unit}"
    return f"{name} = {shown:.5g}{unit}, where {least:.3g} to {most:.3g}{unit} is usual ({why}): look at it, and at its unit"


def doubts_of_known(completion: Completion) -> list[str]:
    """Of a completion what was given and is not usual; the supports that make a catalogue's stiffness have a doubt of their own."""
    given = completion.given
    stated = {name for name in given.known if name != FREE or given.stiffness is None}
    return [*unusual(given, {name: number.value for name, number in completion.numbers.items()}, stated).values()]
