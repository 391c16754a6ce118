"""Other integrators than the plant's, on its own forces and tangent: error against work.

    python3 benchmarks/integrators.py [--reducer NAME ...] [--json FILE]

Two stretches of motion: a quarter crank turn at rated speed and load, and the load
reversed through clearance and backlash in 20 ms.  All methods start from the same state,
keep the same communication points and control their step by the same norm (a deflection
of 1 um times the tolerance).  The sun is a flywheel, so that no coordinate is prescribed.

The reference is SciPy's Radau (order 5) at a tolerance of 1e-5.  The
step methods below are meant for this comparison alone.
"""

import argparse
import json
import math
from dataclasses import dataclass
from pathlib import Path
from time import thread_time

import numba
import numpy as np
from scipy.integrate import solve_ivp

from orchestrator.reducer import load_reducer
from rv_plant import plant
from rv_plant.dynamics import assemble_motion
from rv_plant.linear import cholesky_apply, cholesky_factor, cholesky_solve

REDUCERS = ("RV20E-121", "BX-40E")
FLYWHEEL = 1e9  # kg m^2
NEWTON_SHARE = 1e-2
BDF2, DIRK, ROSENBROCK = range(3)
REFERENCE = 1e-5
LEVELS = (3e-2, 1e-2, 3e-3, 1e-3)
NOT_USED = np.zeros((1, 1))


@dataclass(frozen=True)
class Method:
    """``a`` are Butcher's coefficients, ``e`` the weights of the error estimate.

    Rosenbrock methods in the form without products with the Jacobian (Hairer and Wanner 1996, IV.7):
    (1/(h gamma) - J) k_i = f(y + sum a_ij k_j) + sum c_ij k_j/h, y1 = y + sum b_i k_i.
    """

    kind: int
    order: int
    gamma: float
    a: np.ndarray
    c: np.ndarray
    b: np.ndarray
    e: np.ndarray


def tr_bdf2() -> Method:
    """Trapezoidal rule, then BDF2 (Bank et al. 1985; estimate of Hosea and Shampine 1996): L-stable, order 2."""
    g, w = 1.0 - math.sqrt(0.5), math.sqrt(2.0) / 4.0
    a = np.array([[0.0, 0.0, 0.0], [g, g, 0.0], [w, w, g]])
    e = a[2] - np.array([(1.0 - w) / 3.0, (3.0 * w + 1.0) / 3.0, g / 3.0])
    return Method(DIRK, 2, g, a, NOT_USED, a[2], e)


def trapezoidal() -> Method:
    """A-stable, undamped; the estimate compares with Euler's rule on the acceleration (see ``dirk_step``)."""
    a = np.array([[0.0, 0.0], [0.5, 0.5]])
    return Method(DIRK, 2, 0.5, a, NOT_USED, a[1], np.zeros(2))


def kvaerno3() -> Method:
    """ESDIRK 3(2) of four stages, stiffly accurate, L-stable (Kvaerno 2004)."""
    g = 0.4358665215084590
    a32 = (1.0 - 2.0 * g) / (4.0 * g)
    b2, b3 = 1.0 / (12.0 * g * (1.0 - 2.0 * g)), (1.0 - 6.0 * g + 6.0 * g * g) / (3.0 * (1.0 - 2.0 * g))
    a = np.zeros((4, 4))
    a[1, :2] = g, g
    a[2, :3] = 1.0 - a32 - g, a32, g
    a[3] = 1.0 - b2 - b3 - g, b2, b3, g
    return Method(DIRK, 3, g, a, NOT_USED, a[3], a[3] - a[2])


def ros2() -> Method:
    """Two stages, L-stable, order 2 with any Jacobian (Verwer et al. 1999)."""
    g = 1.0 - math.sqrt(0.5)
    a, c = np.zeros((2, 2)), np.zeros((2, 2))
    a[1, 0], c[1, 0] = 1.0 / g, -2.0 / g
    return Method(ROSENBROCK, 2, g, a, c, np.array([1.5, 0.5]) / g, np.array([0.5, 0.5]) / g)


