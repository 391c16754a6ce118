"""The page of a series: stiffness beside the catalogue's, where the compliance sits and what is missing, efficiency over load."""

from collections.abc import Mapping, Sequence

import numpy as np

from pages import look
from pages.charts import COLOURS, Curve, chart
from pages.content import Card, Page, Section, Table
from pages.look import Figure
from studies.family import CATALOGUE, SHARES, SPEEDS, Member, dial_of
from studies.family_marks import fixed, in_the_middle, marks, passed, range_from

MISSING, TOO_MUCH = "missing for the catalogue", "more than the catalogue has"


def page_of(dials: Mapping[str, float], members: Sequence[Member]) -> Page:
    judged = marks(members)
    stiff, loose = judged[0], next(mark for mark in judged if mark.figure == "lost motion")
    cards = [
        Card("stiffness within a quarter", passed(stiff, members), f"not within: {', '.join(stiff.failed)}" if stiff.failed else "model over catalogue"),
        Card("lost motion below the catalogue's limit", passed(loose, members), ", ".join(loose.failed)),
        Card("dials for all sizes", str(len(dials)), f"none for one size; {len(fixed())} more fixed, {in_the_middle()} as rules put them"),
    ]
    failing = {mark.figure: mark.failed for mark in reversed(judged) if mark.failed}
    finding = f"{passed(stiff, members)} sizes have the catalogue's stiffness within a quarter. Not within a mark: " + (
        "; ".join(f"{figure}: {', '.join(failed)}" for figure, failed in reversed(failing.items())) or "none"
    )
    sections = [
        Section("stiffness", "Stiffness", "Full and half torque, input locked, friction included.", [stiffness(members), compliances(members)]),
        Section("efficiency", "Efficiency", f"At {SPEEDS[1]:g} rpm; the catalogue's charts were not to be had.", [over_load(members)]),
        Section("numbers", "Numbers", "", tables=[of_marks(members), numbers(members), of_dials(dials)]),
    ]
    return Page("family", "RV-E series", f"{len(members)} sizes from catalogue numbers alone", finding, cards, sections, [f"Catalogue: {CATALOGUE}."])


def stiffness(members: Sequence[Member]) -> Figure:
    names = [one.size.name for one in members]
    traces = [
        {"type": "bar", "name": word, "x": names, "y": look.short(values, 4), "marker": {"color": colour}}
        for word, values, colour in (
            ("catalogue", [one.size.stiffness for one in members], look.START), ("model", [one.stiffness for one in members], look.NOW),
        )
    ]  # fmt: skip
    layout = look.layout(barmode="group", xaxis=look.axis(""), yaxis=look.axis("N m/arcmin", type="log"), **BELOW)
    return Figure("stiffness", "Torsional stiffness", "Logarithmic.", traces, layout, 6, 340)


def compliances(members: Sequence[Member]) -> Figure:
    """Where the turning under rated torque comes from, and what is missing or too much."""
    names = [one.size.name for one in members]
    parts = sorted(members[0].parts, key=lambda part: -members[0].parts[part])
    traces = [
        {"type": "bar", "name": part, "x": names, "y": look.short([one.parts[part] * one.size.rated for one in members], 4),
         "marker": {"color": COLOURS[k % len(COLOURS)]}}
        for k, part in enumerate(parts)
    ]  # fmt: skip
    for word, sign, pattern in ((MISSING, 1.0, "/"), (TOO_MUCH, -1.0, "x")):
        values = [max(0.0, sign * one.missing) * one.size.rated * sign for one in members]
        hatched = {"color": "rgba(0,0,0,0)", "line": {"color": look.QUIET, "width": 1.5}, "pattern": {"shape": pattern, "fgcolor": look.QUIET}}
        traces.append({"type": "bar", "name": word, "x": names, "y": look.short(values, 4), "marker": hatched})
    layout = look.layout(barmode="relative", xaxis=look.axis(""), yaxis=look.axis("turning at rated torque [arcmin]"), **BELOW)
    return Figure(
        "compliances", "Where the compliance sits, and what is missing",
        "Springs alone. Hatched: what the cranks' supports, four fifths of the whole, would have to yield more (up) or less (down) for the"
        " catalogue's stiffness.",
        traces, layout, 6, 340,
    )  # fmt: skip


def over_load(members: Sequence[Member]) -> Figure:
    shares = np.array(SHARES[::-1])
    curves = []
    for k, one in enumerate(members):
        efficiency = np.array([one.efficiency[share, SPEEDS[1]] for share in shares])
        curves.append(Curve(one.size.name, 100.0 * shares, efficiency, dash="solid" if k < len(COLOURS) else "dot", mode="lines+markers"))
    return chart("efficiency", "Efficiency over load", "Read off catalogue charts in general: 80 to 90 % at rated load, 50 to 60 % at a tenth.", curves,
                 "load [% of rated]", "efficiency [%]", 12, 340)


def numbers(members: Sequence[Member]) -> Table:
    head = [
        "size", "stiffness, catalogue", "model", "ratio", "lost motion, catalogue", "model", "start-up, catalogue", "model", "no load at the input [N m]",
        "crank supports softer by",
    ]  # fmt: skip
    rows = [
        [one.size.name, f"{one.size.stiffness:g}", f"{one.stiffness:.4g}", f"{one.over_catalogue:.2f}", f"below {one.size.lost_motion:g}",
         f"{one.lost_motion:.2f}", f"{one.size.start_up:g} %", f"{one.start_up:.0f} %", f"{one.no_load:.3f}", f"{100.0 * one.missing_at_cranks:+.0f} %"]
        for one in members
    ]  # fmt: skip
    return Table("Sizes: stiffness [N m/arcmin], lost motion [arcmin], start-up efficiency", head, rows, tuple(range(1, 10)))


def of_marks(members: Sequence[Member]) -> Table:
    rows = [[mark.figure, mark.mark, passed(mark, members), ", ".join(mark.failed)] for mark in marks(members)]
    return Table("Marks, and which size fails in which", ["figure", "mark", "within", "not within"], rows, (2,))


def of_dials(dials: Mapping[str, float]) -> Table:
    found = [(dial_of(name), value, "dial") for name, value in dials.items()] + [(dial, value, "fixed") for dial, value in fixed()]
    rows = [[d.name, d.meaning, f"{value:.3g}", f"{d.low:.3g} to {d.high:.3g}", kind, range_from(d)] for d, value, kind in found]
    return Table("Dials and what is fixed beside them, the same for all sizes", ["dial", "meaning", "value", "range", "", "range from"], rows, (2, 3))


BELOW: look.Layout = {
    "showlegend": True, "margin": {"l": 60, "r": 20, "t": 10, "b": 46},
    "legend": {"orientation": "h", "x": 0, "y": -0.16, "yanchor": "top", "font": {"size": 11.5}},
}  # fmt: skip
