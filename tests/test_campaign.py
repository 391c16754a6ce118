"""What a campaign's file says comes out in the records, in SI units."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from discrepancy.campaign.load import load_campaign
from fmu_src.faults import InputFault

HEAD = """
[campaign]
name = "small"
reducer = "RV20E-121-rigid"

[conditions.warm]
output_speed = "15 rpm"
load_torque = "50 %"
temperature = "40 degC"
hours = { value = 2, unit = "h" }
direction = "reverse"
mounting = "B"
interventions = ["grease_changed"]

[conditions.other]
input_speed = "1815 rpm"
load_torque = "167 Nm"
held_out = true
"""
FILE = """\
t,phi,torque,test,speed,state
1720085544312973400,0,1.0,0,10,ok
1720085544313973400,1,2.0,0,10,ok
1720085544314973400,2,-999,1,11,ok
1720085544315973400,3,,1,12,ok
1720085544316973400,4,5.0,1,13,ok
1720085544317973400,5,7.0,1,14,fault
"""


def load(folder, text):
    (folder / "campaign.toml").write_text(HEAD + text, encoding="utf-8")
    (folder / "a.csv").write_text(FILE, encoding="utf-8")
    return load_campaign(folder)


def run(text, condition="warm", quantity="input_torque", name="r"):
    return f'[[runs]]\nid = "{name}"\ncondition = "{condition}"\nquantity = "{quantity}"\n{text}\n'


TORQUE = 'file = "a.csv"\ncolumns.value = { column = "torque", unit = "N.m" }\n'


def test_conditions_in_si_units(tmp_path):
    campaign = load(tmp_path, run('value = "0.5 N.m"') + run('value = "0.5 N.m"', "other", name="s"))
    warm, other = campaign.records
    assert warm.factors == pytest.approx(
        {"speed": 121 * 15 * math.pi / 30, "load": 83.5, "temperature": 313.15, "hours": 7200.0, "direction": -1.0}
    )
    assert other.factors == pytest.approx({"speed": 1815 * math.pi / 30, "load": 167.0, "direction": 1.0})
    assert (warm.mounting, other.mounting) == ("B", "1")
    assert (warm.held_out, other.held_out) == (False, True)
    assert campaign.training == (warm,) and campaign.held_out == (other,)
    assert warm.tags["interventions"] == "grease_changed"
    assert campaign.rated_torque == 167.0 and campaign.ratio == 121.0


def test_a_campaign_without_anything_to_fit_says_why(tmp_path):
    kept = load(tmp_path, run('value = "0.5 N.m"'))
    kept.require_fittable()
    with pytest.raises(InputFault, match="every run is held out; leave some conditions"):
        replace(kept, records=tuple(replace(r, held_out=True) for r in kept.records)).require_fittable()
    with pytest.raises(InputFault, match="no run has any rows yet; fill in the files"):
        replace(kept, records=()).require_fittable()


def test_rows_are_selected_dropped_and_counted(tmp_path):
    campaign = load(tmp_path, run(TORQUE + 'where = { test = 1, state = "ok" }\nmissing = [-999]'))
    assert campaign.records[0].values == pytest.approx([5.0])
    rows = campaign.rows["r"]
    assert (rows.selected, rows.dropped, rows.used) == (3, 2, 1)
    ranged = load(tmp_path, run(TORQUE + "where = { speed = { min = 13, max = 14 } }"))
    assert ranged.records[0].values == pytest.approx([5.0, 7.0])


def test_clock_in_nanoseconds_keeps_its_digits(tmp_path):
    time = 'columns.time = { column = "t", unit = "ns", from_start = true }'
    record = load(tmp_path, run(TORQUE + time)).records[0]
    assert record.axes["time"] == pytest.approx([0.0, 1e-3, 2e-3, 4e-3, 5e-3], abs=1e-12)


def test_a_moment_that_is_missing_drops_its_row(tmp_path):
    moments = pd.date_range("2024-01-01", periods=5, freq="ms").to_series(index=range(5))
    moments[0] = moments[2] = pd.NaT
    pd.DataFrame({"t": moments, "torque": np.arange(5.0)}).to_parquet(tmp_path / "a.parquet")
    time = 'columns.time = { column = "t", unit = "ns", from_start = true }'
    campaign = load(tmp_path, run(TORQUE.replace("a.csv", "a.parquet") + time))
    assert campaign.records[0].values.tolist() == [1.0, 3.0, 4.0] and campaign.rows["r"].dropped == 2
    assert campaign.records[0].axes["time"] == pytest.approx([0.0, 2e-3, 3e-3], abs=1e-12)


def test_columns_may_be_factors_row_by_row(tmp_path):
    speed = 'columns.output_speed = { column = "speed", unit = "rpm" }'
    record = load(tmp_path, run(TORQUE + speed)).records[0]
    assert record.axes["speed"] == pytest.approx(121 * math.pi / 30 * np.array([10.0, 10.0, 11.0, 13.0, 14.0]))
    assert "speed" not in record.factors and "load" in record.factors


def test_table_and_value_written_in_the_campaign(tmp_path):
    table = (
        'tags.surface = "inner_race"\ntable.hours = { values = [0, 600], unit = "h" }\n'
        'table.value = { values = [0, 12.0], unit = "um" }'
    )
    record = load(tmp_path, run(table, quantity="wear_depth")).records[0]
    assert record.axes["hours"] == pytest.approx([0.0, 600 * 3600.0])
    assert record.values == pytest.approx([0.0, 12e-6])
    stiffness = load(tmp_path, run('value = "49 N.m/arcmin"\nnoise = "1 N.m/arcmin"', quantity="torsional_stiffness"))
    assert stiffness.records[0].values == pytest.approx([49 * 60 * 180 / math.pi])
    assert stiffness.records[0].stated_noise == pytest.approx(60 * 180 / math.pi)


def test_noise_of_a_temperature_is_a_difference(tmp_path):
    text = (
        'tags.location = "housing"\nnoise = "0.2 degC"\ntable.time = { values = [0], unit = "s" }\n'
        'table.value = { values = [25], unit = "degC" }'
    )
    record = load(tmp_path, run(text, quantity="temperature")).records[0]
    assert record.values == pytest.approx([298.15]) and record.stated_noise == pytest.approx(0.2)


def test_layout_is_shared_and_overruled(tmp_path):
    layout = '[layouts.bench]\nquantity = "input_torque"\nreplicate = 7\n' + TORQUE
    runs = '[[runs]]\nlayout = "bench"\nid = "a"\ncondition = "warm"\n[[runs]]\nlayout = "bench"\nid = "b"\ncondition = "other"\nreplicate = 2\n'
    assert [record.replicate for record in load(tmp_path, layout + runs).records] == [7, 2]


def test_what_a_run_states_overrules_its_condition(tmp_path):
    text = 'value = "1 N.m"\ndirection = "forward"\nmounting = "C"\nheld_out = true\nactual = { temperature = "41 degC" }'
    record = load(tmp_path, run(text)).records[0]
    assert (record.factors["direction"], record.mounting, record.held_out) == (1.0, "C", True)
    assert record.factors["temperature"] == pytest.approx(314.15)


def test_transmission_error_from_two_encoders(tmp_path):
    turning = np.linspace(0.0, 2.0, 400)  # output, in turns
    error = 10.0 / 1_296_000 * np.sin(2 * np.pi * 40 * turning)
    rows = np.column_stack([360 * (turning + error) % 360, 121 * turning])
    (tmp_path / "two.csv").write_text("out,in\n" + "\n".join(f"{a!r},{b!r}" for a, b in rows.tolist()))
    text = (
        'file = "two.csv"\ncolumns.angle = { column = "out", unit = "deg", unwrap = true }\n'
        'columns.input_angle = { column = "in", unit = "turn" }'
    )
    record = load(tmp_path, run(text, quantity="transmission_error")).records[0]
    assert record.values == pytest.approx(2 * np.pi * error, abs=1e-12)
    assert record.axes["angle"] == pytest.approx(2 * np.pi * (turning + error))


def test_averages(tmp_path):
    of_points = load(tmp_path, run(TORQUE + "average = { points = 2 }\nwhere = { test = 0 }")).records[0]
    assert of_points.values == pytest.approx([1.5])
    angle = 'columns.angle = { column = "phi", unit = "deg" }\nmissing = [-999]\n'
    binned = load(tmp_path, run(TORQUE + angle + 'average = { axis = "angle", width = "4 deg" }')).records[0]
    assert binned.values == pytest.approx([1.5, 6.0])
    assert np.degrees(binned.axes["angle"]) == pytest.approx([0.5, 4.5])


def test_data_elsewhere(tmp_path):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    load(tmp_path, run(TORQUE))
    (tmp_path / "a.csv").rename(elsewhere / "a.csv")
    assert len(load_campaign(tmp_path, elsewhere).records) == 1


def test_nuisances_and_rig(tmp_path):
    text = """
