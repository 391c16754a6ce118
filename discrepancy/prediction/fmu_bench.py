"""The same bench with the FMUs themselves on it, stepped as any importing tool steps them.

What an FMU does not let one set is reached by stepping, and every step takes time.  A run
that begins at another angle than 0 turns there first, without wear, the shorter way; the
cages roll along (skidding ones a little less far than ``Bench`` puts them), and heat that
follows the losses at once has settled further by the first sample.  Worn surfaces come back
as the wear unit's FMU state, and that unit is led to the plant's angles.
"""

import contextlib
import math
import weakref
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from discrepancy.model_file import ModelFile, extended_reducer
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.held import HELD_ANGLES, positions_of
from discrepancy.prediction.lives import SHORT_CYCLE, fresh, stretches
from discrepancy.prediction.running import Starts
from discrepancy.prediction.runs import MOMENT
from discrepancy.prediction.units import TOLERANCE, Condition, whole_first, within_turn
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, RunFault
from fmu_src.variables import SETTABLE
from orchestrator.fmu import Fmu
from orchestrator.master import Master
from studies.coupled import COLUMNS
from studies.pair import CONNECTIONS, require_built_from

# The wear unit takes no more than half a turn of cranks, carrier or cages in a step [rad].
LONGEST_WEAR_STEP = 3.0


