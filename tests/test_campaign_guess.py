"""Files as benches write them become campaigns: what is guessed is what was written, and what is not sure is said."""

import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCSEC, CURVES, DEG, ERROR, GUESSED_UNITS, TURN, WRITTEN, binary, write

from discrepancy.campaign.guess.lines_above import stated_above
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.run import steps_above
from discrepancy.campaign.guess.table import table_of
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked

ROOT = Path(__file__).resolve().parents[1]


@pytest.mark.parametrize("kind", WRITTEN)
def test_what_was_written_is_read(tmp_path, kind):
    what = WRITTEN[kind][0]
    path = write(tmp_path, kind)
    proposal = propose([path], Wishes("RV20E-121", conditions={"hours": "0 h"}))
    campaign = checked(proposal)
    record = campaign.records[0]
    quantity, curves = CURVES[what]
    assert record.quantity == quantity
    # Nobody knows where an encoder's zero is.
    assert [n.parameter.name for n in campaign.nuisances] == ["encoder_phase"] * (quantity == "transmission_error")
    assert record.values == pytest.approx(curves["value"], abs=2e-6 * np.abs(curves["value"]).max() + 6e-6 * WRITTEN[kind][4][1])
    for axis, values in curves.items():
        if axis != "value":
            offset = 990 * DEG if kind == "thousands" else 0.0
            assert record.axes[axis] == pytest.approx(values + offset, rel=1e-5, abs=1e-5)
    if what in ("te", "drag"):
        assert record.factors["load"] == pytest.approx(167.0)
    said = [d.text for d in proposal.doubts if d.text.startswith("unit of column")]
    assert bool(said) == (kind in GUESSED_UNITS)
    assert not proposal.needs and record.replicate == 1


@pytest.mark.parametrize("ending", ["parquet", "mat", "mf4", "tdms"])
def test_binary_formats(tmp_path, ending):
    proposal = propose([binary(tmp_path, ending)], Wishes("RV20E-121", angle_of="output"))
    record = checked(proposal).records[0]
    assert record.quantity == "transmission_error"
    assert record.axes["angle"] == pytest.approx(ANGLE) and record.values == pytest.approx(ERROR)
    assert not proposal.doubts and [need.text for need in proposal.needs] == [
        "transmission_error needs input_speed or output_speed", "transmission_error needs load_torque",
    ]  # fmt: skip


@pytest.mark.parametrize("word", ["#NV", "---", ""])
def test_a_text_cell_is_a_dropout_and_said(tmp_path, word):
    path = write(tmp_path, "german")
    lines = path.read_text(encoding="cp1252").splitlines()
    lines[5] = lines[5].partition(";")[0] + ";" + word
    path.write_text("\n".join(lines), encoding="cp1252")
    proposal = propose([path], Wishes("RV20E-121"))
    campaign = checked(proposal)
    assert campaign.rows["te_167Nm_15rpm_1"].dropped == 1
    assert any(word in d.text for d in proposal.doubts) == bool(word) or not word


def test_both_encoders_and_steps(tmp_path):
    steps = 1 << 20
    pd.DataFrame({"enc_out (counts)": ANGLE / TURN * steps, "motor angle [rad]": 121 * (ANGLE - ERROR)}).round(9).to_csv(tmp_path / "te_1.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121", counts={"enc_out (counts)": steps}))
    record = checked(proposal).records[0]
    assert record.values == pytest.approx(ERROR, abs=1e-9)
    assumed = propose([tmp_path], Wishes("RV20E-121"))
    assert any("counts steps" in d.text and "--counts" in d.remedy for d in assumed.doubts)


@pytest.mark.parametrize(("reach", "steps"), [
    (3_598_512.0, 3_600_000), (35_990.0, 36_000), (1_048_500.0, 1 << 20), (65_535.0, 1 << 16), (3_130_000.0, 1 << 22), (65_500.0, 1 << 16), (1.0, 1),
])  # fmt: skip
def test_steps_of_a_turn_are_a_power_of_two_or_the_round_number_that_a_turn_just_misses(reach, steps):
    """Of 3,600,000 steps 4,194,304 were assumed, and a turn was 0.86 of one."""
    assert steps_above(reach)[0] == steps


def test_an_error_that_was_measured_counts_before_both_encoders(tmp_path):
    turned = np.linspace(0.0, 360.0, 400)
    heads = {"Input angle (rev)": turned * 121.0 / 360.0, "Output angle (deg)": turned}
    for name in ("TE (arcsec)", "Following error (arcsec)"):
        pd.DataFrame(heads | {name: 8.0 * np.sin(np.radians(40.0 * turned))}).to_csv(tmp_path / "run_50Nm_600rpm.csv", index=False)
        (run,) = propose([tmp_path], Wishes("RV20E-121")).runs
        columns = {role: entry.header for role, entry in run.guessed.columns.items()}
        measured = {"value": "TE (arcsec)", "angle": "Output angle (deg)"}
        encoders = {"angle": "Output angle (deg)", "input_angle": "Input angle (rev)"}
        assert run.guessed.quantity.value == "transmission_error" and columns == (measured if name.startswith("TE") else encoders)


