"""The repetition that stands out is named with its size, and none where there is only noise."""

import json
from dataclasses import replace

import numpy as np
import pytest

from cli.main import main
from discrepancy.campaign.repetition_words import copied_words, what_is_done, words
from discrepancy.inference.noise.replicates import deviations_of
from discrepancy.outlying_samples import marked, outlying_samples
from discrepancy.problem import Record
from discrepancy.repetitions import copies, outlying, with_left_out

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
    assert 13.0 < found.low / ARCMIN < 15.0 and 22.0 < found.high / ARCMIN < 24.5 and found.left_out and found.weight == 0.0
    assert words(found).startswith("run ramp_3 (replicate 3, of 5 repetitions of hysteresis[locked=output] at locked) spans 11")
    assert "arcmin, the others 14" in words(found)


def test_few_repetitions_are_judged_with_care():
    assert [o.run for o in outlying(loops((14.0, 23.0, 111.0), 0.3))] == ["ramp_3"]
    # Three that spread evenly are noise; two near each other make no third one far.
    assert not outlying(numbers((1.0, 2.0, 3.5))) and not outlying(numbers((10.0, 10.001, 10.1)))
    assert [o.run for o in outlying(numbers((10.0, 11.0, 40.0)))] == ["c2"]


def test_a_number_is_left_out_beyond_what_chance_makes_of_such_scatter():
    """With a scatter of 50 % one of three numbers was left out in 19 of 100 campaigns; with one of 10 % or less in hardly any, before as now."""
    assert not outlying(numbers((10.0, 15.0, 12.0, 22.0, 9.0)))
    (doubtful,) = outlying(numbers((10.0, 11.0, 40.0)))
    assert not doubtful.left_out and what_is_done(doubtful).startswith("of so few that differ so chance makes one like it now and then, so that all count")
    assert [o.left_out for o in outlying(numbers((10.0, 10.05, 40.0)))] == [True] and [o.left_out for o in outlying(numbers((10.0, 11.0, 9.0, 10.5, 40.0)))] == [True]
    # Other conditions tell of the scatter, too.
    others = [r for k in range(6) for r in numbers((10.0, 11.0, 9.0), f"o{k}")]
    assert [(o.run, o.left_out) for o in outlying([*others, *numbers((10.0, 11.0, 40.0))])] == [("c2", True)]
    rng = np.random.default_rng(1)
    for count, law in ((3, "normal"), (5, "normal"), (8, "normal"), (4, "lognormal"), (8, "lognormal")):
        groups = [np.abs(1.0 + 0.5 * z) if law == "normal" else np.exp(0.5 * z) for z in rng.standard_normal((400, count))]
        assert np.mean([any(o.left_out for o in outlying(numbers(g))) for g in groups]) < 0.015


def depths(rng, depth, condition, noise=0.045):
    """Three inspections of three hours, of a surface worn so deep [um]; an instrument's noise has tails."""
    return [Record(f"{condition}{k}", "wear_depth", "m", condition, k + 1, 1e-6 * (depth * np.array([0.3, 0.6, 1.0]) + noise * rng.standard_t(5, 3)),
                   {"hours": np.array([1.0, 2.0, 3.0])}, {}, tags={"surface": condition}) for k in range(3)]  # fmt: skip


def test_small_numbers_scatter_as_large_ones():
    """Of shallow wear two inspections agree to a hundredth of their noise now and then, and the third, 2 times its noise off, was left out."""
    rng = np.random.default_rng(4)
    campaigns = [[r for k in range(8) for r in depths(rng, 0.02 * 2.0**k, f"s{k}")] for _ in range(100)]
    assert np.mean([any(o.left_out for o in outlying(records)) for records in campaigns]) <= 0.06
    wrong = [replace(r, values=4.0 * r.values) if r.name == "s71" else r for r in campaigns[0]]
    assert [(o.run, o.left_out) for o in outlying(wrong) if o.left_out] == [("s71", True)]


