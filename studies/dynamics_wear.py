"""Wear from bodies in motion against wear from equilibria: where the dynamics matters.

The same hours in the same meshing cycles are run with both fidelities, at several speeds
and loads and where the teeth pass at the lowest natural frequency.  Short jumps on new
parts on purpose: accelerated wear feeds back on a load that swings almost undamped.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from fmu_src.faults import InputFault
from fmu_src.percent import percent
from orchestrator.settings import Setting, parse_setting
from reducers.reducer import Reducer
from rv_plant.gear_stage import total_ratio
from studies.meshing_cycle import run_cycle
from studies.modes import modes
from studies.pair import Pair, make_pair
from studies.wear_figures import WATCHED, wear_figures

# Volumes that are compared, by their names in the wear unit, and depths, by their names in a life.
VOLUMES = ("flank_volume", "inner_race_volume", "outer_race_volume")
# Wear maps that are compared: table of the wear unit -> what its bins count.
MAPS = {"disc_wear": "flank", "inner_race_wear": "inner raceway", "outer_race_wear": "outer raceway"}
LIGHT = 0.1
SETTLING_TURNS = 4


@dataclass(frozen=True)
class Point:
    """One operating point; changes are dynamic over quasi-static minus 1 [%]."""

    name: str
    speed_factor: float
    torque_factor: float
    input_speed_rpm: float
    output_torque_Nm: float
    passing_Hz: float
    depth_change: dict[str, float]
    volume_change: dict[str, float]
    # Largest difference of the mean profiles over the deepest place of the quasi-static one [%].
    map_difference: dict[str, float]
    # Mean profiles [um], (quasi-static, dynamic).
    profiles: dict[str, tuple[np.ndarray, np.ndarray]]

    @property
    def largest(self) -> float:
        """Largest change of all volumes and mean profiles [%]."""
        return max(abs(v) for v in (*self.volume_change.values(), *self.map_difference.values()))


@dataclass(frozen=True)
class Comparison:
    """All points of a reducer; ``limit`` [%] is what counts as a difference."""

    reducer: str
    hours: float
    limit: float
    lowest_mode_Hz: float
    points: list[Point]

    @property
    def matters(self) -> list[Point]:
        return [p for p in self.points if p.largest > self.limit]

    def sentence(self) -> str:
        """Where dynamics matters, in words."""
        same = [p.name for p in self.points if p.largest <= self.limit]
        other = [f"{p.name} ({percent(0.01 * p.largest, 3)})" for p in self.matters]
        agree = f"Both agree within {self.limit:g} % at {', '.join(same)}. " if same else ""
        differ = f"Dynamics changes wear by more at {', '.join(other)}." if other else "Dynamics matters nowhere here."
        return agree + differ


def compare(reducer: Reducer, settings: list[Setting], factors: list[float], hours: float, cycles: int, limit: float,
            progress: Callable[[str], None] = lambda _: None) -> Comparison:  # fmt: skip
    """Wear of both fidelities at speed ``factors``, at the resonance, and at light load."""
    if any(s.name in ("fidelity", "acceleration") for s in settings):
        raise InputFault("fidelity and acceleration are set by the comparison itself")
    if not (factors and all(0.0 < f <= 100.0 for f in factors) and hours > 0.0 and cycles >= 1 and limit > 0.0):
        raise InputFault("speeds (0 to 100 times), hours, cycles and limit must be positive")
    lowest = modes(reducer, settings)[0].frequency_Hz
    rated = wearing_pair(reducer, settings, 1.0, 1.0, False)
    resonant = lowest / passing_frequency(rated)
    wanted = [(f"{f:g} times the speed" if f != 1.0 else "the set speed", f, 1.0) for f in factors]
    wanted += [("the set speed, light load", 1.0, LIGHT), (f"resonance ({resonant:.3g} times the speed)", resonant, 1.0)]
    points = []
    for name, speed, torque in wanted:
        progress(name)
        points.append(compare_point(reducer, settings, name, speed, torque, hours, cycles))
    return Comparison(reducer.heading, hours, limit, lowest, points)


def passing_frequency(pair: Pair) -> float:
    """How often a tooth of any disc takes up load [Hz]: pins times discs per output turn."""
    t = pair.reducer.topology
    ratio = total_ratio(pair.plant.get("first_stage_ratio"), t.pins, t.lobes)
    return float(abs(pair.plant.number("input_speed") / ratio) / (2.0 * math.pi) * t.pins * t.discs)


def wearing_pair(reducer: Reducer, settings: list[Setting], speed: float, torque: float, moving: bool) -> Pair:
    """A new pair at factors of the set speed and torque."""
    first = make_pair(reducer, settings)
    texts = [f"input.speed={speed * first.plant.get('input_speed')!r}",
             f"output.load_torque={torque * first.plant.get('load_torque')!r}"]
    texts += ["fidelity=dynamic"] if moving else []
    return make_pair(reducer, [*settings, *(parse_setting(text, [reducer.plant]) for text in texts)])


def compare_point(reducer: Reducer, settings: list[Setting], name: str, speed: float, torque: float, hours: float,
                  cycles: int) -> Point:  # fmt: skip
    records = []
    for moving in (False, True):
        pair = wearing_pair(reducer, settings, speed, torque, moving)
        pair.wear.set("acceleration", 0.0)
        pair.master.run(SETTLING_TURNS * pair.positions)
        for _ in range(cycles):
            run_cycle(pair, hours / cycles)
        records.append(pair.wear.record())
    still, moved = records
    depths = [wear_figures(record) for record in records]
    profiles = {}
    for key in MAPS:
        bins = still["slide"].shape[-1] if key == "disc_wear" else still[key].shape[-1]
        profiles[key] = tuple(1e6 * record[key][0].reshape(-1, bins).mean(axis=0) for record in records)
    return Point(
        name, speed, torque, pair.plant.number("input_speed") * 30.0 / math.pi, pair.plant.number("load_torque"),
        passing_frequency(pair), {k: 100.0 * (depths[1][k] / depths[0][k] - 1.0) for k in WATCHED},
        {k: 100.0 * (float(moved[k][0] / still[k][0]) - 1.0) for k in VOLUMES},
        {k: 100.0 * float(np.abs(b - a).max() / a.max()) for k, (a, b) in profiles.items()}, profiles,
    )  # fmt: skip


def as_json(found: Comparison) -> dict[str, Any]:
    """Everything, profiles included."""
    points = [vars(p) | {"profiles": {k: [a.tolist(), b.tolist()] for k, (a, b) in p.profiles.items()},
                         "largest_difference": p.largest, "matters": p.largest > found.limit} for p in found.points]
    return vars(found) | {"points": points, "sentence": found.sentence()}
