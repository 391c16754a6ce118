"""The page: figures and words put into the template."""

from dataclasses import replace
from pathlib import Path

from markupsafe import Markup

from pages import look
from pages.look import Figure
from pages.render import rendered
from pages.words import hour_text
from studies.report import circles, contacts, findings, growth, inputs, parts, phase, spectrum, tooth
from studies.report.result import Result

TEMPLATE = Path(__file__).with_name("life.html")


def page_of(result: Result) -> str:
    """The whole report as HTML."""
    hours = [hour_text(result.hours[i]) for i in result.shown]
    figures = {
        "parts": [parts.disc(result), tooth.shape(result), tooth.depth(result), *circles.figures(result)],
        "turn": [*contacts.figures(result), phase.figure(result)],
        "growth": growth.figures(result),
        "orders": spectrum.figures(result),
    }
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
