"""The same bench with the FMUs themselves on it, stepped as any importing tool steps them.

What an FMU does not let one set is reached by stepping.  A run that begins at another angle
than 0 turns there first, without wear, the shorter way; the cages roll along (skidding ones
a little less far than ``Bench`` puts them).  Worn surfaces come back as the wear unit's FMU
state, and that unit is led to the plant's crank angle.  The age of the grease is fixed once
a unit is initialised: the plant's grease stays new through a life.
"""

import math
import weakref
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from discrepancy.model_file import ModelFile
from discrepancy.prediction.bench import (
    HELD_ANGLES,
    POSITIONS,
    SHORT_CYCLE,
    TOLERANCE,
    Bench,
    Condition,
    stretches,
    within_turn,
)
from orchestrator.coupled import COLUMNS
from orchestrator.faults import InputFault, RunFault
from orchestrator.fmu import Fmu
from orchestrator.master import Master
from orchestrator.pair import CONNECTIONS, require_built_from

# The wear unit takes no more than half a turn of the cranks in a step.
LONGEST_WEAR_STEP = 3.0


class FmuBench(Bench):
    """``Bench`` by RvPlant.fmu and RvWear.fmu of a folder; surfaces are resolved as the FMU has them."""

    def __init__(self, model: ModelFile, settings: Mapping[str, float], folder: Path):
        super().__init__(model.reducer, settings, model.reducer.resolution)
        self.settings = dict(settings)
        self.plant, self.wear = Fmu("plant", folder / "RvPlant.fmu"), Fmu("wear", folder / "RvWear.fmu")
        self.master = Master({"plant": self.plant, "wear": self.wear}, CONNECTIONS, step=1.0)
        weakref.finalize(self, self.master.close)
        for unit, name in ((self.plant, "rv_plant"), (self.wear, "wear_fmu")):
            require_units_of(model, unit, name)

    def renew(self, unit: Fmu, values: Mapping[str, float]) -> None:
        """A new unit with the settings and then ``values``."""
        unit.attempt(unit.slave.reset)
        for name, value in {**self.settings, "tolerance": TOLERANCE, **values}.items():
            if name in unit.signals and unit.signals[name].causality != "output":
                unit.set(name, value)

    def renew_plant(self, condition: Condition, values: Mapping[str, float], **plant_values) -> None:
        self.renew(self.plant, {
            **values, "temperature": condition.temperature, "input_speed": self.input_speed(condition),
            "load_torque": condition.direction * condition.load, "grease_age": condition.hours, **plant_values,
        })  # fmt: skip

    def start_plant(self, condition: Condition, values: Mapping[str, float], **plant_values) -> None:
        """The plant alone at output angle 0."""
        self.renew_plant(condition, values, **plant_values)
        self.plant.enter_initialisation(0.0)
        # Here the values may come from a search: what they do not allow is a fault of the run, as in ``Bench``.
        self.plant.attempt(self.plant.slave.exitInitializationMode)

    def turn_plant(self, condition: Condition, angle: float) -> None:
        """Move the output by ``angle`` [rad], at the speed of the condition in either direction."""
        self.plant.set("input_speed", math.copysign(condition.speed, angle * self.ratio))
        self.plant.step(0.0, abs(angle * self.ratio) / condition.speed)

    def place_wear(self, state: bytes) -> None:
        """Put worn surfaces under the plant's contacts; they wear no further."""
        self.wear.restore(state)
        self.wear.set("acceleration", 0.0)
        self.wear.set("contact_lead", 0.0)
        start, end = self.wear.get("crank_angle"), self.plant.get("crank_angle")
        for angle in np.linspace(start, end, 1 + math.ceil(abs(end - start) / LONGEST_WEAR_STEP))[1:]:
            self.wear.set("crank_angle", angle)
            self.wear.step(0.0, 0.0)

    def worn_state(self, condition: Condition, values: Mapping[str, float]) -> bytes | None:
        """The wear unit's FMU state after the condition's hours, if there are any."""
        if condition.hours == 0.0:
            return None
        return self.states_to(condition, values, [condition.hours], SHORT_CYCLE)[condition.hours]

    def wear_to(self, condition, values, inspections, turns):
        records = {}
        for target, state in self.states_to(condition, values, inspections, turns).items():
            self.wear.restore(state)
            records[target] = self.wear.record()
        return records

    def states_to(
        self, condition: Condition, values: Mapping[str, float], inspections: list[float], turns: int
    ) -> dict[float, bytes]:
        """The wear unit's FMU states at several operating times [s], see ``Bench.wear_to``."""
        fresh = Condition(condition.speed, condition.load, condition.temperature, 0.0, condition.direction)

        def run():
            self.renew_plant(fresh, values, largest_crank_step=1.0)
            self.renew(self.wear, {**values, "temperature": fresh.temperature})
            try:
                self.master.initialise()
            except InputFault as fault:
                raise RunFault(str(fault)) from None
            step = self.turning_time(condition) / POSITIONS
            steps = turns * POSITIONS
            self.master.rebase(step)
            self.wear.set("acceleration", 0.0)
            self.master.run(2)
            found = dict.fromkeys(inspections, self.wear.save())
            for _, stretch, target in stretches(inspections):
                self.wear.set("acceleration", stretch / (steps * step))
                self.master.run(steps)
                found[target] = self.wear.save()
            return found

        return self.kept(("life", fresh, tuple(inspections), turns, self.relevant(values, True)), run)

    def running(self, condition, values, angles):
        def run():
            worn = self.worn_state(condition, values)
            self.start_plant(condition, values, largest_crank_step=1.0)
            start = within_turn(angles[0])
            self.turn_plant(condition, start)
            self.plant.set("input_speed", self.input_speed(condition))
            if worn:
                self.place_wear(worn)
                self.step_pair(0.0)
            move = self.step_pair if worn else lambda duration: self.plant.step(0.0, duration)
            seen = [self.plant.signal(name).references[0] for name in COLUMNS]
            row, series = np.zeros(len(COLUMNS)), np.zeros((len(angles), len(COLUMNS)))
            read = self.plant.reader(tuple(seen), row)
            durations = np.abs(np.diff(angles, prepend=angles[0])) * abs(self.ratio) / condition.speed
            for i, duration in enumerate(durations):
                move(float(duration))
                read()
                series[i] = row
            series[:, COLUMNS.index("output_angle")] += angles[0] - start
            return series

        key = ("running", condition, self.relevant(values, condition.hours > 0.0), angles.tobytes())
        return self.kept(key, run)

    def running_places(self, condition, values, angles):
        raise NotImplementedError("an FMU shows no equilibria; ask for running")

    def step_pair(self, duration: float) -> None:
        self.master.rebase(duration)
        self.master.step()

    def held(self, condition, values, torques):
        def run():
            worn = self.worn_state(condition, values)
            total = np.zeros(len(torques))
            self.start_plant(condition, values, load_torque=torques[0])
            placed = self.plant.save()
            for k in range(HELD_ANGLES):
                if k > 0:
                    self.plant.restore(placed)
                    self.turn_plant(condition, 2.0 * math.pi / (HELD_ANGLES * self.reducer.topology.lobes))
                    placed = self.plant.save()
                self.plant.set("input_speed", 0.0)
                if worn:
                    self.place_wear(worn)
                    for transfers in self.master.incoming.values():
                        ...
                for i, torque in enumerate(torques):
                    self.plant.set("load_torque", torque)
                    self.plant.step(0.0, 1.0)
                    total[i] -= self.plant.get("transmission_error") / HELD_ANGLES
            return total

        key = ("held", condition, self.relevant(values, condition.hours > 0.0), torques.tobytes())
        return self.kept(key, run)