def test_of_two_that_are_at_odds_nobody_knows_which_is_wrong():
    """Both count, and it is said; an even pair, or one within what is stated of its noise, is none."""
    runs = loops((14.0, 111.0))
    (found,) = outlying(runs)
    assert found.run == "ramp_2" and found.other == "ramp_1" and not found.left_out and found.weight == 1.0
    assert not any(r.left_out for r in with_left_out(runs, [found]))
    assert words(found).endswith("spans 112 arcmin, the other, ramp_1, 14") and what_is_done(found).startswith("which of the two is wrong cannot be told")
    assert not outlying(loops((14.0, 20.0))) and not outlying(numbers((1.0, 2.5)))
    assert not outlying([replace(r, stated_noise=ARCMIN) for r in numbers((1.0, 3.5))])
    # Where all other pairs agree to 2 %, half as large is no noise.
    pairs = [r for k in range(12) for r in numbers((10.0, 10.0 + 0.02 * (k - 6)), f"p{k}")]
    assert not outlying(pairs) and [(o.run, o.left_out) for o in outlying(pairs + numbers((10.0, 15.0), "x"))] == [("x1", False)]


def test_as_many_that_stand_out_as_do_not_all_count():
    """Two sizes may each blame another run: then nobody knows which half is right; and something has to be left to fit."""
    wave = np.sin(np.linspace(0.0, 2.0 * np.pi, 200))
    runs = [Record(f"m{k}", "input_torque", "N.m", "c", k, mean + size * wave, {"time": np.arange(200.0)}, {})
            for k, (mean, size) in enumerate(((10.0, 1.0), (40.0, 1.0), (10.0, 1.0), (10.0, 4.0)))]  # fmt: skip
    assert {o.run: (o.what, o.left_out) for o in outlying(runs)} == {"m1": ("mean", False), "m3": ("span", False)}
    assert what_is_done(outlying(runs)[0]).startswith("which of them, of which as many stand out as do not, is wrong cannot be told")
    alone = [replace(r, held_out=r.name != "ramp_3") for r in loops((14.0, 18.0, 111.0, 23.0, 16.0), 0.3)]
    assert [(o.run, o.left_out) for o in outlying(alone)] == [("ramp_3", False)]


@pytest.mark.parametrize("kind", ["noise", "gain", "offset"])
def test_many_conditions_of_three_lose_no_run_by_chance(kind):
    """Of three one is the median itself: what is usual was too small, and with 15 of them every second campaign lost a run."""
    rng = np.random.default_rng(1)
    way = np.linspace(-1.0, 1.0, 60)

    def run(condition, k):
        size = {"noise": 0.0, "gain": 50.0 * (1.0 + 0.1 * rng.standard_normal()), "offset": 5.0}[kind]
        values = size * way + 0.4 * rng.standard_normal(60) + (3.0 * rng.standard_normal() if kind == "offset" else 0.0)
        return Record(f"{condition}_{k}", "input_torque" if kind == "offset" else "hysteresis", "1", f"{condition}", k, values, {"torque": way}, {})

    campaigns = [[run(c, k) for c in range(6) for k in range(3)] for _ in range(60)]
    assert np.mean([bool(outlying(records)) for records in campaigns]) < 0.06


def test_a_loop_that_went_less_far_and_a_later_inspection_are_no_bad_files():
    whole = loops((20.0, 20.1, 19.9, 20.05), 0.01)
    half = loops((20.0,), 0.01)[0]
    small = replace(half, name="half", values=0.3 * half.values, axes={"torque": 0.3 * half.axes["torque"]})
    assert not outlying([*whole, small])
    grown = [replace(r, axes={"hours": np.array([3.6e6 * k])}) for k, r in enumerate(numbers((1.0, 1.1, 1.2, 9.0)))]
    assert not outlying(grown)


def test_a_zero_that_jumps_by_less_than_a_run_spans_makes_no_bad_file():
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    def runs(*means):
        return [Record(f"te_{k}", "input_torque", "N.m", "c", k, m + np.sin(angle) + 0.001 * k * np.cos(7 * angle), {"angle": angle}, {})
                for k, m in enumerate(means)]  # fmt: skip
    assert not [o for o in outlying(runs(0.1, 0.11, 0.4)) if o.what == "mean"]
    assert [(o.run, o.what) for o in outlying(runs(1.0, 1.01, 4.0))] == [("te_2", "mean")]


