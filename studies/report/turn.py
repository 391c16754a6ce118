"""Pictures of one crank turn and of the stiffness test."""

import numpy as np
import xarray as xr

from fmu_src.arrays import Floats
from pages.charts import Curve, chart
from pages.look import Figure
from pages.words import number

CRANKS = "angle of the cranks [°]"


def turn_figures(turn: xr.Dataset) -> list[Figure]:
    """``turn``: of ``studies.turn``: errors, forces and loaded teeth over the angle of the cranks, forces of all pins at one position."""
    angle = turned(turn)
    name = str(turn.attrs["title"])

    def over(variable: str) -> Floats:
        values: Floats = np.asarray(turn[variable].values, float).reshape(len(angle), -1)[:, 0]
        return values

    unit = turn["lag"].attrs["units"]
    lag, error = over("lag"), over("transmission_error_at_input")
    # A picture has no title: what was taken off stands in the legend and at the axis.
    errors = [
        Curve("transmission error", angle, error - error.mean()),
        Curve(f"lag of the carrier, less {number(lag.mean())} {unit}", angle, lag - lag.mean(), dash="dash"),
    ]
    forces = [Curve("largest pin force", angle, over("largest_pin_force")), Curve("largest roller force", angle, over("largest_roller_force"), dash="dash")]
    pins = turn["mesh_force"].values[0]
    discs = [Curve(f"disc {k + 1}", np.arange(1, pins.shape[1] + 1), row, mode="lines+markers") for k, row in enumerate(pins)]
    force = f"force [{turn['mesh_force'].attrs['units']}]"
    return [
        chart("turn_error", f"{name}: errors about their means", "", errors, CRANKS, f"error about its mean [{unit}]"),
        chart("turn_force", f"{name}: forces", "", forces, CRANKS, force),
        chart("turn_teeth", f"{name}: loaded teeth", "", [Curve("loaded teeth", angle, over("loaded_teeth"))], CRANKS, "loaded teeth"),
        chart("turn_pins", f"{name}: force of each pin", "", discs, "pin", force),
    ]


def turned(turn: xr.Dataset) -> Floats:
    """Angle of the cranks from the first position on, whichever way they turn [deg]."""
    angle = np.asarray(turn["crank_angle"].values, float)
    return np.asarray(np.abs(angle - angle[0]), float)


def loop_figures(loop: xr.Dataset) -> list[Figure]:
    """``loop``: of ``studies.turn``: turning over torque."""
    curve = Curve("torque up and down, input locked", loop["torque"].values, loop["turning"].values)
    text = f"lost motion {number(loop['lost_motion_arcmin'].item())} arcmin, stiffness {number(loop['torsional_stiffness_Nm_per_arcmin'].item())} N m/arcmin"
    return [chart("loop", str(loop.attrs["title"]), text, [curve], "torque [N m]", "turning of the output [arcmin]")]
