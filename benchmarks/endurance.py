"""``python -m benchmarks.endurance [STEPS]``: plant and wear through ten million communication steps of a master: memory, time, accuracy.

The reducer does not wear on (``acceleration`` 0), so that the end can be held against a plant that was started at the same angles by
formula: what differs is what rounding has gathered.  Exit code 1 if memory grows, time drifts, forces differ, or steps become dearer.
"""

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks import memory
from orchestrator.component import InProcess
from reducers.reducer import Reducer, load_reducer
from rv_plant.needle_bearing import cage_rate
from studies.pair import crank_turn_time, make_pair

PER_TURN, RATIO = 72, 121.0
WATCHED = ("lag", "drive_torque", "largest_pin_force", "largest_roller_force")
# Growth of memory [byte] and of the cost of a step; drift of time in roundings of it; difference over the value.
MOST_MEMORY, MOST_COST, MOST_DRIFT, MOST_DIFFERENCE = 1 << 20, 1.5, 1.0, 1e-6


@dataclass(frozen=True)
class Endured:
    """After ``steps``: memory grown [byte], time off [roundings of its value], output angle off [rad], figures against those of a plant started there, cost by tenths [s]."""

    steps: int
    grown: float
    drift: float
    angle_off: float
    difference: float
    costs: tuple[float, ...]

    @property
    def problems(self) -> list[str]:
        found = []
        if self.grown > MOST_MEMORY:
            found.append(f"memory grew by {self.grown:.0f} byte")
        if self.drift > MOST_DRIFT:
            found.append(f"time is off by {self.drift:.1f} roundings")
        if self.difference > MOST_DIFFERENCE:
            found.append(f"figures differ from those of a plant started there by {self.difference:.2g}")
        if len(self.costs) > 2 and np.median(self.costs[-3:]) > MOST_COST * np.median(self.costs[:3]):
            found.append(f"steps became dearer: {self.costs[0]:.3g} s to {self.costs[-1]:.3g} s")
        return found


def endure(steps: int, fmus: Path | None = None) -> Endured:
    """Whole meshing cycles of the RV20E-121, as many as ``steps`` hold; in process, or as the FMUs of a folder."""
    reducer = load_reducer("RV20E-121")
    pair = make_pair(reducer, fmus=fmus)
    pair.wear.set("acceleration", 0.0)
    master, tenth = pair.master, max(1, steps // 10)
    master.step_size = crank_turn_time(reducer, pair.plant) / PER_TURN
    master.initialise()
    master.run(tenth)
    before, costs = memory.present(), []
    for _ in range(9):
        started = time.process_time()
        master.run(tenth)
        costs.append((time.process_time() - started) / tenth)
    steps, grown = 10 * tenth, memory.present() - before
    exact = steps * master.step_size
    speed = pair.plant.number("input_speed") / RATIO
    fresh = started_at(reducer, speed * exact, cage_speed(reducer, speed) * exact)
    difference = max(abs(pair.plant.number(name) / fresh.number(name) - 1.0) for name in WATCHED)
    ideal = pair.plant.number("output_angle") - pair.plant.number("transmission_error")
    found = Endured(steps, grown, abs(master.time - exact) / np.spacing(exact), abs(ideal - speed * exact), difference, tuple(costs))
    master.close()
    return found


def cage_speed(reducer: Reducer, output_speed: float) -> float:
    """Of the cages against the discs [rad/s], ideal rolling."""
    inner, outer = (float(reducer.plant.by_name[f"{race}_race_radius"].start) for race in ("inner", "outer"))
    return float(cage_rate(-reducer.topology.lobes * output_speed, output_speed, inner, outer))


def started_at(reducer: Reducer, output: float, cage: float) -> InProcess:
    """A plant in equilibrium at an ideal output angle and a cage angle [rad]."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    plant.records["ideal_output"], plant.records["cage"] = np.remainder(output, 2.0 * np.pi), np.remainder(cage, 2.0 * np.pi)
    plant.enter_initialisation(0.0)
    plant.exit_initialisation()
    return plant


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.endurance", description=__doc__.splitlines()[0])
    parser.add_argument("steps", nargs="?", type=int, default=10_000_000)
    parser.add_argument("--fmus", type=Path, metavar="FOLDER", help="the FMUs of this folder instead of the kernels")
    options = parser.parse_args()
    found = endure(options.steps, options.fmus)
    print(f"{found.steps} steps: memory {found.grown / 1024:+.0f} KiB, time off by {found.drift:.2g} roundings, output angle by {found.angle_off:.2g} rad,"
          f" figures by {found.difference:.2g} of those of a plant started there, {1e6 * found.costs[0]:.1f} us a step at first, {1e6 * found.costs[-1]:.1f} at last")  # fmt: skip
    for problem in found.problems:
        print(problem)
    return 1 if found.problems else 0


if __name__ == "__main__":
    sys.exit(main())
