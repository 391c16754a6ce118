"""Whether a refusal is true: geometry by formulas of its own, a missing equilibrium by a more patient search."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from fmu_src.arrays import Records
from fmu_src.unit import Unit
from rv_plant import faults as f

Record = Any


def least_convex_radius(r: Record) -> float:
    """Smallest radius of curvature [m] of the pins' path in the disc's frame where it bulges outwards."""
    lobes = r["lobe_pitch_error"].shape[1]
    circle, phi = float(r["pin_circle_radius"] + r["shift_modification"]), np.linspace(0.0, np.pi, 20001)
    slow, fast = 1j / lobes, 1j * (lobes + 1) / lobes
    first, second = (circle * slow**k * np.exp(slow * phi) - r["eccentricity"] * fast**k * np.exp(fast * phi) for k in (1, 2))
    curvature = (np.conj(first) * second).imag / np.abs(first) ** 3
    return 1.0 / float(curvature.max())


def holes_overlap(r: Record) -> bool:
    count = r["output_pin_force"].shape[1]
    hole = float(r["output_pin_radius"] + r["eccentricity"] + r["output_clearance"])
    neighbours = 2.0 * float(r["output_circle_radius"]) * math.sin(math.pi / count)
    return not 2.0 * hole < neighbours or not float(r["output_circle_radius"]) - hole > float(r["outer_race_radius"] + r["crank_circle_radius"])


def bearings_overlap(r: Record) -> bool:
    """By the centres of the holes on the disc."""
    cranks, hole = r["roller_force"].shape[1], float(r["outer_race_radius"])
    centres = float(r["crank_circle_radius"]) * np.exp(2j * np.pi * np.arange(cranks) / cranks)
    between = min((abs(a - b) for i, a in enumerate(centres) for b in centres[:i]), default=np.inf)
    roots = float(r["pin_circle_radius"] - r["eccentricity"] - r["pin_radius"] - r["equidistant_modification"])
    return not (2.0 * hole < between and float(np.abs(centres).max()) + hole < roots)


def is_worn_through(r: Record) -> bool:
    """Of the record of RvReducer, by its surfaces and not by the depths that it gives."""
    rollers = 0.5 * float(r["outer_race_radius"] - r["inner_race_radius"])
    return not (float(r["disc_wear"].max()) < float(r["pin_radius"]) and float(max(r["inner_race_wear"].max(), r["outer_race_wear"].max())) < rollers)


def is_true(code: int, r: Record) -> bool:
    """Whether the geometry or the settings have the fault; of equilibria and motion see ``is_found_patiently``."""
    pins, rollers = r["pin_x"].shape[0], r["roller_force"].shape[2]
    circle = float(r["pin_circle_radius"] + r["shift_modification"])
    speed = abs(float(r["input_speed"]))
    claims: dict[int, Callable[[], bool]] = {
        f.PRIMED: lambda: not float(r["eccentricity"]) * pins < circle,
        f.UNDERCUT: lambda: not float(r["pin_radius"] + r["equidistant_modification"]) < least_convex_radius(r) * (1.0 + 1e-6),
        f.PINS_OVERLAP: lambda: not 2.0 * float(r["pin_radius"]) < 2.0 * float(r["pin_circle_radius"]) * math.sin(math.pi / pins),
        f.ROLLERS_OVERLAP: lambda: not float(r["roller_radius"]) < float(r["inner_race_radius"] + r["roller_radius"]) * math.sin(math.pi / rollers),
        f.RACES_DO_NOT_FIT: lambda: not abs(float(r["outer_race_radius"] - r["inner_race_radius"] - 2.0 * r["roller_radius"])) < 1e-4,
        f.CRANKS_ON_AXIS: lambda: float(r["crank_circle_radius"]) == 0.0,
        f.OUTPUT_HOLES_OVERLAP: lambda: holes_overlap(r),
        f.BEARINGS_OVERLAP: lambda: bearings_overlap(r),
        f.OUTPUT_HOLES_OPEN: lambda: not float(r["output_pin_radius"] + r["eccentricity"] + r["output_clearance"] + r["output_circle_radius"])
        < float(r["pin_circle_radius"] - r["eccentricity"] - r["pin_radius"] - r["equidistant_modification"]),
        f.TORQUE_AT_REST: lambda: int(r["drive"]) == 1 and int(r["fidelity"]) == 0,
        f.OUTPUT_PINS_AT_REST: lambda: int(r["fidelity"]) == 1,
        f.LONG_STEP: lambda: speed > 0.0,
    }  # fmt: skip
    return code in claims and claims[code]()


def is_found_patiently(unit: Unit, records: Records, at_start: bool) -> bool:
    """Whether the parts find an equilibrium after all where they stand and as warm as they are, from ideal places with many more iterations.

    ``at_start`` nothing was warmed or moved yet: then as an initialisation.
    """
    patient = records.copy()
    plant = patient["plant"]
    plant["z"] = plant["phase_shift"] = 0.0
    patient["max_iterations"], patient["fidelity"] = 1000, 0
    initialise, step = unit.bound(patient)
    return (initialise() if at_start else step(0.0, 0.0)) == 0
