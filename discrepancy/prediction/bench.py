"""The reducer on a bench: runs of the compiled pair at stated conditions.

Runs are kept, so that parameters that a run does not depend on cost nothing.
"""

import copy
import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.stretches import NOTHING, stretches
from discrepancy.problem import NEAR, Record
from fmu_src.arrays import Floats
from fmu_src.faults import RunFault
from fmu_src.threads import Once
from fmu_src.variables import Table
from reducers.reducer import Reducer
from rv_plant import plant
from rv_plant.faults import FAULTS
from rv_plant.gear_stage import total_ratio
from rv_plant.needle_bearing import cage_rate
from studies import coupled
from wear_fmu import accumulator
from wear_fmu.variables import Resolution

# Surfaces are resolved as finely as inspections need, not as finely as a life run.
RESOLUTION = Resolution(flank=90, pin=90, raceway=180)
# A turn of the cranks in full cycles: depths within 0.2 % (36: 0.5 %).
POSITIONS = 72
# Means over a turn: torque and cage speed are within 1e-4 of those of 72 positions; what values change in them, roughly, is seen
# within 1 % from seven.
MEAN_POSITIONS, FEW_MEAN_POSITIONS = 18, 7
# Turns of the cranks in a wear cycle.  The base model's wear is run through full meshing cycles, once;
# how it changes in proportion through shorter ones of fewer positions, which err by 1 to 6 % of the change by a law of wear.
SHORT_CYCLE, SHORT_POSITIONS = 5, 18
# Out-of-balance force over load: errors of 1e-5 arcsec.
TOLERANCE = 1e-7
# Held test: turning is averaged over positions of the cranks; what values change in it, roughly, over fewer (five see as much as
# eight, whose symmetry is that of the pins, three err by a tenth).
HELD_ANGLES, FEW_HELD_ANGLES = 8, 5
KEPT_RUNS = 4000
# The values that a run depends on, by name.
Relevant = tuple[tuple[str, float], ...]
Run = TypeVar("Run")


@dataclass(frozen=True)
class Condition:
    """What the bench is set to; SI units.  ``direction`` +1 or -1 of rotation and of the torque that opposes it."""

    speed: float
    load: float
    temperature: float = 293.15
    hours: float = 0.0
    direction: int = 1


