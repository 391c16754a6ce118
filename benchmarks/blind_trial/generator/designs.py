"""Campaign designs: which conditions are measured, which signals, how often, what is held out."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypedDict

import numpy as np

from benchmarks.blind_trial.generator.noise import Noise, noise_for
from benchmarks.blind_trial.generator.reducer import HOUR, Setting
from benchmarks.blind_trial.generator.style import Style
from fmu_src.arrays import Floats

RPM = math.pi / 30.0
TURN = 2.0 * math.pi


@dataclass
class Series:
    """One quantity in one condition; ``rows`` are settings of its rows where they differ."""

    quantity: str
    condition: str
    setting: Setting
    noise: Noise
    axes: dict[str, Floats] = field(default_factory=dict)
    rows: list[Setting] = field(default_factory=list)
    tags: dict[str, str] = field(default_factory=dict)
    replicates: int = 2

    @property
    def size(self) -> int:
        return len(self.rows) if self.rows else len(next(iter(self.axes.values())))


class Run(TypedDict):
    """What was measured of a series once; SI units."""

    id: str
    series: Series
    replicate: int
    axes: dict[str, Floats]
    values: Floats


class Nuisance(TypedDict):
    """As in the campaign's file: numbers in ``unit``, ``prior`` a standard deviation."""

    unit: str
    start: float
    lower: float
    upper: float
    prior: float


@dataclass
class Design:
    """Conditions (name: setting), which are held out, what is measured, what may be calibrated."""

    name: str
    conditions: dict[str, Setting] = field(default_factory=dict)
    held_out: set[str] = field(default_factory=set)
    series: list[Series] = field(default_factory=list)
    nuisances: dict[str, Nuisance] = field(default_factory=dict)
    mounting: dict[str, str] = field(default_factory=dict)
    zeros: dict[str, float] = field(default_factory=dict)
    uneven: bool = False
    # Deviation of what the files give as an axis from what it was, SI; how the files look.
    axis_noise: dict[str, float] = field(default_factory=dict)
    style: Style = field(default_factory=Style)

    def quantities(self) -> set[str]:
        return {s.quantity for s in self.series}


# How wide a block is: tiny for the reduced trial, poor has two or three levels and nothing held out.
SIZES = ("tiny", "small", "poor", "middle", "rich", "bench")


def te(design: Design, rng: np.random.Generator, size: str) -> None:
    """Transmission error over one turn of the output."""
    noise = noise_for(rng, "transmission_error")
    # With 400 samples the rollers' orders 361 and 279 would fold onto 39 and 121.
    samples = {"small": 450, "poor": 450, "middle": int(rng.choice([500, 640])), "rich": int(rng.choice([720, 1000, 1440]))}[size]
    grid = {
        "small": [(40, 293, 1), (100, 293, 1), (167, 313, 1), (167, 293, -1), (140, 293, 1)],
        "poor": [(60, 298, 1), (167, 298, 1)],
        "middle": [(30, 293, 1), (90, 293, 1), (167, 293, 1), (167, 318, 1), (90, 318, 1), (167, 293, -1), (130, 308, 1)],
        "rich": [(20, 293, 1), (60, 293, 1), (120, 293, 1), (200, 293, 1), (60, 323, 1), (200, 323, 1), (120, 293, -1),
                 (200, 323, -1), (160, 308, 1), (40, 308, -1)],
    }[size]  # fmt: skip
    held = {"small": 1, "poor": 0, "middle": 1, "rich": 2}[size]
    speed = 121 * float(rng.choice([8, 15])) * RPM
    for k, (load, temperature, direction) in enumerate(grid):
        name = f"te{k + 1}"
        setting = Setting(speed, load, temperature + 0.15, 0.0, direction)
        design.conditions[name] = setting
        if k >= len(grid) - held:
            design.held_out.add(name)
        angles = np.linspace(0.0, TURN, samples, endpoint=False)
        design.series.append(Series("transmission_error", name, setting, noise, {"angle": angles}))


def speeds(design: Design, rng: np.random.Generator, size: str) -> None:
    """Transmission error over one turn of the output at several speeds."""
    noise = noise_for(rng, "transmission_error")
    samples = {"small": 450, "poor": 450, "middle": 500, "rich": 720}[size]
    grid = {"small": [5, 8, 11, 15, 13], "poor": [8, 15], "middle": [4, 6, 9, 12, 16, 14], "rich": [3, 4, 6, 8, 10, 13, 16, 7, 12]}[size]
    held = {"small": 1, "poor": 0, "middle": 1, "rich": 2}[size]
    for k, turns in enumerate(grid):
        name = f"speed{k + 1}"
        setting = Setting(121 * turns * RPM, 120.0, 298.15)
        design.conditions[name] = setting
        if k >= len(grid) - held:
            design.held_out.add(name)
        angles = np.linspace(0.0, TURN, samples, endpoint=False)
        design.series.append(Series("transmission_error", name, setting, noise, {"angle": angles}))


