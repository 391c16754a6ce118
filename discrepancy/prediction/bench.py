"""The reducer on a bench: runs of the compiled pair at stated conditions.

Runs are kept, so that parameters that a run does not depend on cost nothing.
"""

import copy
import math
from collections.abc import Callable, Hashable, Mapping

import numpy as np

from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.lives import ROUGH_CYCLE, SHORT_CYCLE, Lives
from discrepancy.prediction.units import Condition
from discrepancy.problem import ERROR, NEAR, ORDERS, Record
from fmu_src.arrays import Floats
from reducers.reducer import Reducer
from studies import coupled
from studies.hysteresis import MEMORY
from wear_fmu import accumulator
from wear_fmu.variables import Resolution

# Surfaces are resolved as finely as inspections need, not as finely as a life run.
RESOLUTION = Resolution(flank=90, pin=90, raceway=180)
# Means over a turn: torque and cage speed are within 1e-4 of those of 72 positions; what values change in them, roughly, is seen
# within 1 % from seven.
MEAN_POSITIONS, FEW_MEAN_POSITIONS = 18, 7
# Held test: turning is averaged over positions of the cranks; what values change in it, roughly, over fewer (five see as much as
# eight, whose symmetry is that of the pins, three err by a tenth).
HELD_ANGLES, FEW_HELD_ANGLES = 8, 5
# Turning of the cranks [rad] between two equilibria that is not divided.
LARGEST_CRANK_STEP = 1e3
# A step on the spot takes the wear unit's contacts to angles that were set; one of no length only reads where they are, and FMUs refuse it [s].
MOMENT = 1e-12


