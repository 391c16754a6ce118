"""The page of a comparison of fidelities: a table and, for each point, both wear profiles."""

import json
from pathlib import Path

import numpy as np
from jinja2 import Environment, FileSystemLoader
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from pages import look
from pages.embed import STYLE, inside
from pages.look import Figure
from studies.dynamics_wear import MAPS, Comparison, Point
from studies.report.page import HERE
from studies.report.result import number


def figures(point: Point, index: int) -> list[Figure]:
    """Flank, inner and outer raceway: equilibria in grey, motion in blue."""
    made = []
    for key, label in MAPS.items():
        still, moved = point.profiles[key]
        angle = look.short(360.0 * (np.arange(still.size) + 0.5) / still.size)
        traces = [look.line(angle, look.short(still, 4), look.START, 2.4, hover="equilibria, %{x:.0f}°: %{y} µm"),
                  look.line(angle, look.short(moved, 4), look.NOW, 1.6, hover="motion, %{x:.0f}°: %{y} µm")]
        where = "phase on the tooth [°]: 0 root, 180 tip" if key == "disc_wear" else "angle on the raceway [°]"
        axes = {"xaxis": look.angle_axis(where, 0.0, 360.0, 60.0), "yaxis": look.axis("depth [µm]")}
        made.append(Figure(f"{key}_{index}", label.capitalize(), "Mean of all, equilibria grey, motion blue.",
                           traces, look.layout(**axes), 4, 240))
    return made


def write_dynamics_page(found: Comparison, path: Path) -> Path:
    """Write one HTML file that opens offline."""
    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    plots = [figures(point, i) for i, point in enumerate(found.points)]
    content = [{"name": f.name, "data": f.data, "layout": f.layout} for group in plots for f in group]
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
    page = environment.get_template("dynamics.html").render(
        found=found, sections=list(zip(found.points, plots)), number=number, style=inside(STYLE),
        plotly=Markup(get_plotlyjs()), figures=Markup(text),
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page, encoding="utf-8", newline="\n")
    return path