def rodas3() -> Method:
    """Four stages, stiffly accurate, L-stable, order 3(2) (Sandu et al. 1997)."""
    a, c = np.zeros((4, 4)), np.zeros((4, 4))
    a[2, 0], a[3, 0], a[3, 2] = 2.0, 2.0, 1.0
    c[1, 0], c[2, :2], c[3, :3] = 4.0, (1.0, -1.0), (1.0, -1.0, -8.0 / 3.0)
    return Method(ROSENBROCK, 3, 0.5, a, c, np.array([2.0, 0.0, 1.0, 1.0]), np.array([0.0, 0.0, 0.0, 1.0]))


BDF2_METHOD = Method(BDF2, 2, 0.0, NOT_USED, NOT_USED, np.zeros(1), np.zeros(1))
OURS = {
    "BDF2": BDF2_METHOD, "trapezoidal": trapezoidal(), "TR-BDF2": tr_bdf2(), "ESDIRK3 (Kvaerno)": kvaerno3(),
    "ROS2": ros2(), "RODAS3": rodas3(),
}  # fmt: skip


@numba.njit(error_model="numpy")
def cage_speed(r):
    carrier = 3 * r.roller_force.shape[0]
    return (r.v[carrier + 5] - r.v[carrier]) * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)


@numba.njit(error_model="numpy")
def implicit_stage(r, base_q, base_v, hg, found, counts):
    """q = base_q + hg v, v = base_v + hg a, M a + G(q, v) = 0 by Newton from r.q; fills r.q, r.v, found = a."""
    n = r.q.shape[0]
    per = 1.0 / hg
    for _ in range(r.max_newton):
        for i in range(n):
            r.v[i] = (r.q[i] - base_q[i]) * per
            found[i] = (r.v[i] - base_v[i]) * per
        assemble_motion(r, per)
        counts[0] += 1
        counts[1] += 1
        for i in range(n):
            r.direction[i] = -(r.residual_vector[i] + r.mass[i] * found[i])
            for j in range(i, n):
                r.factor[i, j] = r.tangent[i, j]
            r.factor[i, i] += r.mass[i] * per * per
            r.factor_scale[i] = max(r.factor[i, i], 1e-30)
        if not cholesky_solve(r.factor, r.direction, r.factor_scale, n, 0.0):
            return False
        worst = 0.0
        for i in range(n):
            r.q[i] += r.direction[i]
            r.v[i] += r.direction[i] * per
            found[i] += r.direction[i] * per * per
            size = abs(r.direction[i]) / r.length_scale[i]
            if not size <= worst:
                worst = size
        if worst < NEWTON_SHARE * r.dynamic_tolerance:
            return True
        if not worst < 1e6:
            return False
    return False


@numba.njit(error_model="numpy")
def dirk_step(r, h, gamma, a, e, ks, counts):
    """One step; ks[0, i], ks[1, i] are velocity and acceleration of stage i, the last also the step's end."""
    stages, n = a.shape[0], r.q.shape[0]
    base_q, base_v = ks[2, 0], ks[2, 1]
    cage, turning = r.cage, cage_speed(r)
    for i in range(n):
        ks[0, 0, i], ks[1, 0, i] = r.v_start[i], r.acceleration_start[i]
    for s in range(1, stages):
        for i in range(n):
            sum_q = sum_v = 0.0
            for k in range(s):
                sum_q += a[s, k] * ks[0, k, i]
                sum_v += a[s, k] * ks[1, k, i]
            base_q[i], base_v[i] = r.q_start[i] + h * sum_q, r.v_start[i] + h * sum_v
            r.q[i] = base_q[i] + h * gamma * (base_v[i] + h * gamma * ks[1, s - 1, i])
        r.cage = cage + a[s].sum() * h * turning
        if not implicit_stage(r, base_q, base_v, h * gamma, ks[1, s], counts):
            return -1.0
        for i in range(n):
            ks[0, s, i] = r.v[i]
    error = 0.0
    for i in range(n):
        r.acceleration[i] = ks[1, stages - 1, i]
        jump = 0.0
        for s in range(stages):
            jump += h * e[s] * ks[0, s, i]
        if stages == 2:
            # Local error of the trapezoidal rule, h^3/12 of the third derivative.
            jump = h * h / 12.0 * (ks[1, 1, i] - ks[1, 0, i])
        error = max(error, abs(jump) / r.length_scale[i])
    return error / r.dynamic_tolerance


