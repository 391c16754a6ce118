"""What is said against calibrated numbers, and what a step of the ladder leaves."""

import numpy as np
import pytest

from discrepancy.doubts.calibrated_doubts import calibrated_doubts, lag_doubts, softer_by_loops
from discrepancy.figures.key_figures import STIFFNESS, KeyFigure
from discrepancy.inference.base_fit.fit import fit_of
from discrepancy.ladder_step import step_of
from discrepancy.page.extension import model_page
from discrepancy.problem import Parameter, Record
from discrepancy.words.wording import signals_left


def doubts(value, deviation=0.01, name="lag_share", off=1.0, lower=0.0, upper=12.0, prior=None, records=()):
    """Of one number that is known to ``deviation``."""
    parameter = Parameter(name, "1", off, lower, upper, 1.0, prior=prior)
    return calibrated_doubts(fit_of((parameter,), {name: value}, np.zeros(100), np.full((100, 1), 0.1 / deviation)), (), records=records)


@pytest.mark.parametrize("value, words", [(4.7, "4.7 times as soft"), (0.02, 'angle_of = "input"'), (1.0, ""), (1.8, ""), (0.6, ""), (0.35, ""), (2.9, "")])
def test_a_lag_that_no_such_reducer_has_is_doubted(value, words):
    found = doubts(value)
    assert bool(found) == bool(words) and words in "".join(found)


def test_a_lag_that_hardly_lags_is_told_with_the_line_that_says_whose_angle_it_was():
    (text,) = doubts(0.02)
    assert 'state angle_of = "input" in [quantities.transmission_error] of campaign.toml' in text
    # Places of loops that count from the same zero may move with it.
    assert 'the angle is taken for that of the output (angle_of = "output")' in text and "either way" not in text and "may move" in text


@pytest.mark.parametrize("value, deviation", [(10.2, 6.0), (0.02, 1.0)])
def test_of_a_lag_that_is_hardly_known_another_load_is_asked_for(value, deviation):
    (text,) = doubts(value, deviation=deviation)
    assert f"= {value:.3g} (the model's own is 1) is no result" in text and f"known to {deviation:.2g} only" in text and "another load would tell the two apart" in text
    assert not doubts(2.4, deviation=deviation)


def run(load, mounting="1", held_out=False):
    return Record("r", "transmission_error", "rad", "c", 1, np.zeros(1), {"angle": np.zeros(1)}, {"load": load}, mounting=mounting, held_out=held_out, of_output=True)


@pytest.mark.parametrize("runs, alike", [
    ([run(20.0)], True), ([run(20.0), run(84.0, "2")], True), ([run(20.0), run(84.0, held_out=True)], True), ([run(20.0), run(84.0), run(160.0)], False),
])  # fmt: skip
def test_loads_are_called_alike_where_they_are(runs, alike):
    (text,) = doubts(10.2, deviation=6.0, records=runs)
    assert ("all fitted runs of a mounting are at one load" in text) == alike and ("at 3 loads (20, 84, 160 N.m)" in text) != alike


def test_numbers_at_bounds_and_far_from_what_is_known_are_doubted():
    assert "at a bound" in doubts(12.0, name="friction")[0] and not doubts(5.0, name="friction")
    assert not doubts(12.0, name="angle_zero[1]")
    assert "4.8 standard deviations from 0" in doubts(4.8, name="model_error[hysteresis]", off=0.0, lower=-10.0, upper=10.0, prior=1.0)[0]
    assert not doubts(2.0, name="model_error[hysteresis]", off=0.0, lower=-10.0, upper=10.0, prior=1.0)


def test_what_is_an_effects_is_judged_elsewhere():
    parameter = Parameter("drag", "N.m", 0.0, 0.0, 5.0, 1.0)
    fit = fit_of((parameter,), {"drag": 5.0}, np.zeros(100), np.full((100, 1), 10.0))
    assert calibrated_doubts(fit, ()) and not calibrated_doubts(fit, (), {"drag"})


def entry(kept=True):
    """A step as a model file has it: one signal is explained, one is not."""
    signals = [
        {"signal": "no_load_torque", "held_out": held, "unit": "N.m", "before": 0.12, "after": after, "noise_floor": 0.01} for held, after in ((False, 0.09), (True, 0.104))
    ]
    signals.append({"signal": "transmission_error", "held_out": False, "unit": "rad", "before": 6e-5, "after": 1.2e-6, "noise_floor": 1e-6})
    return {"campaign": "c", "effects": ["crank_eccentricity"], "verdict": "helped", "reason": "r", "kept": kept, "signals": signals,
            "held_out_before": 620.0, "held_out_after": 0.82, "training_before": 359.0, "training_after": 0.89}  # fmt: skip


