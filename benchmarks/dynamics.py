"""Cost and accuracy of the plant alone: in motion, and through equilibria.

    python3 benchmarks/dynamics.py [--reducer NAME ...] [--json FILE]

Run it with the project's environment (.venv/bin/python).  Rated speed and load, default
parameters, compiled in process, one core.  Times are those of the thread on its
core, the smallest of several runs.
Force errors are differences of single contact forces over the largest one.
"""

import argparse
import json
import math
from collections.abc import Callable
from pathlib import Path
from time import thread_time
from typing import Any, TypeVar

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.kernel import kernel
from fmu_src.table import Table
from reducers.reducer import load_reducer
from rv_plant import plant
from rv_plant.assembly import assemble, bearing_contacts
from rv_plant.dynamics import assemble_motion, bearing_in_motion
from rv_plant.equilibrium import newton_direction
from rv_plant.faults import FAULTS
from rv_plant.linear import cholesky_solve
from rv_plant.mesh import mesh_contacts
from rv_plant.poses import disc_offset
from studies.pair import POSITIONS_PER_TURN

REDUCERS = ("RV20E-121", "BX-40E")
# Counts that the plant keeps of each communication step in motion.
COUNTS = ("substeps", "rejected", "assemblies")
REPEATS, LOOPS = 5, 1000
Seen = TypeVar("Seen")


def start(table: Table, **values: float) -> tuple[np.ndarray, float]:
    """The plant's record at its start, and the time of a crank turn [s]."""
    records = table.new_records()
    for name, value in values.items():
        records[name] = value
    status = plant.initialise(records)
    assert status == 0, FAULTS[status]
    return records, 2.0 * math.pi / abs(float(records["crank_speed"][0]))


def run(records: np.ndarray, step: float, count: int, look: Callable[[np.void], Seen]) -> list[Seen]:
    """What ``look`` sees after each of ``count`` communication steps."""
    seen = []
    for _ in range(count):
        status = plant.step(records, 0.0, step)
        assert status == 0, FAULTS[status]
        seen.append(look(records[0]))
    return seen


@kernel
def step_often(records: np.ndarray, step: float, count: int) -> None:
    """Without Python in between, whose calls of a kernel take 1 to 10 us."""
    for _ in range(count):
        plant.step(records, 0.0, step)


def forces(record: np.void) -> Floats:
    return np.concatenate([record["mesh_force_now"].ravel(), record["roller_force_now"].ravel()])


def mean_forces(record: np.void) -> Floats:
    return np.concatenate([record["mesh_force"].ravel(), record["roller_force"].ravel()])


def largest_difference(found: Floats, reference: Floats) -> float:
    return float(np.abs(found - reference).max() / reference.max())


def smallest_time(function: Callable[[], object], prepare: Callable[[], object] = lambda: None) -> float:
    """Smallest time of a function [s]; the first call compiles."""
    times = []
    for _ in range(REPEATS + 1):
        prepare()
        begin = thread_time()
        function()
        times.append(thread_time() - begin)
    return min(times)


def in_motion(table: Table) -> dict[str, Any]:
    """One crank turn after a first one, and the same at ten and a hundred times tighter tolerance."""
    found = {}
    for share in (1.0, 0.1, 0.01):
        records, turn = start(table, fidelity=1)
        records["dynamic_tolerance"] *= share
        step = turn / POSITIONS_PER_TURN
        run(records, step, POSITIONS_PER_TURN, lambda _: None)
        before = records.copy()
        seen = run(records, step, POSITIONS_PER_TURN, lambda r: (
            forces(r), mean_forces(r), [int(r[name]) for name in COUNTS], float(r["energy_error"])))
        found[share] = [np.array(column) for column in zip(*seen)]
        if share == 1.0:
            work = abs(float(records["output_energy"][0] - before["output_energy"][0]))
            lacking = account(records) - account(before)
            again = before.copy()

            def restore() -> None:
                again[:] = before

            spent = smallest_time(lambda: step_often(again, step, POSITIONS_PER_TURN), restore)
    counts = dict(zip(COUNTS, (int(n) for n in found[1.0][2].sum(axis=0))))
    return {
        "real_time_factor": turn / spent,
        "core_s_per_turn": spent,
        **{f"{name}_per_turn": n for name, n in counts.items()},
        "assemblies_per_trial": counts["assemblies"] / (counts["substeps"] + counts["rejected"]),
        "force_error_10x": largest_difference(found[1.0][0], found[0.1][0]),
        "force_error_100x": largest_difference(found[1.0][0], found[0.01][0]),
        "mean_force_error_100x": largest_difference(found[1.0][1], found[0.01][1]),
        "energy_error_per_turn": abs(lacking) / work,
        "limits": motion_limits(again, spent, counts),
    }