@numba.njit(error_model="numpy")
def bdf2_step(r, h, h_before, ks, counts):
    """Variable step; ks[0, 0], ks[1, 0] are q and v one step earlier (h_before = 0: Euler)."""
    n = r.q.shape[0]
    base_q, base_v = ks[2, 0], ks[2, 1]
    w = h / h_before if h_before > 0.0 else 0.0
    now, before = (1.0 + w) ** 2 / (1.0 + 2.0 * w), w * w / (1.0 + 2.0 * w)
    hg = h * (1.0 + w) / (1.0 + 2.0 * w)
    for i in range(n):
        base_q[i] = now * r.q_start[i] - before * ks[0, 0, i]
        base_v[i] = now * r.v_start[i] - before * ks[1, 0, i]
        r.q[i] = base_q[i] + hg * (base_v[i] + hg * r.acceleration_start[i])
    r.cage += h * cage_speed(r)
    if not implicit_stage(r, base_q, base_v, hg, ks[1, 1], counts):
        return -1.0
    error = 0.0
    share = (1.0 + w) ** 2 / (6.0 * w * (1.0 + 2.0 * w)) if w > 0.0 else 0.5
    for i in range(n):
        r.acceleration[i] = ks[1, 1, i]
        error = max(error, share * h * h * abs(r.acceleration[i] - r.acceleration_start[i]) / r.length_scale[i])
    return error / r.dynamic_tolerance


@numba.njit(error_model="numpy")
def rosenbrock_step(r, h, gamma, a, c, b, e, ks, damping, counts):
    """One step; ks[0, i], ks[1, i] are the increments k_i of q and v.

    With W = M/(hg)^2 + D/(hg) + K: W kq = M (Rv + Rq/(hg)) + D Rq, kv = kq/(hg) - Rq.  D/(hg) is
    the difference of two tangents; the cages' turning enters as the derivative by time.
    """
    stages, n = a.shape[0], r.q.shape[0]
    per = 1.0 / (h * gamma)
    by_time, rq, start = ks[2, 0], ks[2, 1], ks[2, 2]
    cage, turning = r.cage, cage_speed(r)
    assemble_motion(r, 2.0 * per)
    for i in range(n):
        for j in range(i, n):
            damping[i, j] = r.tangent[i, j]
    nudge = 1e-3 * h
    third = stages > 2
    if third:
        r.cage = cage + nudge * turning
        assemble_motion(r, per)
        counts[0] += 1
        for i in range(n):
            by_time[i] = r.residual_vector[i]
        r.cage = cage
    assemble_motion(r, per)
    counts[0] += 2
    counts[1] += 1
    for i in range(n):
        by_time[i] = (by_time[i] - r.residual_vector[i]) / nudge if third else 0.0
        for j in range(i, n):
            damping[i, j] = damping[j, i] = damping[i, j] - r.tangent[i, j]
            r.factor[i, j] = r.tangent[i, j]
        r.factor[i, i] += r.mass[i] * per * per
        r.factor_scale[i] = max(r.factor[i, i], 1e-30)
        start[i] = r.residual_vector[i]
    if not cholesky_factor(r.factor, r.factor_scale, n, 0.0):
        return -1.0
    for s in range(stages):
        moved = 0.0
        for k in range(s):
            moved += abs(a[s, k])
        if moved > 0.0:
            for i in range(n):
                r.q[i], r.v[i] = r.q_start[i], r.v_start[i]
                for k in range(s):
                    r.q[i] += a[s, k] * ks[0, k, i]
                    r.v[i] += a[s, k] * ks[1, k, i]
            r.cage = cage + h * turning
            assemble_motion(r, per)
            counts[0] += 1
            for i in range(n):
                start[i] = r.residual_vector[i]
        # gamma_i of RODAS3: 1/2, 3/2, 0, 0.
        time_share = (0.5, 1.5, 0.0, 0.0)[s] if third else 0.0
        for i in range(n):
            rq[i] = r.v[i]
            r.direction[i] = -start[i] - time_share * h * by_time[i]
            for k in range(s):
                rq[i] += c[s, k] / h * ks[0, k, i]
                r.direction[i] += r.mass[i] * c[s, k] / h * ks[1, k, i]
            r.direction[i] += r.mass[i] * rq[i] * per
        for i in range(n):
            for j in range(n):
                r.direction[i] += damping[i, j] * rq[j] / per
        cholesky_apply(r.factor, r.direction, n)
        for i in range(n):
            ks[0, s, i] = r.direction[i]
            ks[1, s, i] = r.direction[i] * per - rq[i]
    error = 0.0
    for i in range(n):
        r.q[i], r.v[i] = r.q_start[i], r.v_start[i]
        jump = 0.0
        for s in range(stages):
            r.q[i] += b[s] * ks[0, s, i]
            r.v[i] += b[s] * ks[1, s, i]
            jump += e[s] * ks[0, s, i]
        if not abs(jump) < 1e300:
            return -1.0
        error = max(error, abs(jump) / r.length_scale[i])
    r.cage = cage + h * turning
    return error / r.dynamic_tolerance