class Bench(Lives):
    """Runs of one reducer with settings; every method takes the values of further parameters."""

    def __init__(self, reducer: Reducer, settings: Mapping[str, float], resolution: Resolution = RESOLUTION):
        super().__init__(reducer, settings, resolution)
        self.held_angles, self.mean_positions = HELD_ANGLES, MEAN_POSITIONS
        # How finely runs are computed for a campaign's samples; None: at every sample.
        self.fineness: Fineness | None = None

    def roughly(self) -> "Bench":
        """The same bench with the same runs, as coarse as a search allows."""
        other = copy.copy(self)
        other.fineness = self.fineness.roughly() if self.fineness else None
        other.held_angles, other.mean_positions, other.cycle_turns = FEW_HELD_ANGLES, FEW_MEAN_POSITIONS, ROUGH_CYCLE
        return other

    def allowed(self, record: Record) -> float:
        """What a prediction of this record may err; 0 where nothing is known of its noise."""
        return self.fineness.allowed.get((ERROR if record.quantity == ORDERS else record.quantity, record.condition), 0.0) if self.fineness else 0.0

    def beside(self, key: tuple[Hashable, ...], base: Callable[[], tuple[Floats, Floats]]) -> Floats:
        """Equilibria where the run of ``key`` (kind, condition, relevant values, ...) starts: those of one whose values are said to be near, if
        it was made, or of the ``base`` model's."""
        kind, condition, relevant, *rest = key
        assert isinstance(condition, Condition)
        near = self.relevant(NEAR.get() or {}, condition.hours > 0.0)
        found = self.runs.peek((kind, condition, near, *rest)) if near and near != relevant else None
        return found[1] if isinstance(found, tuple) else base()[1]

    def remembers(self, values: Mapping[str, float]) -> bool:
        """Whether a held output's place depends on the way to it: friction's springs, a seat that slips."""
        return any(values.get(name, self.starts[0][name]) != 0.0 for name in MEMORY)

    def running(self, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0) -> Floats:
        """What a running bench shows at output angles [rad]; columns as coupled.COLUMNS.

        ``cage`` is how far the roller cages stand ahead at the first angle [rad].
        """
        return self.running_places(condition, values, angles, cage)[0]

    def running_places(self, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0) -> tuple[Floats, Floats]:
        """(series, equilibria): the equilibria of the base model are where others start."""
        relevant = self.relevant(values, condition.hours > 0.0)
        key = ("running", condition, relevant, angles.tobytes(), cage)

        def run() -> tuple[Floats, Floats]:
            # Beside a similar run each angle has a start of its own, however far the cranks turn between them.
            step = 1.0 if condition.hours > 0.0 or not relevant else LARGEST_CRANK_STEP
            plants = self.new_plant(condition, values, float(angles[0]), cage=cage, largest_crank_step=step)
            # The wear unit of a new reducer has nothing to do.
            wears = self.templates[1]
            if condition.hours > 0.0:
                wears = self.worn(condition, values, condition.hours).copy()
                for name in ("crank_angle", "output_angle", "cage_angle"):
                    wears[name] = wears[f"{name}_before"] = plants[name]
                wears["acceleration"] = 0.0
            out_speed = condition.speed / abs(self.ratio)
            durations = np.maximum(np.abs(np.diff(angles, prepend=angles[0])) / out_speed, MOMENT)
            series = np.zeros((len(angles), len(coupled.COLUMNS)))
            places = np.zeros((len(angles), plants["z"].shape[1]))
            similar = self.beside(key, lambda: self.running_places(condition, {}, angles)) if relevant else places
            if condition.hours > 0.0:
                # The profile errors of the first angle, before it counts.
                self.put_wear(wears, plants)
            status = coupled.sweep(plants, wears, durations, series, condition.hours > 0.0, places, similar, bool(relevant))
            self.check(status, plants, wears)
            return series, places

        return self.kept(key, run)

    def error_beside(self, condition: Condition, values: Mapping[str, float], angles: Floats,
                     base: Mapping[str, float], base_angles: Floats) -> Floats:
        """Transmission error [rad] of a new reducer with ``values``, to first order beside the run with ``base``."""
        key = ("beside", condition, self.relevant(values, False), self.relevant(base, False), angles.tobytes(), base_angles.tobytes())

        def run() -> Floats:
            similar = self.running_places(condition, base, base_angles)[1]
            plants = self.new_plant(condition, values, float(angles[0]))
            durations = np.abs(np.diff(angles, prepend=angles[0])) / (condition.speed / abs(self.ratio))
            errors = np.zeros(len(angles))
            self.check((coupled.sweep_beside(plants, durations, errors, similar), 0), plants, self.templates[1])
            return errors

        return self.kept(key, run)

    def averages(self, condition: Condition, values: Mapping[str, float]) -> dict[str, float]:
        """Means over one turn of the cranks."""
        means = self.means(condition, values, self.mean_positions)
        if self.mean_positions < MEAN_POSITIONS:
            # What the values change, seen from fewer positions.
            means = means - self.means(condition, {}, self.mean_positions) + self.means(condition, {}, MEAN_POSITIONS)
        return dict(zip(coupled.COLUMNS, means))

    def means(self, condition: Condition, values: Mapping[str, float], positions: int) -> Floats:
        """Mean of each column over ``positions`` of a turn of the cranks."""
        return self.kept(("means", condition, self.relevant(values, condition.hours > 0.0), positions), lambda: self.mean_run(condition, values, positions))

    def mean_run(self, condition: Condition, values: Mapping[str, float], positions: int) -> Floats:
        turn = 2.0 * math.pi / self.reducer.topology.lobes
        angles = condition.direction * np.linspace(0.0, turn, positions, endpoint=False)
        if values.get("thermal_resistance", self.starts[0]["thermal_resistance"]) > 0.0:
            # A second pass: what depends on the losses of the first has settled.
            angles = np.concatenate([angles, angles + condition.direction * turn])
        found: Floats = self.running(condition, values, angles)[-positions:].mean(axis=0)
        return found

    def held(self, condition: Condition, values: Mapping[str, float], torques: Floats) -> Floats:
        """Turning [rad] of the output under torques [N m] applied in order, input held; mean over crank positions."""
        whole = self.held_places(condition, {}, torques, HELD_ANGLES, SHORT_CYCLE)[0]
        if not self.relevant(values, condition.hours > 0.0):
            return whole
        turning = self.held_places(condition, values, torques, self.held_angles, self.cycle_turns)[0]
        if self.held_angles == HELD_ANGLES:
            return turning
        # What the values change, seen from fewer positions and by rougher lives.
        return whole + turning - self.held_places(condition, {}, torques, self.held_angles, self.cycle_turns)[0]

    def held_places(self, condition: Condition, values: Mapping[str, float], torques: Floats, positions: int, turns: int) -> tuple[Floats, Floats]:
        """(turning, equilibria by crank position): those of the base model are where others start."""
        worn = condition.hours > 0.0
        relevant = self.relevant(values, worn)
        key = ("held", condition, relevant, torques.tobytes(), positions, turns if worn else 0)

        def run() -> tuple[Floats, Floats]:
            total = np.zeros(len(torques))
            places = np.zeros((positions, len(torques), self.templates[0]["z"].shape[1]))
            similar = self.beside(key, lambda: self.held_places(condition, {}, torques, positions, turns)) if relevant else places
            # What sticks remembers where it was: friction's springs must not see a start elsewhere.
            guessed = bool(relevant) and not self.remembers(values)
            surfaces = self.worn(condition, values, condition.hours, turns) if worn else None
            plants = None
            for k in range(positions):
                angle = 2.0 * math.pi * k / (positions * self.reducer.topology.lobes)
                start = {"z": similar[k][0], "advance_before": 0.0} if guessed else {}
                if plants is None or not guessed:
                    plants = self.new_plant(condition, values, angle, input_speed=0.0, load_torque=float(torques[0]), **start)
                else:
                    self.place(plants, angle, **start)
                if surfaces is not None:
                    self.put_wear(surfaces, plants)
                turning = np.zeros(len(torques))
                status = coupled.torque_sweep(plants, torques, turning, places[k], similar[k], guessed)
                self.check((status, 0), plants, self.templates[1])
                total += turning / positions
            return total, places

        return self.kept(key, run)

    def held_beside(self, condition: Condition, values: Mapping[str, float], torques: Floats, base: Mapping[str, float]) -> Floats:
        """``held`` of a new reducer with ``values`` to first order beside the run with ``base``; neither may remember its way."""
        positions = self.held_angles
        key = ("held beside", condition, self.relevant(values, False), self.relevant(base, False), torques.tobytes(), positions)

        def run() -> Floats:
            similar = self.held_places(condition, base, torques, positions, SHORT_CYCLE)[1]
            total, turning = np.zeros(len(torques)), np.zeros(len(torques))
            for k in range(positions):
                angle = 2.0 * math.pi * k / (positions * self.reducer.topology.lobes)
                plants = self.new_plant(condition, values, angle, input_speed=0.0, load_torque=float(torques[0]), z=similar[k][0])
                self.check((coupled.torque_sweep_beside(plants, torques, turning, similar[k]), 0), plants, self.templates[1])
                total += turning / positions
            return total

        return self.kept(key, run)

    def put_wear(self, wears: np.ndarray, plants: np.ndarray) -> None:
        """Profile errors of worn surfaces at the present angles, to which their unit is turned without wear."""
        wears = wears.copy()
        for name in ("crank_angle", "output_angle", "cage_angle"):
            wears[name] = wears[f"{name}_before"] = plants[name]
        wears["acceleration"] = wears["crank_speed"] = 0.0
        self.check((0, accumulator.step(wears, 0.0, MOMENT)), plants, wears)
        for name in ("mesh_profile_error", "roller_profile_error"):
            plants[name] = wears[name]
