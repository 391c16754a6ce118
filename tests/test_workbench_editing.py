"""A campaign.toml that was written by hand is corrected cell by cell: comments and all else stay, what cannot be read is refused."""

import numpy as np
import pytest

pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')

from discrepancy.campaign.load import load_campaign
from fmu_src.faults import InputFault
from workbench.editing import cells, edit, turn
from workbench.folder import opened
from workbench.intake import view
from workbench.mending import mend

TEXT = """# Bench 3, October.  Do not touch the grease!
[campaign]
name = "by hand"          # as in the log
reducer = "RV20E-121"

[conditions.warm]
temperature = "40 degC"   # of the housing
load_torque = "167 N.m"
direction = 1

[layouts.loop]
quantity = "hysteresis"
condition = "warm"
tags.locked = "input"

# the first was clamped anew afterwards
[[runs]]
id = "a"
layout = "loop"
file = "a.csv"
columns.value = { column = "y", unit = "arcmin" }  # encoder 2
columns.torque = { column = "x", unit = "N.m" }

[[runs]]
id = "b"
layout = "loop"
replicate = 2
file = "b.csv"
columns.value = { column = "y", unit = "arcmin" }
columns.torque = { column = "x", unit = "N.m" }
"""


@pytest.fixture
def folder(tmp_path):
    for name in "ab":
        (tmp_path / f"{name}.csv").write_text("x,y,z\n" + "\n".join(f"{t},{0.01 * t},{0.6 * t}" for t in range(-160, 170, 10)))
    (tmp_path / "campaign.toml").write_text(TEXT)
    return opened(tmp_path)


def put(folder, place, value):
    edit(folder, {"of": cells(folder)["of"], "place": place, "value": value})
    return folder.campaign.read_text()


def test_one_cell_changes_and_nothing_else(folder):
    assert put(folder, ["conditions", "warm", "temperature"], "41.5 degC") == TEXT.replace('"40 degC"', '"41.5 degC"')
    assert load_campaign(folder.root).conditions["warm"].factors["temperature"] == pytest.approx(314.65)


def test_the_columns_of_one_file_are_its_own(folder):
    assert view(folder)["cells"]["runs"][1]["columns"]["value"] == {"column": "y", "unit": "arcmin"}
    put(folder, ["runs", 1, "columns", "value", "unit"], "deg")
    text = put(folder, ["runs", 1, "columns", "value", "column"], "z")
    assert text == TEXT[: TEXT.index('id = "b"')] + TEXT[TEXT.index('id = "b"') :].replace('"y"', '"z"').replace('"arcmin"', '"deg"')


def test_numbers_stay_numbers_and_marks_come_and_go(folder):
    assert "direction = -1" in put(folder, ["conditions", "warm", "direction"], "-1")
    put(folder, ["conditions", "warm", "direction"], "1")
    with_mark = put(folder, ["conditions", "warm", "held_out"], True)
    assert "held_out = true" in with_mark and load_campaign(folder.root).records[0].held_out
    assert "held_out" not in put(folder, ["conditions", "warm", "held_out"], False)
    assert "load_torque" not in put(folder, ["conditions", "warm", "load_torque"], " ")


@pytest.mark.parametrize("place, value, says", [
    (["conditions", "warm", "temperature"], "40 N", "conditions.warm"), (["runs", 0, "columns", "value", "column"], "q", "'q'"),
    (["conditions", "cold", "temperature"], "1 K", "no place"), (["campaign", "reducer"], "x", "no place"), (["runs", -1, "condition"], "warm", "no place"),
    (["runs", 0, "file"], "../x", "no place"),
])  # fmt: skip
def test_what_could_not_be_read_is_refused_and_nothing_is_written(folder, place, value, says):
    with pytest.raises(InputFault, match=says) as refused:
        put(folder, place, value)
    assert folder.campaign.read_text() == TEXT and ".part" not in str(refused.value) and str(folder.root) not in str(refused.value)
    assert sorted(p.name for p in folder.root.iterdir() if not p.name.startswith(".w")) == ["a.csv", "b.csv", "campaign.toml"]


