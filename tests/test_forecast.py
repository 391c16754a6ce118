"""Forecasts of remaining life: samples against a closed form, limits and refusals, a campaign's readings, intervals on made lives."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks.forecasts import Life, summary, through_points
from cli.main import main
from discrepancy.campaign.load import load_campaign
from discrepancy.forecast import posterior
from discrepancy.forecast.contradictions import contradictions
from discrepancy.forecast.forecast import Range, Reading, forecast, narrowing
from discrepancy.forecast.growth import FIRST, STEP, Growth
from discrepancy.forecast.readings import inspections, limit_of, without_hours
from fmu_src.faults import InputFault

TEST = Path(__file__).parent.parent / "examples" / "durability_test"


def test_growth_without_walk_has_a_closed_form(monkeypatch):
    """L = L_0 + v (t + (r - 1) tau (1 - exp(-t/tau))) where the rate neither walks nor rises."""
    monkeypatch.setattr("discrepancy.forecast.growth.TREND", 0.0)
    growth = Growth(40.0, 1e-3, 2e4, drift=0.0)
    x = np.array([[0.1, 0.3, -0.4, 0.5, *np.zeros(growth.dimensions - 4)]])
    level, rate, excess, decay = (float(v[0]) for v in growth.numbers(x))
    t = growth.hours
    expected = level + rate * (t + excess * decay * (1.0 - np.exp(-t / decay)))
    assert np.abs(growth.levels(x)[0] - expected).max() < 2e-3 * (expected[-1] - level)
    crossing = growth.crossings(growth.levels(x), float(np.interp(5000.0, t, growth.levels(x)[0])))
    assert crossing[0] == pytest.approx(5000.0, rel=1e-6)
    assert np.isinf(growth.crossings(growth.levels(x), 1e9)[0])


def test_samples_are_those_of_a_known_law():
    """With the level alone seen it is known as well as its reading; everything else stays as it was before."""
    growth = Growth(40.0, 1e-3, 1e4)
    x = posterior.samples(growth, np.array([0.0]), np.array([41.0]), np.array([0.5]))
    level = growth.numbers(x)[0]
    assert level.mean() == pytest.approx(41.0, abs=0.05) and level.std() == pytest.approx(0.5, rel=0.1)
    assert np.abs(x[:, 1:].mean(axis=0)).max() < 0.15 and np.abs(x[:, 1:].std(axis=0) - 1.0).max() < 0.15


def test_intervals_narrow_and_hold():
    """A straight life with exact readings: the true remaining life lies in all intervals, and the last is far narrower than the first."""
    hours = [0.0, 500.0, 1000.0, 2000.0, 4000.0, 6000.0]
    readings = [Reading(t, 40.0 + 2e-3 * t, 0.2) for t in hours]
    found = narrowing(readings, 60.0)
    assert [f.hours for f in found] == hours[1:]
    assert all(f.remaining.holds(10_000.0 - f.hours) for f in found)
    widths = [f.remaining.high / f.remaining.low for f in found]
    assert widths[-1] < 0.3 * widths[0] and widths[-1] < 3.0
    assert found[-1].rate.holds(2e-3) and found[-1].drift == pytest.approx(Growth(40.0, 1e-3, 1e5).variance / (FIRST + 6000.0))
    over = forecast([*readings, Reading(12_000.0, 65.0, 0.2)], 60.0, asked=[15_000.0])
    assert over.remaining == Range(0.0, 0.0, 0.0) and over.later[15_000.0].low > 65.0


def test_a_step_rises_seldom_and_far_and_falls_little(monkeypatch):
    """The variance that a filter is told is that of the walk; a rate may double at once, and halve hardly ever."""
    growth = Growth(40.0, 1e-3, 1e4)
    z = np.random.default_rng(0).standard_normal((200_000, 1))
    x = np.zeros((len(z), growth.dimensions))
    x[:, 4:5] = z
    place = FIRST * np.expm1(np.array([STEP]))
    steps = np.log(growth.at(growth.rates(x), place) / growth.numbers(x)[1][:, None])
    assert steps.var() / STEP == pytest.approx(growth.variance, rel=0.03)
    assert np.mean(steps > np.log(1.8)) > 20.0 * np.mean(steps < -np.log(1.5)) and np.quantile(steps, 0.001) > -0.5


CONTRADICTION = [Reading(t, v, 0.2) for t, v in ((0.0, 42.74), (600.0, 40.0), (800.0, 53.86), (1000.0, 54.34))]


def test_readings_that_contradict_are_named():
    """The second reading of the durability test, wrong by 13 arcsec: below the first, and on no growth."""
    for count in (2, 4):
        some = CONTRADICTION[:count]
        fell, off = contradictions(some, forecast(some, 60.0), "arcsec")
        assert "falls from 42.74 arcsec at 0 h to 40 arcsec at 600 h, by 9.7 times the noise of both" in fell.text
        assert "40 arcsec at 600 h (" in off.text and "times its noise too low)" in off.text
    right = [replace(r, value=53.38) if r.hours == 600.0 else r for r in CONTRADICTION]
    assert contradictions(right, forecast(right, 60.0), "arcsec") == []


def test_noise_is_no_contradiction():
    """Of 20 lives that grow as assumed at most one is doubted (one in a hundred is meant)."""
    rng = np.random.default_rng(5)
    hours = np.array([0.0, 200.0, 700.0, 1500.0, 3000.0])
    doubted = 0
    for _ in range(20):
        readings = [Reading(float(t), float(40.0 + 4e-3 * t + 2.0 * (1.0 - np.exp(-t / 200.0)) + 0.3 * rng.standard_normal()), 0.3) for t in hours]
        doubted += bool(contradictions(readings, forecast(readings, 60.0), "arcsec"))
    assert doubted <= 1


def test_command_says_what_contradicts_and_never_inf(tmp_path, capsys):
    text = (TEST / "campaign.toml").read_text(encoding="utf-8")
    (tmp_path / "campaign.toml").write_text(text.replace("53.38, 53.86", "40.00, 53.86"), encoding="utf-8")
    words = ["forecast", str(tmp_path), "--limit", "lost_motion=1arcmin", "--until", "600"]
    assert main(words) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "doubtful: the reading falls from 0.7123 arcmin at 0 h" in shown and "do not fit the best growth" in shown
    assert not re.search(r"\binf\b|\bnan\b", shown) and re.search(r"over 99,400", shown)
    assert re.search(r"with a probability of \d+ % the limit is not reached within 100,000 h", shown) and "two inspections cannot tell" in shown
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert len(told["doubts"]) == 2 and told["forecasts"][0]["horizon"] == 1e5
    assert main(["forecast", str(TEST), "--limit", "lost_motion=1arcmin", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["doubts"] == []


def test_rivals_of_the_benchmark_know_their_own_law():
    noise, limit = 0.1, 60.0
    line = [Reading(t, 40.0 + 2e-3 * t, noise) for t in (0.0, 1000.0, 2000.0, 4000.0)]
    assert through_points(line, limit, np.array([1.0])).holds(6000.0)
    root = [Reading(t, 40.0 + 0.2 * t**0.5, noise) for t in (0.0, 500.0, 1000.0, 2000.0, 4000.0)]
    assert through_points(root, limit, np.linspace(0.2, 3.0, 57)).holds(6000.0)
    assert not through_points(root, limit, np.array([1.0])).holds(6000.0)
    life = Life(line, limit, 10_000.0, [])
    assert summary([life, life], [Range(6000.0, 5000.0, 8000.0), Range(3000.0, 2000.0, 4000.0)])["holds"] == 0.5


def test_readings_of_a_campaign():
    campaign, limit = load_campaign(TEST), limit_of("lost_motion = 60 arcsec")
    assert (limit.value, limit.unit) == (pytest.approx(1.0), "arcmin")
    found = inspections(campaign, limit)
    assert [r.hours for r in found.readings] == pytest.approx([0.0, 600.0, 800.0, 1000.0]) and len(found.held_out) == 2
    assert found.readings[0].value == pytest.approx(42.74 / 60.0) and found.readings[0].noise == pytest.approx(0.2 / 60.0)
    assert inspections(campaign, limit, noise="0.6 arcsec").readings[0].noise == pytest.approx(0.01)


def test_a_reading_that_stands_out_of_its_repetitions_is_left_out_and_said():
    campaign = load_campaign(TEST)
    last = max((r for r in campaign.records if not r.held_out and r.quantity == "lost_motion"), key=lambda r: float(np.max(r.axes.get("hours", r.factors.get("hours")))))
    size = len(last.values)
    again = [replace(last, name=f"again_{k}", replicate=k + 2, values=last.values * (1.001 if k < 3 else 6.0)) for k in range(4)]
    found = inspections(replace(campaign, records=(*campaign.records, *again)), limit_of("lost_motion=1arcmin"))
    assert [(o.run, o.left_out) for o in found.outlying] == [("again_3", True)] and len(found.readings) == 4 + 3 * size
    assert max(r.value for r in found.readings) < 1.0


def test_command(capsys):
    assert main(["forecast", str(TEST), "--limit", "lost_motion=1arcmin", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert [f["readings"] for f in said["forecasts"]] == [2, 3, 4] and len(said["unused"]) == 2
    last = said["forecasts"][-1]["later"]["1550.0"]
    assert last["low"] < 55.66 / 60.0 < last["high"]
    assert main(["forecast", str(TEST), "--limit", "lost_motion=1arcmin", "--until", "800"]) == 0
    shown = capsys.readouterr().out
    assert "not used: 0.9277 arcmin at 1550 h" in shown and "life.expected_rate" in shown


@pytest.mark.parametrize(("options", "says"), [
    (["--limit", "lostmotion=1arcmin"], "did you mean lost_motion"),
    (["--limit", "lost_motion=1kg"], "kg"),
    (["--limit", "wear_depth=5um"], "no run of wear_depth; there is lost_motion"),
    (["--limit", "lost_motion=30arcsec"], "below the first reading"),
    (["--limit", "lost_motion=1arcmin", "--until", "10"], "at 1 number"),
    (["--limit", "lost_motion=1arcmin", "--until", "nan"], "at 0 numbers of hours"),
    (["--limit", "lost_motion=1arcmin", "--noise", "0 arcsec"], "--noise 0 arcsec: a standard deviation lies above 0"),
    (["--limit", "lost_motion=1arcmin", "--condition", "x"], "say which with --condition"),
])  # fmt: skip
def test_refusals(options, says, capsys):
    assert main(["forecast", str(TEST), *options]) == 2
    assert says in capsys.readouterr().err


def test_conditions_are_told_as_the_campaign_states_them():
    record = next(r for r in load_campaign(TEST).records if r.quantity == "lost_motion")
    at = replace(record, factors={"speed": 121.0 * 15.0 * np.pi / 30.0, "load": 167.0, "temperature": 313.15, "direction": -1.0, "hours": 3600.0}, tags={})
    campaign = replace(load_campaign(TEST), ratio=121.0, speed_at="output")
    assert without_hours(at, campaign) == "backward, load 167 N.m, speed 15 rpm at the output, temperature 40 degC"
    assert "speed 1815 rpm at the input" in without_hours(at, replace(campaign, speed_at="input"))


def test_noise_that_nobody_states_is_asked_for():
    campaign = load_campaign(TEST)
    for r in campaign.records:
        object.__setattr__(r, "stated_noise", None)
    with pytest.raises(InputFault, match="--noise"):
        inspections(campaign, limit_of("lost_motion=1arcmin"))


def test_a_forecast_is_exported_with_its_readings(capsys, tmp_path):
    path = tmp_path / "life.csv"
    assert main(["forecast", str(TEST), "--limit", "lost_motion=1arcmin", "--json", "--export", str(path)]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["units"]["rate"] == "arcmin/h"
    written, readings = pd.read_csv(path), pd.read_csv(tmp_path / "life_readings.csv")
    assert list(written["remaining [h]"]) == pytest.approx([f["remaining"]["middle"] for f in told["forecasts"]])
    assert list(readings["used"]) == sorted(readings["used"], reverse=True)
    unused = readings[~readings["used"]]
    assert list(unused["expected_low [arcmin]"]) == pytest.approx([told["forecasts"][-1]["later"][f"{h}"]["low"] for h in unused["hours [h]"]])
