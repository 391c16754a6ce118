"""The HTML page of the catalogue: one file with everything inside, one picture per effect."""

import json
from pathlib import Path

from jinja2 import Environment
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from discrepancy.catalogue.catalogue import Entry
from discrepancy.catalogue.signature import Signature, words
from pages.look import Figure
from reproduce import page as reproduce

# The look is that of the page of claims.
STYLE = Path(reproduce.__file__).with_name("page.css")
SCRIPT = """"use strict";
for (const f of JSON.parse(document.getElementById("content").textContent))
  Plotly.newPlot("plot-" + f.name, f.data, f.layout, {responsive: true, displayModeBar: false, doubleClick: "reset"});
"""
TEMPLATE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Effects and their signatures</title>
<style>
{{ style }}
</style>
</head>
<body>
<header>
<p class="kind">Wear of RV reducers</p>
<h1>Effects and their signatures</h1>
<p class="finding">What a real reducer and its sensors may do beyond the ideal model. Every effect is compiled into the units and off by default; the pictures show it on the virtual bench at RV20E-121, beside the bench without it.</p>
<noscript><p class="finding">The plots need JavaScript; it is inside this file.</p></noscript>
</header>
<main>
<section>
<div class="sheet"><table class="overview"><tbody>
{% for e, found, figure in effects %}
<tr><td>{{ e.number }}</td><td><a href="#{{ e.name }}">{{ e.effect.title }}</a></td><td>{{ e.part }}</td></tr>
{% endfor %}
</tbody></table></div>
</section>
<section>
{% for e, found, figure in effects %}
<article id="{{ e.name }}" class="yes">
<div class="head"><span class="id">{{ e.number }}</span><h3>{{ e.effect.title }}</h3><span class="tag">{{ e.part }}</span></div>
<p class="says">{{ e.effect.law }}</p>
<p class="why">Expected: {{ e.effect.signature }}.</p>
<p class="lead">Source: {{ e.effect.source }}.</p>
<figure><h4>{{ figure.title }}</h4><div class="plot" id="plot-{{ figure.name }}" style="height: {{ figure.height }}px"></div><figcaption>{{ figure.caption }}</figcaption></figure>
{% for s in found %}
<p class="why"><b>{{ s.case.title }}.</b> {{ words(s, 8) | join("; ") or "Nothing that the bench measures changes." }}</p>
{% endfor %}
<table class="numbers"><thead><tr><th>parameter</th><th>off or start</th><th>bounds</th><th>unit</th><th style="text-align: left">meaning</th></tr></thead><tbody>
{% for p in e.effect.parameters %}
<tr><td>{{ p.variable.name }}</td><td>{{ "%g" | format(p.variable.start) }}</td><td>{{ "%g" | format(p.variable.minimum) }} to {{ "%g" | format(p.variable.maximum) }}</td><td>{{ p.variable.unit }}</td><td style="text-align: left; white-space: normal">{{ p.variable.description }}</td></tr>
{% endfor %}
</tbody></table>
</article>
{% endfor %}
</section>
</main>
<script type="application/json" id="content">{{ figures }}</script>
<script>{{ plotly }}</script>
<script>
{{ script }}
</script>
</body>
</html>
"""


def page_of(effects: list[tuple[Entry, list[Signature], Figure]]) -> str:
    """The whole page as HTML; equal content gives equal bytes."""
    content = [{"name": f.name, "data": f.data, "layout": f.layout} for _, _, f in effects]
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    template = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True).from_string(TEMPLATE)
    return template.render(
        effects=effects, words=words, style=Markup(STYLE.read_text(encoding="utf-8")), script=Markup(SCRIPT),
        plotly=Markup(get_plotlyjs()), figures=Markup(text.replace("<", "\\u003c")),
    )  # fmt: skip
