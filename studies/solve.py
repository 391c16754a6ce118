"""Figures of one reducer over a crank turn: forces, pressure, lag, stiffness, sliding."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fmu_src.faults import InputFault
from orchestrator.component import Component
from reducers.reducer import Reducer
from studies.pair import Pair
from wear_fmu.kinematics import sliding_per_crank_angle

ARCSEC = math.degrees(1.0) * 3600.0
ARCMIN = math.degrees(1.0) * 60.0

# What is recorded at each position of a turn: plant output -> shape per position.
SERIES = (
    "input_angle", "crank_angle", "cage_angle", "output_angle", "transmission_error", "lag", "drive_torque",
    "loaded_teeth", "contact_pressure", "largest_pin_force", "largest_roller_force", "mesh_force", "roller_force",
    "tooth_force", "residual", "iterations",
)  # fmt: skip


@dataclass(frozen=True)
class Turn:
    """Series over crank positions: ``series[name]`` has the shape (positions, ...)."""

    series: dict[str, np.ndarray]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.series[name]


def record_turn(pair: Pair, positions: int, each_step: Callable[[], None] | None = None) -> Turn:
    """Step the pair through ``positions`` steps and record the plant after each."""
    signals = {name: pair.plant.signal(name) for name in SERIES}
    buffers, readers = {}, []
    for name, signal in signals.items():
        kind = "i8" if signal.is_integer else "f8"
        buffers[name] = np.zeros(len(signal.references), kind)
        readers.append(pair.plant.reader(signal.references, buffers[name]))
    series = {name: np.zeros((positions, buffer.size), buffer.dtype) for name, buffer in buffers.items()}
    for i in range(positions):
        pair.master.step()
        for read in readers:
            read()
        for name, buffer in buffers.items():
            series[name][i] = buffer
        if each_step is not None:
            each_step()
    return Turn({name: values.reshape(positions, *signals[name].shape) for name, values in series.items()})


def measure(pair: Pair) -> tuple[Turn, dict[str, float]]:
    """One crank turn at the present wear, without wearing on: series and figures.

    The state of both units is put back afterwards.
    """
    saved = pair.master.save()
    torque = pair.plant.number("load_torque")
    pair.wear.set("acceleration", 0.0)
    full = record_turn(pair, pair.positions)
    pair.plant.set("load_torque", 0.5 * torque)
    half = record_turn(pair, pair.positions)
    figures = figures_of(pair.reducer, pair.plant, full, half, torque)
    pair.master.restore(saved)
    return full, figures


def figures_of(reducer: Reducer, plant: Component, full: Turn, half: Turn, torque: float) -> dict[str, float]:
    """The figures of ``rvwear solve``, with units in their names.

    Lag and transmission error of the second stage are taken against the cranks' angle;
    the ``..._at_input`` ones against the sun's.  Torsional stiffness is the secant
    between half and full torque of the mean lag.
    """
    lag, lag_half = float(full["lag"].mean()), float(half["lag"].mean())
    slowest, fastest = sliding_speeds(reducer, plant)
    return {
        "load_torque_Nm": torque,
        "peak_pin_force_N": float(full["largest_pin_force"].max()),
        "mean_loaded_teeth": float(full["loaded_teeth"].mean()),
        "peak_contact_pressure_MPa": float(full["contact_pressure"].max()) / 1e6,
        "peak_roller_force_N": float(full["largest_roller_force"].max()),
        "mean_lag_arcsec": lag * ARCSEC,
        "transmission_error_pp_arcsec": float(np.ptp(full["lag"])) * ARCSEC,
        "mean_lag_at_input_arcsec": float(-full["transmission_error"].mean()) * ARCSEC,
        "transmission_error_at_input_pp_arcsec": float(np.ptp(full["transmission_error"])) * ARCSEC,
        "torsional_stiffness_Nm_per_arcmin": stiffness(0.5 * torque, lag - lag_half),
        "mean_input_torque_Nm": float(full["drive_torque"].mean()),
        "sliding_speed_min_mm_s": slowest * 1e3,
        "sliding_speed_max_mm_s": fastest * 1e3,
        "largest_residual": float(full["residual"].max()),
        "mean_iterations": float(full["iterations"].mean()),
    }


def stiffness(torque: float, turning: float) -> float:
    """Torque over turning [N m/arcmin]; NaN where nothing turns."""
    return torque / (turning * ARCMIN) if turning != 0.0 else math.nan


def sliding_speeds(reducer: Reducer, plant: Component) -> tuple[float, float]:
    """Smallest (at the root) and largest (at the tip) sliding speed of flank on pin [m/s]."""
    lobes = reducer.topology.lobes
    radius, pin = plant.number("pin_circle_radius"), plant.number("pin_radius")
    k1 = plant.number("eccentricity") * reducer.topology.pins / radius
    speed = abs(plant.number("crank_speed"))
    root, tip = (abs(sliding_per_crank_angle(phi, lobes, radius, pin, k1)) * speed for phi in (0.0, math.pi))
    return root, tip


def require_positions(positions: int) -> int:
    """A turn needs at least eight positions to be averaged."""
    if not 8 <= positions <= 100_000:
        raise InputFault(f"positions = {positions}: at least 8 per crank turn are needed (72 is usual), at most 100000")
    return positions
