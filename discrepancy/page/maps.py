"""Heat maps: error over noise by signal and condition, and where the misfit is."""

import math
from collections.abc import Mapping, Sequence, Set
from typing import Any

import numpy as np
import numpy.typing as npt

from discrepancy.inference.chance import chance, chance_number
from discrepancy.page.amounts import signal_title
from discrepancy.page.runs import slug
from discrepancy.page.whys import amount, of_place
from discrepancy.words.wording import SHARE, percent_of_misfit
from pages import look
from pages.content import Table
from pages.look import Figure, short
from pages.words import number

# Ratios from 1 (pale) to this are told apart by colour.
MOST_RATIO = 10.0
# p down to ten to the power of minus this.
MOST_DIGITS = 12.0
MOST_ROWS = 48
TESTED = "#eef1f4"
# As good as the noise; white is left for what was not measured, green for what unused runs show.
WITHIN = "#e3e9f0"


def heat(
    z: npt.ArrayLike,
    x: list[str],
    y: list[str],
    text: list[list[str]],
    hover: list[list[str]],
    title: str,
    low: float,
    high: float,
    ticks: Mapping[float, str] | None = None,
    colours: tuple[str, ...] = (WITHIN, *look.DEPTH),
) -> dict[str, Any]:
    """A heat map trace with its numbers in the cells."""
    bar = {
        "thickness": 10,
        "outlinewidth": 0,
        "tickfont": {"size": 11, "color": look.QUIET},
        "title": {"text": title, "side": "right", "font": {"size": 12, "color": look.QUIET}},
    }
    if ticks:
        bar |= {"tickvals": list(ticks), "ticktext": list(ticks.values())}
    return {
        "type": "heatmap",
        "z": short(z, 4),
        "x": x,
        "y": y,
        "text": text,
        "customdata": hover,
        "texttemplate": "%{text}",
        "hovertemplate": "%{customdata}<extra></extra>",
        "zmin": low,
        "zmax": high,
        "colorscale": look.colour_scale(colours),
        "xgap": 2,
        "ygap": 2,
        "textfont": {"size": 11},
        "colorbar": bar,
        "hoverongaps": False,
    }


def layout(y: Sequence[str], **more: Any) -> dict[str, Any]:
    """Names at the left, columns' names on top."""
    return look.layout(
        xaxis=look.axis("", type="category", side="top", showgrid=False, ticks="", tickangle=0 if more.pop("level", True) else -35),
        yaxis=look.axis("", type="category", autorange="reversed", showgrid=False, ticks=""),
        margin={"l": 60, "r": 20, "t": 40, "b": 10},
        **more,
    )


def grid(
    title: str, caption: str, name: str, cells: Mapping[tuple[str, str], float], held: Set[str] = frozenset(), bar: str = "error / noise"
) -> Figure:
    """Ratios over the noise by (row, condition); ``held`` marks conditions that were never fitted."""
    rows, columns = list(dict.fromkeys(r for r, _ in cells)), list(dict.fromkeys(c for _, c in cells))
    columns = [c for c in columns if c not in held] + [c for c in columns if c in held]
    values = np.array([[cells.get((r, c), math.nan) for c in columns] for r in rows])
    z = np.clip(np.log10(np.maximum(values, 1e-3)), 0.0, math.log10(MOST_RATIO))
    few = len(columns) <= 14
    labels = [c + (("<br>" if few else " ") + "(held out)" if c in held else "") for c in columns]
    text = [[number(v, 2) if math.isfinite(v) and few else "" for v in row] for row in values]
    names = [signal_title(r) for r in rows]
    hover = [[f"{n}, {c}: {number(v)} times the noise" for c, v in zip(columns, row)] for n, row in zip(names, values)]
    ticks = {0.0: "≤ 1", math.log10(2.0): "2", math.log10(5.0): "5", 1.0: f"≥ {MOST_RATIO:g}"}
    trace = heat(z, labels, names, text, hover, bar, 0.0, math.log10(MOST_RATIO), ticks)
    height = 90 + 34 * len(rows) + (0 if few else 60)
    return Figure(name, title, caption, [trace], layout(names, level=few and max(map(len, columns)) < 16), 12, max(height, 190))


def localisation(prefix: str, places: Sequence[Mapping[str, Any]], level: float) -> tuple[list[Figure], list[Table]]:
    """The map of all signals, feature by dependence, coloured by significance; and the single orders of each signal.

    Where nothing was varied the map would have one column: a table then.
    """
    named = [p for p in places if not p["feature"].startswith("order ")]
    varied = len({p["dependence"] for p in named}) > 1
    figures = [place_map(prefix, named, level)] if varied else []
    told = [p for p in named if p["p"] <= level] if varied else named
    tables = [place_table(told, level)] if told else []
    for signal in sorted({p["signal"] for p in places}):
        single = [p for p in places if p["signal"] == signal and p["feature"].startswith("order ")]
        if single:
            figures.append(comb(prefix, signal, single, level))
    return figures, tables


