"""Effects whose opposite would show the same: what was measured then says how large they are, not which way.

The seat of one crank, too far forward by as much as it might be too far back, opens a loop as wide.
"""

from collections.abc import Sequence
from typing import Any

from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.verdict import STOPPED, Diagnosis
from discrepancy.other_places import as_shown


def sign_doubts(effects: Sequence[dict[str, Any]], found: Diagnosis) -> list[str]:
    """A sentence for each named effect whose sign the fitted runs do not tell; two predictions each."""
    if found.verdict == STOPPED:
        return []
    members = {m.name: m for m in found.fits.members}
    alone = [members[candidate] for e in effects for candidate in e["candidates"] if candidate in members]
    return [
        f"{member.name}: with the opposite sign it shows the same in the runs that were fitted; they tell its size, not which way"
        for member in alone
        if either_sign(member, found)
    ]


def either_sign(member: Refit, found: Diagnosis) -> bool:
    """Whether the effect of a member shows the same with all its amplitudes the other way round."""
    fitted = dict(member.fit.values)
    amplitudes = [p for c in member.candidates for p in c.amplitudes if fitted[p.name] != p.off]
    opposite = {p.name: 2.0 * p.off - fitted[p.name] for p in amplitudes}
    if not amplitudes or any(p.sign or not p.lower <= opposite[p.name] <= p.upper for p in amplitudes):
        return False
    own = {p.name for p in member.own}
    rest = {name: value for name, value in fitted.items() if name not in own}
    return as_shown(found.fits.space, fitted, rest)({**fitted, **opposite})
