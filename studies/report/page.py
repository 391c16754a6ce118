"""The page: figures and words put into the template."""

from dataclasses import replace
from pathlib import Path

import xarray as xr
from markupsafe import Markup

from pages import look
from pages.look import Figure
from pages.render import rendered
from pages.words import hour_text
from studies.report import circles, contacts, findings, growth, inputs, parts, phase, spectrum, tooth
from studies.report.result import Result

TEMPLATE = Path(__file__).with_name("life.html")


def sections_of(result: Result) -> dict[str, list[Figure]]:
    return {
        "parts": [parts.disc(result), tooth.shape(result), tooth.depth(result), *circles.figures(result)],
        "turn": [*contacts.figures(result), phase.figure(result)],
        "growth": growth.figures(result),
        "orders": spectrum.figures(result),
    }


def figures_of(dataset: xr.Dataset) -> list[Figure]:
    """All figures of the report, those that follow the hours at the last one."""
    result = Result.of(dataset)
    hours = [hour_text(result.hours[i]) for i in result.shown]
    figures = [at_last(with_hours(figure, hours)) for group in sections_of(result).values() for figure in group]
    maps = {figure.name: figure.data[0]["z"] for figure in figures if figure.data and "z" in figure.data[0]}
    return [with_rows(figure, maps[figure.rows_of]) if figure.rows_of else figure for figure in figures]


def with_rows(figure: Figure, rows: list[list[float]]) -> Figure:
    """The figure with the rows of a map as the heights of its first traces."""
    return replace(figure, data=[trace | {"y": rows[k]} if k < len(rows) else trace for k, trace in enumerate(figure.data)])


def at_last(figure: Figure) -> Figure:
    """The figure as the page shows it when its slider is at the end."""
    if not figure.states:
        return figure
    first, last = figure.states[0][0], figure.states[0][-1]
    changes = [first[new] if isinstance(new, int) else new for new in last]
    return replace(figure, data=[trace | new if isinstance(new, dict) else trace for trace, new in zip(figure.data, changes)], states=[])


def page_of(result: Result) -> str:
    """The whole report as HTML."""
    hours = [hour_text(result.hours[i]) for i in result.shown]
    figures = sections_of(result)
    sections = {name: [with_hours(figure, hours) for figure in group] for name, group in figures.items()}
    return rendered(
        TEMPLATE, [figure for group in sections.values() for figure in group], hours,
        result=result, sections=sections, cards=findings.cards(result), sentences=findings.sentences(result),
        conditions=findings.conditions(result), start=hours[0], hour_keys=list(zip(hours, look.hour_colours(len(hours)))),
        tables=spectrum.tables(result), groups=inputs.groups(result), run=inputs.run_rows(result), counts=inputs.counts(result),
        spark=(findings.SPARK_WIDTH, findings.SPARK_HEIGHT),
    )  # fmt: skip


def with_hours(figure: Figure, hours: list[str]) -> Figure:
    """The figure with the compared hours in its words."""
    keys: list[tuple[str, str, str]] = [(heading(text, hours[0], hours[-1]), colour, dash) for text, colour, dash in figure.keys]
    title, caption = (heading(text, hours[0], hours[-1]) for text in (figure.title, figure.caption))
    return replace(figure, title=title, caption=caption, keys=keys)


def heading(text: str, start: str, now: str) -> Markup:
    """A title with the compared hours in place of {start} and {now}; the script keeps {now} up to date."""
    return Markup(
        str(Markup.escape(text)).replace("{start}", str(Markup.escape(start)))
        .replace("{now}", str(Markup('<span class="now">{}</span>').format(now)))
    )  # fmt: skip
