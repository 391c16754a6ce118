"""Equilibria along a crank turn: the plant against SciPy's ``root``.

Every method goes through the same angles and starts from its own last solution.  Error is that of
the worst pin force over the largest, against the plant at a tolerance of 1e-11.
"""

import math
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import root

from benchmarks.numba_peer import njit
from benchmarks.numpy_plant import NumpyPlant
from benchmarks.ratios import Curve, Measured, Ratio, cost, cost_at
from fmu_src.arrays import Floats
from reducers.reducer import load_reducer
from rv_plant import plant
from rv_plant.assembly import assemble
from rv_plant.faults import FAULTS

LEVEL = 1e-6
TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-9)
XTOLS = (1e-3, 1e-6, 1e-9)
FREE = 7
# A tenth of a micrometre: unknowns are measured in it, as a user must for root to work at all.
SMALL = 1e-7
# Of coordinates, angle of the output and of the cages.
OfState = Callable[[Floats, float, float], Floats]


def start(name: str) -> tuple[np.ndarray, float]:
    records = load_reducer(name).plant.new_records()
    status = plant.initialise(records)
    assert status == 0, FAULTS[status]
    step = 2.0 * math.pi / 72 / abs(float(records["crank_speed"][0]))
    return records, step


def reference(name: str, positions: int) -> tuple[list[tuple[float, float]], Floats]:
    """((angle, cage angle), forces) along the turn."""
    records, step = start(name)
    records["tolerance"] = 1e-11
    records["largest_crank_step"] = 1.0
    angles, forces = [], []
    for _ in range(positions):
        status = plant.step(records, 0.0, step)
        assert status == 0, FAULTS[status]
        angles.append((float(records["ideal_output"][0]), float(records["cage"][0])))
        forces.append(records["mesh_force_now"][0].copy())
    return angles, np.array(forces)


def error_of(forces: Sequence[Floats], wanted: Floats) -> float:
    return float(np.abs(np.array(forces) - wanted).max() / wanted.max())


def with_plant(name: str, positions: int, tolerance: float, wanted: Floats) -> tuple[float, float]:
    first, step = start(name)
    first["tolerance"], first["largest_crank_step"] = tolerance, 1.0
    runs = 20

    def turn() -> None:
        for records in copies.pop():
            for _ in range(positions):
                plant.step(records, 0.0, step)

    copies = [[first.copy() for _ in range(runs)] for _ in range(10)]
    seconds = cost(turn, 10) / (runs * positions)
    records, forces = first.copy(), []
    for _ in range(positions):
        assert plant.step(records, 0.0, step) == 0
        forces.append(records["mesh_force_now"][0].copy())
    return error_of(forces, wanted), seconds


def with_root(
    residual: OfState, forces_at: OfState, angles: list[tuple[float, float]], z0: Floats, lever: float, wanted: Floats, xtol: float,
    jac: OfState | None = None,
) -> tuple[float, float, float]:  # fmt: skip
    """(error, seconds an angle, evaluations an angle)."""
    scale = np.where(np.arange(FREE) % 3 == 2, SMALL / lever, SMALL)
    scale[-1] = SMALL / lever
    x0 = z0[:FREE] / scale
    counted = [0]
    kept: list[Floats] = []

    def turn() -> None:
        x = x0
        counted[0], kept[:] = 0, []
        for angle, cage in angles:
            def function(x: Floats) -> Floats:
                counted[0] += 1
                return residual(x * scale, angle, cage) * scale

            derivative = None if jac is None else lambda x: jac(x * scale, angle, cage) * np.outer(scale, scale)
            x = root(function, x, method="hybr", jac=derivative, options={"xtol": xtol}).x
            kept.append(x)

    seconds = cost(turn, 2) / len(angles)
    forces = [forces_at(x * scale, angle, cage) for x, (angle, cage) in zip(kept, angles)]
    return error_of(forces, wanted), seconds, counted[0] / len(angles)


@njit
def assembled(records: np.ndarray, z: Floats, angle: float, cage: float, out: Floats, tangent: Floats) -> None:
    r = records[0]
    for i in range(z.shape[0]):
        r.z[i] = z[i]
    assemble(r, angle, cage, r.load_torque)
    for i in range(z.shape[0]):
        out[i] = r.residual_vector[i]
        for j in range(i, z.shape[0]):
            tangent[i, j] = tangent[j, i] = r.tangent[i, j]


def compiled(records: np.ndarray) -> tuple[OfState, OfState]:
    """Our residual and tangent as SciPy calls them."""
    out, matrix = np.zeros(FREE), np.zeros((FREE, FREE))

    def residual(z: Floats, angle: float, cage: float) -> Floats:
        assembled(records, z, angle, cage, out, matrix)
        return out.copy()

    def tangent(z: Floats, angle: float, cage: float) -> Floats:
        assembled(records, z, angle, cage, out, matrix)
        return matrix.copy()

    return residual, tangent


def twin_residual(record: Any) -> OfState:
    """The residual of tests/twin.py, written by whoever checks the kernels: 30 Newton iterations to every pin."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
    twin = import_module("twin")

    def residual(z: Floats, angle: float, cage: float) -> Floats:
        whole = np.zeros(len(record.z))
        whole[:FREE] = z
        found: Floats = twin.Twin(record, angle, cage).left_over(whole)
        return found

    return residual


def measure(quick: bool = False) -> Measured:
    found = Measured()
    for name in ("RV20E-121-rigid",) if quick else ("RV20E-121-rigid", "BX-40E-rigid"):
        positions = 6 if quick else 72
        angles, wanted = reference(name, positions)
        first, _ = start(name)
        record = first.view(np.recarray)[0]
        assert int(record.free_count) == FREE
        model = NumpyPlant(first[0])
        z0, lever = first["z"][0].copy(), float(record.pin_circle_radius)
        ours = [with_plant(name, positions, t, wanted) for t in (TOLERANCES[2:] if quick else TOLERANCES)]
        residual, tangent = compiled(first.copy())
        peers = {
            "SciPy root, NumPy residual in whole arrays": (model.out_of_balance, None),
            "SciPy root, NumPy residual of the tests' twin": (twin_residual(record), None),
            "SciPy root, our residual": (residual, None),
            "SciPy root, our residual and tangent": (residual, tangent),
        }
        lines = {"rvwear": [(e, 1e6 * s) for e, s in ours]}
        mine = cost_at(ours, LEVEL)
        for peer, (function, jac) in peers.items():
            runs = [with_root(function, model.forces, angles, z0, lever, wanted, x, jac) for x in (XTOLS[1:2] if quick else XTOLS)]
            lines[peer] = [(e, 1e6 * s) for e, s, _ in runs]
            target = 1000.0 if "NumPy" in peer else None
            found.ratios.append(Ratio("equilibrium", f"{name}, one angle of {positions}", peer, mine,
                                      cost_at([(e, s) for e, s, _ in runs], LEVEL), f"pin force within {LEVEL:g}", target,
                                      note=f"{runs[-1][2]:.0f} evaluations an angle"))
        found.curves.append(Curve(f"Equilibrium of the {name}: cost against error", "error of the pin force", "us an angle", lines))
    return found
