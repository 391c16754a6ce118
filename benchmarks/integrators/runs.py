"""A stretch gone through by the plant's own integrator, by a method of this folder, or by SciPy."""

from collections.abc import Callable
from time import thread_time
from typing import Literal

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

from benchmarks.integrators.first_order import jacobian, rate_of_change
from benchmarks.integrators.methods import Method
from benchmarks.integrators.steps import advance_by
from benchmarks.integrators.stretches import Stretch, observe
from fmu_src.arrays import Floats
from rv_plant import plant

REFERENCE = 1e-5
Solver = Literal["Radau", "BDF", "LSODA"]
# What was seen (rows as ``observe``), counts (assemblies, factorisations, steps, rejected), time [s].
Seen = tuple[Floats, npt.NDArray[np.int64], float]


def with_alpha(stretch: Stretch, tolerance: float, radius: float = 0.5,
               observing: Callable[[np.ndarray], Floats] = observe) -> Seen | None:  # fmt: skip
    """The plant's own integrator: what was seen, and counts."""
    records = stretch.start.copy()
    records["dynamic_tolerance"], records["spectral_radius"] = tolerance, radius
    counts, seen, spent = np.zeros(4, int), [], 0.0
    for load in stretch.loads:
        records["load_torque"] = load
        begun = thread_time()
        status = plant.step(records, 0.0, stretch.step)
        spent += thread_time() - begun
        if status != 0:
            return None
        r = records[0]
        counts += r["assemblies"], r["assemblies"], r["substeps"], r["rejected"]
        seen.append(observing(records))
    return np.array(seen), counts, spent


def with_method(stretch: Stretch, method: Method, tolerance: float) -> Seen | None:
    records = stretch.start.copy()
    records["dynamic_tolerance"] = tolerance
    n = records["q"].shape[1]
    ks, damping, counts, seen, spent = np.zeros((4, 4, n)), np.zeros((n, n)), np.zeros(4, int), [], 0.0
    for load in stretch.loads:
        records["load_torque"] = load
        begun = thread_time()
        moved = advance_by(records, stretch.step, method.kind, method.order, method.gamma, method.a, method.c,
                           method.b, method.e, ks, damping, counts)
        spent += thread_time() - begun
        if not moved:
            return None
        seen.append(observe(records))
    return np.array(seen), counts, spent


def with_scipy(stretch: Stretch, name: Solver, tolerance: float) -> Seen | None:
    """SciPy's solver from communication point to communication point."""
    records = stretch.start.copy()
    r = records[0]
    n = len(r["q"])
    y = np.concatenate([r["q"], r["v"], [r["cage"]]])
    # Velocities are weighed at the frequency of the contacts, 2e4 rad/s.
    small = tolerance * np.concatenate([r["length_scale"], 2e4 * r["length_scale"], [1e-4]])
    dy, matrix, counts, seen, spent = np.zeros(2 * n + 1), np.zeros((2 * n + 1, 2 * n + 1)), np.zeros(4, int), [], 0.0

    def right_hand_side(_: float, y: Floats) -> Floats:
        rate_of_change(records, y, dy)
        return dy.copy()

    def tangent(_: float, y: Floats) -> Floats:
        jacobian(records, y, matrix)
        return matrix.copy()

    for load in stretch.loads:
        records["load_torque"] = load
        begun = thread_time()
        found = solve_ivp(right_hand_side, (0.0, stretch.step), y, method=name, jac=tangent, rtol=1e-12, atol=small,
                          first_step=1e-6)
        spent += thread_time() - begun
        if found.status != 0:
            return None
        y = found.y[:, -1]
        counts += found.nfev + 2 * found.njev, found.nlu, len(found.t) - 1, 0
        r["q"], r["v"], r["cage"] = y[:n], y[n : 2 * n], y[2 * n]
        seen.append(observe(records))
    return np.array(seen), counts, spent


def errors(seen: Floats, reference: Floats) -> tuple[float, float, float]:
    """Largest and root mean square error of the forces over the largest force; largest of the output angle [arcsec]."""
    scale = reference[:, :-1].max()
    away = seen - reference
    return (float(np.abs(away[:, :-1]).max() / scale), float(np.sqrt((away[:, :-1] ** 2).mean()) / scale),
            float(np.degrees(np.abs(away[:, -1]).max()) * 3600.0))