class FmuBench(Bench):
    """``Bench`` by RvPlant.fmu and RvWear.fmu of a folder; surfaces are resolved as the FMU has them."""

    def __init__(self, model: ModelFile, settings: Mapping[str, float], folder: Path):
        super().__init__(model.reducer, settings, model.reducer.resolution)
        self.settings = whole_first(settings)
        self.plant, self.wear = Fmu("plant", folder / "RvPlant.fmu"), Fmu("wear", folder / "RvWear.fmu")
        self.master = Master({"plant": self.plant, "wear": self.wear}, CONNECTIONS, step=1.0)
        weakref.finalize(self, self.master.close)
        for unit, name in ((self.plant, "rv_plant"), (self.wear, "wear_fmu")):
            require_units_of(model, unit, name)

    def renew(self, unit: Fmu, values: Mapping[str, float]) -> None:
        """A new unit with the settings and then ``values``."""
        unit.attempt(unit.slave.reset)
        for name, value in {**self.settings, "tolerance": TOLERANCE, **values}.items():
            if unit.has(name) and unit.signal(name).causality in SETTABLE:
                unit.set(name, value)

    def renew_plant(self, condition: Condition, values: Mapping[str, float], load: float) -> None:
        self.renew(self.plant, {
            **values, "temperature": condition.temperature, "input_speed": self.input_speed(condition),
            "load_torque": load, "grease_age": condition.hours, "largest_crank_step": 1.0,
        })  # fmt: skip

    def start_plant(self, condition: Condition, values: Mapping[str, float], load: float) -> None:
        """The plant alone, at output angle 0."""
        self.renew_plant(condition, values, load)
        self.plant.enter_initialisation(0.0)
        with refusal_as_run_fault():
            self.plant.exit_initialisation()
        self.time = 0.0

    def step_plant(self, duration: float) -> None:
        self.plant.step(self.time, duration)
        self.time += duration

    def step_pair(self, duration: float) -> None:
        self.master.advance(self.time, duration)
        self.time += duration

    def turn_plant(self, condition: Condition, angle: float) -> None:
        """Move the output by ``angle`` [rad], at the condition's speed whichever the direction."""
        if angle == 0.0:
            # A step there would let heat that follows the losses at once settle further than in ``Bench``.
            return
        self.plant.set("input_speed", math.copysign(condition.speed, angle * self.ratio))
        self.step_plant(abs(angle * self.ratio) / condition.speed)

    def age_plant(self, condition: Condition, values: Mapping[str, float]) -> None:
        """The plant where it stands, with grease as old as the condition says: its age is fixed in a unit's life."""
        angle = float(self.plant.get("input_angle")) / self.ratio
        self.start_plant(condition, values, condition.direction * condition.load)
        self.turn_plant(condition, angle)
        self.plant.set("input_speed", self.input_speed(condition))

    def place_wear(self, state: bytes) -> None:
        """Put worn surfaces under the plant's contacts; they wear no further."""
        wear, plant = self.wear, self.plant
        wear.restore(state)
        wear.set("acceleration", 0.0)
        wear.set("crank_speed", 0.0)
        names = ("crank_angle", "output_angle", "cage_angle")
        start, end = (np.array([unit.get(name) for name in names]) for unit in (wear, plant))
        for angles in np.linspace(start, end, 2 + int(np.abs(end - start).max() / LONGEST_WEAR_STEP))[1:]:
            for name, angle in zip(names, angles):
                wear.set(name, angle)
            wear.step(self.time, MOMENT)
        for source, target in CONNECTIONS:
            if source.startswith("wear."):
                plant.set(target.partition(".")[2], wear.get(source.partition(".")[2]))

    def worn_state(self, condition: Condition, values: Mapping[str, float]) -> bytes | None:
        """The wear unit's FMU state after the condition's hours, if there are any."""
        if condition.hours == 0.0:
            return None
        new = fresh(condition)
        return self.states_to(new, values, self.looked_at(new, {condition.hours}), SHORT_CYCLE)[condition.hours]

    def wear_to(
        self, condition: Condition, values: Mapping[str, float], inspections: list[float], turns: int
    ) -> dict[float, np.ndarray]:
        records = {}
        for target, state in self.states_to(condition, values, inspections, turns).items():
            self.wear.restore(state)
            records[target] = self.wear.record()
        return records

    def states_to(
        self, condition: Condition, values: Mapping[str, float], inspections: list[float], turns: int
    ) -> dict[float, bytes]:
        """The wear unit's FMU states at several operating times [s], see ``Bench.wear_to``."""

        def run() -> dict[float, bytes]:
            self.renew_plant(condition, values, condition.direction * condition.load)
            self.renew(self.wear, {**values, "temperature": condition.temperature, "largest_sweep": self.largest_sweep})
            with refusal_as_run_fault():
                self.master.initialise()
            self.time = 0.0
            step, weights = self.cycle(condition, turns)
            self.wear.set("acceleration", 0.0)
            for _ in range(2):
                self.step_pair(step)
            found = dict.fromkeys(inspections, self.wear.save())
            ageing = self.plant.get("grease_ageing") != 0.0
            for done, stretch, target in stretches(inspections, turns):
                if ageing:
                    self.age_plant(replace(condition, hours=done + 0.5 * stretch), values)
                for acceleration in stretch / step * weights:
                    self.wear.set("acceleration", acceleration)
                    self.step_pair(step)
                found[target] = self.wear.save()
            return found

        return self.kept(("life", condition, tuple(inspections), turns, self.relevant(values, True)), run)

    def running(self, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0) -> Floats:
        if cage != 0.0:
            # No FMU can be told where its cages stand; what they change is the same in process.
            return super().running_places(condition, values, angles, cage)[0]

        def run() -> Floats:
            worn = self.worn_state(condition, values)
            self.start_plant(condition, values, condition.direction * condition.load)
            start = within_turn(angles[0])
            self.turn_plant(condition, start)
            self.plant.set("input_speed", self.input_speed(condition))
            if worn:
                self.place_wear(worn)
            move = self.step_pair if worn else self.step_plant
            row, series = np.zeros(len(COLUMNS)), np.zeros((len(angles), len(COLUMNS)))
            read = self.plant.reader(tuple(self.plant.signal(name).references[0] for name in COLUMNS), row)
            durations = np.abs(np.diff(angles, prepend=angles[0])) * abs(self.ratio) / condition.speed
            for i, duration in enumerate(durations):
                move(max(float(duration), MOMENT))
                read()
                series[i] = row
            series[:, COLUMNS.index("output_angle")] += angles[0] - start
            return series

        key = ("running", condition, self.relevant(values, condition.hours > 0.0), angles.tobytes())
        return self.kept(key, run)

    def column(self, name: str, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0,
               starts: Starts | None = None) -> Floats:  # fmt: skip
        return self.running(condition, values, angles, cage)[:, COLUMNS.index(name)]

    def running_places(self, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0,
                       starts: Starts | None = None) -> tuple[Floats, Floats]:  # fmt: skip
        raise NotImplementedError("an FMU shows no equilibria; ask for running")

    def error_beside(self, condition: Condition, values: Mapping[str, float], angles: Floats,
                     base: Mapping[str, float], base_angles: Floats, cage: float = 0.0, starts: Starts | None = None) -> Floats:  # fmt: skip
        # There is no equilibrium to start from: the whole run.
        return self.running(condition, values, angles, cage)[:, COLUMNS.index("transmission_error")]

    def held(self, condition: Condition, values: Mapping[str, float], torques: Floats, positions: int = HELD_ANGLES) -> Floats:
        def run() -> Floats:
            worn = self.worn_state(condition, values)
            count = positions_of(condition, positions)
            first = within_turn(self.held_at(condition, count)[0])
            total = np.zeros(len(torques))
            self.start_plant(condition, values, torques[0])
            placed, since = self.plant.save(), self.time
            for k in range(count):
                further = first if k == 0 else 2.0 * math.pi / (count * self.reducer.topology.lobes)
                if further != 0.0:
                    self.plant.restore(placed)
                    self.time = since
                    self.turn_plant(condition, further)
                    placed, since = self.plant.save(), self.time
                self.plant.set("input_speed", 0.0)
                if worn:
                    self.place_wear(worn)
                for i, torque in enumerate(torques):
                    self.plant.set("load_torque", torque)
                    self.step_plant(1.0)
                    total[i] -= self.plant.get("transmission_error") / count
            return total

        key = ("held", condition, self.relevant(values, condition.hours > 0.0), torques.tobytes(), positions)
        return self.kept(key, run)


@contextlib.contextmanager
def refusal_as_run_fault() -> Iterator[None]:
    """Values come from a search here: those that a unit refuses end a run, they are no fault of the user's."""
    try:
        yield
    except InputFault as fault:
        raise RunFault(str(fault)) from None


def require_units_of(model: ModelFile, unit: Fmu, name: str) -> None:
    """An FMU is that of the model's reducer, or of the extended model; the rest is set at each run."""
    # What the extended model is called hangs on its file's name, by which no value is another.
    extended = replace(extended_reducer(model), name=unit.specification()["reducer"])
    built_extended = unit.specification() == extended.specification(name)
    require_built_from(extended if built_extended else model.reducer, unit, name)
