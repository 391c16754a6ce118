"""A held-out condition is proposed of every quantity that has enough conditions, inside the range of its others."""

import pytest

from discrepancy.campaign.guess.held_out import held_out


def loads(*numbers):
    return {f"L{n}": {"load_torque": f"{n} N.m"} for n in numbers}


def temperatures(*numbers):
    return {f"T{n}": {"temperature": f"{n} degC"} for n in numbers}


@pytest.mark.parametrize("conditions, quantities, kept", [
    # Each quantity its own.
    (loads(50, 100, 130, 167) | temperatures(20, 40, 60), {"L": ["te"], "T": ["drag"]}, ["L100", "T40"]),
    # Two are too few.
    (loads(50, 100, 130, 167) | temperatures(20, 45), {"L": ["te"], "T": ["loop"]}, ["L100"]),
    # A condition that loops share with friction is kept for fitting: they have two only.
    (temperatures(20, 45, 40, 60), {"T20": ["loop", "drag"], "T45": ["loop"], "T": ["drag"]}, ["T40"]),
    (temperatures(20, 40, 60, 50), {"T40": ["loop", "drag"], "T50": ["loop"], "T": ["drag"]}, []),
    # One serves both.
    (temperatures(20, 40, 60), {"T": ["loop", "drag"]}, ["T40"]),
    (temperatures(10, 20, 40, 60, 80), {"T10": ["drag"], "T80": ["drag"], "T": ["loop", "drag"]}, ["T40"]),
    # Nothing says what lies inside.
    ({"a": {}, "b": {}, "c": {}}, {"a": ["te"], "b": ["te"], "c": ["te"]}, ["c"]),
])  # fmt: skip
def test_of_every_quantity_one_inside(conditions, quantities, kept):
    measured = {name: quantities.get(name) or quantities[name[0]] for name in conditions}
    assert list(held_out(conditions, measured)) == kept


def bench(*states):
    """Conditions of one quantity, each (load, speed, temperature)."""
    return {f"{load}_{speed}_{temperature}": {"input_speed": f"{speed} rpm", "load_torque": f"{load} N.m", "temperature": f"{temperature} degC"}
            for load, speed, temperature in states}  # fmt: skip


@pytest.mark.parametrize("states, repeated, kept, reason", [
    # The second load stays, and so do the repetitions.
    ([(167, 1500, 25), (167, 500, 25), (80, 1500, 25)], 0, 1, "its load within the others', only its speed beyond"),
    ([(167, 500, 25), (167, 1500, 25), (80, 1500, 25)], 0, 1, "inside the range of the others"),
    # Where nothing is repeated, nothing of that is lost.
    ([(167, 1500, 25), (167, 500, 25), (80, 1500, 25)], None, 0, "inside the range of the others"),
    # The load counts more than the temperature, that more than the speed.
    ([(167, 1500, 25), (167, 1500, 45), (80, 1500, 25)], 0, 1, "its load within the others', only its temperature beyond"),
    ([(167, 1500, 25), (167, 500, 25), (167, 1500, 45), (80, 1500, 25)], 0, 1, "its load and temperature within the others', only its speed beyond"),
    ([(167, 1500, 25), (80, 1500, 25), (167, 500, 25), (167, 2000, 25)], 0, 3, "its load within the others', only its speed beyond"),
    # The loads about it would stay, but not the noise.
    ([(50, 1500, 25), (100, 1500, 25), (150, 1500, 25)], 1, None, ""),
])  # fmt: skip
def test_the_rest_keeps_its_loads_and_its_only_repetitions(states, repeated, kept, reason):
    conditions = bench(*states)
    names = list(conditions)
    found = held_out(conditions, {name: ["te"] for name in names}, {} if repeated is None else {names[repeated]: {"te"}})
    assert list(found) == ([] if kept is None else [names[kept]])
    assert [guess.reason for guess in found.values()] == ([] if kept is None else [f"kept for the test of what is found: {reason}"])


def test_of_places_at_which_the_input_was_locked_any_may_be_held_out_but_the_repeated_one():
    conditions = {f"{angle}g": {"locked_at": f"{angle} deg"} for angle in (0, 120, 240)}
    assert list(held_out(conditions, {name: ["hysteresis"] for name in conditions}, {"120g": {"hysteresis"}})) == ["240g"]
