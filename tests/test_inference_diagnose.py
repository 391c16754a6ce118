"""Diagnosis of toy campaigns: each verdict once, estimates, intervals, plain data, speed."""

import json
import re
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from test_inference_toy import CANDIDATES, LOADS, TURN, Noise, Toy, campaign, law, measure

from discrepancy.inference.diagnose import Diagnostician, diagnose
from discrepancy.inference.law.recover import recover
from discrepancy.inference.refit.refit import leave_condition_out, literal_leave_out
from discrepancy.problem import Parameter, Record
from fmu_src.progress import told_to


def test_null_is_none():
    model, _ = campaign(11, "null")
    result = diagnose(model)
    assert result.verdict == "none" and not result.effects
    # What comes nearest is what chance makes least often, not what has the most parameters.
    chances = [float(found[1]) for one in result.rejected if (found := re.search(r"p = (\S+) over", one["reason"]))]
    assert len(chances) > 2 and chances == sorted(chances)


def test_what_only_rough_predictions_show_is_no_effect():
    """To first order a clearance seems to bend the curve as the noise happens to; in earnest it gains nothing."""
    model, _ = campaign(11, "null")
    chance = {r.name: 6.0 * np.std(r.values) * np.random.default_rng(k).standard_normal(np.size(r.values)) for k, r in enumerate(model.records)}

    class Rough(Toy):
        def predict_beside(self, values, base, which, roughly=False):
            found = self.predict(values, which)
            if values.get("clearance", 0.0) == base.get("clearance", 0.0):
                return found
            off = values.get("clearance", 0.0) - base.get("clearance", 0.0)
            return [y + off * (self.records[i].values - law(self.records[i], {}) + 1e-3 * chance[self.records[i].name]) for i, y in zip(which, found)]

        def predict_roughly(self, values, which):
            return self.predict_beside(values, {}, which)

        def predict_near(self, values, base, which):
            return self.predict(values, which)

    result = diagnose(Rough(model.records))
    assert result.p_screen < 1e-6
    assert result.verdict in ("none", "unknown") and not result.effects


def test_what_near_predictions_err_moves_no_reported_fit():
    """They lack a tenth of what differs; the fit ends where the exact ones do, as well as its steps go by exact ones."""
    model, _ = campaign(12, "effect", 20, "stribeck")

    class Near(Toy):
        share = 1.0

        def predict_beside(self, values, base, which, roughly=False):
            return self.predict(values, which)

        def predict_roughly(self, values, which):
            return self.predict(values, which)

        def predict_near(self, values, base, which):
            return [low + self.share * (high - low) for high, low in zip(self.predict(values, which), self.predict(base, which))]

    class Coarse(Near):
        share = 0.9

    exact, coarse = (diagnose(kind(model.records)).effects[0] for kind in (Near, Coarse))
    assert coarse.name == exact.name == "stribeck"
    for name, entry in exact.parameters.items():
        low, high = entry["interval"]
        assert coarse.parameters[name]["value"] == pytest.approx(entry["value"], abs=0.02 * (high - low))
        assert np.diff(coarse.parameters[name]["interval"]) == pytest.approx(high - low, rel=0.25)


def test_one_effect_is_named_with_its_parameters():
    model, hidden = campaign(12, "effect", 20, "stribeck")
    result = diagnose(model)
    assert result.verdict == "one effect" and result.effects[0].name == "stribeck"
    effect = result.effects[0]
    for name, entry in effect.parameters.items():
        low, high = entry["interval"]
        assert low - (high - low) <= hidden.values[name] <= high + (high - low)
    assert effect.held_out_error_after < 0.6 * effect.held_out_error_before
    assert effect.share_explained > 0.8
    assert any(r["name"] == "churning" for r in result.rejected)
    plain = json.loads(json.dumps(result.to_dict()))
    assert {"verdict", "effects", "confusable", "localisation", "rejected"} <= plain.keys()


