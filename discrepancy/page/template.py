"""The frame of the pages; colours and type are those of the wear report (pages/page.css)."""

STYLE = """
:root { --good: #00705a; --fair: #9a6a00; --bad: #b3401b; --plain: #0b4f94; }
.good { --tone: var(--good); } .fair { --tone: var(--fair); } .bad { --tone: var(--bad); } .plain { --tone: var(--plain); }
.cards { grid-template-columns: repeat(auto-fit, minmax(176px, 1fr)); }
.card .values { color: var(--tone); white-space: normal; }
.warnings { list-style: none; margin: 0 0 24px; padding: 0; font-size: 13.5px; }
.warnings li { border-left: 3px solid #e0a000; background: #fff9ec; padding: 5px 12px; margin-bottom: 4px; max-width: 88em; }
.top { display: flex; flex-wrap: wrap; align-items: baseline; justify-content: space-between; gap: 4px 18px; }
.top label { font-size: 12.5px; color: var(--quiet); display: flex; gap: 6px; align-items: center; }
.top select { font: inherit; max-width: 24em; padding: 1px 4px; border: 1px solid var(--line); border-radius: 4px; background: var(--paper); color: var(--ink); }
main .grid + .scroll, main .scroll + .scroll, main .lead + .scroll { margin-top: 14px; }
.scroll .note { font-size: 13px; color: var(--quiet); margin-top: 6px; }
td.right, th.right { text-align: right; white-space: nowrap; }
.printing .top select { border: 0; appearance: none; }
"""

SCRIPT = """"use strict";
(() => {
  const figures = JSON.parse(document.getElementById("content").textContent);
  const config = { responsive: true, displayModeBar: false, doubleClick: "reset" };
  const place = (figure) => document.getElementById("plot-" + figure.name);
  // Data and layout of a figure at its chosen entry.
  function shown(figure) {
    const select = document.querySelector(`select[data-figure="${figure.name}"]`);
    if (!select) return [figure.data, structuredClone(figure.layout)];
    const choice = figure.choices[Number(select.value)];
    const data = figure.data.map((trace, i) => ({ ...trace, ...choice.traces[i] }));
    return [data, structuredClone({ ...figure.layout, ...choice.layout })];
  }
  for (const figure of figures) {
    Plotly.newPlot(place(figure), ...shown(figure), config);
    const select = document.querySelector(`select[data-figure="${figure.name}"]`);
    if (select) select.addEventListener("change", () => Plotly.react(place(figure), ...shown(figure), config));
  }
  // A phone that scrolls over a plot must not zoom it.
  if (matchMedia("(hover: none)").matches) {
    for (const figure of figures) Plotly.relayout(place(figure), { dragmode: false });
  }
  function fit(printing) {
    document.body.classList.toggle("printing", printing);
    for (const figure of figures) {
      const p = place(figure);
      Plotly.relayout(p, printing ? { width: p.clientWidth, height: p.clientHeight } : { width: null, height: null, autosize: true });
    }
  }
  window.addEventListener("beforeprint", () => fit(true));
  window.addEventListener("afterprint", () => fit(false));
})();
"""

TEMPLATE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{ page.title }}: {{ page.kind }}</title>
<style>
{{ style }}
</style>
</head>
<body>
<header>
<p class="kind">{{ page.kind }}</p>
<h1>{{ page.title }}</h1>
<p class="conditions">{{ page.conditions }}</p>
<p class="finding">{{ page.finding }}</p>
{% if page.warnings %}
<ul class="warnings">
{% for text in page.warnings %}
<li>{{ text }}</li>
{% endfor %}
</ul>
{% endif %}
{% if page.cards %}
<div class="cards">
{% for card in page.cards %}
<div class="card {{ card.tone }}">
<p class="label">{{ card.label }}{% if card.unit %} <span class="unit">{{ card.unit }}</span>{% endif %}</p>
<p class="values">{% if card.start %}<span class="from">{{ card.start }}</span><span class="arrow">→</span>{% endif %}<span class="to">{{ card.value }}</span></p>
<p class="note">{{ card.note }}</p>
</div>
{% endfor %}
</div>
{% endif %}
{% if page.sections | length > 1 %}
<nav>{% for s in page.sections %}<a href="#{{ s.id }}">{{ s.title }}</a>{% endfor %}</nav>
{% endif %}
<noscript><p class="finding">The figures need JavaScript; it is inside this file.</p></noscript>
</header>
<main>
{% for s in page.sections %}
<section id="{{ s.id }}">
<h2>{{ s.title }}</h2>
<p class="lead">{{ s.lead }}</p>
{% if s.figures %}
<div class="grid">
{% for figure in s.figures %}
<figure class="span{{ figure.columns }}{{ ' tall' if figure.rows > 1 }}">
<div class="top"><h3>{{ figure.title }}</h3>{% if has_choices(figure) %}
<label>{{ figure.asks }} <select data-figure="{{ figure.name }}">{% for c in figure.choices %}<option value="{{ loop.index0 }}">{{ c.label }}</option>{% endfor %}</select></label>
{% endif %}</div>
<div class="plot" id="plot-{{ figure.name }}" style="height: {{ figure.height }}px"></div>
<figcaption>{{ figure.caption }}</figcaption>
</figure>
{% endfor %}
</div>
{% endif %}
{% for table in s.tables %}
<div class="scroll">
{% if table.title %}
<h3>{{ table.title }}</h3>
{% endif %}
<table>
<thead><tr>{% for name in table.head %}<th{% if loop.index0 in table.right %} class="right"{% endif %}>{{ name }}</th>{% endfor %}</tr></thead>
<tbody>
{% for row in table.rows %}
<tr>{% for cell in row %}<td{% if loop.index0 in table.right %} class="right"{% endif %}>{{ cell }}</td>{% endfor %}</tr>
{% endfor %}
</tbody>
</table>
{% if table.note %}
<p class="note">{{ table.note }}</p>
{% endif %}
</div>
{% endfor %}
</section>
{% endfor %}
</main>
<script type="application/json" id="content">{{ content }}</script>
<script>{{ plotly }}</script>
<script>
{{ script }}
</script>
</body>
</html>
"""