def test_a_step_names_the_signals_that_it_leaves():
    assert signals_left(step_of(entry()).left) == "left: no_load_torque 10.4 times its noise"
    # What was not kept leaves all as it was.
    assert signals_left(step_of(entry(kept=False)).left) == "left: transmission_error 60 times its noise, no_load_torque 12 times its noise"
    assert signals_left({}) == ""


def test_the_ladder_says_it_on_page_and_screen(file, capsys):
    from dataclasses import replace

    from cli.show.comparison import show_ladder

    made = replace(file, steps=(entry(),))
    assert model_page(made).finding.endswith("Left: no load torque 10.4 times its noise.")
    show_ladder(made)
    assert "left: no_load_torque 10.4 times its noise" in capsys.readouterr().out


@pytest.fixture
def file():
    from discrepancy.model_file import load_model

    return load_model("RV20E-121")


def test_what_ended_at_nothing_is_told_as_nothing():
    """A share of the model's lag was told as 3.02585e-10."""
    from types import SimpleNamespace

    from discrepancy.compare import calibrated_texts
    from discrepancy.problem import Parameter

    model = SimpleNamespace(nuisances=(Parameter("lag_share", "1", 1.0, 0.0, 10.0, 0.3), Parameter("angle", "rad", 0.0, -1.0, 1.0, 1e-5)))
    assert calibrated_texts(model, {"lag_share": 3.02585e-10, "angle": 2e-12}) == ["lag_share = 0", "angle = 4.125e-07 arcsec"]
    # With what noise leaves: 1.060 and 1.034 of one model and one campaign stood there as if they were two numbers.
    base = fit_of([Parameter("lag_share", "1", 0.0, 0.0, 2.0, 1.0, 0)], {"lag_share": 1.03}, np.zeros(2), np.full((2, 1), 20.0))
    assert calibrated_texts(model, {"lag_share": 1.03, "angle": 2e-6}, base) == ["lag_share = 1.03 +- 0.035", "angle = 0.4125 arcsec"]
    assert calibrated_texts(model, {"lag_share": 0.02, "angle": 1e-13}) == ["lag_share = 0.02", "angle = 0 arcsec"]


def test_where_the_model_misses_the_data_no_deviation_is_told():
    """"lag_share = 1.271e-05 +- 0.063" stood there above "is known to 1.2 only", and with the missing effect it was 1.017."""
    from types import SimpleNamespace

    from discrepancy.compare import calibrated_texts
    from discrepancy.doubts.calibrated_deviations import AT_BOUND, unsure_text
    from discrepancy.problem import Parameter

    lag = Parameter("lag_share", "1", 1.0, 0.0, 10.0, 0.3)
    model = SimpleNamespace(nuisances=(lag,))
    fits, near, misses = (fit_of([lag], {"lag_share": 1.271e-5}, np.full(2, left), np.full((2, 1), 20.0)) for left in (0.0, 1.3, 20.0))
    assert calibrated_texts(model, fits.values, misses) == [f"lag_share = 0 ({AT_BOUND})"] and unsure_text(misses).startswith("without +-: the model misses the data by 20 times")
    assert calibrated_texts(model, fits.values, fits) == [f"lag_share = 0 +- 0.035 ({AT_BOUND})"] and unsure_text(fits) == ""
    # What is left a little above the noise widens it, as in the doubts.
    assert calibrated_texts(model, fits.values, near) == [f"lag_share = 0 +- 0.046 ({AT_BOUND})"]


def test_what_was_calibrated_is_told_with_its_meaning():
    """"angle_zero[1] = -55.0386 arcmin, lag_share = 1.00309" said nothing to who does not know the names."""
    from types import SimpleNamespace

    from discrepancy.compare import calibrated_texts
    from discrepancy.problem import Parameter

    angle = "output angle of the model at the record's angle 0"
    zeros = [Parameter(f"angle_zero[{k}]", "rad", 0.0, -1.0, 1.0, 1e-5, description=angle) for k in (1, 2)]
    model = SimpleNamespace(nuisances=(*zeros, Parameter("lag_share", "1", 1.0, 0.0, 10.0, 0.3, description="lag of the output")))
    assert calibrated_texts(model, {"angle_zero[1]": -0.0160101, "lag_share": 1.00309, "angle_zero[2]": 1e-3, "own": 2.0}) == [
        f"angle_zero[1] = -0.9173 deg, angle_zero[2] = 0.0573 deg: {angle}", "lag_share = 1.003: lag of the output", "own = 2",
    ]


