"""Runs of two conditions that were interchanged are found, other differences of repetitions are none of that."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.campaign.repetition_words import interchanged_words
from discrepancy.interchanged import interchanged
from discrepancy.problem import Record

ARCSEC = np.pi / 648000.0
ANGLE = np.linspace(0.0, 2.0 * np.pi, 1800, endpoint=False)


def run(name, condition, replicate, amplitudes, seed, noise=0.5, shift=0.0, gain=1.0, drift=0.0):
    """A transmission error of orders with ``amplitudes`` [arcsec], noise that forgets in some samples, and a drift over the turn."""
    rng = np.random.default_rng(seed)
    white = rng.standard_normal(len(ANGLE) + 8)
    coloured = np.convolve(white, np.exp(-np.arange(8) / 2.0), "valid")[: len(ANGLE)]
    values = gain * sum(size * np.sin(order * (ANGLE + shift) + order) for order, size in amplitudes.items())
    values = values + noise * coloured / coloured.std() + drift * np.linspace(-1.0, 1.0, len(ANGLE)) ** 3 + 20.0 * rng.standard_normal()
    return Record(name, "transmission_error", "rad", condition, replicate, ARCSEC * values, {"angle": ANGLE}, {})


LOW, HIGH = {1: 3.0, 40: 2.0, 80: 1.0}, {1: 3.2, 40: 2.5, 80: 0.6}


def runs(repetitions=2, swap=(), **unlike):
    """Of two conditions; ``swap``: numbers of the runs whose files are taken for each other's; ``unlike``: of every run of the first."""
    low = [run(f"low_{k + 1}", "low", k + 1, LOW, k, **unlike) for k in range(repetitions)]
    high = [run(f"high_{k + 1}", "high", k + 1, HIGH, 100 + k) for k in range(repetitions)]
    if swap:
        i, k = swap
        low[i], high[k] = replace(low[i], values=high[k].values), replace(high[k], values=low[i].values)
    return [*low, *high]


def test_two_repetitions_each_tell_which_pair_or_the_other():
    (found,) = interchanged(runs(2, (0, 0)))
    assert set(found.runs) in ({"low_1", "high_1"}, {"low_2", "high_2"}) and set(found.runs) | set(found.or_else) == {"low_1", "low_2", "high_1", "high_2"}
    # Half of the squares of two amplitudes, of both runs.
    assert found.before / ARCSEC == pytest.approx(np.sqrt(0.5 * (0.5**2 + 0.4**2)), rel=0.15) and found.after < 0.3 * found.before


def test_first_and_second_repetition_are_only_taken_for_interchanged_if_a_third_condition_repeats_itself():
    made = runs(2, (0, 1))
    assert not interchanged(made)
    third = [run(f"third_{k}", "third", k, {40: 3.0, 80: 2.0}, 50 + k) for k in range(2)]
    (found,) = interchanged([*made, *third])
    assert set(found.runs) in ({"low_1", "high_2"}, {"low_2", "high_1"})
    # All second repetitions larger by a third: those of another day belong together.
    day = [run(f"{c}_{k}", c, k, {40: size}, 10 * n + k, gain=1.0 + 0.3 * k) for n, (c, size) in enumerate((("a", 2.0), ("b", 2.05), ("c", 2.1))) for k in range(2)]
    assert not interchanged(day)


def test_of_three_repetitions_it_is_known_which():
    (found,) = interchanged(runs(3, (2, 0)))
    assert found.runs == ("low_3", "high_1") and found.conditions == ("low", "high") and found.or_else is None


def test_it_is_said_with_what_to_do():
    class Placed:
        def place(self, run, what):
            return f" ({run}.csv)"

    (found,) = interchanged(runs(3, (2, 0)))
    text, remedy = interchanged_words(found, Placed())
    assert text.startswith("runs low_3 (low_3.csv) of low and high_1 (high_1.csv) of high look interchanged: each repeats the other condition's run; they differ by 0.")
    assert "arcsec from their own repetitions, exchanged by 0.0" in text and "file =" in remedy


@pytest.mark.parametrize("unlike", [{}, {"shift": 0.04}, {"gain": 1.3}, {"drift": 15.0}, {"noise": 3.0}], ids=str)
def test_what_repetitions_differ_by_otherwise_is_no_exchange(unlike):
    assert not interchanged(runs(2, **unlike))
    # In one run alone.
    first, *rest = runs(2)
    assert not interchanged([run("low_1", "low", 1, LOW, 0, **unlike), *rest])
    assert not interchanged([run("low_1", "low", 1, LOW, 0, **unlike), *rest[:2], run("high_2", "high", 2, HIGH, 101, **unlike)])


def test_a_zero_that_is_elsewhere_in_every_run_is_no_exchange():
    rng = np.random.default_rng(3)
    for _ in range(20):
        shifts = rng.uniform(-0.08, 0.08, 4)
        made = [run(f"{c}_{k}", c, k, {40: 2.0 + 0.1 * (c == "b")}, k + 7 * (c == "b"), shift=shifts[2 * (c == "b") + k]) for c in "ab" for k in range(2)]
        assert not interchanged(made), shifts


def test_chance_finds_none():
    """Of 400 pairs of conditions that hardly differ, or not at all."""
    for seed in range(400):
        sizes = {40: 2.0}, {40: 2.0 + 0.05 * (seed % 2)}
        made = [run(f"{c}{k}", c, k, sizes[c == "b"], 10 * seed + k + 5 * (c == "b")) for c in "ab" for k in range(2)]
        assert not interchanged(made), seed


def test_short_single_and_unlike_runs_are_passed_over():
    every = runs(2, (0, 0))
    assert not interchanged(every[1:]) and not interchanged([replace(r, values=r.values[:150], axes={"angle": ANGLE[:150]}) for r in every])
    assert not interchanged([replace(r, values=r.values[:-300], axes={"angle": ANGLE[:-300]}) if r.condition == "low" else r for r in every])
    # Repetitions of one condition may be of different lengths.
    assert not interchanged([replace(every[0], values=every[0].values[:-9], axes={"angle": ANGLE[:-9]}), *every[1:]])