def loops(design: Design, rng: np.random.Generator, size: str) -> None:
    """Torque up and down with the input held, at some temperatures."""
    noise = noise_for(rng, "hysteresis")
    temperatures = {"tiny": [293, 323, 308], "small": [293, 323, 308], "poor": [293], "middle": [283, 298, 323, 310], "rich": [283, 293, 308, 323, 333, 300]}[size]
    held = 0 if size == "poor" else 1
    steps = {"tiny": 7, "small": 10, "poor": 12, "middle": 16, "rich": 24}[size]
    peak = 167.0 if size == "tiny" else float(rng.choice([167.0, 200.0, 250.0]))
    way = there_and_back(peak, steps)
    for k, temperature in enumerate(temperatures):
        name = f"loop{k + 1}"
        setting = Setting(200.0, 167.0, temperature + 0.15)
        design.conditions[name] = setting
        if k >= len(temperatures) - held:
            design.held_out.add(name)
        design.series.append(Series("hysteresis", name, setting, noise, {"torque": way}, tags={"locked": "input"}))


def there_and_back(peak: float, steps: int) -> Floats:
    """Torques [N m] of a loop; none at no torque: there the output floats in its play, and nothing says where."""
    up = (np.arange(steps) + 0.5) / (steps - 0.5) * peak
    return np.concatenate([up, up[-2::-1], -up, -up[-2::-1], up])


def torque(design: Design, rng: np.random.Generator, size: str) -> None:
    """Input torque over the speed, at loads and temperatures."""
    noise = noise_for(rng, "input_torque")
    speeds = {"tiny": [200, 600, 1400, 2400], "small": [200, 500, 1000, 1700, 2400], "poor": [500, 1500]}.get(size, [200, 350, 600, 1000, 1500, 2000, 2500])
    grid = {
        "tiny": [(40, 293), (167, 293), (100, 318), (130, 303)],
        "small": [(40, 293), (167, 293), (100, 318), (130, 303)],
        "poor": [(50, 293), (167, 293)],
        "middle": [(20, 293), (80, 293), (167, 293), (80, 323), (167, 323), (120, 308)],
        "rich": [(20, 283), (80, 283), (167, 283), (250, 283), (20, 323), (80, 323), (167, 323), (250, 323), (120, 303), (200, 303)],
    }[size]  # fmt: skip
    held = {"poor": 0, "rich": 2}.get(size, 1)
    for k, (load, temperature) in enumerate(grid):
        name = f"drive{k + 1}"
        setting = Setting(speeds[-1] * RPM, load, temperature + 0.15)
        design.conditions[name] = setting
        if k >= len(grid) - held:
            design.held_out.add(name)
        rows = [Setting(n * RPM, load, temperature + 0.15) for n in speeds]
        design.series.append(Series("input_torque", name, setting, noise, rows=rows, replicates=3))


def old(design: Design, rng: np.random.Generator, size: str) -> None:
    """As ``wear``, to 10,000 h."""
    wear(design, rng, size, [1000, 3000, 6000, 10000])


def wear(design: Design, rng: np.random.Generator, size: str, until: Sequence[float] = ()) -> None:
    """Depths of flank and races over the hours, at loads, speeds and temperatures."""
    noise = noise_for(rng, "wear_depth")
    hours = until or {"small": [100, 400, 1200, 3000], "poor": [300, 1000, 3000]}.get(size, [50, 150, 400, 1000, 2500, 6000])
    grid = {
        "small": [(167, 2000, 313), (80, 1000, 293), (230, 1500, 303)],
        "poor": [(167, 2000, 313), (100, 2000, 313)],
        "middle": [(167, 2000, 313), (80, 2000, 293), (230, 1000, 313), (120, 1000, 333), (167, 1500, 303)],
        "rich": [(167, 2000, 313), (60, 2000, 293), (110, 2500, 333), (230, 1000, 313), (230, 2000, 293), (110, 600, 333), (167, 1500, 303),
                 (90, 1200, 318)],
    }[size]  # fmt: skip
    held = {"small": 1, "poor": 0, "middle": 1, "rich": 2}[size]
    for k, (load, speed, temperature) in enumerate(grid):
        name = f"life{k + 1}"
        setting = Setting(speed * RPM, load, temperature + 0.15, hours[-1] * HOUR)
        design.conditions[name] = setting
        if k >= len(grid) - held:
            design.held_out.add(name)
        rows = [Setting(speed * RPM, load, temperature + 0.15, h * HOUR) for h in hours]
        for surface in ("flank", "inner_race", "outer_race"):
            design.series.append(Series("wear_depth", name, setting, noise, rows=rows, tags={"surface": surface}, replicates=3))
    design.nuisances["mesh_wear_coefficient"] = {"unit": "1", "start": 5e-9, "lower": 1e-9, "upper": 2.5e-8, "prior": 1.5e-9}
    design.nuisances["roughness"] = {"unit": "um", "start": 0.4, "lower": 0.1, "upper": 1.2, "prior": 0.06}