def test_a_softness_that_loops_contradict_is_none():
    """"Either the measured reducer is about 6.4 times as soft, which a loop of it would show" stood below loops that showed 49.6 of 50 N m/arcmin."""
    figures = [KeyFigure("hysteresis", "a", STIFFNESS, "N.m/rad", measured, 1.72e5, 1e3, 1, True) for measured in (1.70e5, 1.71e5)]
    assert softer_by_loops(figures) == pytest.approx(1.009, abs=1e-3) and softer_by_loops([]) is None
    [text] = lag_doubts(6.354, 0.01, softer=softer_by_loops(figures))
    assert "is no softness: loops of this campaign show 1.01 times the model's own" in text
    # What they show, too, may be one; and where there are none nobody knows.
    for softer in (5.0, None):
        [text] = lag_doubts(6.354, 0.01, softer=softer)
        assert "about 6.4 times as soft" in text


def test_a_number_at_its_bound_is_doubted_wherever_it_is_told():
    """``lag_share,0.0`` stood in a table that other programs read, and "lag_share = 0" on the screen, as if it had been measured."""
    from types import SimpleNamespace

    from discrepancy.compare import calibrated_texts
    from discrepancy.doubts.calibrated_deviations import AT_BOUND, doubt_of
    from discrepancy.tables import calibrated_rows
    from workbench.look import calibrated

    numbers = (Parameter("angle_zero[1]", "rad", 0.0, -1.0, 1.0, 1e-5), Parameter("lag_share", "1", 1.0, 0.0, 10.0, 0.3))
    model = SimpleNamespace(nuisances=numbers)

    def fit(share, left):
        return fit_of(numbers, {"angle_zero[1]": 0.02736, "lag_share": share}, np.full(2, left), np.array([[5e3, 0.0], [0.0, 20.0]]))

    at_bound, sure = fit(1e-9, 21.0), fit(1.02, 0.0)
    assert calibrated_texts(model, at_bound.values, at_bound) == ["angle_zero[1] = 1.568 deg", f"lag_share = 0 ({AT_BOUND})"]
    (table,) = calibrated_rows(model, SimpleNamespace(base=at_bound))
    told = {column.name: list(column.values) for column in table.columns}
    assert told["unit"] == ["deg", "1"] and told["doubt"][1].startswith(AT_BOUND) and "misses the data by 21 times the noise" in told["doubt"][0]
    assert np.isnan(told["standard_deviation"]).all()
    assert doubt_of(sure, "lag_share") == "" and calibrated_texts(model, sure.values, sure)[1] == "lag_share = 1.02 +- 0.05"
    shown = calibrated(SimpleNamespace(model=model, nuisances=at_bound.values, diagnostician=SimpleNamespace(space=SimpleNamespace(base=at_bound))))
    assert [row["meaning"] for row in shown] == ["", AT_BOUND]


def test_a_zero_of_angles_has_one_unit_wherever_it_is_told():
    """94 arcmin in the base model, 5.7 deg in the extended one."""
    from discrepancy.words import as_told

    told = [as_told.numbers({"angle_zero[1]": value, "other": value}, {"angle_zero[1]": "rad", "other": "rad"}, ()) for value in (0.02736, 0.0995)]
    assert [entry["angle_zero[1]"]["unit"] for entry in told] == ["deg", "deg"] and told[0]["other"]["unit"] == "arcmin"
    assert told[0]["angle_zero[1]"]["value"] == pytest.approx(1.5676, abs=1e-4)


def test_a_zero_has_the_digits_that_its_deviation_leaves():
    """In degrees four digits are fewer arc minutes than they were."""
    from discrepancy.compare import digits_beside

    assert [digits_beside(1.5677, 0.0003), digits_beside(5.702, 0.002), digits_beside(0.9991, 0.044), digits_beside(0.0, 0.1), digits_beside(3.0, 0.0)] == [5, 4, 4, 4, 4]


def test_a_lag_that_says_nothing_is_told_in_short_sentences():
    """One sentence had 80 words."""
    (text,) = doubts(0.0, deviation=1.3, records=[run(50.0), run(100.0), run(150.0)])
    sentences = text.replace("N.m", "N m").replace("campaign.toml", "campaign file").split(". ")
    assert len(sentences) == 3 and max(len(sentence.split()) for sentence in sentences) < 35 and "no result" in sentences[0]
