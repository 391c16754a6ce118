"""Motion through a part of a crank turn at rated speed: the plant against SciPy, SUNDIALS and Exudyn.

All start from the same state with the same forces; the sun is a flywheel.  A peer's tolerances are
laid on deflections of 1 um as the plant's are.  Each is run over a ladder of tolerances, and the
cheapest run whose worst contact force is within 1 % (0.3 %) of the largest counts, so that a peer is
judged at its best setting; reference is SciPy's Radau at a tolerance of 1e-5.  A SciPy peer goes through
in one call and also from point to point; the cheaper counts.  Exudyn, the general multibody package, cannot
express the contacts and gets the same forces (see ``exudyn_peer``); its steps are fixed, and it has a ladder of
settings instead of tolerances.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import repeat
from multiprocessing import get_context
from time import process_time
from typing import Any, get_args

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.exudyn_peer import LADDER, SLOW_LADDER, ExudynPlant
from benchmarks.integrators.first_order import jacobian, rate_of_change
from benchmarks.integrators.runs import REFERENCE, Solver, errors, with_alpha, with_scipy
from benchmarks.integrators.stretches import Stretch, observe, rated
from benchmarks.numpy_plant import NumpyPlant
from benchmarks.ratios import Curve, Figure, Measured, Ratio
from fmu_src.arrays import Floats
from reducers.reducer import load_reducer

LEVELS = (1e-2, 3e-3)
OURS = (3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3)
PEERS = (1.0, 3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3)
SLOW_PEERS = (1e-1, 3e-2, 1e-2, 3e-3)
# Velocities are weighed at the frequency of the contacts [rad/s].
CONTACTS = 2e4

Point = tuple[float, float]
# Rates, or their derivatives, of time and state.
OfTime = Callable[[float, Floats], Floats]
# Name -> (states by rung, ladder of tolerances or settings, runs, target).
States = Sequence[Floats] | Floats | None
Peers = dict[str, tuple[Callable[[Any], States], Sequence[Any], int, float | None]]


class Problem:
    """One stretch as a system of first order, with our right-hand side or NumPy's."""

    def __init__(self, stretch: Stretch):
        self.stretch, self.records = stretch, stretch.start.copy()
        self.records["load_torque"] = stretch.loads[0]
        self.begun = self.records.copy()
        r = self.records[0]
        self.n = n = len(r["q"])
        self.start = np.concatenate([r["q"], r["v"], [r["cage"]]])
        self.scale = np.concatenate([r["length_scale"], CONTACTS * r["length_scale"], [1e-4]])
        self.times = stretch.step * np.arange(1, len(stretch.loads) + 1, dtype=np.float64)
        self.model = NumpyPlant(r)
        self.dy, self.matrix = np.zeros(2 * n + 1), np.zeros((2 * n + 1, 2 * n + 1))
        self.calls = 0

    def ours(self, _: float, y: Floats) -> Floats:
        self.calls += 1
        rate_of_change(self.records, y, self.dy)
        return self.dy.copy()

    def tangent(self, _: float, y: Floats) -> Floats:
        self.calls += 2
        jacobian(self.records, y, self.matrix)
        return self.matrix.copy()

    def numpy(self, _: float, y: Floats) -> Floats:
        self.calls += 1
        return self.model.rate_of_change(y)

    def forget(self) -> None:
        """The record remembers where contacts were last; a run that went astray must not leave that behind."""
        self.records[:] = self.begun

    def seen(self, states: Iterable[Floats]) -> Floats:
        """What the reference holds, at the states (points, coordinates)."""
        n, rows = self.n, []
        self.forget()
        for y in states:
            self.records["q"], self.records["v"], self.records["cage"] = y[:n], y[n : 2 * n], y[2 * n]
            rows.append(observe(self.records))
        return np.array(rows)


def scipy_states(
    problem: Problem, function: OfTime, jac: OfTime | None, method: Solver, tolerance: float, through: bool
) -> States:
    """States at the communication points, or None."""
    options: dict[str, Any] = {"method": method, "rtol": 1e-12, "atol": tolerance * problem.scale, "first_step": 1e-6}
    if method != "LSODA" or jac is not None:
        options["jac"] = jac
    if through:
        found = solve_ivp(function, (0.0, problem.times[-1]), problem.start, t_eval=problem.times, **options)
        return found.y.T if found.status == 0 else None
    y, states, before = problem.start, [], 0.0
    for time in problem.times:
        found = solve_ivp(function, (before, time), y, **options)
        if found.status != 0:
            return None
        y, before = found.y[:, -1], time
        states.append(y)
    return states