@numba.njit(error_model="numpy")
def advance_by(records, duration, kind, order, gamma, a, c, b, e, ks, damping, counts):
    """Integrate over a communication step; counts: assemblies, factorisations, steps, rejected."""
    r = records[0]
    n = r.q.shape[0]
    time = 0.0
    while time < duration * (1.0 - 1e-12):
        left = duration - time
        h = r.internal_step
        if h >= left:
            h = left
        elif 2.0 * h > left:
            h = 0.5 * left
        cage, turning = r.cage, cage_speed(r)
        for i in range(n):
            r.q_start[i], r.v_start[i], r.acceleration_start[i] = r.q[i], r.v[i], r.acceleration[i]
        if kind == BDF2:
            error = bdf2_step(r, h, ks[3, 0, 0], ks, counts)
        elif kind == DIRK:
            error = dirk_step(r, h, gamma, a, e, ks, counts)
        else:
            error = rosenbrock_step(r, h, gamma, a, c, b, e, ks, damping, counts)
        if not 0.0 <= error <= 1.0:
            for i in range(n):
                r.q[i], r.v[i], r.acceleration[i] = r.q_start[i], r.v_start[i], r.acceleration_start[i]
            r.cage = cage
            counts[3] += 1
            r.internal_step = 0.25 * h if error < 0.0 else h * max(0.2, 0.9 * error ** (-1.0 / (order + 1)))
            if r.internal_step < 1e-9:
                return False
            continue
        time += h
        counts[2] += 1
        r.cage = cage + 0.5 * h * (turning + cage_speed(r))
        if kind == BDF2:
            ks[3, 0, 0] = h
            for i in range(n):
                ks[0, 0, i], ks[1, 0, i] = r.q_start[i], r.v_start[i]
        if h < left:
            r.internal_step = h * min(2.0, max(0.2, 0.9 * max(error, 1e-6) ** (-1.0 / (order + 1))))
    return True


@numba.njit(error_model="numpy")
def contact_forces(records):
    """Forces at the present state."""
    assemble_motion(records[0], 1.0)


@numba.njit(error_model="numpy")
def rate_of_change(records, y, dy):
    """For SciPy: y = (q, v, cage)."""
    r = records[0]
    n = r.q.shape[0]
    r.q[:], r.v[:], r.cage = y[:n], y[n : 2 * n], y[2 * n]
    assemble_motion(r, 1.0)
    for i in range(n):
        dy[i], dy[n + i] = r.v[i], -r.residual_vector[i] / r.mass[i]
    dy[2 * n] = cage_speed(r)


