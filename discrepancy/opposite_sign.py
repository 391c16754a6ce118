"""Effects whose opposite would show the same: what was measured then says how large they are, not which way.

The seat of one crank, too far forward by as much as it might be too far back, opens a loop as wide.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from discrepancy.as_told import told_name
from discrepancy.inference.refit.directions import half_a_turn_on
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.verdict import STOPPED, Diagnosis
from discrepancy.other_places import as_shown
from fmu_src.table import Table

SAME = "shows the same in the runs that were fitted"


def sign_doubts(effects: Sequence[dict[str, Any]], found: Diagnosis) -> list[str]:
    """A sentence for each named effect whose sign the fitted runs do not tell; two predictions each."""
    return [
        f"{member.name}: with the opposite sign it {SAME}; they tell its size, not which way"
        for member in alone(effects, found)
        if either_sign(member, found)
    ]


def direction_doubts(effects: Sequence[dict[str, Any]], found: Diagnosis, tables: Sequence[Table]) -> list[str]:
    """A sentence for each direction of a named effect that half a turn further shows the same; two predictions each.

    Of a ring with an even number of pins, about discs that take turns half a turn apart, an error is as well on the other side.
    """
    found_doubts = []
    for member in alone(effects, found):
        if not (others := list(half_a_turn_on(member.candidates, member.fit.values))):
            continue
        same = shown_by(member, found)
        for p, other in others:
            if same({p.name: other}):
                here, there = (f"{math.degrees(angle):.1f} deg" for angle in (member.fit.values[p.name], other))
                found_doubts.append(
                    f"{told_name(p.name, tables)}: {there} {SAME} as {here}; they do not tell which of the two it is"
                )
    return found_doubts


def alone(effects: Sequence[dict[str, Any]], found: Diagnosis) -> list[Refit]:
    """The refits of named effects by themselves; none of a diagnosis that was stopped."""
    if found.verdict == STOPPED:
        return []
    members = {m.name: m for m in found.fits.members}
    return [members[candidate] for e in effects for candidate in e["candidates"] if candidate in members]


def either_sign(member: Refit, found: Diagnosis) -> bool:
    """Whether the effect of a member shows the same with all its amplitudes the other way round."""
    fitted = dict(member.fit.values)
    amplitudes = [p for c in member.candidates for p in c.amplitudes if fitted[p.name] != p.off]
    opposite = {p.name: 2.0 * p.off - fitted[p.name] for p in amplitudes}
    if not amplitudes or any(p.sign or not p.lower <= opposite[p.name] <= p.upper for p in amplitudes):
        return False
    return shown_by(member, found)(opposite)


def shown_by(member: Refit, found: Diagnosis) -> Callable[[Mapping[str, float]], bool]:
    """Whether other values of a member's parameters show in the fitted runs what its own do."""
    fitted, own = dict(member.fit.values), {p.name for p in member.own}
    same = as_shown(found.fits.space, fitted, {name: value for name, value in fitted.items() if name not in own})
    return lambda other: same({**fitted, **other})
