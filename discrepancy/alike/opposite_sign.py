"""Effects that would show the same the other way round, or half a turn on: what was measured then says how large they are, not which way, or not where.

The seat of one crank, too far forward by as much as it might be too far back, opens a loop as wide.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from discrepancy.alike.other_places import as_shown
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.directions import half_a_turn_on
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.verdict import STOPPED, Diagnosis
from discrepancy.problem import Candidate

SAME = "shows the same in the runs that were fitted"
# Behind the name of an effect.
OTHER_WAY = f"with the opposite sign it {SAME}; they tell its size, not which way"


def with_others(effects: Sequence[Mapping[str, Any]], found: Diagnosis) -> list[dict[str, Any]]:
    """The effects, each parameter with the other value that shows the same as ``alike`` where there is one; two predictions each, none of a diagnosis that
    was stopped."""
    named = {candidate for effect in effects for candidate in effect["candidates"]}
    members = [] if found.verdict == STOPPED else [m for m in found.fits.members if named & {c.name for c in m.candidates}]
    # Of alternatives the first is the one whose values are told.
    others = {name: value for member in reversed(members) for name, value in others_of(member, found.fits.space).items()}
    return [
        {**effect, "parameters": {name: {**entry, "alike": others[name]} if name in others else entry for name, entry in effect["parameters"].items()}}
        for effect in effects
    ]


def others_of(member: Refit, space: Workspace) -> dict[str, float]:
    """By parameter of a fit the other value that shows the same in the fitted runs: a direction half a turn on, and amplitudes of an effect that may as well be
    all the other way round.

    Of a ring with an even number of pins, about discs that take turns half a turn apart, an error is as well on the other side.
    """
    same = shown_by(member, space)
    found = {}
    for p, other in half_a_turn_on(member.candidates, member.fit.values):
        between = 0.5 * (member.fit.values[p.name] + other)
        # What a quarter of a turn on shows the same, too, is no direction that anything tells.
        if same({p.name: other}) and not same({p.name: between}):
            found[p.name] = other
    for candidate in member.candidates:
        opposite = opposite_of(candidate, member.fit.values)
        if opposite and same(opposite):
            found |= opposite
    return found


def opposite_of(candidate: Candidate, fitted: Mapping[str, float]) -> dict[str, float]:
    """All amplitudes of an effect that are not off, the other way round; none where one of them can only go one way."""
    amplitudes = [p for p in candidate.amplitudes if not p.is_off(fitted[p.name])]
    opposite = {p.name: 2.0 * p.off - fitted[p.name] for p in amplitudes}
    return {} if any(p.sign or not p.lower <= opposite[p.name] <= p.upper for p in amplitudes) else opposite


def shown_by(member: Refit, space: Workspace) -> Callable[[Mapping[str, float]], bool]:
    """Whether other values of a member's parameters show in the fitted runs what its own do."""
    fitted, own = dict(member.fit.values), {p.name for p in member.own}
    same = as_shown(space, fitted, {name: value for name, value in fitted.items() if name not in own})
    return lambda other: same({**fitted, **other})
