"""Pictures of the profile likelihood of every named parameter."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from discrepancy.inference.refit.profile import Profile, profiles
from discrepancy.page.amounts import pretty
from discrepancy.scales import of_estimate, of_parameter
from discrepancy.verdict import Answer
from discrepancy.words.as_told import tables_of, told_name
from fmu_src.arrays import Floats
from fmu_src.effect_words import effect_title
from fmu_src.progress import task
from pages import look
from pages.content import Section

# What 95 % of intervals keep below: one parameter's chi-square.
LIMIT = 3.84
HIGHEST = 18.0


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
        " follow. Grey is the parabola of the interval; a line that leaves it, flattens or has a second valley says that the interval is too simple."
    )
    return Section("profiles", "How well each parameter is known", lead if figures else "No parameter has an interval.", figures)


def between(p: Profile, best: float, at: Floats) -> Floats:
    """The profile ``at`` values between those computed: its root, with the sign of the side, is straight where a parabola fits."""
    order = np.argsort(p.values)
    root = np.sign(p.values - best) * np.sqrt(np.maximum(p.chi2, 0.0))
    found: Floats = np.interp(at, p.values[order], root[order]) ** 2
    return found


def figure(place: int, p: Profile, name: str, told: Mapping[str, Any] | None = None) -> look.Figure:
    """``told``: the estimate as the answer has it, whose unit the picture takes: far ends of a profile would ask for another."""
    scale = of_estimate(told) if told else of_parameter(float(np.abs(p.values).max()), p.unit, p.is_direction)
    x = scale.factor * p.values + scale.offset
    best, width = float(p.values[int(np.argmin(p.chi2))]), p.deviation
    fine = np.linspace(float(p.values.min()), float(p.values.max()), 61)
    parabola: list[Any] = look.short(((fine - best) / width) ** 2)
    unit = pretty(scale.unit)
    data = [
        look.line(look.short(scale.factor * fine + scale.offset, 5), parabola, look.QUIET, 1.2, "dot", name="parabola"),
        look.line(look.short(scale.factor * fine + scale.offset, 5), look.short(between(p, best, fine)), look.NOW, 2.0, name="profile"),
        look.line(look.short(x, 5), look.short(p.chi2), look.NOW, 2.0, mode="markers", name="computed"),
    ]
    limit = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": LIMIT, "y1": LIMIT, "line": {"color": look.QUIET, "width": 1}}
    layout = look.layout(
        xaxis=look.axis(f"{name}{f' [{unit}]' if unit else ''}", exponentformat="power"),
        yaxis=look.axis("chi-square above the best", range=[-0.5, HIGHEST]),
        shapes=[limit],
        annotations=[{"xref": "paper", "x": 1, "y": LIMIT, "text": "95 %", "showarrow": False, "xanchor": "right", "yanchor": "bottom"}],
    )
    return look.Figure(f"profile_{place}", name, "Below the line lie 95 %.", data, layout, 6)
