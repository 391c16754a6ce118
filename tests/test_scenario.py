"""Scenario files: the pair from a file, and what a bad file is told."""

import numpy as np
import pytest

from fmu_src.faults import InputFault
from orchestrator.system import load

PAIR = """
[scenario]
name = "pair"
step = { value = 1.3, unit = "ms" }
duration = { value = 26, unit = "ms" }

[components.plant]
reducer = "RV20E-121-rigid"
unit = "plant"
parameters = { output.load_torque = "100 N.m", bearing.clearance = "4 um", contact.law = "line" }
record = ["output.lag", "mesh.force", "mesh.force[1,3]"]

[components.wear]
reducer = "RV20E-121-rigid"
unit = "wear"
parameters = { acceleration = 1e6 }
record = ["flank.depth"]

[[connections]]
from = "plant.crank.angle"
to = "wear.crank.angle"

[[connections]]
from = "plant.mesh.force"
to = "wear.mesh.force"
"""


def write(folder, text):
    path = folder / "case.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_pair_from_a_file_runs_and_records(tmp_path):
    scenario = load(write(tmp_path, PAIR))
    series = scenario.run()
    assert series["time"] == pytest.approx(1.3e-3 * np.arange(21))
    assert series["plant.mesh.force"].shape == (21, 2, 40)
    assert np.array_equal(series["plant.mesh.force[1,3]"], series["plant.mesh.force"][:, 0, 2])
    assert series["wear.flank.depth"][-1].max() > 0.0
    assert scenario.master.components["plant"].get("load_torque") == 100.0
    assert scenario.master.components["plant"].get("bearing_clearance") == pytest.approx(4e-6)


def test_fmu_from_a_file(tmp_path, fmus):
    text = PAIR.replace('reducer = "RV20E-121-rigid"\nunit = "plant"', f'fmu = "{fmus / "RvPlant.fmu"}"')
    theirs = load(write(tmp_path, text)).run()
    ours = load(write(tmp_path, PAIR)).run()
    assert theirs["wear.flank.depth"] == pytest.approx(ours["wear.flank.depth"], rel=1e-12)


@pytest.mark.parametrize("before, after, said", [
    ("step =", "stepp =", "scenario.step"),
    ('unit = "ms" }\nduration', 'unit = "mm" }\nduration', "'mm' does not fit"),
    ("value = 1.3", "value = -1.3", "both positive"),
    ('unit = "plant"', 'unit = "plnt"', "components.plant.unit"),
    ('reducer = "RV20E-121-rigid"\nunit = "plant"', "", "give either fmu"),
    ('"output.lag"', '"output.lagg"', "did you mean output.lag"),
    ('"100 N.m"', '"100 kg"', r"output.load_torque = '100 kg'.*'kg' does not fit"),
    ('"100 N.m"', "nan", "not a finite number"),
    ("contact.law =", "contact.lw =", "did you mean contact.law"),
    ('"wear.mesh.force"', '"wear.roller.force"', "shapes"),
    ('"wear.mesh.force"', '"wheel.mesh.force"', "no component 'wheel'"),
])  # fmt: skip
def test_bad_scenario_is_told_what_is_wrong(tmp_path, before, after, said):
    assert before in PAIR
    with pytest.raises(InputFault, match=said):
        load(write(tmp_path, PAIR.replace(before, after, 1)))
