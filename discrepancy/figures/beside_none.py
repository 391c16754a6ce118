"""A key figure that stands far off beside the verdict that nothing is missing: what it is, and why it names nothing."""

from collections.abc import Sequence

from discrepancy.figures.figure_chance import RARE, rarest
from discrepancy.figures.key_figures import CLEARLY, KeyFigure, furthest
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.chance import chance
from discrepancy.inference.misfit.localise import Group
from discrepancy.inference.noise.series import stream_of
from discrepancy.scales import shown


def beside_none(figures: Sequence[KeyFigure], space: Workspace, groups: Sequence[Group]) -> str:
    """Of the figure that is furthest off, as the end of a sentence; empty where none is clearly off or rarer than chance.  ``groups``: what was tested."""
    if not figures:
        return ""
    most = furthest(figures)[0]
    first = "furthest off"
    if abs(most.off) <= CLEARLY:
        most, p = rarest(figures)
        if p >= RARE:
            return ""
        first = f"that chance makes least often ({chance(p)} among all)"
    apart, noise = (shown(value, most.unit, most.told_as) for value in (abs(most.measured - most.model), most.noise))
    of = "what its repetitions differ by" if most.repeated else "what the noise of its samples makes of it"
    text = f"the figure {first}, of {len(figures)}, is {most.name} of {most.signal} at {most.condition}: {apart}, {abs(most.off):.1f} times {of} ({noise})"
    fitted = {(stream_of(space.records[i]), space.records[i].condition) for i in space.training}
    if (most.signal, most.condition) not in fitted:
        return f"{text}; its runs are held out, and only fitted ones are tested"
    tested = [g for g in groups if g.signal == most.signal]
    least = min(tested, key=lambda g: g.p, default=None)
    seen = f" (the least of {len(tested)}: {least.feature}, {chance(least.p)})" if least else ""
    return f"{text}; tests over all samples, which count how few repetitions tell the noise and how many tests there are, find nothing in that signal{seen}"
