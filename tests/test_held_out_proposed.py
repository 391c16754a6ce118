"""A held-out condition is proposed of every quantity that has enough conditions, inside the range of its others."""

import pytest

from discrepancy.campaign.guess.conditions import held_out


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