def test_an_encoder_that_jumps_is_joined(tmp_path):
    pd.DataFrame({"angle_deg": np.degrees(ANGLE) % 360.0, "te_arcsec": ERROR / ARCSEC}).to_csv(tmp_path / "te_1.csv", index=False)
    assert checked(propose([tmp_path], Wishes("RV20E-121"))).records[0].axes["angle"] == pytest.approx(ANGLE)


def test_mountings_that_are_dates_are_no_numbers(tmp_path):
    for day in ("2024.01.02", "2024.01.03", "2024.01.04"):
        pd.DataFrame({"angle_deg": np.degrees(ANGLE), "te_arcsec": ERROR / ARCSEC}).to_csv(tmp_path / f"te_{day}_1.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121", names=("te_{mounting}_{replicate}",)))
    assert len(proposal.conditions) == 3 and [guess.reason for guess in proposal.held_out.values()] == [
        "kept for the test of what is found: the last one; nothing says which lies inside the others"
    ]  # fmt: skip


def test_moments_that_are_missing_are_no_numbers(tmp_path):
    moments = pd.date_range("2024-01-01", periods=100, freq="s").to_series(index=range(100))
    moments[5] = pd.NaT
    pd.DataFrame({"time": moments, "te_arcsec": np.arange(100.0)}).to_parquet(tmp_path / "a.parquet")
    times = table_of(tmp_path / "a.parquet").columns["time"]
    assert np.isnan(times[5]) and np.diff(times[:5]) == pytest.approx(1e9)


@pytest.mark.parametrize(("line", "found"), [
    ("# torque = 100 N.m, speed = 15 rpm; temperature: 40 °C", {"load": (100.0, "N.m"), "speed": (15.0, "rpm"), "temperature": (40.0, "degC")}),
    ("Drehmoment: 12,5 Nm; Drehzahl: 15,5 1/min", {"load": (12.5, "N.m"), "speed": (15.5, "rpm")}),
    ("Torque: 167 Nm speed: 15 rpm", {"load": (167.0, "N.m"), "speed": (15.0, "rpm")}),
    ("load torque [N.m] = 50 | input speed = 1500 rpm", {"load": (50.0, "N.m"), "input_speed": (1500.0, "rpm")}),
    ("date: 2024-03-01, time: 12:30:11", {}),
])  # fmt: skip
def test_one_line_above_a_table_may_state_several_conditions(line, found):
    assert stated_above((line,)) == found


@pytest.mark.parametrize("above", ["Date,12.11.2026,", "15.10.2026,room 22 C,", "Load,50,N m", "Rig 3,,"])
def test_figures_above_a_table_are_not_its_first_rows(tmp_path, above):
    rows = "\n".join(f"{k + 1},{torque},{0.01 * torque:.2f}" for k, torque in enumerate([0, 50, 100, 150, 100, 50, 0, -50, -100, -150]))
    (tmp_path / "hand.csv").write_text(f"Hysteresis RV-20E, input shaft clamped,,\n{above}\nNo.,Torque (N m),Twist (arcmin)\n{rows}\n")
    table = table_of(tmp_path / "hand.csv")
    assert list(table.columns) == ["No.", "Torque (N m)", "Twist (arcmin)"]
    assert len(table.columns["No."]) == 10


def test_a_pause_in_a_table_is_no_head(tmp_path):
    (tmp_path / "a.csv").write_text("torque,turning\n" + "\n".join(f"{k},{2 * k}" for k in range(6)) + "\npause,pause\n" + "\n".join(f"{k},{k}" for k in range(40)))
    assert len(table_of(tmp_path / "a.csv").columns["torque"]) == 47


def test_a_long_line_above_a_table_keeps_nobody_waiting():
    started = time.process_time()
    assert stated_above((" " * 20_000 + "x", "a" + " " * 20_000 + "1", "Torque: 15 Nm")) == {"load": (15.0, "N.m")}
    assert time.process_time() - started < 0.5


def test_repetitions_within_a_file(tmp_path):
    one = pd.DataFrame({"rep": 1, "angle_deg": np.degrees(ANGLE), "te_arcsec": ERROR / ARCSEC})
    pd.concat([one, one.assign(rep=2, te_arcsec=ERROR / ARCSEC + 0.1 * np.cos(ANGLE))]).to_csv(tmp_path / "te.csv", index=False)
    records = checked(propose([tmp_path], Wishes("RV20E-121"))).records
    assert [r.replicate for r in records] == [1, 2]
    assert records[1].axes["angle"] == pytest.approx(ANGLE)
