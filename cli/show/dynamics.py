"""Wear in motion against wear in equilibrium on the screen."""

from cli.screen import WIDTH, console, dense
from studies.dynamics_wear import MAPS, VOLUMES, Comparison


def show_dynamics(found: Comparison) -> None:
    """Change of wear by dynamics at each operating point, in percent."""
    title = f"{found.reducer}: wear in motion against equilibria, {found.hours:g} h, lowest mode {found.lowest_mode_Hz:.1f} Hz"
    table = dense(title)
    table.add_column("point")
    heads = [name.replace("_", " ") + " %" for name in VOLUMES] + [f"{label} profile %" for label in MAPS.values()]
    for head in ("teeth pass Hz", *heads, "dynamics"):
        table.add_column(head, justify="right")
    for p in found.points:
        cells = [f"{v:+.2f}" for v in p.volume_change.values()] + [f"{v:.2f}" for v in p.map_difference.values()]
        table.add_row(p.name, f"{p.passing_Hz:.1f}", *cells, "matters" if p.largest > found.limit else "no matter")
    console(WIDTH).print(table)
    print(found.sentence())
