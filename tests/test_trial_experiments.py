"""Criteria for the next experiment in closed form, and the random one drawn from all that a rig can do."""

import json

import numpy as np
import pytest

from benchmarks.blind_trial import experiments
from benchmarks.blind_trial.criteria import CRITERIA, Prediction, buzzi_ferraris, hunter_reiner, jensen_renyi, reduced
from benchmarks.blind_trial.generator.make import Task, drawn
from benchmarks.blind_trial.results import KINDS, finished, pack, peers_in, resolved, unpack
from benchmarks.blind_trial.words import ABOUT, BESIDE, EXPERIMENTS, RESULTS, SEALS

RNG = np.random.default_rng(4)
NONE = np.zeros((30, 0))


def two(difference, first=NONE, second=NONE) -> list[Prediction]:
    start = RNG.standard_normal(len(difference))
    return [Prediction(start, first), Prediction(start + difference, second)]


def test_hunter_reiner_is_the_squared_difference():
    d = RNG.standard_normal(30)
    spread = RNG.standard_normal((30, 2))
    # Two equal weights of one half each.
    assert hunter_reiner(two(d)) == pytest.approx(0.25 * d @ d)
    assert hunter_reiner(two(d, spread, spread)) == pytest.approx(0.25 * d @ d)


def test_buzzi_ferraris_is_half_of_that_where_parameters_are_known():
    d = RNG.standard_normal(30)
    assert buzzi_ferraris(two(d)) == pytest.approx(0.5 * hunter_reiner(two(d)))


def test_buzzi_ferraris_as_written_with_all_samples():
    d, a, b = RNG.standard_normal(30), RNG.standard_normal((30, 2)), RNG.standard_normal((30, 3))
    inverse = np.linalg.inv(2.0 * np.eye(30) + a @ a.T + b @ b.T)
    assert buzzi_ferraris(two(d, a, b)) == pytest.approx(0.25 * (d @ inverse @ d + 2.0 * np.trace(inverse) - 30.0))


def test_a_difference_that_parameters_swallow_is_worth_little():
    d = RNG.standard_normal(30)
    assert buzzi_ferraris(two(d, 100.0 * d[:, None])) < 0.01 * hunter_reiner(two(d))


def test_jensen_renyi_of_equal_and_of_far_predictions():
    d = RNG.standard_normal(30)
    assert jensen_renyi(two(0.0 * d, d[:, None], d[:, None])) == pytest.approx(0.0, abs=1e-9)
    # Two that never overlap are one bit apart.
    assert jensen_renyi(two(100.0 * d)) == pytest.approx(np.log(2.0))
    by_hand = -np.log(0.5 + 0.5 * np.exp(-0.25 * d @ d))
    assert jensen_renyi(two(d)) == pytest.approx(by_hand)


def test_what_rivals_have_in_common_counts_nothing():
    d = RNG.standard_normal(30)
    few = reduced(two(d, d[:, None]))
    assert [len(r.mean) for r in few] == [1, 1]
    assert sum(r.weight for r in few) == pytest.approx(1.0)


def test_random_experiments_are_all_over_what_the_rig_can_do():
    made = drawn(Task(1, 5, "effect", ("drag of seals and grease",), 12.0, "tiny"))
    rng = np.random.default_rng(0)
    found = [experiments.at_random(made, rng) for _ in range(200)]
    assert {s.quantity for s in found} == {"transmission_error", "hysteresis", "input_torque"}
    loads = np.array([s.setting.load for s in found])
    assert loads.min() < 35.0
    assert loads.max() > 235.0
    assert {s.setting.direction for s in found} == {1, -1}
    assert all(283.0 < s.setting.temperature < 334.0 for s in found)
    # Nothing of the trial's reducers wears but what is measured as wear.
    assert all(s.setting.hours == 0.0 for s in found)


def test_random_wear_is_measured_after_hours():
    made = drawn(Task(1, 5, "effect", ("surfaces that tire",), 12.0, "small"))
    rng = np.random.default_rng(0)
    found = [experiments.at_random(made, rng) for _ in range(50)]
    assert all((s.setting.hours > 0.0) == (s.quantity == "wear_depth") for s in found)


def test_further_cases_are_fixed_and_small():
    tasks = experiments.more_tasks()
    first = [next(tasks) for _ in range(5)]
    again = experiments.more_tasks()
    assert first == [next(again) for _ in range(5)]
    assert all(t.size in ("small", "poor") and t.kind == "effect" for t in first)


def test_shares_by_who_chose(tmp_path):
    def line(number, **resolves):
        return json.dumps({"number": number, **{k.replace("_", "-"): {"resolved": v} for k, v in resolves.items()}})

    rows = [line(1, proposed=True, random=False), line(2, proposed=True, random=True), json.dumps({"number": 3, "verdict": "nothing is left"})]
    (tmp_path / EXPERIMENTS).write_text("\n".join(rows) + "\n", encoding="utf-8")
    shares = resolved(tmp_path)
    assert (shares["proposed"]["count"], shares["random"]["count"], shares["random"]["of"]) == (2, 1, 2)
    assert tuple(shares) == KINDS == ("proposed", "random", *CRITERIA)


def test_what_is_packed_is_there_again(tmp_path):
    before, after = tmp_path / "before", tmp_path / "after"
    before.mkdir()
    lines = {RESULTS: {"number": 7, "verdict": "none"}, BESIDE: {"number": 7, "peers": {"BIC": ["drag"]}}, EXPERIMENTS: {"number": 7, "proposed": {"resolved": True}}}
    for name, line in lines.items():
        (before / name).write_text(json.dumps(line) + "\n", encoding="utf-8")
    (before / ABOUT).write_text('{"seed": 1}', encoding="utf-8")
    (before / SEALS).write_text("0 sha256\n", encoding="utf-8")
    pack(before, tmp_path / "packed")
    unpack(after, tmp_path / "packed")
    assert finished(after) == finished(before)
    assert peers_in(after) == {7: {"BIC": ["drag"]}}
    assert resolved(after)["proposed"]["count"] == 1