[nuisances.encoder_phase]
unit = "deg"
lower = -180
upper = 180
per = "mounting"
[nuisances.bearing_clearance]
unit = "um"
start = 2.5
lower = 0
upper = 12
prior = 1
[rig]
output_speed = ["1 rpm", "30 rpm"]
load_torque = ["0 %", "200 %"]
directions = ["forward"]
quantities = ["hysteresis"]
cost_per_run = 100
"""
    campaign = load(tmp_path, run('value = "1 N.m"') + text)
    phase, clearance = campaign.nuisances
    assert (phase.per, phase.parameter.unit) == ("mounting", "rad")
    assert (phase.parameter.lower, phase.parameter.upper) == pytest.approx((-math.pi, math.pi))
    assert (clearance.parameter.off, clearance.parameter.prior) == pytest.approx((2.5e-6, 1e-6))
    assert campaign.rig.ranges["load"] == pytest.approx((0.0, 334.0))
    assert campaign.rig.ranges["speed"] == pytest.approx((121 * math.pi / 30, 121 * math.pi))
    assert campaign.rig.directions == (1,)


BAD = [
    (run('value = "5 kg"'), r"runs\[1\] \(r\)\.value = 5 kg: unit 'kg' does not fit: a unit of the same kind as 'N.m'"),
    (run("value = 5"), r"runs\[1\] \(r\)\.value = 5.* is not a number with a unit: write \"15 N.m\""),
    (run(""), r"runs\[1\] \(r\): has no numbers: give exactly one of file"),
    (run('file = "b.csv"\ncolumns.value = { column = "torque", unit = "N.m" }'), r"runs\[1\] \(r\): file = '.*b.csv': there is no such file"),
    (run('file = "a.xyz"\ncolumns.value = { column = "torque", unit = "N.m" }'), r"a.xyz"),
    (run('file = "a.csv"\ncolumns.value = { column = "torqe", unit = "N.m" }'), r"a.csv: column 'torqe': .* it has t, phi, torque"),
    (run('file = "a.csv"\ncolumns.value = { column = "torque", unit = "s" }'), r"columns.value.unit = 's': unit 's' does not fit"),
    (run('file = "a.csv"\ncolumns.value = { column = "state", unit = "N.m" }'), r"columns.value: column 'state', row 1: 'ok' is not a number; .*missing"),
    (run('file = "a.csv"\ncolumns.values = { column = "torque", unit = "N.m" }'), r"columns.values: input_torque has no such column; possible: value"),
    (run('file = "a.csv"\ncolumns.angle = { column = "phi", unit = "deg" }'), r"input_torque needs value"),
    (run(TORQUE + "where = { test = 5 }"), r"where.test = 5.0 selects no row; the column holds 0, 1"),
    (run(TORQUE + 'average = { axis = "angle", width = "1 deg" }'), r"average.axis = 'angle': not an axis of this run"),
    (run('value = "1 rad"', quantity="transmission_error"), r"value = '1 rad': transmission_error needs angle or input_angle"),
    (run('value = "1 um"', quantity="wear_depth"), r"wear_depth needs tags.surface \(flank, pin, inner_race, outer_race\)"),
    (run('value = "1 um"\ntags.surface = "tooth"', quantity="wear_depth"), r"tags.surface = 'tooth': choose one of flank"),
    (run('value = "1 um"\ntags = { surface = "pin", disc = 3 }', quantity="wear_depth"), r"tags.disc = '3': give the number of the disc, from 1 to 2"),
    (run('value = "1 N.m"', quantity="torque_in"), r"runs\[1\] \(r\).quantity = 'torque_in': 'torque_in' is not a quantity"),
    (run('value = "1 N.m"', condition="hot"), r"condition = 'hot': there is no such condition \(warm, other\); add \[conditions.hot\]"),
    (run('value = "1 N.m"') * 2, r"id = 'r' is used twice, first in runs\[1\]"),
    (run('value = "1 N.m"') + run('value = "1 N.m"', name="s"), r"\(s\): replicate = 1: r is replicate 1 of input_torque in warm already"),
    (run('value = "1 N.m"\nreplicate = 0'), r"runs\[1\] \(r\).replicate = 0: it should be greater than or equal to 1"),
    (run('value = "1 N.m"\nnoise = "-1 N.m"'), r"noise = -1 N.m: a standard deviation must be positive"),
    (run('value = "1 N.m"\nreplicates = 2'), r"runs\[1\] \(r\).replicates = 2 is not a key here; did you mean replicate"),
    ('[conditions.x]\ninptu_speed = "1 rpm"\n' + run('value = "1 N.m"'), r"conditions.x.inptu_speed = '1 rpm' is not a key here; did you mean input_speed"),
    ('[conditions.x]\ninput_speed = "-1 rpm"\n' + run('value = "1 N.m"'), r"conditions.x.input_speed = -1 rpm: .* direction = \"reverse\""),
    ('[conditions.x]\ninput_speed = "1 rpm"\noutput_speed = "1 rpm"\n' + run('value = "1 N.m"'), r"the speed is given twice"),
    ('[conditions.x]\ntemperature = "-300 degC"\n' + run('value = "1 N.m"'), r"conditions.x.temperature = -300 degC: a finite number from 0 K on"),
    ('[conditions.x]\ndirection = "left"\n' + run('value = "1 N.m"'), r"conditions.x.direction = 'left': it should be 'forward', 'reverse'"),
    ('[conditions.x]\ninterventions = ["oiled"]\n' + run('value = "1 N.m"'), r"'oiled' is not an intervention; choose from grease_changed"),
    ('[nuisances.phase]\nunit = "deg"\nlower = 2\nupper = 1\n' + run('value = "1 N.m"'), r"nuisances.phase: lower = 2, start = 0, upper = 1 deg: must rise"),
    ('[nuisances.phase]\nunit = "deg"\nupper = 1\n' + run('value = "1 N.m"'), r"nuisances.phase.lower is missing; add it"),
    ('[rig]\nload_torque = ["9 N.m", "1 N.m"]\n' + run('value = "1 N.m"'), r"rig.load_torque = .*: give the lowest first"),
    ('[[runs]]\nlayout = "none"\n', r"runs\[1\].layout = 'none': there is no such layout"),
    (run(TORQUE + 'columns.input_speed = { column = "speed", unit = "rpm", scale = -1 }'), r"columns.input_speed: median .* cannot be; use scale = -1"),
    ("runs = 3", r"not a TOML file|runs"),
]  # fmt: skip


@pytest.mark.parametrize("text, said", BAD)
def test_bad_input_names_place_value_and_remedy(tmp_path, text, said):
    with pytest.raises(InputFault, match=said) as fault:
        load(tmp_path, text)
    assert str(tmp_path / "campaign.toml") in str(fault.value)


def test_shares_and_output_speeds_need_a_reducer(tmp_path):
    head = '[campaign]\nname = "x"\n[conditions.a]\n'
    for stated, said in (('load_torque = "50 %"', "rated_torque"), ('output_speed = "1 rpm"', "ratio")):
        (tmp_path / "campaign.toml").write_text(head + stated + "\n" + run('value = "1 N.m"', "a"))
        with pytest.raises(InputFault, match=said):
            load_campaign(tmp_path)
    head = '[campaign]\nname = "x"\nratio = 13\nrated_torque = "20 N.m"\n[conditions.a]\nload_torque = "50 %"\noutput_speed = "1 rpm"\n'
    (tmp_path / "campaign.toml").write_text(head + run('value = "1 N.m"', "a"))
    assert load_campaign(tmp_path).records[0].factors["load"] == 10.0


def test_no_campaign(tmp_path):
    with pytest.raises(InputFault, match="no campaign file at .*; rvwear campaign from .* makes one of measured files, rvwear campaign template"):
        load_campaign(tmp_path)


def test_no_campaign_where_the_files_lie_elsewhere_names_both_folders(tmp_path):
    with pytest.raises(InputFault, match="rvwear campaign from 'my files' --output .* --reducer"):
        load_campaign(tmp_path, "my files")
