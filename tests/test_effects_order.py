"""The order of the effects does not matter: all of them on, in an order and in the reverse one, give the same reducer.

A probe among them changes every field that an effect may change, so that each has two contributors at least.
"""

import os
import random
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from stand import SHARED, crank_period, exchange, records_of

from fmu_src.effect import effect_modules
from reducers.reducer import load_reducer
from rv_plant import assembly, outputs, plant, prepared
from rv_plant.effects import ALLOWED as PLANT_ALLOWED
from rv_plant.effects import EFFECTS as PLANT
from rv_plant.effects import HOOKS as PLANT_HOOKS
from wear_fmu import accumulator
from wear_fmu.effects import ALLOWED as WEAR_ALLOWED
from wear_fmu.effects import EFFECTS as WEAR
from wear_fmu.effects import HOOKS as WEAR_HOOKS

# Sums and products in another order differ by their rounding, which equilibria carry on to accelerations.
ROUNDING = 1e-10
# What the probe adds; it multiplies by FACTOR.
ADDED = {"compliance": 1e-9, "reducer_temperature": 0.5, "friction_power": 0.1, "tangent": 1.0, "effects_on": 1, "standing": 0.01}
FACTOR = 1.001


def everything(effects) -> dict[str, float]:
    """All amplitudes at half their typical size."""
    return {p.variable.name: float(p.variable.start) + (p.sign or 1) * 0.5 * p.scale for e in effects.values() for p in e.amplitudes()}


def probe(hooks, allowed) -> SimpleNamespace:
    """An effect that changes all that effects may."""

    def hook(name, operation):
        def change(r, *_):
            for field, operator in allowed[name].items():
                if operator == "+=":
                    r[field] += ADDED.get(field, 1e-8)
                elif operator == "*=":
                    r[field] *= FACTOR
            return FACTOR

        return change

    return SimpleNamespace(**{name: hook(name, operation) for name, (_, operation) in hooks.items()})


def composed(package, hooks, allowed, reverse):
    """Hooks in plain Python that call the effects' in an order."""
    modules = {**effect_modules(package), "probe": probe(hooks, allowed)}
    names = sorted(modules)
    random.Random(5).shuffle(names)
    names = names[::-1] if reverse else names

    def hook(name, operation):
        kernels = [getattr(modules[n], name) for n in names if hasattr(modules[n], name)]

        def call(*arguments):
            values = [kernel(*arguments) for kernel in kernels]
            return np.prod(values) if operation == "*" else None

        return call

    return SimpleNamespace(**{name: hook(name, operation) for name, (_, operation) in hooks.items()})


def take(reverse) -> None:
    """Put hooks of another order in the place of those that the units have: any order, or the reverse of it."""
    of_plant, of_wear = composed("rv_plant.effects", PLANT_HOOKS, PLANT_ALLOWED, reverse), composed("wear_fmu.effects", WEAR_HOOKS, WEAR_ALLOWED, reverse)
    plant.start_effects, plant.advance_states, plant.heat_effects = of_plant.start, of_plant.advance, of_plant.heat
    prepared.prepare_effects = of_plant.prepare
    outputs.warm_effects, outputs.before_effects, outputs.after_effects = of_plant.warm, of_plant.before, of_plant.after
    assembly.hold_effects = of_plant.hold
    accumulator.prepare_effects, accumulator.advance_effects = of_wear.prepare, of_wear.advance
    # All surfaces are chosen, and effects are not told which is worn.
    accumulator.effect_factor = lambda *arguments: of_wear.factor(*arguments[:-1])


def results(reducer):
    """Outputs and states of both units after a turning step, of the plant with its input held, and in motion."""
    tables = reducer.plant, reducer.wear
    values = everything(PLANT), everything(WEAR)
    found = {}

    def keep(case, table, records):
        found.update({f"{case} {v.name}": np.array(records[v.name][0]) for v in table.of_role("output", "state")})

    for case, given, duration in (
        ("turning", {"thermal_time": 60.0}, 1e-3), ("held", {"input_speed": 0.0}, 1.0), ("moving", {"fidelity": 1}, 2e-6),
    ):  # fmt: skip
        machine = records_of(tables[0], **{**values[0], **given}).view(np.recarray)
        assert plant.initialise(machine) == 0
        assert plant.step(machine, 0.0, duration) == 0
        keep(case, tables[0], machine)
        if case == "turning":
            surface = records_of(tables[1], acceleration=1e8, **values[1]).view(np.recarray)
            exchange(machine, surface, SHARED)
            assert accumulator.initialise(surface) == 0
            surface["crank_angle"] += 0.1
            assert accumulator.step(surface, 0.0, 0.1 * crank_period(machine)) == 0
            keep(case, tables[1], surface)
    return found


def compare_orders() -> None:
    assert not hasattr(plant.step, "py_func"), "the compiler is not switched off"
    reducer = load_reducer("RV20E-121-rigid")
    take(reverse=False)
    first = results(reducer)
    acting = {name for name, value in first.items() if name.endswith(("_added", "friction_torque")) and np.any(value)}
    assert len(acting) > 15, acting
    take(reverse=True)
    for name, value in results(reducer).items():
        scale = np.abs(first[name]).max()
        # What is left of the forces in equilibrium, and of an angle beside its last place, is rounding alone.
        assert name.endswith((" residual", "_rest")) or np.abs(value - first[name]).max() <= ROUNDING * scale + of_angles(name, first), name
    every_stage_starts_anew(reducer)


def of_angles(name, first) -> float:
    """Rounding of a path with the input held: a little way between two angles, of which equilibrium knows some digits less than the last."""
    if not (name.startswith("held") and name.endswith("_path")):
        return 0.0
    force = np.abs(first[name.removesuffix("_path")]).max() if name.removesuffix("_path") in first else 1.0
    return 256.0 * np.finfo(float).eps * np.abs(first["held crank_angle"]).max() * force


def every_stage_starts_anew(reducer) -> None:
    """A stage that runs twice gives what it gives once: the units clear what effects add to."""
    machine = records_of(reducer.plant, **everything(PLANT)).view(np.recarray)
    assert plant.initialise(machine) == 0
    r = machine[0]

    def after(r):
        # The last loss warms the contacts.
        r.friction_power = 1.0
        plant.assemble_at_input(r)
        outputs.publish_losses(r, 1.0)

    # Out of balance, so that the residual is more than rounding.
    r.load_torque *= 0.5
    for stage, run in (
        ("prepare", plant.prepare), ("warm", outputs.prepare_position), ("before", outputs.prepare_position),
        ("hold", plant.assemble_at_input), ("after", after),
    ):  # fmt: skip
        run(r)
        fields = [f for f, operator in PLANT_ALLOWED[stage].items() if operator != "="]
        once = {f: np.array(r[f]) for f in fields}
        run(r)
        # The second look at a contact starts from the first one's result.
        assert fields and all(np.abs(r[f] - once[f]).max() <= 1e-6 * np.abs(once[f]).max() for f in fields), stage


def test_order_of_effects_does_not_matter(tmp_path):
    root = Path(__file__).resolve().parents[1]
    search = os.pathsep.join([str(root), str(root / "tests")])
    done = subprocess.run([sys.executable, "-c", "import test_effects_order as t; t.compare_orders()"], capture_output=True, text=True,
                          timeout=120, env={**os.environ, "RVWEAR_PLAIN_PYTHON": "1", "PYTHONPATH": search, "XDG_CACHE_HOME": str(tmp_path)})
    assert done.returncode == 0, done.stderr
