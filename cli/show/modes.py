"""Natural frequencies and mode shapes on the screen."""

from rich.table import Table

from cli.screen import console
from studies.modes import Mode


def show_modes(title: str, found: list[Mode]) -> None:
    """Frequency, damping, what moves, and the bodies' shares of the kinetic energy."""
    table = Table(title=title, title_justify="left")
    for head in ("frequency Hz", "damping ratio", "what moves", "kinetic energy in"):
        table.add_column(head, justify="right" if head in ("frequency Hz", "damping ratio") else "left")
    for mode in found:
        shares = sorted(mode.energy_share.items(), key=lambda item: -item[1])
        bodies = ", ".join(f"{body} {100 * share:.0f} %" for body, share in shares if share > 0.02)
        table.add_row(f"{mode.frequency_Hz:.1f}", f"{mode.damping_ratio:.4f}", mode.moves, bodies)
    console().print(table)