def account(records: np.ndarray) -> float:
    """Energy that the account lacks so far [J]."""
    r = records[0]
    kinetic = 0.5 * float(r["mass"] @ r["v"] ** 2)
    stored = r["potential"] + kinetic - r["stored_energy"]
    return float(r["input_energy"] + r["cage_energy"] - r["output_energy"] - r["lost_energy"] - stored)


def through_equilibria(table: Table) -> dict[str, Any]:
    """Crank turns with more and fewer positions, against a fine one."""
    fine, windows = 1152, 18
    records, turn = start(table, largest_crank_step=1.0)
    first = forces(records[0])
    reference = np.array([first, *run(records, turn / fine, fine, forces)])
    rows = []
    limits_found: dict[str, float] = {}
    for count in (18, 36, 72, 144, 288):
        records, _ = start(table, largest_crank_step=1.0)
        step = turn / count
        seen = run(records, step, count, lambda r: (forces(r), int(r["iterations"]) + 1))
        found, evaluations = np.array([first] + [f for f, _ in seen]), [n for _, n in seen]
        spent = smallest_time(lambda: step_often(records, step, count))
        along = np.arange(fine + 1) * count / fine
        left = np.minimum(along.astype(int), count - 1)
        between = found[left] + (along - left)[:, None] * (found[left + 1] - found[left])
        means, wanted = (window_means(f, windows) for f in (found, reference))
        rows.append({
            "positions_per_turn": count,
            "real_time_factor": turn / spent,
            "us_per_position": 1e6 * spent / count,
            "evaluations_per_position": float(np.mean(evaluations)),
            "force_error_between_positions": largest_difference(between, reference),
            "force_error_of_20_degree_means": largest_difference(means, wanted),
        })
        if count == POSITIONS_PER_TURN:
            limits_found = equilibrium_limits(records, spent, sum(evaluations))
    return {"positions": rows, "limits": limits_found}


def window_means(force: Floats, windows: int) -> Floats:
    """Trapezoidal means over equal parts of the turn."""
    parts = (0.5 * (force[1:] + force[:-1])).reshape(windows, -1, force.shape[1])
    means: Floats = parts.mean(axis=1)
    return means


def piece_time(loop: Callable[[np.ndarray, int], None], records: np.ndarray) -> float:
    """Time of one pass through a compiled loop's body [s]."""
    return smallest_time(lambda: loop(records, LOOPS)) / LOOPS


def limits(pieces: list[float], assemblies: int, spent: float) -> dict[str, float]:
    """Shares of the time; what no piece explains is the rest."""
    mesh, bearings, assembly, factor = (assemblies * piece for piece in pieces)
    shares = {
        "pins": mesh, "bearings": bearings, "joints and clearing": max(0.0, assembly - mesh - bearings),
        "factorisation": factor, "rest": max(0.0, spent - assembly - factor),
    }
    return {"assembly_us": 1e6 * pieces[2], **{f"share: {name}": time / spent for name, time in shares.items()}}


