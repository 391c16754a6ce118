"""The page of an ensemble: bands over the hours, hours to the limits, and which parameter makes the scatter, from its result file."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.faults import InputFault
from fmu_src.reading import read_text, reading
from pages import look
from pages.charts import COLOURS
from pages.content import Card, Page, Section, Table
from pages.look import Figure, Trace
from pages.words import hour_text, number, units_in_print
from studies.figure_units import figure_unit

WHAT, REMEDY = "a result of rvwear ensemble", "rvwear ensemble writes one"
# Of the bands' height what lies between two of them, and what one takes on the screen [px].
GAP, PANE = 0.025, 120
NINE, HALF = "rgba(11,79,148,0.13)", "rgba(11,79,148,0.22)"
LIMIT = "#a3195b"


def read_result(path: Path) -> dict[str, Any]:
    """The content of a file that ``rvwear ensemble`` wrote; InputFault for any other."""
    text = read_text(path, "result file", REMEDY)
    with reading(path, WHAT, REMEDY):
        content = json.loads(text)
        if not isinstance(content, dict) or "lives_planned" not in content:
            raise InputFault(f"{path}: no result of rvwear ensemble; a life (.nc) and an ensemble (.json) have a report")
        if "bands" not in content:
            raise InputFault(f"{path}: it holds no bands over the hours, as results of former versions: run rvwear ensemble again, its lives are kept")
    return content


def figures_of(found: Mapping[str, Any]) -> list[Figure]:
    """The bands, then what matters; of too few lives none."""
    return [*([bands(found)] if found["bands"]["panes"] else []), *([shares(found)] if matters(found) else [])]


def page_of(found: Mapping[str, Any]) -> Page:
    hours, done, planned = float(found["hours"]), int(found["lives_done"]), int(found["lives_planned"])
    spread = figures_of(found)
    few = "Too few lives have ended for a distribution." if not spread else ""
    end = Section("end", f"After {hour_text(hours)}", "With 95 % intervals of so many lives.", tables=[at_end(found), of_variance(found)]) if spread else None
    sections = [
        Section("bands", "Over the hours", few or "Each life has parts, load and coefficients of its own.", spread), *([end] if end else []),
        Section("scatter", "What scatters", "Each life draws these anew.", tables=[of_scatters(found)]),
    ]  # fmt: skip
    failed = int(found["lives_failed"])
    warnings = [f"{done} of {planned} lives are done: the same command goes on."] if done < planned else []
    if failed:
        warnings.append(f"{lives(failed)} failed and {'is' if failed == 1 else 'are'} not in the bands: {found['faults'][0]}")
    return Page("many lives", str(found["reducer"]), f"{done} of {planned} lives of {hour_text(hours)}", finding(found), cards(found), sections, warnings)


def finding(found: Mapping[str, Any]) -> str:
    """The answer in a sentence: the life where there are limits, else the lost motion at the end."""
    hours = hour_text(float(found["hours"]))
    if "distributions" not in found:
        return "Too few lives have ended for a distribution."
    if life := found.get("life_hours"):
        middle = life["q50"]["value"]
        stay = f"More than half of the reducers stay within their limits for {hours}"
        half = stay if middle is None else f"Half of the reducers reach a limit by {hour_text(middle)}"
        return f"{half}; {percent(found['beyond_any_limit'])} pass one within {hours}."
    lost = found["distributions"]["lost_motion_arcmin"]
    low, middle, high = (number(lost[q]["value"]) for q in ("q05", "q50", "q95"))
    return f"After {hours} half of the reducers have more than {middle} arcmin of lost motion, nine of ten {low} to {high} arcmin."


def percent(share: Mapping[str, float]) -> str:
    value, low, high = (f"{100.0 * share[key]:.0f}" for key in ("value", "low", "high"))
    return f"{value} % ({low} to {high} %)"


def cards(found: Mapping[str, Any]) -> list[Card]:
    if "distributions" not in found:
        return []
    told = []
    if life := found.get("life_hours"):
        low, middle, high = (lasting(life[q]["value"], float(found["hours"])) for q in ("q05", "q50", "q95"))
        told.append(Card("time to the first limit", middle, f"the middle of all; nine of ten {low} to {high}", unit="h"))
    told += [Card(f"beyond {found['limits'][name]:g} {unit_of(name)} of {title_of(name)}", f"{100.0 * share['value']:.0f}",
                  f"of the reducers, at the end; {100.0 * share['low']:.0f} to {100.0 * share['high']:.0f} % with 95 %", unit="%")
             for name, share in found.get("beyond_limits", {}).items()]  # fmt: skip
    for name in ("lost_motion_arcmin", "disc_flank_um"):
        at = found["distributions"][name]
        low, middle, high = (number(at[q]["value"]) for q in ("q05", "q50", "q95"))
        told.append(Card(f"{title_of(name)} at the end", middle, f"the middle of all; nine of ten {low} to {high}", unit=unit_of(name)))
    return told


def lasting(hours: float | None, most: float) -> str:
    return f"more than {most:,.0f}" if hours is None else f"{hours:,.0f}"


def bands_words(found: Mapping[str, Any]) -> str:
    of = found["bands"]
    return f"Of {of['lives']} lives the {of['counted']} that stand for the distributions: the middle one, and bands that hold half of them and nine of ten."


def bands(found: Mapping[str, Any]) -> Figure:
    """Panes one below the other, as the workbench has them, with limits across."""
    told = found["bands"]
    panes, hours = told["panes"], np.asarray(told["hours"], float)
    height = (1.0 - (len(panes) - 1) * GAP) / len(panes)
    traces: list[Trace] = []
    layout: look.Layout = {"shapes": []}
    for k, pane in enumerate(panes):
        own = "y" if k == 0 else f"y{k + 1}"
        low, lower, middle, upper, high = (np.asarray(row, float) for row in pane["quantiles"])
        limit, unit = pane.get("limit"), units_in_print(pane["unit"])
        hover = f"%{{x:,.0f}} h: %{{y:.4~g}} {unit}"
        traces += [trace | {"xaxis": "x", "yaxis": own, "showlegend": k == 0} for trace in (
            area(hours, low, high, NINE, "nine of ten"), area(hours, lower, upper, HALF, "half of them"),
            look.line(look.short(hours, 5), look.short(middle, 5), look.NOW, hover=hover, name="the middle one"),
        )]  # fmt: skip
        base = (len(panes) - 1 - k) * (height + GAP)
        span = look.padded(np.concatenate((low, high, [limit] if limit is not None else [])), 0.0, 0.08)
        layout[f"{own[0]}axis{own[1:]}"] = look.axis(
            f"{pane['title']}<br>[{unit}]", range=span, domain=[round(base, 4), round(base + height, 4)], nticks=4, automargin=True,
        )  # fmt: skip
        if limit is not None:
            layout["shapes"].append({"type": "line", "xref": "paper", "yref": own, "x0": 0, "x1": 1, "y0": limit, "y1": limit,
                                     "line": {"color": LIMIT, "width": 1.5, "dash": "dash"}})  # fmt: skip
    layout["xaxis"] = look.hour_axis(hours) | {"anchor": "y" if len(panes) == 1 else f"y{len(panes)}"}
    legend = {"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom", "font": {"size": 11.5}}
    picture = look.layout(showlegend=True, legend=legend, margin={"l": 76, "r": 20, "t": 30, "b": 46}, **layout)
    caption = bands_words(found) + (" Dashed: limits." if layout["shapes"] else "")
    return Figure("bands", f"{lives(int(told['counted']))} over the hours", caption, traces, picture, 7, PANE * len(panes) + 90)


def lives(count: int) -> str:
    return f"{count} {'life' if count == 1 else 'lives'}"


def area(hours: np.ndarray, low: np.ndarray, high: np.ndarray, colour: str, name: str) -> Trace:
    around = {"x": look.short(np.concatenate((hours, hours[::-1])), 5), "y": look.short(np.concatenate((low, high[::-1])), 5)}
    return {"type": "scatter", "mode": "lines", "fill": "toself", "fillcolor": colour, "line": {"width": 0}, "hoverinfo": "skip", "name": name, **around}


def matters(found: Mapping[str, Any]) -> dict[str, dict[str, dict[str, float]]]:
    """By figure the parameters with their shares of its variance; without figures that do not scatter."""
    return {name: rows for name, rows in found.get("sensitivity", {}).items() if rows}


def names_of(found: Mapping[str, Any]) -> dict[str, str]:
    """The names that files have of what scatters, by those that the shares have."""
    return {one["parameter"]: one["name"] for one in found["scatters"]}


def shares(found: Mapping[str, Any]) -> Figure:
    told = matters(found)
    figures = [title_of(name) for name in told]
    names = sorted(next(iter(told.values())))
    traces = [
        {"type": "bar", "orientation": "h", "name": names_of(found).get(name, name), "y": figures, "marker": {"color": COLOURS[k % len(COLOURS)]},
         "x": look.short([max(0.0, rows[name]["total"]) for rows in told.values()], 3)}
        for k, name in enumerate(names)
    ]  # fmt: skip
    legend = {"orientation": "h", "x": 0, "y": -0.14, "yanchor": "top", "font": {"size": 11.5}}
    layout = look.layout(barmode="group", xaxis=look.axis("share of the variance, with all interactions", rangemode="tozero"),
                         yaxis=look.axis("", autorange="reversed"), showlegend=True, legend=legend, margin={"l": 100, "r": 20, "t": 10, "b": 46})  # fmt: skip
    caption = "Sobol' indices: what of a figure's scatter would go if that parameter did not scatter. With few lives they are rough, and may pass 1."
    return Figure("shares", "What matters", caption, traces, layout, 5, 480)


def at_end(found: Mapping[str, Any]) -> Table:
    rows = [[title_of(name), unit_of(name), *(with_interval(value) for value in values.values())] for name, values in found["distributions"].items()]
    if life := found.get("life_hours"):
        rows.append(["hours to the first limit", "h", "", *(lasting_interval(life[q], float(found["hours"])) for q in ("q05", "q50", "q95"))])
    return Table("Distributions at the end", ["figure", "unit", "mean", "5 %", "50 %", "95 %"], rows, (2, 3, 4, 5))


def with_interval(value: Mapping[str, float]) -> str:
    return f"{number(value['value'])} ({number(value['low'])} to {number(value['high'])})"


def lasting_interval(value: Mapping[str, float | None], most: float) -> str:
    told, low, high = (lasting(value[key], most) for key in ("value", "low", "high"))
    return told if told == low == high else f"{told} ({low} to {high})"


def of_variance(found: Mapping[str, Any]) -> Table:
    told = matters(found)
    rows = [
        [names_of(found).get(name, name), *(f"{rows[name]['alone']:.2f} / {rows[name]['total']:.2f}" for rows in told.values())]
        for name in sorted(next(iter(told.values()), {}))
    ]
    note = "" if rows else "Said where all lives are done and more than one parameter scatters."
    return Table("Share of the variance that a parameter makes, alone / with all interactions", ["parameter", *map(title_of, told)], rows,
                 tuple(range(1, 1 + len(told))), note)  # fmt: skip


def of_scatters(found: Mapping[str, Any]) -> Table:
    rows = [
        [one["name"], one["distribution"], ", ".join(f"{key} {value:.6g}" for key, value in one["numbers"].items()),
         "" if one["unit"] == "1" else units_in_print(one["unit"])]
        for one in found["scatters"]
    ]  # fmt: skip
    return Table("", ["number", "distribution", "its numbers", "unit"], rows)


def title_of(figure: str) -> str:
    return figure.rpartition("_")[0].replace("_", " ")


def unit_of(figure: str) -> str:
    return units_in_print(figure_unit(figure))