@numba.njit(error_model="numpy")
def jacobian(records, y, matrix):
    r = records[0]
    n = r.q.shape[0]
    r.q[:], r.v[:], r.cage = y[:n], y[n : 2 * n], y[2 * n]
    rate = 1e5
    matrix[:] = 0.0
    for twice in range(2):
        assemble_motion(r, rate * (1 + twice))
        for i in range(n):
            matrix[i, n + i] = 1.0
            for j in range(n):
                t = r.tangent[min(i, j), max(i, j)] / r.mass[i]
                # First -(K + rate D), then -(K + 2 rate D): the difference is D.
                if twice == 0:
                    matrix[n + i, j] = -t
                else:
                    d = (-t - matrix[n + i, j]) / rate
                    matrix[n + i, n + j] = d
                    matrix[n + i, j] -= rate * d
    carrier = 3 * r.roller_force.shape[0]
    share = r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)
    matrix[2 * n, n + carrier + 5], matrix[2 * n, n + carrier] = share, -share


@dataclass
class Stretch:
    """Where a motion starts, and load torque and duration of each communication step."""

    start: np.ndarray
    loads: np.ndarray
    step: float


def rated(table) -> Stretch:
    records, turn = begin(table)
    step = turn / 72
    for _ in range(72):
        assert plant.step(records, 0.0, step) == 0
    return Stretch(records, np.full(18, float(records["load_torque"][0])), step)


def reversal(table) -> Stretch:
    records, _ = begin(table, backlash=10e-6, first_stage_compliance=1e-8)
    for _ in range(20):
        assert plant.step(records, 0.0, 1e-3) == 0
    loads = float(records["load_torque"][0]) * np.cos(np.pi * np.minimum(1.0, np.arange(1, 51) / 40))
    return Stretch(records, loads, 5e-4)


def begin(table, **values):
    records = table.new_records()
    values = {"fidelity": 1, "drive": 1, "sun_inertia": FLYWHEEL, "dynamic_tolerance": 1e-4, **values}
    for name, value in values.items():
        records[name] = value
    # Started as a driven sun; from then on the flywheel keeps the speed.
    status = plant.initialise(records)
    assert status == 0, plant.FAULTS[status]
    return records, 2.0 * math.pi / abs(float(records["crank_speed"][0]))


def observe(records):
    contact_forces(records)
    r = records[0]
    return np.concatenate([r["mesh_force_now"].ravel(), r["roller_force_now"].ravel(), r["q"][-1:]])


def with_alpha(stretch: Stretch, tolerance: float, radius: float = 0.5, observing=observe):
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


def with_method(stretch: Stretch, method: Method, tolerance: float):
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


def with_scipy(stretch: Stretch, name: str, tolerance: float):
    """SciPy's solver from communication point to communication point."""
    records = stretch.start.copy()
    r = records[0]
    n = len(r["q"])
    y = np.concatenate([r["q"], r["v"], [r["cage"]]])
    # Velocities are weighed at the frequency of the contacts, 2e4 rad/s.
    small = tolerance * np.concatenate([r["length_scale"], 2e4 * r["length_scale"], [1e-4]])
    dy, matrix, counts, seen, spent = np.zeros(2 * n + 1), np.zeros((2 * n + 1, 2 * n + 1)), np.zeros(4, int), [], 0.0

    def right_hand_side(_, y):
        rate_of_change(records, y, dy)
        return dy.copy()

    def tangent(_, y):
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


def errors(seen, reference):
    """Largest and root mean square error of the forces over the largest force; largest of the output angle [arcsec]."""
    scale = reference[:, :-1].max()
    away = seen - reference
    return (float(np.abs(away[:, :-1]).max() / scale), float(np.sqrt((away[:, :-1] ** 2).mean()) / scale),
            float(np.degrees(np.abs(away[:, -1]).max()) * 3600.0))


def smallest(run, repeats):
    """A run's result with the smallest time of several."""
    results = [run() for _ in range(repeats)]
    return min(results, key=lambda x: x[2]) if None not in results else None


