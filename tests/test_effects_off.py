"""Every effect vanishes exactly at its start values, whatever its shapes and choices say."""

import numpy as np
import pytest
from stand import SHARED, crank_period, exchange, only, records_of

from discrepancy.effects import EFFECTS as CHAIN
from discrepancy.effects import MODULES
from discrepancy.problem import Record
from fmu_src.effect import Effect
from rv_plant import plant
from rv_plant.effects import EFFECTS as PLANT
from wear_fmu import accumulator
from wear_fmu.effects import EFFECTS as WEAR

POSITIONS = 6


def other_shapes(effect: Effect, seed: int = 3) -> dict[str, float]:
    """Values within bounds for everything but the amplitudes."""
    random, values = np.random.default_rng(seed), {}
    for p in effect.parameters:
        v = p.variable
        if p.kind == "choice":
            values[v.name] = 2
        elif p.kind == "shape":
            values[v.name] = min(max(float(v.start) * random.uniform(0.3, 3.0) + random.uniform(0.0, 0.2), v.minimum), v.maximum)
    return values


def outputs(table, record) -> dict[str, np.ndarray]:
    return {v.name: np.array(record[v.name]) for v in table.of_role("output")}


def run(table, fidelity=0, **values):
    """Outputs after a few communication steps."""
    records = records_of(table, fidelity=fidelity, **values)
    assert plant.initialise(records) == 0
    step = crank_period(records) / 40.0 if fidelity == 0 else 2e-5
    found = []
    for i in range(POSITIONS if fidelity == 0 else 2):
        assert plant.step(records, i * step, step) == 0
        found.append(outputs(table, only(records)))
    return found


def same(a, b) -> bool:
    return all(np.array_equal(x[name], y[name], equal_nan=True) for x, y in zip(a, b) for name in x)


@pytest.fixture(scope="module")
def still(rv20e):
    return run(rv20e.plant)


@pytest.mark.parametrize("name", PLANT)
def test_plant_is_the_same_to_the_last_bit(rv20e, still, name):
    assert same(still, run(rv20e.plant, **other_shapes(PLANT[name])))


def test_motion_is_the_same_to_the_last_bit(rv20e):
    every = {k: v for effect in PLANT.values() for k, v in other_shapes(effect).items()}
    assert same(run(rv20e.plant, fidelity=1), run(rv20e.plant, fidelity=1, **every))


@pytest.fixture(scope="module")
def forces(rv20e):
    """The plant's records over some steps, for the wear unit."""
    records = records_of(rv20e.plant)
    assert plant.initialise(records) == 0
    step, found = crank_period(records) / 40.0, []
    for i in range(POSITIONS):
        assert plant.step(records, i * step, step) == 0
        found.append(records.copy())
    return step, found


def wear(table, forces, **values):
    step, series = forces
    records = records_of(table, acceleration=1e6, **values)
    exchange(series[0], records, SHARED)
    assert accumulator.initialise(records) == 0
    for machine in series[1:]:
        exchange(machine, records, SHARED)
        assert accumulator.step(records, 0.0, step) == 0
    return [outputs(table, only(records))]


@pytest.mark.parametrize("name", WEAR)
def test_wear_is_the_same_to_the_last_bit(rv20e, forces, name):
    assert same(wear(rv20e.wear, forces), wear(rv20e.wear, forces, **other_shapes(WEAR[name])))


@pytest.mark.parametrize("name", CHAIN)
@pytest.mark.parametrize("quantity", ["transmission_error", "input_torque"])
def test_sensor_is_the_same_to_the_last_bit(name, quantity):
    angle = np.linspace(0.0, 6.0, 50)
    values = np.sin(3.0 * angle)
    record = Record("", quantity, "", "", 1, values, {"angle": angle}, {})
    assert np.array_equal(MODULES[name].change(values, record, lambda p: 0.0, 1.0), values)


@pytest.mark.parametrize("effect", [*PLANT.values(), *WEAR.values(), *CHAIN.values()], ids=lambda e: e.title)
def test_declaration_is_complete(effect):
    """Something that vanishes, bounds round it, and words for all of it."""
    assert effect.amplitudes()
    for p in effect.parameters:
        v = p.variable
        assert v.minimum <= float(v.start) <= v.maximum and v.description and v.source
        assert all(v.minimum <= g <= v.maximum for g in p.grid)
        if p.kind == "amplitude":
            assert v.minimum <= float(v.start) + (p.sign or 1) * p.scale <= v.maximum
    assert effect.law and effect.source and effect.signature
