"""Recovered laws: curves with their bands, the points behind them, closed forms ranked."""

import numpy as np

from discrepancy.inference.law.closed_forms import Form, closed_forms
from discrepancy.inference.law.recover import Recovered
from discrepancy.inference.law.splines import Curve
from discrepancy.page import amounts, panels
from discrepancy.page.runs import slug
from discrepancy.page.whys import of_form
from discrepancy.scales import Scale
from fmu_src.arrays import Floats
from pages import look
from pages.content import Table
from pages.look import Figure, short
from pages.words import capital, number

MOST_FORMS = 8
MOST_SHARE_HIDDEN = 0.02
FORM_COLOUR = "#d55e00"


def figures(law: Recovered, speed: Scale) -> list[Figure]:
    """The leading curve over its points, and the other curves that matter."""
    factor, y_unit = law.y_told
    title = f"misfit / {law.factor}" if law.factor else f"misfit of {amounts.signal_title(law.signal.partition('[')[0])}"
    title += f" at the largest {law.growth.factor}" if law.growth else ""
    title += f" [{amounts.pretty(y_unit)}]" if y_unit else ""
    name = f"law_{slug(law.signal)}"
    lead = next(c for c in law.curves if c.name == law.leading)
    others = [c for c in law.curves if c.name != law.leading and c.share > MOST_SHARE_HIDDEN]
    made = [leading(name, law, lead, factor, title, 12 if not others else 8)]
    for curve in others:
        x = amounts.axis_values(curve.name, curve.x, speed)
        half = 1.96 * factor * curve.deviation
        traces = [
            panels.band(x, factor * curve.y - half, factor * curve.y + half, ""),
            look.line(short(x, 5), short(factor * curve.y, 4), look.NOW, hover="%{y} at %{x}"),
        ]
        layout = look.layout(xaxis=look.axis(amounts.axis_title(curve.name, speed)), yaxis=look.axis(title))
        made.append(
            Figure(
                f"{name}_{slug(curve.name)}",
                f"Beside it, over {curve.name.replace('_', ' ')}",
                f"{100 * curve.share:.0f} % of the variance; centred.",
                traces,
                layout,
                4,
                340,
            )
        )
    return made


def sentence(law: Recovered) -> str:
    """The best form in words."""
    text = law.text.replace(law.signal, amounts.signal_title(law.signal))
    return capital(text) + "."


def told(law: Recovered, x: Floats) -> Floats:
    """Values of the leading axis in the unit of the law."""
    factor, offset, _ = law.x_told
    return factor * np.asarray(x, float) + offset


def leading(name: str, law: Recovered, curve: Curve, factor: float, title: str, columns: int) -> Figure:
    x, y, deviation = (np.asarray(law.points[k], float) for k in ("x", "y", "deviation"))
    # Curves are centred; the points carry the level.
    weight = 1.0 / np.maximum(deviation, 1e-300) ** 2
    level = float(np.average(y - np.interp(x, curve.x, curve.y), weights=weight)) if x.size else 0.0
    grid = told(law, curve.x)
    middle, half = factor * (curve.y + level), 1.96 * factor * curve.deviation
    dots = {
        "type": "scatter",
        "mode": "markers",
        "name": "measured, averaged",
        "x": short(told(law, x), 5),
        "y": short(factor * y, 4),
        "marker": {"color": panels.MEASURED, "size": 5, "opacity": 0.7},
        "hovertemplate": "%{y} at %{x}<extra></extra>",
        "error_y": {"type": "data", "array": short(factor * deviation, 3), "thickness": 0.8, "width": 0, "color": "#c9d0d7"},
    }
    traces = [
        panels.band(grid, middle - half, middle + half, "95 %"),
        dots,
        look.line(short(grid, 5), short(middle, 4), look.NOW, 2.2, hover="curve: %{y} at %{x}") | {"name": "curve"},
    ]
    best = law.forms[0] if law.forms else None
    drawn = evaluated(best, told(law, x), grid) if best else None
    if best is not None and drawn is not None:
        traces.append(
            look.line(short(grid, 5), short(drawn, 4), FORM_COLOUR, 1.8, "dash", hover="closed form: %{y} at %{x}")
            | {"name": f"{best.name}: {best.text}"}
        )
    held = ""
    if law.held_out_error_before is not None and law.held_out_error_after is not None:
        held = (
            f" With this law the error on runs that were not used goes from {number(law.held_out_error_before)} to "
            f"{number(law.held_out_error_after)} times the noise."
        )
    legend = {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom", "font": {"size": 11.5}}
    layout = look.layout(
        xaxis=look.axis(law.leading.replace("_", " ") + (f" [{amounts.pretty(law.x_told[2])}]" if law.x_told[2] else "")),
        yaxis=look.axis(title),
        showlegend=True,
        legend=legend,
        margin={"l": 64, "r": 16, "t": 30, "b": 46},
    )
    heading = f"{amounts.signal_title(law.signal).capitalize()} over {law.leading.replace('_', ' ')}"
    return Figure(
        name,
        heading,
        f"What is left of the misfit after the other dependences, {100 * curve.share:.0f} % of its variance.{held}",
        traces,
        layout,
        columns,
        340,
    )


def evaluated(form: Form, x: Floats, grid: Floats) -> Floats | None:
    """A closed form along the curve; None where it is not finite."""
    known = closed_forms(x)
    if form.name not in known:
        return None
    y = known[form.name][2](grid, **form.parameters)
    return y if np.all(np.isfinite(y)) else None


def in_unit(unit: str) -> str:
    return f" in {amounts.pretty(unit)}" if unit else ""


def table(law: Recovered) -> Table:
    """Closed forms, most credible first."""
    rows = []
    for form in law.forms[:MOST_FORMS]:
        rows.append([form.name, form.text, "; ".join(form.numbers(3, number)), number(form.error), f"{100 * form.confidence:.0f} %"])
    note = (
        f"x: {law.leading.replace('_', ' ')}{in_unit(law.x_told[2])}, y: misfit{' / ' + law.factor if law.factor else ''}"
        f"{in_unit(law.y_told[1])}; 95 % intervals. Errors are on points left out, in times the noise."
    )
    return Table(
        f"Closed forms for {amounts.signal_title(law.signal)}", ["form", "law", "parameters", "error", "confidence"], rows, (3, 4), note,
        [of_form(form) for form in law.forms[:MOST_FORMS]],
    )