def test_aliases_are_shown_as_a_set():
    model, _ = campaign(13, "effect", 15, "needle_clearance")
    twin = replace(CANDIDATES[3], name="twin", amplitudes=(Parameter("twin_clearance", "um", 0.0, 0.0, 1e3, 1.0, 1),))

    class Doubled(Toy):
        def predict(self, values, which=None):
            merged = dict(values)
            merged["clearance"] = merged.get("clearance", 0.0) + merged.pop("twin_clearance", 0.0)
            return super().predict(merged, which)

    result = diagnose(Doubled(model.records, candidates=(*CANDIDATES, twin)))
    assert result.verdict == "set" and set(result.confusable) == {"needle_clearance", "twin"}
    assert max(result.correlations.values()) == pytest.approx(1.0, abs=1e-3)


def test_two_effects_are_found():
    model, hidden = campaign(14, "effect", 20, "disc_pitch")
    records = [replace(r, values=r.values + law(r, {"seal": 0.08}) - law(r, {})) for r in model.records]
    result = diagnose(Toy(records))
    assert {e.name for e in result.effects} >= {"disc_pitch"} and len(result.effects) == 2
    assert result.verdict in ("several effects", "named but incomplete")


def test_how_many_effects_were_tested_is_told_of_how_many():
    """The answer had 60 screened, which stood beside a progress of 85: the others show nothing in this campaign."""
    model, _ = campaign(14, "effect", 20, "disc_pitch")
    said = []
    with told_to(SimpleNamespace(begin=lambda task: None, end=lambda task: None, say=said.append)):
        doctor = Diagnostician(model)
        doctor.prepare()
        doctor.screened()
        doctor.say_scores()
    every, tested = len(model.candidates), len(doctor.refits.scores)
    assert f"{tested} of {every} effects tested" in said[-1]
    # An order of a first look was taken for the answer.
    assert "nearest" not in said[-1] and "at first sight, each alone and none fitted yet" in said[-1] and said[-1].endswith("no answer yet")
    assert (f"the other {every - tested} change nothing here" in said[-1]) == (tested < every)
    # In words of the bench, the largest first: p of 5e-101 beside 5e-159 ranked nothing.
    shares = [float(share) for share in re.findall(r"\(([\d.e+]+) % of the misfit", said[-1])]
    assert len(shares) == 3 and shares == sorted(shares, reverse=True) and 5.0 < shares[0] <= 100.0 and "p =" not in said[-1]


def test_an_unknown_law_is_recovered_without_a_name():
    model, hidden = campaign(15, "outside", 30, "resonance")
    doctor = Diagnostician(model)
    result = doctor.run()
    assert result.verdict == "unknown"
    assert result.localisation["findings"][0]["signal"] == "torque"
    law_found = recover(doctor.space, doctor.space.base, ["torque"])[0]
    assert law_found.leading == "sliding_speed" and law_found.forms[0].name == "bump"
    low, high = law_found.forms[0].intervals["c"]
    assert low - 0.02 < 0.45 < high + 0.02
    assert law_found.held_out_error_after < law_found.held_out_error_before
    json.dumps(law_found.to_dict())


def test_leave_one_out_in_closed_form_agrees_with_refits():
    model, _ = campaign(16, "effect", 15, "thermal_expansion")
    doctor = Diagnostician(model)
    doctor.prepare()
    doctor.screened()
    result = doctor.fit(["thermal_expansion"])
    closed = leave_condition_out(doctor.space, result.fit)
    conditions = [c for c in closed if c.startswith("te")][:3]
    literal = literal_leave_out(doctor.space, result, conditions)
    for c in conditions:
        assert literal[c] == pytest.approx(closed[c], rel=0.02)


def test_a_large_campaign_is_diagnosed_in_time():
    rng = np.random.default_rng(17)
    noise = Noise()
    records = []
    for k, (load, temperature, direction) in enumerate((a, b, c) for a in (*LOADS, 500.0) for b in (293.0, 320.0) for c in (1.0, -1.0)):
        for replicate in range(2):
            records.append(Record(f"{k} {replicate}", "te", "1", str(k), replicate, np.zeros(2000), {"angle": np.linspace(0, TURN, 2000, endpoint=False)},
                                  {"load": load, "temperature": temperature, "direction": direction}, "1", k % 4 == 3))
    model = Toy(measure(records, {"clearance": 0.2}, noise, rng))
    started = time.perf_counter()
    result = diagnose(model)
    assert "needle_clearance" in [e.name for e in result.effects]
    assert time.perf_counter() - started < 60
