"""A model file has the digits that its numbers are known to, in the field's unit, and is read as the same model."""

import tomllib

import numpy as np
import pytest

from discrepancy.model_file import ModelFile, every_effect, load_model, save_model
from discrepancy.words.written_number import digits_of, rounded
from reducers.reducer import load_reducer

# Chosen so that every value has all the digits that a float has.
ODD = 0.87365012873460912


def amounts():
    """Of each number of each effect a usual size and its bounds, with an interval of a hundredth."""
    for name, effect in every_effect().items():
        for p in effect.parameters:
            v = p.variable
            if v.is_integer or p.kind == "choice":
                continue
            usual = float(np.clip(ODD * (p.scale if p.kind == "amplitude" else float(v.start) or p.scale), v.minimum, v.maximum))
            for value in {usual, v.minimum, v.maximum}:
                half = 0.01 * abs(value) or 1e-9
                yield name, v, {"value": value, "unit": v.unit, "low": value - half, "high": value + half}


def test_every_number_of_every_effect_is_read_as_it_was_to_a_thousandth_of_its_uncertainty(tmp_path):
    reducer, path = load_reducer("RV20E-121-rigid"), tmp_path / "m.toml"
    rows = list(amounts())
    for k in range(3):
        effects: dict = {}
        for name, v, entry in rows[k::3]:
            effects.setdefault(name, {})[v.name] = entry
        save_model(ModelFile("m", reducer, {}, effects), path)
        again = load_model(path).effects
        for name, own in effects.items():
            for key, entry in own.items():
                half = 0.5 * (entry["high"] - entry["low"])
                for end in ("value", "low", "high"):
                    # A thousandth of the interval, or what a change of unit leaves of temperatures and the like.
                    assert again[name][key][end] == pytest.approx(entry[end], rel=1e-11, abs=1.1e-3 * half), (name, key, end)


def test_the_file_has_the_units_and_digits_of_the_field(tmp_path):
    path = tmp_path / "better.toml"
    entry = {"value": 4.0086713487623451e-6, "unit": "m", "low": 3.9981234567890123e-6, "high": 4.0192192407356779e-6}
    step = {"effects": ["needle_clearance"], "held_out_before": 17.123456789012345, "nuisances": {"angle": 0.123456789012345}, "kept": True}
    effects = {"needle_clearance": {"needle_clearance_added": entry}}
    save_model(ModelFile("m", load_reducer("RV20E-121"), {"bearing_clearance": 2.4000000000000003e-6}, effects, (step,)), path)
    text = path.read_text(encoding="utf-8")
    assert 'added = {value = 4.00867, unit = "um", low = 3.99812, high = 4.01922}' in text
    assert 'bearing.clearance = "2.4 um"' in text and "held_out_before = 17.1235" in text
    assert load_model(path).values() == pytest.approx({"bearing_clearance": 2.4e-6, "needle_clearance_added": 4.00867e-6})
    # Written again nothing changes.
    save_model(load_model(path), path)
    assert path.read_text(encoding="utf-8") == text
    assert tomllib.loads(text)["steps"][0]["nuisances"] == {"angle": 0.123457}


def test_digits_follow_the_uncertainty():
    assert rounded(1.0 / 3.0, digits_of(1.0 / 3.0, 0.1)) == 0.3333 and rounded(1.0 / 3.0, digits_of(1.0 / 3.0, 1e-4)) == 0.3333333
    assert digits_of(2.0, float("inf")) == digits_of(2.0, 0.0) == 12


def test_angles_are_in_degrees_minutes_or_seconds_by_their_size(tmp_path):
    path, degree = tmp_path / "m.toml", np.pi / 180.0
    sizes = {
        "disc_tooth_errors": {"disc_runout_angle": 30.0 * degree}, "crank_lobe_errors": {"lobe_phase_error_1": 0.5 * degree},
        "edge_loading": {"misalignment": 0.01 * degree},
    }  # fmt: skip
    effects = {effect: {name: {"value": value, "unit": "rad"} for name, value in own.items()} for effect, own in sizes.items()}
    save_model(ModelFile("m", load_reducer("RV20E-121"), {}, effects), path)
    written = [entry for table in tomllib.loads(path.read_text())["effects"].values() for entry in table.values()]
    assert sorted((e["value"], e["unit"]) for e in written) == [(30.0, "arcmin"), (30.0, "deg"), (36.0, "arcsec")]
    assert load_model(path).values() == pytest.approx({name: value for own in sizes.values() for name, value in own.items()})
