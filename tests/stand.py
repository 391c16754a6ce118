"""A test stand: puts plant and wear records into a known situation and runs them."""

import numpy as np

from rv_plant import plant
from rv_plant.faults import FAULTS
from rv_reducer.exchange import PLANT_TO_WEAR, WEAR_TO_PLANT
from wear_fmu import accumulator

# What a plant without running totals gives, and what ours gives and gets (the temperature stays as it is).
SHARED = ("crank_angle", "crank_speed", "output_angle", "cage_angle", "mesh_force", "roller_force")
GIVEN = tuple(name.replace(".", "_") for name in PLANT_TO_WEAR if not name.startswith("heat."))
BACK = tuple(name.replace(".", "_") for name in WEAR_TO_PLANT)
ARCSEC = np.degrees(1.0) * 3600.0


def records_of(table, **values):
    """A one-element record array with other values than the start values; fields are attributes, also for plain Python."""
    records = table.new_records().view(np.recarray)
    for name, value in values.items():
        records[name] = value
    return records


def only(records):
    """The one record, with its fields as attributes."""
    return records.view(np.recarray)[0]


def in_equilibrium(table, angle=0.0, cage=0.0, **values):
    """The plant's record in equilibrium at an ideal output angle and a cage angle [rad]."""
    records = records_of(table, ideal_output=angle, cage=cage, **values)
    status = plant.initialise(records)
    assert status == 0, FAULTS[status]
    return only(records)


def imperfect(table, seed, size=1.5e-6):
    """Random values of every error of a part, up to ``size`` [m] (angles as at the crank circle)."""
    random, values = np.random.default_rng(seed), {}
    for variable in table.of_role("parameter"):
        # Effects have scalars; errors of single parts are arrays.
        if variable.shape and variable.name.endswith(("_error", "_error_radial", "_error_tangential")):
            largest = size / 28e-3 if variable.unit == "rad" else size
            values[variable.name] = random.uniform(-largest, largest, variable.shape)
    return values


def crank_period(records):
    """Time of one turn of the cranks [s]."""
    return 2.0 * np.pi / abs(float(records["crank_speed"][0]))


def run_plant(table, turns=1, steps_per_turn=72, **values):
    """Steps through turns of the cranks and yields the record after each step."""
    records = records_of(table, **values)
    assert plant.initialise(records) == 0
    step = crank_period(records) / steps_per_turn
    for i in range(turns * steps_per_turn):
        status = plant.step(records, i * step, step)
        assert status == 0, (i, FAULTS[status])
        yield only(records)


def run_coupled(reducer, hours, turns=39, steps_per_turn=72, **values):
    """Plant and wear stepped together through turns of the cranks that stand for ``hours``.

    ``values`` go to each of the two units that has a variable of the name.
    """
    machine, surface = pair_of(reducer, **values)
    assert plant.initialise(machine) == 0
    step = crank_period(machine) / steps_per_turn
    count = turns * steps_per_turn
    surface["acceleration"] = hours * 3600.0 / (count * step)
    for _ in steps_together(machine, surface, step, count):
        pass
    return only(machine), only(surface)


def pair_of(reducer, **values):
    """Records of plant and wear; ``values`` go to each of the two that has a variable of the name."""
    ours = [{k: v for k, v in values.items() if k in t.by_name} for t in (reducer.plant, reducer.wear)]
    return tuple(records_of(t, **v) for t, v in zip((reducer.plant, reducer.wear), ours))


def steps_together(machine, surface, step, count):
    """Initialises the wear unit of an initialised plant and steps both; yields after each step [s]."""
    exchange(machine, surface, GIVEN)
    assert accumulator.initialise(surface) == 0
    for i in range(count):
        assert plant.step(machine, i * step, step) == 0
        exchange(machine, surface, GIVEN)
        assert accumulator.step(surface, i * step, step) == 0
        exchange(surface, machine, BACK)
        yield


def exchange(source, target, names):
    for name in names:
        target[name] = source[name]


def gradient(function, place, lengths):
    """Rows d(function)/d(place[i]) by central differences of fourth order."""
    rows = []
    for i, length in enumerate(lengths):
        away = np.zeros_like(place)
        away[i] = length
        near = function(place + away) - function(place - away)
        far = function(place + 2.0 * away) - function(place - 2.0 * away)
        rows.append((8.0 * near - far) / (12.0 * length))
    return np.array(rows)


def in_motion(table, **values):
    """The plant's records with fidelity = dynamic, initialised."""
    records = records_of(table, fidelity=1, **values)
    status = plant.initialise(records)
    assert status == 0, FAULTS[status]
    return records


def run_motion(records, duration, count):
    """Copies of the record after each of ``count`` equal communication steps through ``duration`` [s]."""
    series = []
    for i in range(count):
        status = plant.step(records, i * duration / count, duration / count)
        assert status == 0, (i, FAULTS[status])
        series.append(only(records).copy())
    return series
