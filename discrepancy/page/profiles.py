"""Pictures of the profile likelihood of every named parameter."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.special import stdtrit

from discrepancy.inference.refit.profile import Profile, profiles
from discrepancy.page.amounts import pretty
from discrepancy.scales import Scale, of_estimate, of_parameter
from discrepancy.verdict import Answer
from discrepancy.words.as_told import tables_of, told_name
from discrepancy.words.intervals import interval_text, relied_on
from fmu_src.arrays import Floats
from fmu_src.effect_words import effect_title
from fmu_src.progress import task
from pages import look
from pages.content import Section
from pages.words import number

# What 95 % of intervals keep below where the noise is known for sure and nothing widens them: one parameter's chi-square.
LIMIT = 3.84
HIGHEST = 18.0
# Share of the interval's half by which the profile may cross the line elsewhere before it is said.
ELSEWHERE = 0.1
# An interval that is wider by less than this factor is not said to be widened.
SEEN = 1.02


def section(answer: Answer) -> Section:
    """Of the best fit: all effects that are named together, or the best of those that are alternatives."""
    space, best = answer.diagnosis.fits.space, answer.diagnosis.fits.members[0]
    # They take most of the time of a page.
    if best.name not in answer.profiles:
        with task("looking at how well each parameter is known"):
            answer.profiles[best.name] = profiles(space, best)
    told = {name: entry for effect in answer.effects for name, entry in effect["parameters"].items()}
    figures = [figure(k, p, told_name(p.name, tables_of(answer.model)), told.get(p.name)) for k, p in enumerate(answer.profiles[best.name])]
    lead = (
        f"How much worse the fit of {' + '.join(effect_title(c.name) for c in best.candidates)} becomes as one parameter is moved and all others"
        " follow. Dotted is the parabola that the interval stated is of, the band this interval, and the line where it ends: it lies higher the fewer"
        " degrees of freedom tell the noise and the more the interval is widened. A profile that leaves the parabola, flattens or has a second valley"
        " says that the interval is too simple."
    )
    return Section("profiles", "How well each parameter is known", lead if figures else "No parameter has an interval.", figures)


def between(p: Profile, best: float, at: Floats) -> Floats:
    """The profile ``at`` values between those computed: its root, with the sign of the side, is straight where a parabola fits."""
    order = np.argsort(p.values)
    root = np.sign(p.values - best) * np.sqrt(np.maximum(p.chi2, 0.0))
    found: Floats = np.interp(at, p.values[order], root[order]) ** 2
    return found


def limit_of(p: Profile, told: Mapping[str, Any]) -> tuple[float, str]:
    """Chi-square above the best at which the parabola of a fit has the interval that is stated of it, and why there."""
    dof, widened = float(told.get("degrees_of_freedom", np.inf)), told["standard_deviation"] / p.deviation
    known = 1.0 <= dof < 1e6
    student = float(stdtrit(dof, 0.975)) if known else float(np.sqrt(LIMIT))
    low, high = told["interval"]
    first, last = relied_on(told)
    beside = (last - first) / (high - low) if high > low else 1.0
    reasons = [f"Student's law of {dof:.0f} degrees of freedom"] if known else []
    reasons += [f"{number(widened)} times as wide for the misfit that is left"] if widened > SEEN else []
    reasons += [f"{number(beside)} times as wide for the base model's own numbers"] if beside > SEEN else []
    return (student * widened * beside) ** 2, ", ".join(reasons)


def crossings(p: Profile, level: float) -> tuple[float | None, float | None]:
    """Where the profile first crosses a ``level`` to either side of its best; None where it stays below as far as it was computed."""
    best = float(p.values[int(np.argmin(p.chi2))])
    ends: list[float | None] = []
    for end in (float(p.values.min()), float(p.values.max())):
        fine = np.linspace(best, end, 401)
        beyond = between(p, best, fine) > level
        ends.append(float(fine[int(np.argmax(beyond))]) if beyond.any() else None)
    return ends[0], ends[1]


def caption_of(p: Profile, told: Mapping[str, Any], scale: Scale, level: float, why: str) -> str:
    """What the line and the band are, and where the profile crosses the line where that is elsewhere."""
    low, high = relied_on(told)
    unit = pretty(scale.unit)
    of = f" {unit}" if unit and unit != "1" else ""

    def text(a: float, b: float) -> str:
        return interval_text(scale.number(a), scale.number(b))

    where = f"where the parabola lies below the line, {number(level)} above the best{why and f' ({why})'}"
    said = f"Band: the 95 % interval stated, {text(low, high)}{of}; {where}."
    if told.get("told_with"):
        why = "the fitted runs tell it only together with others, which make up for it along all of it"
        return f"Band: the 95 % interval stated, {text(low, high)}{of}: {why}."
    first, last = crossings(p, level)
    apart = [abs((float(edge) if end is None else end) - stated) for end, edge, stated in ((first, p.values.min(), low), (last, p.values.max(), high))]
    if max(apart) <= ELSEWHERE * 0.5 * (high - low):
        return said
    if first is None and last is None:
        return f"{said} The profile stays below the line as far as it was followed."
    if first is None or last is None:
        side, there = ("above", last) if first is None else ("below", first)
        at = f"{number(scale.number(float(there or 0.0)), 4)}{of}"
        return f"{said} The profile leaves the parabola: {side} the best it crosses the line at {at}, on the other side nowhere as far as it was followed."
    return f"{said} The profile leaves the parabola: it lies below the line from {text(first, last)}{of}, read between the places that are marked."


def figure(place: int, p: Profile, name: str, told: Mapping[str, Any] | None = None) -> look.Figure:
    """``told``: the estimate as the answer has it, whose unit the picture takes: far ends of a profile would ask for another."""
    scale = of_estimate(told) if told else of_parameter(float(np.abs(p.values).max()), p.unit, p.is_direction)
    x = scale.factor * p.values + scale.offset
    best, width = float(p.values[int(np.argmin(p.chi2))]), p.deviation
    fine = np.linspace(float(p.values.min()), float(p.values.max()), 61)
    # What the runs say nothing of at the fit itself has its range for an interval, and no parabola's end.
    open_ended = told is not None and not np.isfinite(told["standard_deviation"])
    level, why = limit_of(p, told) if told and not open_ended else (LIMIT, "")
    ends = scale.factor * np.array(relied_on(told)) + scale.offset if told else np.array([])
    # An interval that is wider than the profile was followed is drawn to its ends, too.
    reach = [*p.values, *(relied_on(told) if told else ())]
    wide = np.linspace(float(min(reach)), float(max(reach)), 61)
    parabola: list[Any] = look.short(((wide - best) / width) ** 2)
    unit = pretty(scale.unit)
    dotted = look.line(look.short(scale.factor * wide + scale.offset, 7), parabola, look.QUIET, 1.2, "dot", name="parabola")
    data = [
        *([] if told and told.get("told_with") else [dotted]),
        look.line(look.short(scale.factor * fine + scale.offset, 7), look.short(between(p, best, fine)), look.NOW, 2.0, name="profile"),
        look.line(look.short(x, 7), look.short(p.chi2), look.NOW, 2.0, mode="markers", name="computed"),
    ]
    limit = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": level, "y1": level, "line": {"color": look.QUIET, "width": 1}}
    band = {"type": "rect", "yref": "paper", "y0": 0, "y1": 1, "fillcolor": look.QUIET, "opacity": 0.12, "line": {"width": 0}, "layer": "below"}
    bands = [band | {"x0": float(ends.min()), "x1": float(ends.max())}] if len(ends) else []
    layout = look.layout(
        xaxis=look.axis(f"{name}{f' [{unit}]' if unit else ''}", exponentformat="power"),
        yaxis=look.axis("chi-square above the best", range=[-0.5, max(HIGHEST, 1.3 * level)]),
        shapes=[limit, *bands],
        annotations=[{"xref": "paper", "x": 1, "y": level, "text": "95 %", "showarrow": False, "xanchor": "right", "yanchor": "bottom"}],
    )
    said = caption_of(p, told, scale, level, why) if told and not open_ended else "Below the line lie 95 %."
    said += " Band: the parameter's range, which is stated as its interval, for at the fit itself the runs say nothing of it." if open_ended else ""
    return look.Figure(f"profile_{place}", name, said, data, layout, 6)
