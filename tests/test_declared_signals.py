"""Signals that an effect declares, held against what it changes on the virtual bench."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from cli.main import main
from cli.show.effects import show_signals
from discrepancy.catalogue.catalogue import Entry
from discrepancy.catalogue.declared_signals import Change, doubts_in, doubts_of
from discrepancy.model_file import every_effect
from tests.test_effects_check import LAW, written

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(("name", "signals", "said"), [
    ("support_compliance", ("hysteresis", "lost_motion", "torsional_stiffness", "transmission_error", "vibration"), []),
    ("support_compliance", ("hysteresis", "lost_motion"), ["signals lack torsional_stiffness (by"]),
    ("support_compliance", ("cage_speed",), ["signals lack hysteresis (by", "none of its signals is changed by more than noise"]),
    # What is not judged may show it; what declares nothing is looked for everywhere.
    ("unbalance", ("vibration", "hysteresis"), ["signals have hysteresis, changed by nothing"]), ("unbalance", ("vibration",), []), ("support_compliance", (), []),
    # An effect of wear shows in wear; an effect of a rig whose output is locked in its loops.
    ("load_exponent", ("wear_depth",), ["signals lack wear_profile (by"]), ("drive_friction", ("hysteresis", "input_torque", "efficiency"), []),
])  # fmt: skip
def test_what_is_changed_and_not_declared_is_told_with_its_size(name, signals, said):
    found = doubts_of(name, replace(every_effect()[name], signals=signals))
    assert len(found) == len(said) and all(text.startswith(begin) for text, begin in zip(found, said))
    assert all(("a usual bench's noise is" in text or "by nothing" in text) and "at its usual size on RV20E-121" in text for text in found)


@pytest.mark.parametrize(("signals", "most"), [
    # Orders are made of the curve, and are not looked at by themselves: they kept every effect that shows in transmission errors from being doubted.
    (("transmission_error", "hysteresis"), "hysteresis (by 0.0076 arcmin"), (("transmission_error",), "transmission_error (by 0.13 arcsec"),
    (("transmission_order",), "transmission_error (by 0.13 arcsec"), (("transmission_error", "vibration"), ""), (("lost_motion",), ""),
])  # fmt: skip
def test_an_effect_within_the_noise_of_all_its_signals_is_doubted(signals, most):
    found = {
        "transmission_error": Change("transmission_error", 0.26, "0.13 arcsec", "rated", "0.5 arcsec"),
        "hysteresis": Change("hysteresis", 0.44, "0.0076 arcmin", "rated", "0.0172 arcmin"),
        "lost_motion": Change("lost_motion", 1.2, "0.04 arcmin", "rated", "0.034 arcmin"),
    }  # fmt: skip
    said = doubts_in(replace(every_effect()["support_compliance"], signals=signals), found)
    assert len(said) == bool(most) and all("none of its signals" in text and f"most {most}" in text for text in said)


# Each changes by far too little.
FAINT = {"before": "r.roller_gap_now[0, 0, 0] += 1e-9 * r.faint_size", "after": "r.friction_power += 1e-9 * r.faint_size"}


def test_check_and_table_doubt_an_effect_of_any_hook_alike(tmp_path, capsys):
    signals = ("hysteresis", "lost_motion", "transmission_error", "input_torque")
    for hook, line in FAINT.items():
        head = LAW.partition("    (amplitude(")[0]
        text = f'{head}    (amplitude("{hook}_size", "1", "a", 1e-4, 0.0, 1.0),),\n    signals={signals!r},\n)\n'
        written(tmp_path, f"{text}\n\n@kernel\ndef {hook}(r):\n    {line.replace('faint_size', f'{hook}_size')}\n", name=f"faint_{hook}")
    assert main(["effects", "--check", str(tmp_path), "--json"]) == 0
    doubts = {Path(name).stem: [doubt["text"] for doubt in found] for name, found in json.loads(capsys.readouterr().out)["doubts"].items()}
    assert len(doubts) == len(FAINT) and all(len(found) == 1 and "none of its signals" in found[0] for found in doubts.values())
    env = os.environ | {"RVWEAR_EFFECTS": str(tmp_path)}
    shown = subprocess.run([sys.executable, "-m", "cli", "effects", "faint_before"], cwd=ROOT, env=env, capture_output=True, text=True, check=True).stdout
    assert f"doubtful: {doubts['faint_before'][0]}" in " ".join(shown.split())


def test_what_is_declared_and_not_judged_stands_in_the_table(capsys):
    effect = every_effect()["unbalance"]
    show_signals(Entry("unbalance", replace(effect, signals=("vibration", "hysteresis")), "plant", ()), {"hysteresis": Change("hysteresis")})
    said = " ".join(capsys.readouterr().out.split())
    assert "vibration yes not judged" in said and "doubtful: none" not in said and "doubtful: signals have hysteresis, changed by nothing" in said and "unless it declares what is not judged, as here vibration" in said


def test_the_check_of_an_own_effect_doubts_signals_that_it_does_not_change(tmp_path, capsys):
    """A campaign that measures the input's torque would never have had it looked for."""
    file = written(tmp_path, LAW.replace('("input_torque",)', '("hysteresis",)').replace('"a", 0.1,', '"a", 0.2,'), name="lip")
    # It can be meant so: a doubt, no fault.
    assert main(["effects", "--check", str(file)]) == 0
    said = capsys.readouterr().out
    assert "nothing wrong" in said and "doubtful: signals lack input_torque (by 0.0995 N m, speed 10 %; a usual bench's noise is 0.02 N m)" in said
    assert "doubtful: none of its signals is changed by more than noise" in said and "most hysteresis (by nothing)" in said
    # What explains it has the same signals, though its figures are those of another reducer at other conditions.
    env = os.environ | {"RVWEAR_EFFECTS": str(file.parents[1])}
    shown = subprocess.run([sys.executable, "-m", "cli", "effects", "lip"], cwd=ROOT, env=env, capture_output=True, text=True, check=True).stdout
    assert "on RV20E-121, where it changes most" in shown and "Figures are those of RV20E-121-rigid" in shown
    rows = {line.split()[0]: line.split()[1:] for line in shown.partition("by signal")[2].splitlines() if line.startswith(" ") and line.split()}
    assert rows["input_torque"] == ["0.0995", "N", "m", "speed", "10", "%", "0.02", "N", "m", "5"] and rows["hysteresis"] == ["yes", "nothing"]
    assert main(["effects", "--check", str(file), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["findings"] == {str(file): []}
    assert [LAW.splitlines()[doubt["line"] - 1].split("=")[0].strip() for doubt in found["doubts"][str(file)]] == ["signals"] * 2