class Bench:
    """Runs of one reducer with settings; every method takes the values of further parameters."""

    def __init__(self, reducer: Reducer, settings: Mapping[str, float], resolution: Resolution = RESOLUTION):
        self.reducer = replace(reducer, resolution=resolution)
        self.tables: tuple[Table, Table] = (self.reducer.plant, self.reducer.wear)
        self.templates = []
        for table in self.tables:
            records = table.new_records()
            for name, value in settings.items():
                if name in table.by_name:
                    records[name] = value
            if "tolerance" in table.by_name:
                records["tolerance"] = TOLERANCE
            self.templates.append(records)
        self.runs = Once(KEPT_RUNS)
        self.held_angles, self.mean_positions = HELD_ANGLES, MEAN_POSITIONS
        # How finely runs are computed for a campaign's samples; None: at every sample.
        self.fineness: Fineness | None = None
        topology = reducer.topology
        self.ratio = float(total_ratio(float(self.templates[0]["first_stage_ratio"][0]), topology.pins, topology.lobes))
        self.rated_speed = float(self.templates[0]["input_speed"][0])
        self.rated_load = float(self.templates[0]["load_torque"][0])

    def roughly(self) -> "Bench":
        """The same bench with the same runs, as coarse as a search allows."""
        other = copy.copy(self)
        other.fineness = self.fineness.roughly() if self.fineness else None
        other.held_angles, other.mean_positions = FEW_HELD_ANGLES, FEW_MEAN_POSITIONS
        return other

    def allowed(self, record: Record) -> float:
        """What a prediction of this record may err; 0 where nothing is known of its noise."""
        return self.fineness.allowed.get((record.quantity, record.condition), 0.0) if self.fineness else 0.0

    def kept(self, key: Hashable, make: Callable[[], Run]) -> Run:
        """The run under ``key``, made if there is none yet."""
        return self.runs.get(key, make)

    def equilibria(self, kind: str, condition: Condition, relevant: Relevant, *rest: Hashable) -> Floats | None:
        """Those of a run whose values are said to be near, if it was made under the same key: where another may start."""
        beside = self.relevant(NEAR.get() or {}, condition.hours > 0.0)
        found = self.runs.peek((kind, condition, beside, *rest)) if beside and beside != relevant else None
        return found[1] if isinstance(found, tuple) else None

    def relevant(self, values: Mapping[str, float], worn: bool) -> Relevant:
        """The values that a run depends on, without those that stand at their start."""
        tables = self.tables if worn else self.tables[:1]
        templates = self.templates if worn else self.templates[:1]
        return tuple(sorted(
            (name, value) for name, value in values.items()
            if any(name in table.by_name and float(t[name].flat[0]) != value for table, t in zip(tables, templates))
        ))  # fmt: skip

    def away(self, values: Mapping[str, float]) -> dict[str, float]:
        """By name how far the plant's values are off the base model's."""
        start = self.templates[0]
        return {name: value - float(start[name].flat[0]) for name, value in self.relevant(values, False)}

    def remembers(self, values: Mapping[str, float]) -> bool:
        """Whether a held output's place depends on the way to it: friction's springs."""
        friction = (values.get(name, float(self.templates[0][name][0])) for name in ("friction_coefficient", "friction_excess"))
        return sum(friction) != 0.0

    def pair(self, condition: Condition, values: Mapping[str, float], first_angle: float = 0.0, cage: float = 0.0,
             **plant_values: float) -> tuple[np.ndarray, np.ndarray]:
        """Records of both units, initialised at a condition and an output angle [rad].

        ``cage`` is how far the roller cages stand ahead of where rolling from 0 brings them [rad].
        """
        plants = self.new_plant(condition, values, first_angle, cage, **plant_values)
        wears = self.set_up(1, values, condition)
        for name in ("crank_angle", "crank_speed", "output_angle", "cage_angle"):
            wears[name] = plants[name]
        fault = accumulator.initialise(wears)
        if fault:
            raise RunFault(accumulator.FAULTS[fault].format(**self.tables[1].scalars(wears)))
        return plants, wears

    def set_up(self, unit: int, values: Mapping[str, float], condition: Condition) -> np.ndarray:
        """Records of a unit (0 plant, 1 wear) with values and the condition's temperature."""
        records = self.templates[unit].copy()
        for name, value in values.items():
            if name in self.tables[unit].by_name:
                records[name] = value
        records["temperature"] = condition.temperature
        return records

    def new_plant(self, condition: Condition, values: Mapping[str, float], first_angle: float = 0.0, cage: float = 0.0,
                  **plant_values: float) -> np.ndarray:
        """The plant's records, see ``pair``: all that runs of a new unit need."""
        plants = self.set_up(0, values, condition)
        plants["input_speed"] = self.input_speed(condition)
        plants["load_torque"] = condition.direction * condition.load
        plants["ideal_output"] = first_angle
        # Where the cages have rolled with the output from 0, by the shorter way.
        rate = cage_rate(-self.reducer.topology.lobes, 1.0, plants["inner_race_radius"][0], plants["outer_race_radius"][0])
        plants["cage"] = rate * math.remainder(first_angle, 2.0 * math.pi) + cage
        if "grease_age" in self.tables[0].by_name:
            plants["grease_age"] = condition.hours
        for name, value in plant_values.items():
            plants[name] = value
        fault = plant.initialise(plants)
        if fault:
            raise RunFault(FAULTS[fault].format(**self.tables[0].scalars(plants)))
        return plants

    def input_speed(self, condition: Condition) -> float:
        """Speed of the sun [rad/s] with its sign."""
        return condition.direction * condition.speed * (1.0 if self.ratio > 0.0 else -1.0)

    def check(self, status: tuple[int, int], plants: np.ndarray, wears: np.ndarray) -> None:
        for code, faults, table, records in zip(status, (FAULTS, accumulator.FAULTS), self.tables, (plants, wears)):
            if code:
                raise RunFault(faults[code].format(**table.scalars(records)))

    def turning_time(self, condition: Condition) -> float:
        """Time of one turn of the cranks in the housing [s]."""
        return 2.0 * math.pi * abs(self.ratio) / (condition.speed * self.reducer.topology.lobes)

    def wear_steps(self, condition: Condition, turns: int) -> tuple[float, int]:
        """Communication step [s] and their number in a wear cycle of ``turns``."""
        positions = SHORT_POSITIONS if turns == SHORT_CYCLE else POSITIONS
        return self.turning_time(condition) / positions, turns * positions

    def worn(self, condition: Condition, values: Mapping[str, float], hours: float) -> np.ndarray:
        """The wear unit's record after ``hours`` [s] at a condition."""
        return self.wear_to(condition, values, [hours], SHORT_CYCLE)[hours]

    def wear_to(
        self, condition: Condition, values: Mapping[str, float], inspections: list[float], turns: int
    ) -> dict[float, np.ndarray]:
        """Wear records at several operating times [s], by cycles of ``turns`` that stand for growing stretches."""
        fresh = Condition(condition.speed, condition.load, condition.temperature, 0.0, condition.direction)
        key = ("life", fresh, tuple(inspections), turns, self.relevant(values, True))

        def run() -> dict[float, np.ndarray]:
            plants, wears = self.pair(fresh, values, largest_crank_step=1.0)
            step, steps = self.wear_steps(condition, turns)
            wears["acceleration"] = 0.0
            self.check(coupled.run_pair(plants, wears, 2, step), plants, wears)
            found = {target: wears.copy() for target in inspections if target <= NOTHING}
            for done, stretch, target in stretches(inspections):
                wears["acceleration"] = stretch / (steps * step)
                if "grease_age" in self.tables[0].by_name:
                    plants["grease_age"] = done + 0.5 * stretch
                self.check(coupled.run_pair(plants, wears, steps, step), plants, wears)
                found[target] = wears.copy()
            return found

        return self.kept(key, run)

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
            plants = self.new_plant(condition, values, float(angles[0]), cage=cage, largest_crank_step=1.0)
            # The wear unit of a new reducer has nothing to do.
            wears = self.templates[1]
            if condition.hours > 0.0:
                wears = self.worn(condition, values, condition.hours).copy()
                for name in ("crank_angle", "output_angle", "cage_angle"):
                    wears[name] = wears[f"{name}_before"] = plants[name]
                wears["acceleration"] = 0.0
            out_speed = condition.speed / abs(self.ratio)
            durations = np.abs(np.diff(angles, prepend=angles[0])) / out_speed
            series = np.zeros((len(angles), len(coupled.COLUMNS)))
            places = np.zeros((len(angles), plants["z"].shape[1]))
            similar = places
            if relevant:
                beside = self.equilibria("running", condition, relevant, angles.tobytes(), cage)
                similar = self.running_places(condition, {}, angles)[1] if beside is None else beside
            if condition.hours > 0.0:
                # The profile errors of the first angle, before it counts.
                self.put_wear(condition, values, plants)
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
        turn = 2.0 * math.pi / self.reducer.topology.lobes
        angles = condition.direction * np.linspace(0.0, turn, positions, endpoint=False)
        if values.get("thermal_resistance", float(self.templates[0]["thermal_resistance"][0])) > 0.0:
            # A second pass: what depends on the losses of the first has settled.
            angles = np.concatenate([angles, angles + condition.direction * turn])
        found: Floats = self.running(condition, values, angles)[-positions:].mean(axis=0)
        return found

    def held(self, condition: Condition, values: Mapping[str, float], torques: Floats) -> Floats:
        """Turning [rad] of the output under torques [N m] applied in order, input held; mean over crank positions."""
        whole = self.held_places(condition, {}, torques, HELD_ANGLES)[0]
        if not self.relevant(values, condition.hours > 0.0):
            return whole
        turning = self.held_places(condition, values, torques, self.held_angles)[0]
        if self.held_angles == HELD_ANGLES:
            return turning
        # What the values change, seen from fewer positions.
        return whole + turning - self.held_places(condition, {}, torques, self.held_angles)[0]

    def held_places(self, condition: Condition, values: Mapping[str, float], torques: Floats, positions: int) -> tuple[Floats, Floats]:
        """(turning, equilibria by crank position): those of the base model are where others start."""
        relevant = self.relevant(values, condition.hours > 0.0)
        key = ("held", condition, relevant, torques.tobytes(), positions)

        def run() -> tuple[Floats, Floats]:
            total = np.zeros(len(torques))
            places = np.zeros((positions, len(torques), self.templates[0]["z"].shape[1]))
            similar = places
            if relevant:
                beside = self.equilibria("held", condition, relevant, torques.tobytes(), positions)
                similar = self.held_places(condition, {}, torques, positions)[1] if beside is None else beside
            for k in range(positions):
                angle = 2.0 * math.pi * k / (positions * self.reducer.topology.lobes)
                plants = self.new_plant(condition, values, angle, input_speed=0.0, load_torque=float(torques[0]))
                if condition.hours > 0.0:
                    self.put_wear(condition, values, plants)
                turning = np.zeros(len(torques))
                # What sticks remembers where it was: friction's springs must not see a start elsewhere.
                guessed = bool(relevant) and not self.remembers(values)
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
            similar = self.held_places(condition, base, torques, positions)[1]
            total, turning = np.zeros(len(torques)), np.zeros(len(torques))
            for k in range(positions):
                angle = 2.0 * math.pi * k / (positions * self.reducer.topology.lobes)
                plants = self.new_plant(condition, values, angle, input_speed=0.0, load_torque=float(torques[0]))
                self.check((coupled.torque_sweep_beside(plants, torques, turning, similar[k]), 0), plants, self.templates[1])
                total += turning / positions
            return total

        return self.kept(key, run)

    def put_wear(self, condition: Condition, values: Mapping[str, float], plants: np.ndarray) -> None:
        """Profile errors of the worn surfaces at the present angles."""
        wears = self.worn(condition, values, condition.hours).copy()
        for name in ("crank_angle", "output_angle", "cage_angle"):
            wears[name] = wears[f"{name}_before"] = plants[name]
        wears["acceleration"] = wears["crank_speed"] = 0.0
        self.check((0, accumulator.step(wears, 0.0, 0.0)), plants, wears)
        for name in ("mesh_profile_error", "roller_profile_error"):
            plants[name] = wears[name]
