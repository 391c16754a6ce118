"""A campaign over real data, if it is there: $RVWEAR_DATA or ../shared/data beside the checkout."""

import os
from pathlib import Path

import numpy as np
import pytest
from test_campaign_documentation import write

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.load import load_campaign
from fmu_src.source_hash import ROOT

DATA = Path(os.environ.get("RVWEAR_DATA", ROOT.parent / "shared" / "data")) / "cycloidal_actuator"

pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason=f"no measurements at {DATA}; set RVWEAR_DATA to their folder")


def test_torque_ramps_of_the_documentation(tmp_path):
    write(tmp_path, 2)
    campaign = load_campaign(tmp_path, DATA)
    assert [record.name for record in campaign.held_out] == ["ramp_3"]
    for record in campaign.records:
        assert 400 < len(record.values) < 500
        assert 24.0 < np.abs(record.axes["torque"]).max() < 27.0
        # The wind-up of the plain drive, end to end: 7 to 8 degrees of the output.
        assert 6.5 < np.degrees(np.ptp(record.values)) < 8.0
    check = check_campaign(campaign)
    assert not check.problems
    assert {"no held-out condition", "no reducer"} <= {finding.code for finding in check.findings}
    status = {verdict.pair.number: verdict.status for verdict in check.pairs}
    # Loops of both signs, from small torques to more than rated, but once only and cold only.
    assert (status[4], status[7]) == ("separable", "separable")
    assert (status[1], status[5], status[9]) == ("not separable", "not separable", "not visible")


def test_run_in_at_constant_speed(tmp_path):
    (tmp_path / "campaign.toml").write_text("""
[campaign]
name = "run-in"
ratio = 13
[conditions.run]
output_speed = "0.5 rev/s"
load_torque = "0 N.m"
direction = "forward"
[[runs]]
id = "torque"
quantity = "input_torque"
condition = "run"
file = "07-04_11-32-24_run-in_split_0.5rps.csv.gz"
columns.time = { column = "TIME", unit = "ns", from_start = true }
columns.angle = { column = "POSITION", unit = "turn" }
columns.value = { column = "TORQUE", unit = "N.m", scale = 0.0769230769 }
columns.temperature = { column = "TEMPERATURE", unit = "degC" }
""")
    record = load_campaign(tmp_path, DATA).records[0]
    assert np.ptp(record.axes["time"]) == pytest.approx(58.9196, abs=1e-4)
    assert np.ptp(record.axes["angle"]) == pytest.approx(2 * np.pi * 29.515, rel=1e-3)
    assert record.axes["temperature"].max() == pytest.approx(315.15)
    assert record.factors["speed"] == pytest.approx(13 * np.pi)
