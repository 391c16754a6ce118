"""One crank turn and the standard stiffness test as datasets, in the units that people read."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr

from exports.tables import Table, rows_table
from fmu_src.display import display_unit
from fmu_src.units import conversion
from orchestrator.component import InProcess
from orchestrator.master import Master
from orchestrator.settings import Setting, apply
from reducers.reducer import Reducer
from studies.figure_units import figure_unit
from studies.hysteresis import Hysteresis
from studies.modes import Mode
from studies.pair import Pair, crank_turn_time
from studies.solve import SERIES, Turn, figures_of, record_turn, require_positions

# The units of what is read over a turn, where the tables know none that suits it.
READ_IN = {"transmission_error": "arcsec", "lag": "arcsec", "contact_pressure": "MPa"}
# Curves by the names of the figures that are read from them.
CURVES = {"transmission_error": "transmission_error_at_input"}


@dataclass(frozen=True)
class CrankTurn:
    """``turn``: series at the full torque in SI units; ``figures``: as ``studies.solve.figures_of``."""

    reducer: Reducer
    turn: Turn
    figures: dict[str, float]

    def dataset(self) -> xr.Dataset:
        """Series over ``position`` with the crank angle [deg] beside, and the figures as single numbers."""
        variables = {CURVES.get(name, name): self.variable(name) for name in SERIES if name not in ("crank_angle", "residual", "iterations")}
        lag = variables["lag"]
        # Against the cranks, as the figure of that name.
        said = {"units": lag.attrs["units"], "long_name": "departure of the output from its mean, against the cranks: mean lag less lag"}
        variables["transmission_error"] = xr.Variable(("position",), lag.values.mean() - lag.values.reshape(-1), said)
        figures = {name: ((), value, {"units": figure_unit(name)}) for name, value in self.figures.items()}
        angle = np.degrees(self.turn["crank_angle"]).reshape(-1)
        coordinates = {"crank_angle": ("position", angle, {"units": "deg", "long_name": "angle of the cranks"})}
        return xr.Dataset(variables | figures, coordinates, {"title": f"{self.reducer.heading} over one crank turn", "reducer": self.reducer.name})

    def variable(self, name: str) -> xr.Variable:
        found = self.reducer.plant.by_name[name]
        unit = READ_IN.get(name) or display_unit(found) or found.unit
        factor, offset = conversion(found.unit, unit)
        values = self.turn[name] if found.is_integer else factor * self.turn[name] + offset
        return xr.Variable(("position", *found.axes), values, {"units": unit, "long_name": found.description})


def crank_turn(reducer: Reducer, settings: list[Setting], positions: int = 72) -> CrankTurn:
    """The plant alone over one crank turn, at the set torque and at half of it for the stiffness."""
    require_positions(positions)
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings, {"plant": plant})
    torque = plant.number("load_torque")
    master = Master({"plant": plant}, [], crank_turn_time(reducer, plant) / positions)
    pair = Pair(reducer, master, plant, plant, positions)
    master.initialise()
    full = record_turn(pair, positions)
    plant.set("load_torque", 0.5 * torque)
    half = record_turn(pair, positions)
    return CrankTurn(reducer, full, figures_of(reducer, plant, full, half, torque))


def mode_table(found: Mapping[tuple[bool, bool], Sequence[Mode]]) -> Table:
    """Modes by (input held, under load): frequency, damping, what moves, share of each body in the kinetic energy."""
    rows = [
        {"input": "held" if held else "free", "loaded": loaded, "frequency_Hz": mode.frequency_Hz, "damping_ratio": mode.damping_ratio, "moves": mode.moves}
        | {f"energy of {body}": share for body, share in mode.energy_share.items()}
        for (held, loaded), modes in found.items() for mode in modes
    ]  # fmt: skip
    keys = dict.fromkeys(key for row in rows for key in row)
    return rows_table("modes", [{key: row.get(key, 0.0) for key in keys} for row in rows], {})


def loop_figures(loop: Hysteresis) -> dict[str, float]:
    """What is read from the loop, with units in the names."""
    return {
        "largest_torque_Nm": float(loop.torque.max()),
        "lost_motion_arcmin": loop.lost_motion_arcmin,
        "torsional_stiffness_Nm_per_arcmin": loop.stiffness_Nm_per_arcmin,
        "torsional_stiffness_reverse_Nm_per_arcmin": loop.stiffness_reverse_Nm_per_arcmin,
        "loop_width_arcmin": loop.width_arcmin,
        "loop_mean_width_arcmin": loop.mean_width_arcmin,
        "loop_area_Nm_arcmin": loop.loop_area_Nm_arcmin,
    }


def loop_dataset(reducer: Reducer, loop: Hysteresis) -> xr.Dataset:
    """Torque [N.m] and turning [arcmin] along the way, and the figures as single numbers."""
    figures = {name: ((), value, {"units": figure_unit(name)}) for name, value in loop_figures(loop).items()}
    curve = {
        "torque": ("step", loop.torque, {"units": "N.m", "long_name": "torque on the output"}),
        "turning": ("step", loop.turning, {"units": "arcmin", "long_name": "turning of the output, input locked"}),
    }
    return xr.Dataset(curve | figures, attrs={"title": f"{reducer.heading}: torque up and down, input locked", "reducer": reducer.name})
