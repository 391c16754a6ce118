"""What the report knows of a life result: arrays, topology, parameters, derived speeds."""

import json
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr

from fmu_src.faults import InputFault
from rv_plant.gear_stage import total_ratio
from rv_plant.geometry import shortening
from rv_plant.topology import Topology
from studies.figure_units import OVER_TURN
from studies.results import swings

MICRON = 1e6
ARCSEC = math.degrees(1.0) * 3600.0
# Shapes and turns show at most this many of the recorded hours.
MOST_SHOWN = 12


@dataclass(frozen=True)
class Result:
    """One life; lengths in m and angles in rad as in the dataset, unless a name says otherwise."""

    dataset: xr.Dataset
    inputs: dict[str, Any]
    topology: Topology

    @classmethod
    def of(cls, dataset: xr.Dataset) -> "Result":
        n = dataset.sizes
        if "hour" not in n or "lobe" not in n:
            raise InputFault("this result holds no life, which the report shows; rvwear life writes one")
        topology = Topology(n["disc"], n["crank"], n["pin"], n["lobe"], n["roller"])
        return cls(with_swings(dataset), json.loads(dataset.attrs.get("inputs", "{}")), topology)

    def __getitem__(self, name: str) -> np.ndarray:
        return self.dataset[name].values

    @property
    def name(self) -> str:
        return str(self.inputs["parameters"]["reducer"])

    @property
    def plant(self) -> dict[str, Any]:
        parameters: dict[str, Any] = self.inputs["parameters"]["plant"]
        return parameters

    @property
    def wear(self) -> dict[str, Any]:
        parameters: dict[str, Any] = self.inputs["parameters"]["wear"]
        return parameters

    @property
    def hours(self) -> np.ndarray:
        return self["hour"]

    @cached_property
    def shown(self) -> list[int]:
        """Entries of ``hour`` that shapes and turns show, first and last among them."""
        count = len(self.hours)
        return sorted({round(i) for i in np.linspace(0, count - 1, min(count, MOST_SHOWN))})

    @property
    def output_speed(self) -> float:
        """Speed of the output [rad/s]."""
        t = self.topology
        return float(self.plant["input_speed"] / total_ratio(self.plant["first_stage_ratio"], t.pins, t.lobes))

    @property
    def crank_speed(self) -> float:
        return -self.topology.lobes * self.output_speed

    @property
    def sense(self) -> float:
        """+1 if the cranks turn counter-clockwise."""
        return -1.0 if self.crank_speed < 0.0 else 1.0

    @property
    def pins_turn(self) -> bool:
        return bool(self.wear["pins"] == "turn")

    @property
    def generating(self) -> tuple[float, float, float]:
        """Circle and radius that generate the profile [m], and its K1."""
        circle = self.plant["pin_circle_radius"] + self.plant["shift_modification"]
        radius = self.plant["pin_radius"] + self.plant["equidistant_modification"]
        return circle, radius, shortening(self.plant["eccentricity"], self.topology.lobes, circle)

    @cached_property
    def deepest_tooth(self) -> tuple[int, int]:
        """(disc, lobe) with the deepest wear at the end."""
        disc, lobe = deepest(self["disc_wear"][-1])
        return disc, lobe

    def peak_place(self, name: str, entry: int = -1) -> float:
        """Place of a surface's deepest wear [deg], e.g. ``inner_peak_deg``."""
        return float(self[name][entry])


def with_swings(dataset: xr.Dataset) -> xr.Dataset:
    """Results of 0.2.0 and before know the error over a turn of the output at their first and last hour alone."""
    if OVER_TURN in dataset or "transmission_error_over_turn" not in dataset:
        return dataset
    known = swings(dataset)
    values = [known.get(hour, math.nan) for hour in dataset["hour"].values.tolist()]
    return dataset.assign({OVER_TURN: ("hour", values, {"units": "arcsec"})})


def deepest(wear: np.ndarray) -> tuple[int, ...]:
    """Indices of the row with the deepest wear, of an array whose last axis are the bins."""
    worn = wear.max(axis=-1)
    return tuple(int(i) for i in np.unravel_index(worn.argmax(), worn.shape))