def test_all_conditions_say_what_deviation_is_usual():
    quiet = [r for k in range(4) for r in numbers(10.0 + 0.1 * np.array((-1.0, 0.3, 1.0, 0.1)), f"q{k}")]
    assert [o.run for o in outlying(quiet + numbers((10.0, 10.1, 13.0), "x"))] == ["x2"]


def test_same_torques_show_another_shape():
    runs = loops((20.0,) * 4, 0.2, shifted=False)
    runs[1].values[:] = runs[1].values[::-1] + ARCMIN * np.where(TORQUE > 5.0, 3.0, 0.0)
    assert [(o.run, o.what) for o in outlying(runs)] == [("ramp_2", "departure")]


@pytest.mark.parametrize("count", [3, 4, 5, 8])
def test_a_drift_that_differs_from_run_to_run_is_no_other_shape(count):
    """One in four groups lost a run to its departure: drifts scatter like numbers, and what they scatter by is the noise."""
    rng = np.random.default_rng(count)
    groups = []
    for _ in range(200):
        runs = loops((40.0,) * count, 0.2, int(rng.integers(1e6)), shifted=False)
        groups.append([replace(r, values=r.values + 0.6 * ARCMIN * rng.standard_normal() * np.linspace(-1.0, 1.0, len(TORQUE))) for r in runs])
    assert np.mean([bool(outlying(g)) for g in groups]) < 0.02


@pytest.mark.parametrize("count", [3, 4, 5, 8])
def test_noise_is_seldom_taken_for_a_fault(count):
    rng = np.random.default_rng(count)
    groups = [numbers(10.0 + rng.standard_normal(count), "n") for _ in range(400)] + [loops(20.0 + rng.standard_normal(count), 1.0, k) for k in range(100)]
    assert np.mean([bool(outlying(g)) for g in groups]) < 0.02


def test_a_series_that_agrees_to_the_last_digit_is_a_copy():
    runs = loops((20.0, 21.0, 22.0), 0.1)
    runs[2] = replace(runs[0], name="ramp_3", replicate=3)
    assert copies(runs) == {"ramp_3": "ramp_1"}
    # In another condition it repeats nothing; other torques are another measurement.
    assert not copies([runs[0], runs[1], replace(runs[2], condition="free")])
    assert not copies([runs[0], replace(runs[2], axes={"torque": runs[1].axes["torque"]})])


def test_few_numbers_may_agree_by_chance():
    assert not copies(numbers((1.0, 1.0, 1.2)))
    assert not copies(numbers((1.0, 1.0), "a") + numbers((1.0, 1.1), "b"))
    assert copies(numbers((1.0, 1.0), "a") + numbers((2.0, 2.0), "b") + numbers((3.0,), "c")) == {"a1": "a0", "b1": "b0"}
    assert not copies([replace(r, stated_noise=1e-5) for r in numbers((1.0, 1.0))])


