"""The page: all claims put into the template, with everything it needs inside."""

import json
from pathlib import Path

from jinja2 import Environment, FileSystemLoader
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from reproduce.claim import CONDITIONAL, CONTRADICTED, NOT_TESTABLE, REPRODUCED, SOURCES, VERDICTS, Claim
from reproduce.table import audited_text, value_text

HERE = Path(__file__).parent
CLASSES = {REPRODUCED: "yes", CONDITIONAL: "if", CONTRADICTED: "no", NOT_TESTABLE: "open"}


def page_of(claims: list[Claim]) -> str:
    """The whole page as HTML; equal claims give equal bytes."""
    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    groups = [(source, [c for c in claims if c.source == source]) for source in SOURCES]
    figures = [figure for claim in claims for figure in claim.figures]
    names = [figure.name for figure in figures]
    if len(set(names)) != len(names):
        raise ValueError(f"figures share a name: {sorted(names)}")
    content = [{"name": f.name, "data": f.data, "layout": f.layout} for f in figures]
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    numbers = [n for c in claims for n in c.numbers if n.agrees is not None]
    return environment.get_template("page.html").render(
        groups=[(source, found) for source, found in groups if found], classes=CLASSES, number=value_text,
        audited=audited_text,
        counts=[(v, CLASSES[v], sum(c.verdict == v for c in claims)) for v in VERDICTS], total=len(claims),
        confirmed=sum(n.agrees for n in numbers), compared=len(numbers), fallen=[c for c in claims if not c.stands],
        discrepancies=[(c, n) for c in claims for n in c.discrepancies],
        style=Markup((HERE / "page.css").read_text(encoding="utf-8")),
        script=Markup((HERE / "page.js").read_text(encoding="utf-8")),
        plotly=Markup(get_plotlyjs()), figures=Markup(text.replace("<", "\\u003c")),
    )  # fmt: skip
