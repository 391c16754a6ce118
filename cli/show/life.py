"""Lives on the screen."""

from collections.abc import Callable

import xarray as xr

from cli.screen import BETWEEN, WIDTH, console, dense
from studies.figure_units import HELD_IN_LIVES, OVER_TURN, RUNNING, WHAT_IS_OVER_TURN
from studies.life import Life
from studies.passes import again_line


def jump_line(life: Life) -> str:
    """What a jump has come to."""
    f = life.figures[-1]
    return (
        f"{life.hours[-1]:8.0f} h  raceways {f['inner_raceway_um']:.3f} / {f['outer_raceway_um']:.3f} um  "
        f"flank {f['disc_flank_um']:.3f} um  pin {f['pin_um']:.3f} um  jump {len(life.hours) - 1} of {life.jumps}"
    )


def telling(say: Callable[[str], None]) -> Callable[[Life], None]:
    """Says each jump, and between them when the life begins again in shorter ones."""
    jumps: list[int] = []

    def told(life: Life) -> None:
        if jumps and jumps[-1] != life.jumps:
            say(again_line(life, jumps[-1]))
        jumps.append(life.jumps)
        say(jump_line(life))

    return told


# Columns of the summary of a life: name of the figure, head of the column, digits.
LIFE_COLUMNS = (
    ("inner_raceway_um", "inner\nrace\num", 3), ("outer_raceway_um", "outer\nrace\num", 3),
    ("disc_flank_um", "\nflank\num", 3), ("pin_um", "\npin\num", 3), ("inner_peak_deg", "inner\nat\ndeg", 0),
    ("outer_peak_deg", "outer\nat\ndeg", 0), ("disc_peak_deg", "flank\nat\ndeg", 0),
    ("peak_pin_force_N", "pin\nforce\nN", 0), ("mean_loaded_teeth", "\nloaded\nteeth", 1),
    ("mean_lag_arcsec", "\nlag\narcsec", 1), (OVER_TURN, "transm.\nerror\narcsec", 2),
    ("torsional_stiffness_Nm_per_arcmin", "stiff\nN m per\narcmin", 0), ("lost_motion_arcmin", "lost\nmotion\narcmin", 3),
)  # fmt: skip


def life_table(dataset: xr.Dataset) -> None:
    """Growth over the hours."""
    heads = ["\n\nhours", *(head for _, head, _ in LIFE_COLUMNS)]
    rows = [
        [f"{hours:.0f}", *(f"{float(dataset[name][i]):.{digits}f}" for name, _, digits in LIFE_COLUMNS)]
        for i, hours in enumerate(dataset["hour"].values)
    ]  # fmt: skip
    widths = [max(map(len, [*head.split("\n"), *column])) for head, column in zip(heads, zip(*rows))]
    table = dense(dataset.attrs["title"])
    table.caption, table.caption_justify = f"{WHAT_IS_OVER_TURN}\n{RUNNING}\n{HELD_IN_LIVES}", "left"
    for head, width in zip(heads, widths):
        table.add_column(head, justify="right", no_wrap=True, min_width=width)
    for row in rows:
        table.add_row(*row)
    # Numbers are never cut: much wear makes a wider table.
    console(max(WIDTH, sum(widths) + BETWEEN * len(widths))).print(table)
