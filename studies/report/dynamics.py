"""The page of a comparison of fidelities: a table and, for each point, both wear profiles."""

from pathlib import Path

import numpy as np

from pages import look
from pages.content import Page, Section, Table
from pages.look import Figure
from pages.render import rendered_sections, written
from pages.words import number
from studies.dynamics_wear import MAPS, Comparison, Point


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


def table(found: Comparison) -> Table:
    """One row per operating point."""
    volumes = [f"{label} volume" for label in MAPS.values()]
    profiles = [f"{label} profile" for label in MAPS.values()]
    head = ["point", "input rpm", "torque N m", "teeth pass Hz", *volumes, *profiles, "dynamics"]
    rows = [
        [p.name, number(p.input_speed_rpm), number(p.output_torque_Nm), number(p.passing_Hz),
         *(number(v, 2) for v in (*p.volume_change.values(), *p.map_difference.values())),
         "matters" if p.largest > found.limit else "does not matter"]
        for p in found.points
    ]  # fmt: skip
    return Table("", head, rows, tuple(range(1, len(head) - 1)))


def page_of(found: Comparison) -> Page:
    lead = "Change of worn volumes, and largest difference of the mean profiles over the deepest place, all in percent."
    sections = [Section("where", "Where dynamics matters", lead, tables=[table(found)])]
    sections += [
        Section(f"point_{i}", point.name.capitalize(), "", figures(point, i)) for i, point in enumerate(found.points)
    ]  # fmt: skip
    return Page(
        "Wear of an RV reducer, in motion and in equilibrium", found.reducer,
        f"{number(found.hours)} h at each point; lowest natural frequency {number(found.lowest_mode_Hz)} Hz",
        found.sentence(), [], sections, [],
    )  # fmt: skip


def write_dynamics_page(found: Comparison, path: Path) -> Path:
    """Write one HTML file that opens offline."""
    return written(rendered_sections(page_of(found)), path)
