"""Scenario files: the pair from a file, and what a bad file is told."""

import numpy as np
import pandas as pd
import pytest

from cli.main import main
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


def test_a_run_that_ends_beside_its_duration_says_so_and_goes_into_other_files(tmp_path, capsys):
    """An element's unit is its array's; what only a life can show is refused before anything is written."""
    case, result = str(write(tmp_path, PAIR)), str(tmp_path / "r.nc")
    assert main(["run", case, "--duration", "3ms", "--output", result]) == 0
    said = capsys.readouterr()
    assert "0.003 s are no whole steps of 0.0013 s: the run took the nearest number of them, 0.0026 s; --step 0.0015 divides it" in said.err
    assert main(["run", case, "--duration", "2.6ms", "--output", result, "-q"]) == 0 and not capsys.readouterr().err
    files = [tmp_path / f"r.{ending}" for ending in ("csv", "parquet", "mat", "xlsx")]
    assert main(["export", result, str(tmp_path / "a.csv"), str(tmp_path / "a.svg")]) == 2
    assert "holds no life, which" in capsys.readouterr().err and not (tmp_path / "a.csv").exists()
    assert main(["export", result, *map(str, files)]) == 0 and all(file.is_file() for file in files)
    table = pd.read_csv(files[0])
    assert len(table) == 3 and {"time [s]", "plant.output.lag [rad]", "plant.mesh.force[1,3] [N]"} <= set(table.columns)


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
