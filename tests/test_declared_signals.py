"""Signals that an effect declares, held against what it changes on the virtual bench."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from cli.main import main
from discrepancy.catalogue.declared_signals import doubts_of
from discrepancy.model_file import every_effect
from tests.test_effects_check import LAW, written

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(("name", "signals", "said"), [
    ("support_compliance", ("hysteresis", "lost_motion", "torsional_stiffness", "transmission_error", "vibration"), []),
    ("support_compliance", ("hysteresis", "lost_motion"), ["signals lack torsional_stiffness (by"]),
    ("support_compliance", ("cage_speed",), ["signals lack hysteresis (by", "none of its signals is changed by more than noise"]),
    # What is not judged may show it; what declares nothing is looked for everywhere.
    ("unbalance", ("vibration", "temperature"), []), ("support_compliance", (), []),
    # An effect of wear shows in wear; an effect of a rig whose output is locked in its loops.
    ("load_exponent", ("wear_depth",), ["signals lack wear_profile (by"]), ("drive_friction", ("hysteresis", "input_torque", "efficiency"), []),
])  # fmt: skip
def test_what_is_changed_and_not_declared_is_told_with_its_size(name, signals, said):
    found = doubts_of(name, replace(every_effect()[name], signals=signals))
    assert len(found) == len(said) and all(text.startswith(begin) for text, begin in zip(found, said))
    assert all(("a usual bench's noise is" in text or "by nothing" in text) and "at its usual size on RV20E-121" in text for text in found)


def test_the_check_of_an_own_effect_doubts_signals_that_it_does_not_change(tmp_path, capsys):
    """A campaign that measures the input's torque would never have had it looked for."""
    file = written(tmp_path, LAW.replace('("input_torque",)', '("hysteresis",)').replace('"a", 0.1,', '"a", 0.2,'), name="lip")
    # It can be meant so: a doubt, no fault.
    assert main(["effects", "--check", str(file)]) == 0
    said = capsys.readouterr().out
    assert "nothing wrong" in said and "doubtful: signals lack input_torque (by 0.0995 N.m, speed 10 %; a usual bench's noise is 0.02 N.m)" in said
    assert "doubtful: none of its signals is changed by more than noise" in said and "most hysteresis (by nothing)" in said
    # What explains it has the same signals, though its figures are those of another reducer at other conditions.
    env = os.environ | {"RVWEAR_EFFECTS": str(file.parents[1])}
    shown = subprocess.run([sys.executable, "-m", "cli", "effects", "lip"], cwd=ROOT, env=env, capture_output=True, text=True, check=True).stdout
    assert "on RV20E-121, where it changes most" in shown and "Figures are those of RV20E-121-rigid" in shown
    rows = {line.split()[0]: line.split()[1:] for line in shown.partition("by signal")[2].splitlines() if line.startswith(" ") and line.split()}
    assert rows["input_torque"] == ["0.0995", "N.m", "speed", "10", "%", "0.02", "N.m", "5"] and rows["hysteresis"] == ["yes", "nothing"]
    assert main(["effects", "--check", str(file), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["findings"] == {str(file): []}
    assert [LAW.splitlines()[doubt["line"] - 1].split("=")[0].strip() for doubt in found["doubts"][str(file)]] == ["signals"] * 2