def place_table(places: Sequence[Mapping[str, Any]], level: float) -> Table:
    """Features, those first that carry most of the misfit, then the others by their significance."""
    shown = sorted(places, key=lambda p: (-p["share"], p["p"]))[:MOST_ROWS]
    alike = len({p["dependence"] for p in places}) == 1
    rows = [
        [signal_title(p["signal"]), told_feature(p, alike), percent_of_misfit(p["share"]) if p["p"] <= level else "", chance(p["p"]),
         "yes" if p["p"] <= level else "no"]
        for p in shown
    ]
    only = f"with {places[0]['dependence'].replace('_', ' ')}" if alike else "that is significant"
    where = "at all conditions alike" if all(p["dependence"] == "everywhere" for p in places) else only
    return Table(f"Misfit {where}", ["signal", "what", "share of all misfit", "p over all tests", f"significant at {chance_number(level)}"], rows, (2,),
                 whys=[of_place(dict(p), level) for p in shown])


def told_feature(p: Mapping[str, Any], alike: bool) -> str:
    """What carries a misfit, and with what it changes where that is not said of all."""
    depends = "" if alike else ", everywhere alike" if p["dependence"] == "everywhere" else f", with {p['dependence'].replace('_', ' ')}"
    return str(p["feature"]) + depends


def place_map(prefix: str, places: Sequence[Mapping[str, Any]], level: float) -> Figure:
    def row_of(p: Mapping[str, Any]) -> str:
        return f"{signal_title(p['signal'])} · {p['feature']}"

    at = {(row_of(p), p["dependence"]): p for p in places}
    rows = list(dict.fromkeys(row_of(p) for p in sorted(places, key=lambda p: p["signal"])))
    columns = sorted(dict.fromkeys(p["dependence"] for p in places), key=lambda c: (c != "everywhere", c))
    dropped = 0
    if len(rows) > MOST_ROWS:
        telling = [r for r in rows if any(at[r, c]["p"] <= level for c in columns if (r, c) in at)]
        dropped, rows = len(rows) - len(telling or rows[:MOST_ROWS]), telling or rows[:MOST_ROWS]
    z = np.array([[strength(at[r, c]["p"]) if (r, c) in at else math.nan for c in columns] for r in rows])
    text = [[percent_of_misfit(at[r, c]["share"]) if (r, c) in at and at[r, c]["p"] <= level else "" for c in columns] for r in rows]
    hover = [[described(at.get((r, c)), level) for c in columns] for r in rows]
    labels = ["everywhere alike" if c == "everywhere" else f"with {c.replace('_', ' ')}" for c in columns]
    # Up to the level all is grey: only what is significant takes colour.
    start = min(-math.log10(max(level, 1e-300)), 0.8 * MOST_DIGITS) / MOST_DIGITS
    scale = [[0.0, TESTED], [start, TESTED], *[[start + (1.0 - start) * (0.001 + 0.999 * i / 5), c] for i, c in enumerate(look.DEPTH)]]
    ticks = {0.0: "1", start * MOST_DIGITS: chance_number(level), MOST_DIGITS: f"≤ {chance_number(10.0**-MOST_DIGITS)}"}
    trace = heat(z, labels, rows, text, hover, "p", 0.0, MOST_DIGITS, ticks) | {"colorscale": scale}
    found = sum(p["p"] <= level for p in places)
    caption = (
        "Left column: alike at all conditions, right of it: changing with a factor. Colour: p over all tests "
        f"together; grey is tested and not significant at {chance_number(level)} ({found} of {len(places)} are). Numbers:"
        f" share {SHARE};"
        " features overlap, so shares need not add to 100 %."
    )
    caption += f" {dropped} rows without findings are left out." if dropped else ""
    return Figure(prefix, "Map of the misfit", caption, [trace], layout(rows), 12, 110 + 27 * max(len(rows), 3))


def strength(p: float) -> float:
    """-log10 of p, limited."""
    return min(-math.log10(max(p, 1e-300)), MOST_DIGITS)


def described(place: Mapping[str, Any] | None, level: float) -> str:
    if place is None:
        return "not tested"
    verdict = f"{percent_of_misfit(place['share'])} of all misfit" if place["p"] <= level else "not significant"
    return f"{place['feature']}, {place['dependence']}: {verdict}<br>{chance(place['p'])}, {amount(place)}, {place['width']} expected"


def comb(prefix: str, signal: str, places: Sequence[Mapping[str, Any]], level: float) -> Figure:
    """Single orders of the output's turn as bars."""
    places = sorted(places, key=lambda p: float(p["feature"].split()[1]))
    x = [float(p["feature"].split()[1]) for p in places]
    colours = [look.DEPTH[4] if p["p"] <= level else "#c9d0d7" for p in places]
    bars = {
        "type": "bar",
        "x": look.short(x, 5),
        "y": short([p["statistic"] / p["width"] for p in places], 4),
        "marker": {"color": colours},
        "width": 0.7,
        "customdata": [described(p, level) for p in places],
        "hovertemplate": "%{customdata}<extra></extra>",
    }
    picture = look.layout(
        xaxis=look.axis("order of the output's turn"), yaxis=look.axis("misfit over noise [variance]", rangemode="tozero")
    )
    caption = (
        f"Orders that belong to no named part. 1 is what noise alone gives on average; of {len(places)} tests some give several times that by chance:"
        f" coloured are those that all tests together leave significant (p ≤ {chance_number(level)})."
    )
    return Figure(
        f"{prefix}_orders_{slug(signal)}", f"{signal_title(signal).capitalize()}: single orders", caption, [bars], picture, 12, 240
    )