def sundials_states(problem: Problem, solver: Any) -> States:
    """States at the communication points of a solver that was given the start, or None."""
    states = []
    for time in problem.times:
        found = solver.step(time, method="normal", tstop=time)
        if not found.success:
            return None
        states.append(np.array(found.y).ravel())
    return states


def cvode_states(problem: Problem, tolerance: float, jac: bool, order: int = 5) -> States:
    """SUNDIALS CVODE, BDF, dense, stopping at the communication points without a new start."""
    from sksundae.cvode import CVODE

    def function(t: float, y: Floats, yp: Floats) -> None:
        problem.calls += 1
        rate_of_change(problem.records, np.ascontiguousarray(y), yp)

    def tangent(t: float, y: Floats, yp: Floats, matrix: Floats) -> None:
        problem.calls += 2
        jacobian(problem.records, y, matrix)

    options = {"jacfn": tangent} if jac else {}
    solver = CVODE(function, rtol=1e-12, atol=tolerance * problem.scale, max_num_steps=100_000, first_step=1e-6,
                   max_order=order, **options)
    solver.init_step(0.0, problem.start)
    return sundials_states(problem, solver)


def ida_states(problem: Problem, tolerance: float, jac: bool) -> States:
    """SUNDIALS IDA with the residual yp - f(y)."""
    from sksundae.ida import IDA

    def residual(t: float, y: Floats, yp: Floats, res: Floats) -> None:
        problem.calls += 1
        rate_of_change(problem.records, y, res)
        res[:] = yp - res

    def tangent(t: float, y: Floats, yp: Floats, res: Floats, cj: float, matrix: Floats) -> None:
        problem.calls += 2
        jacobian(problem.records, y, matrix)
        np.negative(matrix, out=matrix)
        matrix[np.diag_indices_from(matrix)] += cj

    options = {"jacfn": tangent} if jac else {}
    solver = IDA(residual, rtol=1e-12, atol=tolerance * problem.scale, max_num_steps=100_000, first_step=1e-6, **options)
    solver.init_step(0.0, problem.start, problem.ours(0.0, problem.start))
    return sundials_states(problem, solver)


def run(problem: Problem, reference: Floats, states: Callable[[], States], runs: int) -> tuple[Point, int]:
    """((error, least seconds), evaluations)."""
    best = math.inf
    found: States = None
    for _ in range(runs):
        problem.forget()
        problem.calls, begun = 0, process_time()
        found = states()
        best = min(best, process_time() - begun)
        if found is None:
            break
    calls = problem.calls
    if found is None:
        return (math.inf, best), calls
    return (errors(problem.seen(found), reference)[0], best), calls


def ours(stretch: Stretch, reference: Floats, runs: int) -> list[Point]:
    points = []
    for tolerance in OURS:
        found = [seen for _ in range(runs) if (seen := with_alpha(stretch, tolerance)) is not None]
        assert len(found) == runs, f"the plant's own motion failed at a tolerance of {tolerance:g}"
        points.append((errors(found[0][0], reference)[0], min(seconds for _, _, seconds in found)))
    return points


def exudyn_peers(problem: Problem, quick: bool) -> Peers:
    try:
        import exudyn  # noqa: F401
    except ImportError:
        return {}
    return {
        "Exudyn generalised-alpha, our right-hand side and Jacobian": (
            ExudynPlant(problem, False).states, LADDER[:4] if quick else LADDER, 2 if quick else 3, None),
        "Exudyn generalised-alpha, NumPy right-hand side": (
            ExudynPlant(problem, True).states, SLOW_LADDER[:1] if quick else SLOW_LADDER, 1, None),
    }


