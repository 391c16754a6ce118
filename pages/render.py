"""A page as one HTML file with everything it needs inside: it opens offline."""

import gzip
import json
from base64 import b64encode
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from fmu_src.checked_file import write_text
from pages.content import Choosable, Page
from pages.look import Figure, Trace
from pages.words import in_print, units_in_print

HERE = Path(__file__).parent


def rendered(template: Path, figures: Sequence[Figure], hours: Sequence[str] = (), **values: object) -> str:
    """HTML of a template that extends ``page.html``; equal content gives equal bytes.

    ``figures`` are all that the template shows; ``hours`` the entries of the slider that some of them follow.
    """
    names = [figure.name for figure in figures]
    if len(set(names)) != len(names):
        raise ValueError(f"figures share a name: {sorted(names)}")
    environment = Environment(
        loader=FileSystemLoader([template.parent, HERE]), autoescape=True, trim_blocks=True, lstrip_blocks=True, finalize=in_print,
    )  # fmt: skip
    return environment.get_template(template.name).render(
        style=inside("page.css"), dark=inside("dark.js"), narrow=inside("narrow.js"), script=inside("page.js"), plotly=Markup(packed_plotly()),
        content=embedded(figures, hours), hours=hours, **values,
    )  # fmt: skip


@cache
def packed_plotly() -> str:
    """plotly.js, gzip in base64: 2 MB instead of 5 in every page; browsers since 2023 unpack it by themselves.  Equal at every call."""
    return b64encode(gzip.compress(get_plotlyjs().encode(), 9, mtime=0)).decode()


def rendered_sections(page: Page) -> str:
    """HTML of a page of cards, figures and tables."""
    return rendered(HERE / "sections.html", page.figures, page=page)


def written(text: str, path: Path) -> Path:
    """Write a page, whole or not at all."""
    write_text(Path(path), text)
    return Path(path)


def inside(name: str) -> Markup:
    """A file of this folder, to stand in the page."""
    return Markup((HERE / name).read_text(encoding="utf-8"))


def embedded(figures: Sequence[Figure], hours: Sequence[str]) -> Markup:
    """All figures as JSON that may stand inside a script element."""
    content = {"hours": list(hours), "figures": [described(figure) for figure in figures]}
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return Markup(text.replace("<", "\\u003c"))


def described(figure: Figure) -> dict[str, Any]:
    choices = figure.choices if isinstance(figure, Choosable) else []
    return {
        "name": figure.name, "data": named(figure.data), "layout": in_print(figure.layout), "states": figure.states, "rows": figure.rows_of,
        "height": figure.height, "choices": [{"traces": named(choice.traces), "layout": in_print(choice.layout)} for choice in choices],
    }  # fmt: skip


def named(traces: list[Trace]) -> list[Trace]:
    """With names and words under the pointer in print; numbers, of which there may be many, and words of axes stay."""
    return [{key: units_in_print(value) if type(value) is str else value for key, value in trace.items()} for trace in traces]