def test_a_file_that_was_copied_counts_once_and_is_said(tmp_path, capsys):
    """No noise of nothing, no warnings of numerics: check, from and compare say what it is."""
    for k in (1, 2):
        rows = "".join(f"{t:.3f},{t / 45 + 0.2 * np.sin(t):.4f}\n" for t in 167 * np.sin(np.linspace(0, 2.5 * np.pi, 200)))
        (tmp_path / f"loop_{k}.csv").write_text(f"torque [N.m],twist [arcmin]\n{rows}")
    said = "runs loop_1 and loop_2 hold the same numbers: a copy is no repetition"
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--tag", "locked=input"]) == 0
    assert said in " ".join(capsys.readouterr().out.split())
    # compare and diagnose take the noise of one loop from its own scatter.
    assert main(["campaign", "check", str(tmp_path)]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert said in shown and "no run is repeated and no noise is stated" in shown
    assert main(["compare", "RV20E-121", str(tmp_path), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [run["run"] for run in told["runs"]] == ["loop_1"] and 0.1 < told["runs"][0]["ratio"] < 1e3
    assert any(said in warning for warning in told["warnings"])


def test_copies_are_named_together():
    text, _ = copied_words({"a2": "a1", "a3": "a1"} | {f"{n}2": f"{n}1" for n in "bcdef"})
    assert text.startswith("runs a1 and a2 and a3; b1 and b2; c1 and c2; d1 and d2; and 2 more like them hold the same numbers")


def errors(noise, spikes=(), runs=2, samples=600, shape=0.0, seed=3):
    """Transmission errors [rad] at the same angles; ``spikes`` are (run, sample, size), ``shape`` the size of a cusp that all runs have."""
    rng = np.random.default_rng(seed)
    angle = np.linspace(0.0, 2.0 * np.pi, samples, endpoint=False)
    curve = 5.0 * np.sin(39.0 * angle) + shape * np.maximum(0.0, 1.0 - np.abs(angle - 2.0) / 0.002)
    found = []
    for k in range(runs):
        values = curve + noise * rng.standard_normal(samples)
        for run, sample, size in spikes:
            values[sample] += size * (run == k)
        found.append(Record(f"te_{k + 1}", "transmission_error", "rad", "rated", k + 1, values, {"angle": angle}, {"load": 167.0}))
    return found


@pytest.mark.parametrize("runs", [1, 2, 3])
def test_sample_far_off_is_found_in_the_run_that_has_it(runs):
    (found,) = outlying_samples(errors(0.1, [(runs - 1, 200, 45.0)], runs, 4000))
    assert found.run == f"te_{runs}" and found.rows == (200,) and found.samples == 4000
    assert found.off[0] == pytest.approx(45.0, abs=0.6) and found.noise == pytest.approx(0.1, rel=0.3) and 300.0 < found.times[0] < 650.0


def test_what_noise_or_the_reducer_does_is_no_sample_far_off():
    rng = np.random.default_rng(5)
    assert not any(outlying_samples(errors(noise, runs=runs, seed=int(rng.integers(1000)))) for noise in (0.0, 0.1) for runs in (1, 2, 3) for _ in range(40))
    # One sample wide, but in both runs: a fault of a tooth.
    assert not outlying_samples(errors(0.1, [(0, 200, 45.0), (1, 200, 45.0)], 2, 4000))
    # Noise of an instrument that slips often is another kind of noise; an impact is a vibration's own.
    assert not outlying_samples(errors(0.1, [(0, k, 45.0) for k in range(10, 590, 20)], 1))
    assert not outlying_samples([replace(r, quantity="vibration", axes={"time": r.axes["angle"]}) for r in errors(0.1, [(1, 200, 45.0)], 2, 4000)])


def test_noise_of_a_sample_is_never_less_than_a_step_of_its_display():
    runs = errors(0.02, [(1, 200, 45.0)], 2, 4000)
    (found,) = outlying_samples([replace(r, values=np.round(r.values / 0.1) * 0.1) for r in runs])
    assert found.rows == (200,) and found.noise > 0.02


def test_records_are_marked_with_their_samples_far_off_and_else_stay_as_they_are():
    records = [*errors(0.1, [(1, 200, 45.0)]), *numbers((10.0, 11.0))]
    found = marked(records)
    assert [r.far_off for r in found] == [(), (200,), (), ()] and not found[1].counted[200] and found[1].counted.sum() == 599
    assert all(a is b for a, b in zip(found, records) if not a.far_off)


@pytest.mark.parametrize("lacking", [0, 1, 9])
def test_samples_that_one_run_lacks_are_no_noise_of_what_the_model_leaves(lacking):
    """Runs that lacked as many samples, at other angles, were held against each other row by row: 2 % more noise, 7 % beside a steeper misfit."""
    rng, angle = np.random.default_rng(0), np.linspace(0.0, 2.0 * np.pi, 1800, endpoint=False)
    misfit, runs = 3.0 * np.sin(300.0 * angle), []
    for k in range(2):
        there = np.ones(angle.size, bool)
        there[rng.choice(angle.size, lacking, replace=False)] = False
        y = (misfit + rng.standard_normal(angle.size))[there]
        runs.append(Record(f"run {k}", "transmission_error", "rad", "c", k, y, {"angle": angle[there]}, {"speed": 1.0, "load": 1.0}))
    found = deviations_of(runs, [r.values for r in runs], [np.ones(len(r.values), bool) for r in runs], [0, 1])
    assert np.std(found[0].values) == pytest.approx(1.0, abs=0.02) and found[0].rows.size >= 1800 - 4 * lacking
