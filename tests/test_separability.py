"""What a campaign could not tell apart, said before anything is measured."""

import argparse
import json
from dataclasses import replace

import numpy as np
import pytest

from cli.commands import campaign as campaign_commands
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.planned import with_planned
from discrepancy.campaign.template import write_template
from discrepancy.experiment.separability import separability, thinned
from fmu_src.faults import InputFault

CONDITION = """[conditions.c{k}]
input_speed = "{speed} rpm"
load_torque = "{load} N.m"
temperature = "{temperature} degC"
hours = "0 h"
"""


def planned_torque(folder, speeds) -> None:
    """Input torque at some speeds and one load, nothing measured yet."""
    lines = ['[campaign]\nname = "plan"\nreducer = "RV20E-121-rigid"\n']
    for k, speed in enumerate(speeds):
        lines.append(CONDITION.format(k=k, speed=speed, load=100, temperature=20))
        lines.append(f'[[runs]]\nid = "r{k}"\nquantity = "input_torque"\ncondition = "c{k}"\nnoise = "0.01 N.m"\nfile = "t{k}.csv"\n'
                     'columns.value = { column = "y", unit = "N.m" }\n')  # fmt: skip
        (folder / f"t{k}.csv").write_text("y\n", encoding="utf-8")
    (folder / "campaign.toml").write_text("\n".join(lines), encoding="utf-8")


def test_planned_runs_have_axes_and_nothing_in_them(tmp_path):
    write_template(tmp_path / "plan", ("transmission_error", "hysteresis", "input_torque"))
    campaign, planned = with_planned(load_campaign(tmp_path / "plan"))
    assert len(planned) == 9
    records = {r.quantity: r for r in campaign.records}
    assert np.ptp(records["transmission_error"].axes["angle"]) > 6.2
    assert records["hysteresis"].axes["torque"].max() == pytest.approx(campaign.rated_torque)
    assert not any(np.any(r.values) for r in campaign.records)
    assert {r.held_out for r in campaign.records} == {True, False}


def test_one_speed_cannot_tell_an_offset_from_drag_and_many_can(tmp_path):
    planned_torque(tmp_path, [500])
    one = separability(load_campaign(tmp_path))
    assert {(p.hidden, p.rival) for p in one.alike} >= {("drag", "sensor_offset"), ("sensor_offset", "drag")}
    assert one.planned == ("r0",)
    planned_torque(tmp_path, [100, 400, 800, 1500, 2400])
    many = {(p.hidden, p.rival): p for p in separability(load_campaign(tmp_path)).pairs}
    assert many["drag", "sensor_offset"].typical > 1.0
    assert many["sensor_gain", "sensor_offset"].typical == pytest.approx(0.0, abs=0.1)


def test_command_says_it_on_request(tmp_path, capsys):
    planned_torque(tmp_path, [500])
    options = argparse.Namespace(folder=str(tmp_path), data=None, json=True, separable=True)
    campaign_commands.run_check(options)
    found = json.loads(capsys.readouterr().out)["separability"]
    assert found["planned"] == ["r0"]
    assert {"hidden", "rival", "least", "typical", "error"} == set(found["pairs"][0])
    options.json = False
    campaign_commands.run_check(options)
    assert "no test could tell apart" in capsys.readouterr().out
    options.separable, options.json = False, True
    campaign_commands.run_check(options)
    assert "separability" not in json.loads(capsys.readouterr().out)


def test_samples_that_no_effect_needs_are_left_out(tmp_path):
    write_template(tmp_path / "plan", ("hysteresis",))
    record = with_planned(load_campaign(tmp_path / "plan"))[0].records[0]
    assert thinned(record) is record
    long = replace(record, values=np.arange(2000.0), axes={"torque": np.arange(2000.0)})
    assert len(thinned(long).values) == len(thinned(long).axes["torque"]) == 500


def test_without_a_model_nothing_can_be_told(tmp_path):
    planned_torque(tmp_path, [500])
    file = tmp_path / "campaign.toml"
    file.write_text(file.read_text(encoding="utf-8").replace('reducer = "RV20E-121-rigid"', "ratio = 121.0"), encoding="utf-8")
    with pytest.raises(InputFault, match="state \\[campaign\\] reducer"):
        separability(load_campaign(tmp_path))
