"""The page: figures and words put into the template, with everything it needs inside."""

import json
from pathlib import Path

from jinja2 import Environment, FileSystemLoader
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from pages import look
from pages.embed import STYLE, inside
from pages.look import Figure
from studies.report import circles, contacts, findings, growth, inputs, parts, phase, spectrum, tooth
from studies.report.result import Result, hour_text

HERE = Path(__file__).parent


def page_of(result: Result) -> str:
    """The whole report as HTML."""
    sections = {
        "parts": [parts.disc(result), tooth.shape(result), tooth.depth(result), *circles.figures(result)],
        "turn": contacts.figures(result) + [phase.figure(result)],
        "growth": growth.figures(result),
        "orders": spectrum.figures(result),
    }
    plots = [figure for group in sections.values() for figure in group]
    names = [figure.name for figure in plots]
    if len(set(names)) != len(names):
        raise ValueError(f"figures share a name: {sorted(names)}")
    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    hours = [hour_text(result.hours[i]) for i in result.shown]
    return environment.get_template("page.html").render(
        result=result, sections=sections, cards=findings.cards(result), sentences=findings.sentences(result),
        conditions=findings.conditions(result), hours=hours, start=hours[0],
        hour_keys=list(zip(hours, look.hour_colours(len(hours)))), tables=spectrum.tables(result),
        groups=inputs.groups(result), run=inputs.run_rows(result), counts=inputs.counts(result), heading=heading,
        spark=(findings.SPARK_WIDTH, findings.SPARK_HEIGHT), style=inside(STYLE), script=inside(HERE / "life.js"),
        plotly=Markup(get_plotlyjs()), figures=embedded(plots, hours),
    )  # fmt: skip


def heading(text: str, start: str, now: str) -> Markup:
    """A title with the compared hours in place of {start} and {now}; the script keeps {now} up to date."""
    return Markup(
        str(Markup.escape(text)).replace("{start}", str(Markup.escape(start)))
        .replace("{now}", str(Markup('<span class="now">{}</span>').format(now)))
    )  # fmt: skip


def embedded(plots: list[Figure], hours: list[str]) -> Markup:
    """All figures as JSON that may stand inside a script element."""
    content = {
        "hours": hours,
        "figures": [
            {"name": f.name, "data": f.data, "layout": f.layout, "states": f.states, "rows": f.rows_of} for f in plots
        ],
    }
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return Markup(text.replace("<", "\\u003c"))
