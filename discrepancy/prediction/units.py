"""Records of a reducer's two units, set up for the bench at stated conditions."""

import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from fmu_src.arrays import Floats, copied
from fmu_src.faults import RunFault
from fmu_src.kernel import plain
from fmu_src.table import Table
from fmu_src.threads import Once
from reducers.reducer import Reducer
from rv_plant import plant
from rv_plant.faults import FAULTS
from rv_plant.gear_stage import total_ratio
from rv_plant.needle_bearing import cage_rate
from rv_plant.parts import cannot_be_made
from wear_fmu import accumulator
from wear_fmu.variables import Resolution

# Out-of-balance force over load: errors of 1e-5 arcsec.
TOLERANCE = 1e-7
KEPT_RUNS = 4000
# The values that a run depends on, by name.
Relevant = tuple[tuple[str, float], ...]
Run = TypeVar("Run")


@dataclass(frozen=True)
class Condition:
    """What the bench is set to; SI units.  ``direction`` +1 or -1 of rotation and of the torque that opposes it.

    ``locked_at``: where a held test is done, as the angle [rad] of an output that follows its input evenly; None: the mean over a turn of the cranks.
    ``cage``: how far the roller cages stand ahead there [rad] of where rolling from 0 brings them.
    """

    speed: float
    load: float
    temperature: float = 293.15
    hours: float = 0.0
    direction: int = 1
    locked_at: float | None = None
    cage: float = 0.0


class Units:
    """Both units of one reducer with settings; every method takes the values of further parameters.

    Runs are kept, so that parameters that a run does not depend on cost nothing.
    """

    def __init__(self, reducer: Reducer, settings: Mapping[str, float], resolution: Resolution):
        self.reducer = replace(reducer, resolution=resolution)
        self.tables: tuple[Table, Table] = (self.reducer.plant, self.reducer.wear)
        self.templates = []
        for table in self.tables:
            records = table.new_records()
            for name, value in whole_first(settings).items():
                base, bracket, _ = name.partition("[")
                if base in table.by_name and bracket:
                    table.cells(records)[table.cell_index(name)] = value
                elif base in table.by_name:
                    records[name] = value
            if "tolerance" in table.by_name:
                records["tolerance"] = TOLERANCE
            self.templates.append(records)
        # By name what a parameter's first element is without further values.
        self.starts = [{name: float(records[name].flat[0]) for name in table.by_name} for table, records in zip(self.tables, self.templates)]
        self.runs = Once(KEPT_RUNS)
        topology = reducer.topology
        self.ratio = float(total_ratio(self.starts[0]["first_stage_ratio"], topology.pins, topology.lobes))
        self.rated_speed = self.starts[0]["input_speed"]
        self.rated_load = self.starts[0]["load_torque"]

    def kept(self, key: Hashable, make: Callable[[], Run]) -> Run:
        """The run under ``key``, made if there is none yet."""
        return self.runs.get(key, make)

    def relevant(self, values: Mapping[str, float], worn: bool) -> Relevant:
        """The values that a run depends on, without those that stand at their start."""
        plant, wear = self.starts
        if not worn:
            return tuple(sorted([(name, value) for name, value in values.items() if plant.get(name, value) != value]))
        return tuple(sorted([(name, value) for name, value in values.items() if plant.get(name, value) != value or wear.get(name, value) != value]))

    def away(self, values: Mapping[str, float]) -> dict[str, float]:
        """By name how far the plant's values are off the base model's."""
        return {name: value - self.starts[0][name] for name, value in self.relevant(values, False)}

    def pair(self, condition: Condition, values: Mapping[str, float], first_angle: float = 0.0, cage: float = 0.0,
             **plant_values: float | Floats) -> tuple[np.ndarray, np.ndarray]:
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
        records = copied(self.templates[unit])
        for name, value in values.items():
            if name in self.tables[unit].by_name:
                records[name] = value
        records["temperature"] = condition.temperature
        return records

    def new_plant(self, condition: Condition, values: Mapping[str, float], first_angle: float = 0.0, cage: float = 0.0,
                  **plant_values: float | Floats) -> np.ndarray:
        """The plant's records, see ``pair``: all that runs of a new unit need."""
        plants = self.set_up(0, values, condition)
        plants["input_speed"] = self.input_speed(condition)
        plants["load_torque"] = condition.direction * condition.load
        if "grease_age" in self.tables[0].by_name:
            plants["grease_age"] = condition.hours
        self.place(plants, first_angle, cage, **plant_values)
        fault = plant.initialise(plants)
        if fault:
            told = cannot_be_made(fault, plants, self.tables[0], self.reducer.topology, self.reducer.heading)
            raise RunFault(told or FAULTS[fault].format(**self.tables[0].scalars(plants)))
        return plants

    def place(self, plants: np.ndarray, angle: float, cage: float = 0.0, **plant_values: float | Floats) -> None:
        """Turn a plant's input to an output angle [rad], with the cages where they have rolled with the output from 0 and ``cage`` ahead."""
        plants["ideal_output_rest"] = plants["cage_rest"] = 0.0
        self.turn_on(plants, angle - float(plants["ideal_output"][0]))
        plants["ideal_output"] = angle
        plants["cage"] = plants["cage_angle"] = self.cages_per_turn(plants) * within_turn(angle) + cage
        for name, value in plant_values.items():
            plants[name] = value

    def turn_on(self, plants: np.ndarray, further: float) -> None:
        """Turn a plant's input on until the output is ``further`` [rad], as ideal kinematics has it until it is solved there; the cages roll with it."""
        plants["ideal_output"] += further
        plants["crank_angle"] -= self.reducer.topology.lobes * further
        plants["output_angle"] += further
        plants["cage"] += self.cages_per_turn(plants) * further
        plants["cage_angle"] = plants["cage"]

    def cages_per_turn(self, plants: np.ndarray) -> float:
        """Turns of the cages per turn of the output."""
        return float(plain(cage_rate)(-self.reducer.topology.lobes, 1.0, float(plants["inner_race_radius"][0]), float(plants["outer_race_radius"][0])))

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


def whole_first(settings: Mapping[str, float]) -> dict[str, float]:
    """Settings in the order in which they are made: single elements (one pin) after those of whole variables (all are larger)."""
    return dict(sorted(settings.items(), key=lambda setting: "[" in setting[0]))


def within_turn(angle: float) -> float:
    """The same place of the output by the shorter way from 0 [rad]."""
    return math.remainder(angle, 2.0 * math.pi)