def prints(design: Design, rng: np.random.Generator, size: str) -> None:
    """Worn profiles of pins at the end of the life runs."""
    noise = noise_for(rng, "wear_profile")
    for name, setting in list(design.conditions.items()):
        if name.startswith("life"):
            angles = np.radians(np.linspace(-78.0, 78.0, 40))
            design.series.append(Series("wear_profile", name, setting, noise, {"depth_angle": angles}, tags={"surface": "pin"}))


def vibration(design: Design, rng: np.random.Generator, size: str) -> None:
    """Acceleration of the housing over the order."""
    noise = noise_for(rng, "vibration_order")
    grid = {"small": [(60, 1000), (167, 2000), (100, 1500)], "poor": [(167, 2000), (167, 1000)],
            "middle": [(40, 2000), (167, 2000), (167, 1000), (100, 500), (100, 1500)]}  # fmt: skip
    grid["rich"] = grid["middle"] + [(200, 2500)]
    rows = grid[size]
    for k, (load, speed) in enumerate(rows):
        name = f"shake{k + 1}"
        setting = Setting(speed * RPM, load, 303.15)
        design.conditions[name] = setting
        if size != "poor" and k == len(rows) - 1:
            design.held_out.add(name)
        design.series.append(Series("vibration_order", name, setting, noise, {"order": np.arange(20.0, 420.0, 1.0)},
                                    tags={"location": "housing_radial"}))


def cage(design: Design, rng: np.random.Generator, size: str) -> None:
    """Speed of a cage over the load, at some speeds."""
    noise = noise_for(rng, "cage_speed")
    loads = [10, 30, 80, 167] if size in ("tiny", "small", "poor") else [5, 15, 30, 60, 110, 167, 230]
    speeds = {"tiny": [1000, 2000, 1500], "small": [1000, 2000, 1500], "poor": [2000], "middle": [500, 2000, 1200], "rich": [500, 1000, 2000, 2500, 1500]}[size]
    for k, speed in enumerate(speeds):
        name = f"cage{k + 1}"
        setting = Setting(speed * RPM, 167.0, 303.15)
        design.conditions[name] = setting
        if size != "poor" and k == len(speeds) - 1:
            design.held_out.add(name)
        rows = [Setting(speed * RPM, load, 303.15) for load in loads]
        design.series.append(Series("cage_speed", name, setting, noise, rows=rows, replicates=3))


BLOCKS = {"te": te, "speeds": speeds, "loops": loops, "torque": torque, "wear": wear, "old": old, "prints": prints, "vibration": vibration, "cage": cage}


def make_design(rng: np.random.Generator, blocks: list[str], size: str) -> Design:
    design = Design(size)
    for block in blocks:
        BLOCKS[block](design, rng, size)
    if size not in ("tiny", "small") and {"te", "loops"} & set(blocks) and rng.random() < 0.4:
        design.nuisances["mesh_stiffness"] = {"unit": "N", "start": 3.2e5, "lower": 2.2e5, "upper": 4.4e5, "prior": 1e4}
    if size not in ("tiny", "small") and "te" in blocks:
        design.uneven = bool(rng.random() < 0.25)
        if rng.random() < 0.25:
            mounted = ["A", "B"]
            names = [n for n in design.conditions if n.startswith("te")]
            design.mounting = {n: mounted[k % 2] for k, n in enumerate(names)}
            design.zeros = {m: float(rng.uniform(-0.9, 0.9) * TURN / 160.0) for m in mounted}
    if size == "poor" and rng.random() < 0.4:
        for s in design.series:
            s.replicates = 1
    return design
