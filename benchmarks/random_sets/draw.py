"""A random legal set of parameters for RvReducer: sizes, errors of parts, laws, effects, load and speed at once."""

from dataclasses import dataclass, field

import numpy as np

from fmu_src.effect import Effect, EffectParameter
from fmu_src.table import Table
from fmu_src.variables import SETTABLE, Variable
from reducers.reducer import Reducer
from rv_plant.effects import EFFECTS as PLANT
from wear_fmu.effects import EFFECTS as WEAR

Value = float | int | np.ndarray

# Lengths that make the reducer's size; they are scaled together and scatter by a few per cent.
SIZES = ("pin_radius", "pin_circle_radius", "mesh_width", "eccentricity", "crank_circle_radius", "inner_race_radius", "roller_radius", "roller_length",
         "output_pin_radius", "output_circle_radius")  # fmt: skip
STIFFNESSES = ("mesh_stiffness", "roller_stiffness", "output_stiffness")
ERRORS = ("_error", "_error_radial", "_error_tangential")
CHOICES = ("contact_law", "damping_law", "joints", "pins", "sliding_form", "mesh_wear_law", "raceway_wear_law")
# Young's modulus [Pa] of what is called steel.
STEEL = 1e11
# One of so many sets has one number anywhere in its range, so that refusals are tried too.
ONE_ASTRAY = 6


@dataclass
class Drawn:
    """Values by the kernels' names; ``astray`` names what was taken from anywhere in its range."""

    number: int
    values: dict[str, Value] = field(default_factory=dict)
    astray: str = ""


def draw(reducer: Reducer, table: Table, number: int) -> Drawn:
    """Set ``number`` for a reducer: the same at every call."""
    random = np.random.default_rng([16, number])
    drawn, start = Drawn(number), {v.name: v.start for v in table.variables}
    values = drawn.values
    size = np.exp(random.uniform(np.log(0.5), np.log(3.0)))
    for name in SIZES:
        values[name] = float(start[name]) * size * random.uniform(0.98, 1.02)
    # Races and rollers fit, holes for output pins too.
    values["outer_race_radius"] = float(values["inner_race_radius"]) + 2.0 * float(values["roller_radius"])
    for name in STIFFNESSES:
        values[name] = float(start[name]) * float(np.exp(random.normal(0.0, 0.5)))
    of_plastic = float(start["elastic_modulus"]) < STEEL
    for name in CHOICES:
        # Janakiraman's laws, the last two, are for steel.
        values[name] = int(random.integers(2 if of_plastic and name.endswith("wear_law") else len(table.by_name[name].choices)))
    if reducer.specification("rv_reducer")["sizes"]["topology"]["output_pins"] == 0:
        values["fidelity"] = int(random.random() < 0.25)
        values["bearing_clearance"] = random.uniform(-3e-6, 30e-6)
    # No load, or up to so many times the rated one of a reducer of this size; a drive of plastic skips teeth at twice.
    most = 1.0 if reducer.specification("rv_reducer")["sizes"]["topology"]["output_pins"] else 2.0
    share = 0.0 if random.random() < 0.1 else random.uniform(-most, most)
    values["load_torque"] = float(start["load_torque"]) * size**2 * share
    values["input_speed"] = float(start["input_speed"]) * random.uniform(0.05, 1.5) * random.choice([-1.0, 1.0])
    values["temperature"] = random.uniform(253.0, 363.0)
    for name in ("equidistant_modification", "shift_modification"):
        values[name] = float(start[name]) + random.uniform(-2e-5, 2e-5)
    for name in ("mesh_wear_coefficient", "raceway_wear_coefficient"):
        values[name] = float(start[name]) * 10.0 ** random.uniform(-1.0, 1.0)
    values["load_exponent"] = random.uniform(0.0, 1.0)
    if random.random() < 0.5:
        draw_errors(table, random, values)
    for effect in (*PLANT.values(), *WEAR.values()):
        if random.random() < 0.35:
            draw_effect(effect, table, random, values)
    # Where play comes and goes there is as much of it at least, as the effect says.
    varying = sum(abs(float(values.get(f"first_stage_play_{part}", 0.0))) for part in ("cos", "sin"))
    values["backlash"] = float(values.get("backlash", 0.0)) + varying
    if random.random() < 1.0 / ONE_ASTRAY:
        drawn.astray = go_astray(table, random, values)
    # What a topology lacks is not to be set.
    drawn.values = {name: value for name, value in values.items() if table.by_name[name].role in SETTABLE}
    return drawn


def draw_errors(table: Table, random: np.random.Generator, values: dict[str, Value]) -> None:
    """Every dimension of every part scatters by the same few micrometres."""
    scatter = 10.0 ** random.uniform(-6.5, -5.5)
    for v in table.of_role("parameter"):
        if v.shape and v.name.endswith(ERRORS):
            values[v.name] = random.normal(0.0, scatter / (28e-3 if v.unit == "rad" else 1.0), v.shape)


def draw_effect(effect: Effect, table: Table, random: np.random.Generator, values: dict[str, Value]) -> None:
    for parameter in effect.parameters:
        v = table.by_name[parameter.variable.name]
        values[v.name] = drawn_value(parameter, v, random)


def drawn_value(parameter: EffectParameter, v: Variable, random: np.random.Generator) -> Value:
    if v.choices:
        return int(random.integers(len(v.choices)))
    if v.is_integer:
        return int(random.integers(int(v.minimum), min(int(v.maximum), 5) + 1))
    if parameter.kind == "amplitude":
        side = parameter.sign or random.choice([-1, 1])
        value = float(v.start) + side * parameter.scale * random.uniform(0.0, 2.0)
    elif v.unit == "rad" and v.minimum < 0.0:
        value = random.uniform(0.0, 2.0 * np.pi)
    else:
        value = float(random.choice(parameter.grid or (float(v.start),))) * random.uniform(0.7, 1.4)
    return float(np.clip(value, v.minimum, v.maximum))


def go_astray(table: Table, random: np.random.Generator, values: dict[str, Value]) -> str:
    """One number from anywhere in its range, small and large ones alike."""
    scalars = [v for v in table.of_role("parameter", "input") if not v.shape and v.name not in ("largest_crank_step", "largest_sweep", "max_iterations")]
    if random.random() < 0.5:
        # Sizes that do not fit each other are what refusals are mostly about.
        scalars = [table.by_name[name] for name in (*SIZES, "outer_race_radius") if table.by_name[name].role in SETTABLE]
    v = scalars[int(random.integers(len(scalars)))]
    if v.is_integer:
        values[v.name] = int(random.integers(int(v.minimum), min(int(v.maximum), 1000) + 1))
    else:
        largest = v.maximum if v.minimum >= 0.0 or random.random() < 0.5 else v.minimum
        least = max(abs(v.minimum), 1e-9 * abs(largest)) if v.minimum > 0.0 else 1e-9 * abs(largest)
        if v.name in values and random.random() < 0.5:
            values[v.name] = float(np.clip(float(values[v.name]) * np.exp(random.normal(0.0, 1.0)), v.minimum, v.maximum))
            return v.name
        values[v.name] = float(np.clip(np.sign(largest) * np.exp(random.uniform(np.log(least), np.log(abs(largest)))), v.minimum, v.maximum)) if largest else 0.0
    return v.name
