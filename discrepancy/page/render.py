"""A page as HTML with everything it needs inside."""

import json

from jinja2 import Environment
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from discrepancy.page.content import Choosable, Page
from discrepancy.page.template import SCRIPT, STYLE, TEMPLATE
from pages.embed import STYLE as LOOK
from pages.embed import inside


def rendered(page: Page) -> str:
    """HTML text; equal pages give equal bytes."""
    plots = [figure for section in page.sections for figure in section.figures]
    names = [figure.name for figure in plots]
    if len(set(names)) != len(names):
        raise ValueError(f"figures share a name: {sorted(names)}")
    content = []
    for figure in plots:
        choices = figure.choices if isinstance(figure, Choosable) else []
        content.append(
            {
                "name": figure.name,
                "data": figure.data,
                "layout": figure.layout,
                "choices": [{"traces": c.traces, "layout": c.layout} for c in choices],
            }
        )
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    template = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True).from_string(TEMPLATE)
    return template.render(
        page=page,
        style=inside(LOOK) + Markup(STYLE),
        script=Markup(SCRIPT),
        plotly=Markup(get_plotlyjs()),
        content=Markup(text.replace("<", "\\u003c")),
        has_choices=lambda f: bool(getattr(f, "choices", None)),
    )
