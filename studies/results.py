"""What a life leaves behind: figures, turns, surfaces and orders as one dataset."""

import math
from typing import Any

import numpy as np
import xarray as xr

from fmu_src.arrays import Floats
from orchestrator.component import Component
from orchestrator.netcdf import provenance
from studies.figure_units import OF_LIVES, OVER_TURN, figure_unit
from studies.life import Life, as_arrays
from studies.pair import Pair
from studies.solve import SERIES, Turn


def parameters_of(component: Component) -> dict[str, Any]:
    """Present values of all parameters and inputs that are not exchanged arrays, by the names that kernels have for them."""
    values: dict[str, Any] = {}
    field = {path: name for name, path in component.old_names().items()}
    for path, signal in component.signals.items():
        name = field.get(path, path)
        if signal.causality == "parameter" or (signal.causality == "input" and not signal.shape):
            value = component.get(name)
            if isinstance(value, np.ndarray):
                values[name] = value.tolist()
            else:
                values[name] = signal.choices[int(value)] if signal.choices else value
    return values


def turn_variables(turns: list[Turn], pair: Pair, leading: str) -> dict[str, xr.Variable]:
    """The recorded turns as variables with a leading dimension."""
    variables = {}
    for name in SERIES:
        signal = pair.plant.signal(name)
        axes = axes_of(pair, "plant", name)
        stack = np.stack([turn[name] for turn in turns])
        variables[name] = xr.Variable((leading, "position", *axes), stack, {"units": signal.unit})
    return variables


def axes_of(pair: Pair, unit: str, name: str) -> tuple[str, ...]:
    table = pair.reducer.plant if unit == "plant" else pair.reducer.wear
    return table.by_name[name].axes


def life_dataset(pair: Pair, life: Life, orders: list[xr.Dataset], inputs: dict[str, Any]) -> xr.Dataset:
    """Everything that a life run found; one entry of ``hour`` per jump."""
    topology = pair.reducer.topology
    variables: dict[str, xr.Variable] = {}
    spectra = xr.concat(orders, "spectrum_hour", data_vars="minimal", coords="minimal", compat="equals", join="exact")
    for name, values in (as_arrays(life) | {OVER_TURN: life.over_turn_at_hours(swings(spectra))}).items():
        if name != "hours":
            said = {"long_name": OF_LIVES[name]} if name in OF_LIVES else {}
            variables[name] = xr.Variable(("hour",), values, {"units": figure_unit(name)} | said)
    variables |= turn_variables(life.turns, pair, "hour")
    shapes = {
        "disc_wear": ("disc", "lobe", "flank_bin"), "pin_wear": ("disc", "pin", "pin_bin"),
        "pin_even_wear": ("disc", "pin"), "inner_race_wear": ("disc", "crank", "race_bin"),
        "outer_race_wear": ("disc", "crank", "race_bin"),
    }  # fmt: skip
    for name, axes in shapes.items():
        stack = np.stack([surface[name] for surface in life.surfaces])
        if name == "disc_wear":
            stack = stack.reshape(len(life.hours), topology.discs, topology.lobes, -1)
        text = pair.reducer.wear.by_name[name].description
        variables[name] = xr.Variable(("hour", *axes), stack.astype("f4"), {"units": "m", "long_name": text})
    coordinates = {
        "hour": ("hour", life.hours, {"units": "hour", "long_name": "operating time"}),
        "flank_phase": ("flank_bin", bin_middles(variables["disc_wear"].shape[-1], 0.0, 360.0), {"units": "deg"}),
        "pin_phase": ("pin_bin", bin_middles(variables["pin_wear"].shape[-1], -90.0, 90.0), {"units": "deg"}),
        "race_phase": ("race_bin", bin_middles(variables["inner_race_wear"].shape[-1], 0.0, 360.0), {"units": "deg"}),
    }
    record = {"reducer": pair.reducer.heading, "plant": parameters_of(pair.plant), "wear": parameters_of(pair.wear)}
    attributes: dict[str, Any] = dict(provenance(inputs | {"parameters": record, "sources": pair.reducer.sources}))
    attributes |= {"title": f"wear of {pair.reducer.heading} over {life.hours[-1]:g} h", "cycles_simulated": life.cycles}
    return xr.Dataset(variables, coordinates, attributes).assign(spectra.data_vars).assign_coords(spectra.coords)


def figure_arrays(dataset: xr.Dataset) -> dict[str, list[float]]:
    """The figures of a life as arrays parallel to ``hours``."""
    names = [str(n) for n, v in dataset.data_vars.items() if v.dims == ("hour",)]
    return {"hours": dataset["hour"].values.tolist()} | {n: dataset[n].values.tolist() for n in names}


def swings(spectra: xr.Dataset) -> dict[float, float]:
    """Transmission error's peak to peak over a turn of the output [arcsec] at the hours that were recorded."""
    found = np.ptp(spectra["transmission_error_over_turn"].values, axis=1)
    return dict(zip(spectra["spectrum_hour"].values.tolist(), found.tolist()))


def bin_middles(count: int, low: float, high: float) -> Floats:
    return low + (np.arange(count) + 0.5) * (high - low) / count


def order_spectrum(pair: Pair, hours: float, positions: int = 120) -> xr.Dataset:
    """Transmission error over one output turn and its orders per output turn, at the present wear.

    120 positions a crank turn resolve the pin meshing order (lobes times pins).
    """
    saved, before = pair.master.save(), pair.positions
    pair.wear.set("acceleration", 0.0)
    pair.set_positions(positions)
    # The profile errors at hand were given for the longer step: let them settle to this one.
    pair.master.run(2)
    pair.master.rebase(pair.master.step_size)
    count = pair.reducer.topology.lobes * positions
    buffer = np.zeros(2)
    signals = [pair.plant.signal(name) for name in ("transmission_error", "lag")]
    read = pair.plant.reader(tuple(s.references[0] for s in signals), buffer)
    series = np.zeros((count, 2))

    def keep() -> None:
        read()
        series[pair.master.steps_done - 1] = buffer

    pair.master.run(count, keep)
    pair.positions = before
    pair.master.restore(saved)
    amplitude = 2.0 * np.abs(np.fft.rfft(series, axis=0)) / count
    arcsec = math.degrees(3600.0)
    angle = 360.0 * (np.arange(count) + 1) / count
    return xr.Dataset(
        {
            "transmission_error_over_turn": (
                ("spectrum_hour", "output_position"), series[None, :, 0] * arcsec, {"units": "arcsec"},
            ),
            "order_amplitude": (
                ("spectrum_hour", "order"), amplitude[None, 1:, 0] * arcsec,
                {"units": "arcsec", "long_name": "amplitude of the transmission error"},
            ),
        },
        {
            "spectrum_hour": ("spectrum_hour", [hours], {"units": "hour"}),
            "output_phase": ("output_position", angle, {"units": "deg"}),
            "order": ("order", np.arange(1, amplitude.shape[0]), {"units": "1/rev", "long_name": "per output turn"}),
        },
    )