def motion_limits(records: np.ndarray, spent: float, counts: dict[str, int]) -> dict[str, float]:
    loops = (mesh_in_motion_loop, bearings_in_motion_loop, motion_loop, factor_loop)
    return limits([piece_time(loop, records) for loop in loops], counts["assemblies"], spent)


def equilibrium_limits(records: np.ndarray, spent: float, evaluations: int) -> dict[str, float]:
    loops = (mesh_loop, bearings_loop, equilibrium_loop, direction_loop)
    return limits([piece_time(loop, records) for loop in loops], evaluations, spent)


RATE = 1e5  # velocity per position of a step of 20 us [1/s]


@kernel
def mesh_in_motion_loop(records: np.ndarray, count: int) -> None:
    r = records[0]
    for _ in range(count):
        for d in range(r.mesh_force.shape[0]):
            mesh_contacts(r, d, r.q[3 * r.mesh_force.shape[0]], 0.0, RATE, False)


@kernel
def bearings_in_motion_loop(records: np.ndarray, count: int) -> None:
    r = records[0]
    for _ in range(count):
        for d in range(r.roller_force.shape[0]):
            for c in range(r.roller_force.shape[1]):
                bearing_in_motion(r, d, c, 0.0, RATE)


@kernel
def motion_loop(records: np.ndarray, count: int) -> None:
    for _ in range(count):
        assemble_motion(records[0], RATE)


@kernel
def factor_loop(records: np.ndarray, count: int) -> None:
    r = records[0]
    n = r.q.shape[0] - 1
    for _ in range(count):
        for a in range(n):
            r.direction[a] = 1.0
            for b in range(a, n):
                r.factor[a, b] = r.tangent[a, b]
            r.factor[a, a] += r.mass[a] * RATE * RATE
            r.factor_scale[a] = r.factor[a, a]
        cholesky_solve(r.factor, r.direction, r.factor_scale, n, 0.0)


@kernel
def mesh_loop(records: np.ndarray, count: int) -> None:
    r = records[0]
    lobes = r.lobe_pitch_error.shape[1]
    for _ in range(count):
        for d in range(r.mesh_force.shape[0]):
            mesh_contacts(r, d, r.ideal_output, -lobes * r.ideal_output + disc_offset(r, d), 0.0, True)


@kernel
def bearings_loop(records: np.ndarray, count: int) -> None:
    r = records[0]
    for _ in range(count):
        for d in range(r.roller_force.shape[0]):
            for c in range(r.roller_force.shape[1]):
                bearing_contacts(r, d, c, r.ideal_output, r.cage, 1.0, False)


@kernel
def equilibrium_loop(records: np.ndarray, count: int) -> None:
    r = records[0]
    for _ in range(count):
        assemble(r, r.ideal_output, r.cage, r.load_torque)


@kernel
def direction_loop(records: np.ndarray, count: int) -> None:
    for _ in range(count):
        newton_direction(records[0])


def show(name: str, figures: dict[str, Any]) -> None:
    print(f"\n{name}")
    motion, still = figures["in_motion"], figures["through_equilibria"]
    print("  in motion")
    for key, value in motion.items():
        if key != "limits":
            print(f"    {key:28} {value:.4g}")
    print("  through equilibria")
    rows = still["positions"]
    for key in rows[0]:
        print(f"    {key:32}" + "".join(f"{row[key]:>10.4g}" for row in rows))
    print(f"  {'what the time goes into':32}{'motion':>10}{'equilibria':>12}")
    for key in motion["limits"]:
        print(f"    {key:30}{motion['limits'][key]:10.3g}{still['limits'][key]:12.3g}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reducer", nargs="+", default=REDUCERS)
    parser.add_argument("--json", type=Path, help="also write the figures to this file")
    arguments = parser.parse_args()
    result = {}
    for name in arguments.reducer:
        table = load_reducer(name).plant
        result[name] = {"in_motion": in_motion(table), "through_equilibria": through_equilibria(table)}
        show(name, result[name])
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