def peers(problem: Problem, quick: bool) -> Peers:
    found: Peers = exudyn_peers(problem, quick)

    def scipy(
        label: str, function: OfTime, jac: OfTime | None, method: Solver, through: bool, ladder: Sequence[float], runs: int,
        target: float | None,
    ) -> None:  # fmt: skip
        found[label] = (lambda t: scipy_states(problem, function, jac, method, t, through), ladder, runs, target)

    def sundials(states: Callable[[Problem, float, bool], States], jac: bool) -> Callable[[float], States]:
        return lambda tolerance: states(problem, tolerance, jac)

    methods: tuple[Solver, ...] = get_args(Solver)
    ladder: Sequence[float] = PEERS[2:5:2] if quick else PEERS
    runs = 2 if quick else 3
    for method in methods:
        for through, way in ((False, "point to point"), (True, "in one go")):
            scipy(f"SciPy {method}, our right-hand side and Jacobian, {way}", problem.ours, problem.tangent, method, through, ladder, runs, None)
    for method in methods:
        scipy(f"SciPy {method}, NumPy right-hand side, in one go", problem.numpy, None, method, True,
              SLOW_PEERS[:1] if quick else SLOW_PEERS, 1, 100.0)
    try:
        import sksundae  # noqa: F401
    except ImportError:
        return found
    for name, states in (("CVODE", cvode_states), ("IDA", ida_states)):
        for jac in (True, False):
            label = f"SUNDIALS {name}, our right-hand side" + (" and Jacobian" if jac else "")
            found[label] = (sundials(states, jac), (*ladder, 3e-4), runs, 3.0)
    # Orders above 2 are unstable on lightly damped oscillations, which CVODE does not always notice.
    found["SUNDIALS CVODE of order 2, our right-hand side and Jacobian"] = (
        lambda t: cvode_states(problem, t, True, 2), ladder, runs, 3.0)
    return found


def check_right_hand_sides(problem: Problem) -> float:
    """Largest difference of NumPy's and the kernels' rates, over the largest of the bodies' accelerations."""
    nudged = problem.start + 1e-8 * np.sin(np.arange(len(problem.start)))
    kernel, whole = problem.ours(0.0, nudged), problem.numpy(0.0, nudged)
    return float(np.abs(kernel - whole).max() / np.abs(kernel).max())


def short(label: str) -> str:
    return label.removesuffix(", point to point").removesuffix(", in one go")


def cheapest(points: list[Point], level: float) -> float:
    """Cost of the cheapest run within the level; NaN if there is none."""
    return min((seconds for error, seconds in points if error <= level), default=math.nan)


def measure(quick: bool = False) -> Measured:
    """Each reducer in a process of its own: a call from Python of a kernel that two record types share costs peers three times as much."""
    found = Measured()
    with ProcessPoolExecutor(1, get_context("spawn"), max_tasks_per_child=1) as processes:
        for one in processes.map(measure_one, ("RV20E-121-rigid",) if quick else ("RV20E-121-rigid", "BX-40E-rigid"), repeat(quick)):
            found.ratios += one.ratios
            found.figures += one.figures
            found.curves += one.curves
    return found


def measure_one(name: str, quick: bool) -> Measured:
    found = Measured()
    stretch = rated(load_reducer(name).plant)
    stretch = Stretch(stretch.start, np.full(3 if quick else 36, stretch.loads[0]), stretch.step)
    wanted = with_scipy(stretch, "Radau", REFERENCE)
    assert wanted is not None, "no reference"
    reference = wanted[0]
    problem = Problem(stretch)
    away = check_right_hand_sides(problem)
    assert away < 1e-7, f"NumPy's right-hand side is off by {away:.1e}"
    mine = ours(stretch, reference, 3)
    lines: dict[str, list[Point]] = {}
    targets: dict[str, float | None] = {}
    evaluations: dict[float, int] = {}
    for label, (states, ladder, runs, target) in peers(problem, quick).items():
        made = [run(problem, reference, lambda: states(t), runs) for t in ladder]
        targets[short(label)] = target
        for (error, seconds), calls in made:
            if math.isfinite(error):
                lines.setdefault(short(label), []).append((error, seconds))
                evaluations[seconds] = calls
    # Once more at the end: load of the machine at the start alone must not decide.
    mine = [(e, min(a, b)) for (e, a), (_, b) in zip(mine, ours(stretch, reference, 3))]
    for level in LEVELS[:1] if quick else LEVELS:
        seconds = cheapest(mine, level)
        for label, points in lines.items():
            peer = cheapest(points, level)
            note = f"{evaluations[peer]} evaluations" if peer in evaluations else "never within, at the tolerances run"
            found.ratios.append(Ratio("motion", f"{name}, {len(stretch.loads)} of 72 positions of a turn", label, seconds, peer,
                                      f"contact forces within {level:.1%}", targets[label], note=note))
        found.figures.append(Figure("motion", f"{name}: times real time at rated speed, forces within {level:.1%}",
                                    len(stretch.loads) * stretch.step / seconds, "1", at_least=2.0))
    found.curves.append(Curve(f"Motion of the {name}: cost against error", "error of the contact force", "s",
                              {"rvwear": mine} | lines))
    return found