def compare(stretch: Stretch, repeats: int):
    reference, *_ = with_scipy(stretch, "Radau", REFERENCE)
    rows = []

    def add(name, tolerance, run, count):
        result = smallest(run, count)
        if result is None:
            rows.append({"method": name, "tolerance": tolerance, "failed": True})
            return
        seen, counts, spent = result
        force, mean, angle = errors(seen, reference)
        rows.append({
            "method": name, "tolerance": tolerance, "force_error": force, "force_error_rms": mean,
            "angle_error_arcsec": angle, "core_ms": 1e3 * spent,
            "real_time_factor": len(stretch.loads) * stretch.step / spent,
            **dict(zip(("assemblies", "factorisations", "steps", "rejected"), (int(x) for x in counts))),
        })

    ladder = (3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4)
    for radius in (0.0, 0.5, 0.8):
        for tolerance in ladder:
            add(f"generalised-alpha {radius:g}", tolerance, lambda: with_alpha(stretch, tolerance, radius), repeats)
    for name, method in OURS.items():
        for tolerance in ladder:
            add(name, tolerance, lambda: with_method(stretch, method, tolerance), repeats)
    for name in ("Radau", "BDF", "LSODA"):
        for tolerance in (1.0, 1e-1, 1e-2, 1e-3):
            add(f"SciPy {name}", tolerance, lambda: with_scipy(stretch, name, tolerance), 2)
    return rows


def work_at(rows, method, error):
    """Assemblies with which a method's force error comes down to ``error`` for good, read in logarithms.

    Where its loosest run suffices, that run's.  Each assembly costs the same in all methods of
    this file and all but a fifth of the time, and counts do not depend on the machine.
    """
    points = sorted((r["assemblies"], r["force_error"]) for r in rows if r["method"] == method and not r.get("failed"))
    k = max([i + 1 for i, (_, e) in enumerate(points) if e > error], default=0)
    if k == len(points):
        return math.nan
    if k == 0:
        return points[0][0]
    (n0, e0), (n1, e1) = points[k - 1 : k + 1]
    return n0 * (n1 / n0) ** (math.log(e0 / error) / math.log(e0 / e1))


def show(rows):
    print(f"    {'method':22}{'tolerance':>10}{'force':>10}{'rms':>10}{'angle':>10}{'ms':>9}{'x real':>8}"
          f"{'assemb.':>9}{'factor.':>9}{'steps':>8}{'reject.':>8}")
    for r in rows:
        if r.get("failed"):
            print(f"    {r['method']:22}{r['tolerance']:10.0e}    failed")
            continue
        print(f"    {r['method']:22}{r['tolerance']:10.0e}{r['force_error']:10.1e}{r['force_error_rms']:10.1e}"
              f"{r['angle_error_arcsec']:10.1e}{r['core_ms']:9.2f}{r['real_time_factor']:8.2f}"
              f"{r['assemblies']:9d}{r['factorisations']:9d}{r['steps']:8d}{r['rejected']:8d}")
    print("    assemblies at a force error of".ljust(36) + "".join(f"{e:>10.1%}" for e in LEVELS))
    for method in dict.fromkeys(r["method"] for r in rows):
        print(f"    {method:32}" + "".join(f"{work_at(rows, method, e):10.0f}" for e in LEVELS))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reducer", nargs="+", default=REDUCERS)
    parser.add_argument("--stretch", nargs="+", default=("rated", "reversal"))
    parser.add_argument("--repeats", type=int, default=4, help="runs of which the fastest counts")
    parser.add_argument("--json", type=Path, help="also write the figures to this file")
    arguments = parser.parse_args()
    result = {}
    for name in arguments.reducer:
        table = load_reducer(name).plant
        for kind in arguments.stretch:
            stretch = {"rated": rated, "reversal": reversal}[kind](table)
            print(f"\n{name}, {kind}")
            rows = result[f"{name} {kind}"] = compare(stretch, arguments.repeats)
            show(rows)
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
