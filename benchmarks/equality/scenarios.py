"""The scenarios: library reducers as they are, with every effect, in motion, and with random legal parameters."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from benchmarks.random_sets.draw import Value, draw
from benchmarks.random_sets.run import REDUCERS, Sets
from fmu_src.effect import Effect
from fmu_src.faults import InputFault, RunFault
from fmu_src.unit import Specification
from fmu_src.variables import SETTABLE
from orchestrator.component import Component, InProcess, unit_of
from reducers.reducer import load_reducer
from rv_plant.effects import EFFECTS as PLANT
from wear_fmu.effects import EFFECTS as WEAR

NAMES = {"rv_plant": "RvPlant", "wear_fmu": "RvWear", "rv_reducer": "RvReducer"}
STEPS = 5


@dataclass
class Scenario:
    """One unit with its values, stepped ``STEPS`` times by ``step`` [s]; a wear unit is driven along."""

    name: str
    reducer: str
    unit: str
    step: float
    values: dict[str, Value] = field(default_factory=dict)

    @property
    def specification(self) -> Specification:
        return load_reducer(self.reducer).specification(self.unit)


def everything(*catalogues: dict[str, Effect]) -> dict[str, Value]:
    """All amplitudes at half their typical size."""
    effects = [e for catalogue in catalogues for e in catalogue.values()]
    return {p.variable.name: float(p.variable.start) + (p.sign or 1) * 0.5 * p.scale for e in effects for p in e.amplitudes()}


def scenarios(count: int = 50) -> list[Scenario]:
    """The named ones first, then random sets of the three topologies in turn."""
    fast: dict[str, Value] = {"acceleration": 1e6}
    found = [
        Scenario("plant", "RV20E-121-rigid", "rv_plant", 1.3e-3),
        Scenario("plant, every effect", "RV20E-121-rigid", "rv_plant", 1.3e-3, everything(PLANT)),
        Scenario("plant of the reducer with its supports", "RV20E-121", "rv_plant", 1.3e-3),
        Scenario("plant in motion", "RV20E-121-rigid", "rv_plant", 1e-4, {"fidelity": 1}),
        Scenario("plant in motion, constrained joints", "BX-40E-rigid", "rv_plant", 1e-4, {"fidelity": 1, "joints": 1}),
        Scenario("plant driven by torque", "RV20E-121-rigid", "rv_plant", 1e-4, {"fidelity": 1, "drive": 1, "input_torque": 1.5}),
        Scenario("wear", "RV20E-121-rigid", "wear_fmu", 1e-3, fast),
        Scenario("wear, every effect", "RV20E-121-rigid", "wear_fmu", 1e-3, fast | everything(WEAR)),
        Scenario("wear of standing pins", "RV20E-121-rigid", "wear_fmu", 1e-3, fast | {"pins": 1}),
        *(Scenario("reducer", name, "rv_reducer", 1e-3, fast) for name in REDUCERS),
        Scenario("reducer with its supports, in motion", "BX-40E", "rv_reducer", 1e-4, fast | {"fidelity": 1}),
        Scenario("reducer in motion", "RV20E-121-rigid", "rv_reducer", 1e-4, fast | {"fidelity": 1}),
        Scenario("reducer, every effect", "RV20E-121-rigid", "rv_reducer", 1e-3, fast | everything(PLANT, WEAR)),
    ][:count]
    for scenario in found:
        # What a topology lacks is not to be set.
        table = unit_of(scenario.specification).table
        scenario.values = {name: value for name, value in scenario.values.items() if table.by_name[name].role in SETTABLE}
    return [*found, *random_ones(count - len(found))]


def random_ones(count: int) -> Iterator[Scenario]:
    sets: dict[str, Sets] = {}
    number = 0
    while count:
        name = REDUCERS[number % len(REDUCERS)]
        own = sets[name] = sets.get(name) or Sets(name, None)
        drawn = draw(own.reducer, own.unit.table, number)
        scenario = Scenario(f"random set {number}", name, "rv_reducer", own.step_of(drawn), drawn.values | {"acceleration": 1e4})
        if not drawn.astray and runs(scenario):
            count -= 1
            yield scenario
        number += 1


def runs(scenario: Scenario) -> bool:
    """Whether it comes to its end; what is refused is compared elsewhere (benchmarks/random_sets)."""
    try:
        states(scenario, InProcess("unit", scenario.specification))
    except (InputFault, RunFault):
        return False
    return True


def states(scenario: Scenario, unit: Component) -> np.ndarray:
    """Cells of the state after initialisation and after each step (steps + 1, cells), as whole numbers."""
    table = unit_of(scenario.specification).table
    size = 8 * table.state_cells

    def cells() -> np.ndarray:
        return np.frombuffer(unit.save()[-size:], "i8")

    for name, value in scenario.values.items():
        unit.set(name, value)
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    rows = [cells()]
    for n in range(STEPS):
        if scenario.unit == "wear_fmu":
            for name, value in driven(n).items():
                unit.set(name, value)
        unit.step(n * scenario.step, scenario.step)
        rows.append(cells())
    return np.array(rows)


def driven(n: int) -> dict[str, float]:
    """Inputs of a wear unit before step n."""
    return {"crank_angle": 0.1 * n, "mesh_force": 300.0 + n, "roller_force": 100.0, "crank_speed": 100.0}
