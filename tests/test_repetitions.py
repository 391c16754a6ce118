"""The repetition that stands out is named with its size, and none where there is only noise."""

import numpy as np
import pytest

from discrepancy.campaign.repetition_words import words
from discrepancy.problem import Record
from discrepancy.repetitions import outlying

ARCMIN = np.pi / 180.0 / 60.0
TORQUE = 20.0 * np.concatenate([np.linspace(0.0, 1.0, 30), np.linspace(1.0, -1.0, 60), np.linspace(-1.0, 0.0, 30)])


def loops(spans, noise=0.0, seed=0, shifted=True):
    """Loops of so many arcmin from end to end, sampled at torques of their own, counted from anywhere."""
    rng = np.random.default_rng(seed)
    found = []
    for k, span in enumerate(spans):
        torque = TORQUE + (0.1 * rng.standard_normal(len(TORQUE)) if shifted else 0.0)
        values = span * ARCMIN * torque / 40.0 + ARCMIN * (noise * rng.standard_normal(len(torque)) + 50.0 * rng.standard_normal())
        found.append(Record(f"ramp_{k + 1}", "hysteresis", "rad", "locked", k + 1, values, {"torque": torque}, {}, tags={"locked": "output"}))
    return found


def numbers(values, condition="c"):
    return [Record(f"{condition}{k}", "lost_motion", "rad", condition, k + 1, np.array([v * ARCMIN]), {}, {}) for k, v in enumerate(values)]


def test_one_of_five_loops_stands_out():
    (found,) = outlying(loops((14.0, 18.0, 111.0, 23.0, 16.0), 0.3))
    assert found.run == "ramp_3" and found.what == "span" and found.size / ARCMIN == pytest.approx(111.0, rel=0.05)
    assert 13.0 < found.low / ARCMIN < 15.0 and 22.0 < found.high / ARCMIN < 24.5 and found.weight < 0.3
    assert words(found).startswith("run ramp_3 (replicate 3, of 5 repetitions of hysteresis[locked=output] at locked) spans 11")
    assert "arcmin, the others 14" in words(found)


def test_few_repetitions_are_judged_with_care():
    assert [o.run for o in outlying(loops((14.0, 23.0, 111.0), 0.3))] == ["ramp_3"]
    # Of two nobody knows which is wrong; three that spread evenly are noise; two near each other make no third one far.
    assert not outlying(loops((14.0, 111.0)))
    assert not outlying(numbers((1.0, 2.0, 3.5))) and not outlying(numbers((10.0, 10.001, 10.1)))
    assert [o.run for o in outlying(numbers((10.0, 11.0, 40.0)))] == ["c2"]


def test_all_conditions_say_what_deviation_is_usual():
    quiet = [r for k in range(4) for r in numbers(10.0 + 0.1 * np.array((-1.0, 0.3, 1.0, 0.1)), f"q{k}")]
    assert [o.run for o in outlying(quiet + numbers((10.0, 10.1, 13.0), "x"))] == ["x2"]


def test_same_torques_show_another_shape():
    runs = loops((20.0,) * 4, 0.2, shifted=False)
    runs[1].values[:] = runs[1].values[::-1] + ARCMIN * np.where(TORQUE > 5.0, 3.0, 0.0)
    assert [(o.run, o.what) for o in outlying(runs)] == [("ramp_2", "departure")]


@pytest.mark.parametrize("count", [3, 4, 5, 8])
def test_noise_is_seldom_taken_for_a_fault(count):
    rng = np.random.default_rng(count)
    groups = [numbers(10.0 + rng.standard_normal(count), "n") for _ in range(400)] + [loops(20.0 + rng.standard_normal(count), 1.0, k) for k in range(100)]
    assert np.mean([bool(outlying(g)) for g in groups]) < 0.02
