"""Lives on the screen."""

import xarray as xr

from cli.screen import WIDTH, console, dense
from studies.life import Life


def jump_line(life: Life) -> str:
    """What a jump has come to."""
    f = life.figures[-1]
    return (
        f"{life.hours[-1]:8.0f} h  raceways {f['inner_raceway_um']:.3f} / {f['outer_raceway_um']:.3f} um  "
        f"flank {f['disc_flank_um']:.3f} um  pin {f['pin_um']:.3f} um  jump {len(life.hours) - 1} of {life.jumps}"
    )


# Columns of the summary of a life: name of the figure, head of the column, digits.
LIFE_COLUMNS = (
    ("inner_raceway_um", "inner\nrace um", 3), ("outer_raceway_um", "outer\nrace um", 3),
    ("disc_flank_um", "flank\num", 3), ("pin_um", "pin\num", 3), ("inner_peak_deg", "inner\nat deg", 0),
    ("outer_peak_deg", "outer\nat deg", 0), ("disc_peak_deg", "flank\nat deg", 0),
    ("peak_pin_force_N", "pin\nforce N", 0), ("mean_loaded_teeth", "loaded\nteeth", 1),
    ("mean_lag_arcsec", "lag\narcsec", 1), ("transmission_error_pp_arcsec", "TE p-p\narcsec", 2),
    ("torsional_stiffness_Nm_per_arcmin", "stiff Nm\nper arcmin", 0),
)  # fmt: skip


def life_table(dataset: xr.Dataset) -> None:
    """Growth over the hours."""
    table = dense(dataset.attrs["title"])
    table.add_column("hours", justify="right")
    for _, head, _ in LIFE_COLUMNS:
        table.add_column(head, justify="right")
    for i, hours in enumerate(dataset["hour"].values):
        cells = [f"{float(dataset[name][i]):.{digits}f}" for name, _, digits in LIFE_COLUMNS]
        table.add_row(f"{hours:.0f}", *cells)
    console(WIDTH).print(table)
