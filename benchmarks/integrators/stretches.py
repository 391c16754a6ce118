"""Two stretches of motion, and what is looked at along them."""

import math
from dataclasses import dataclass

import numpy as np

from benchmarks.numba_peer import njit
from fmu_src.arrays import Floats
from fmu_src.table import Table
from rv_plant import plant
from rv_plant.dynamics import assemble_motion
from rv_plant.faults import FAULTS

FLYWHEEL = 1e9  # kg m^2


@dataclass
class Stretch:
    """Where a motion starts, and load torque and duration of each communication step."""

    start: np.ndarray
    loads: Floats
    step: float


def rated(table: Table) -> Stretch:
    records, turn = begin(table)
    step = turn / 72
    for _ in range(72):
        assert plant.step(records, 0.0, step) == 0
    return Stretch(records, np.full(18, float(records["load_torque"][0])), step)


def reversal(table: Table) -> Stretch:
    records, _ = begin(table, backlash=10e-6, first_stage_compliance=1e-8)
    for _ in range(20):
        assert plant.step(records, 0.0, 1e-3) == 0
    loads = float(records["load_torque"][0]) * np.cos(np.pi * np.minimum(1.0, np.arange(1, 51) / 40))
    return Stretch(records, loads, 5e-4)


def begin(table: Table, **values: float) -> tuple[np.ndarray, float]:
    records = table.new_records()
    values = {"fidelity": 1, "drive": 1, "sun_inertia": FLYWHEEL, "dynamic_tolerance": 1e-4, **values}
    for name, value in values.items():
        records[name] = value
    # Started as a driven sun; from then on the flywheel keeps the speed.
    status = plant.initialise(records)
    assert status == 0, FAULTS[status]
    return records, 2.0 * math.pi / abs(float(records["crank_speed"][0]))


@njit
def contact_forces(records: np.ndarray) -> None:
    """Forces at the present state."""
    assemble_motion(records[0], 1.0)


def observe(records: np.ndarray) -> Floats:
    contact_forces(records)
    r = records[0]
    return np.concatenate([r["mesh_force_now"].ravel(), r["roller_force_now"].ravel(), r["q"][-1:]])