def test_a_factor_of_one_column_is_a_cell(folder):
    assert "scale = 0.25" in put(folder, ["runs", 0, "columns", "value", "scale"], "1/4")
    assert view(folder)["cells"]["runs"][0]["columns"]["value"]["scale"] == 0.25
    assert "scale" not in put(folder, ["runs", 0, "columns", "value", "scale"], "")


def test_an_older_view_of_the_file_is_refused(folder):
    of = cells(folder)["of"]
    put(folder, ["conditions", "warm", "temperature"], "39 degC")
    with pytest.raises(InputFault, match="was changed since"):
        edit(folder, {"of": of, "place": ["conditions", "warm", "temperature"], "value": "38 degC"})


ANGLES = """[campaign]
name = "angles"
reducer = "RV20E-121"
[quantities.transmission_error]
angle_of = "output"
[conditions.a]
output_speed = "15 rpm"
load_torque = "0 N.m"
[layouts.other]
quantity = "transmission_error"
condition = "a"
columns.value = { column = "te", unit = "arcsec" }
columns.angle = { column = "phi [deg]", unit = "deg" }  # of the recorder
[[runs]]
id = "one"
quantity = "transmission_error"
condition = "a"
file = "one.csv"
columns.value = { column = "te", unit = "arcsec" }
columns.angle = { column = "phi [deg]", unit = "deg" }
columns.time = { column = "t", unit = "s" }
[[runs]]
id = "two"
layout = "other"
replicate = 2
file = "two.csv"
"""


@pytest.fixture
def angles(tmp_path):
    for name in ("one", "two"):
        (tmp_path / f"{name}.csv").write_text("t,phi [deg],te\n" + "\n".join(f"{0.01 * k},{108.9 * k},{k % 7}" for k in range(401)))
    (tmp_path / "campaign.toml").write_text(ANGLES)
    return opened(tmp_path)


def test_an_angle_of_the_motor_is_mended_where_runs_and_layouts_read_it(angles):
    """The doubt names the control, its mending the role in the file; the campaign's word on angles was of the output's."""
    found = [f for f in view(angles)["findings"] if f.get("role")]
    assert found[0]["column"] == "phi [deg]" and found[0]["remedy"] == "choose angle of the input (motor) as the role of column phi [deg]"
    mend(angles, {"column": "phi [deg]", "role": found[0]["role"]})
    text, campaign = angles.campaign.read_text(), load_campaign(angles.root)
    assert text.count("columns.input_angle = ") == 2 and "columns.angle" not in text and "# of the recorder" in text
    assert not [f for f in view(angles)["findings"] if f.get("role")]
    for record in campaign.records:
        assert record.axes["angle"].max() == pytest.approx(2.0 * np.pi, rel=0.01) and not record.of_output
    mend(angles, {"column": "phi [deg]", "role": "angle"})
    assert "input_angle" not in angles.campaign.read_text() and 'angle_of = "input"' not in angles.campaign.read_text()


def test_a_column_or_role_that_there_is_not_mends_nothing(angles):
    for column, role, said in (("psi", "input_angle", "no run of campaign.toml reads a column 'psi'"), ("phi [deg]", "inputangle", "inputangle")):
        with pytest.raises(InputFault, match=said):
            mend(angles, {"column": column, "role": role})
    assert angles.campaign.read_text() == ANGLES


def test_the_role_of_one_run_s_column_is_a_cell(angles):
    text = put(angles, ["runs", 0, "columns", "angle"], "input_angle")
    assert text.count("columns.input_angle = ") == 1 and text.count("columns.angle = ") == 1 and text.count('angle_of = "input"') == 1
    with pytest.raises(InputFault, match=r"unit 's' does not fit"):
        put(angles, ["runs", 0, "columns", "time"], "input_angle")
    both = {"columns": {"angle": "a", "input_angle": "b"}}
    turn(both, "angle", "input_angle")
    assert both == {"columns": {"input_angle": "a", "angle": "b"}}
