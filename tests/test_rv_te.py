"""The converter of a public data set of a real RV reducer, on files of its format; the data themselves where they are."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from cli.main import main
from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.from_rv_te import ORDERS, measured_in
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.write_rv_te import held_out
from fmu_src.faults import InputFault
from fmu_src.source_hash import ROOT

DATA = Path(os.environ.get("RVWEAR_DATA", ROOT.parent / "shared" / "data")) / "rv_reducer_te" / "orders.csv"
DEGREES = np.pi / 180.0


def amplitudes(direction, torque):
    """[deg] by order: the mean follows the load against the motion, the rest is one unit's."""
    found = {k: (0.017 / k**0.5) * np.exp(1j * (0.3 * k + 0.1 * (direction == "backward"))) for k in ORDERS if k}
    return {0: (-0.02 - 3e-5 * torque if direction == "forward" else -0.01 + 3e-5 * torque) + 0j} | found


def curve(direction, torque, theta):
    return sum((a * np.exp(1j * k * theta * DEGREES)).real for k, a in amplitudes(direction, torque).items())


def angles(direction, start=40.0):
    """Some more than a turn [deg], within one turn; backward they fall."""
    return start + (1 if direction == "forward" else -1) * 0.0185 * 2.0 * np.arange(9800)


def write_polished(clone, direction, speed, torque, temperature, name=None):
    theta = angles(direction)
    rng = np.random.default_rng(round(speed + torque))
    sign = 1.0 if direction == "forward" else -1.0
    columns = [
        theta % 360.0, np.full(len(theta), sign * speed), sign * torque + rng.normal(0.0, 5.0, len(theta)),
        np.full(len(theta), temperature + 0.2), curve(direction, torque, theta),
    ]  # fmt: skip
    folder = clone / "data" / "polished_dataset" / direction / f"{temperature:g}degree" / f"{speed:g}rpm"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / (name or f"{speed:.1f}rpm{torque:.1f}Nm{temperature:.1f}deg.csv")
    np.savetxt(path, np.column_stack(columns), fmt="%.12g", delimiter=",", header="theta,theta_dot,tau_load,T,theta_TE", comments="")
    return path


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    folder = tmp_path_factory.mktemp("clone")
    for direction in ("forward", "backward"):
        for speed, torque in ((100, 0), (100, 900), (1000, 300), (1000, 1800), (1800, 900)):
            write_polished(folder, direction, speed, torque, 25)
    return folder


def test_a_clone_becomes_a_campaign(clone, tmp_path, capsys):
    assert main(["campaign", "from-rv-te", str(clone), str(tmp_path / "c"), "--held-out", "0.3", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert (said["runs"], said["conditions"], said["left_out"]) == (10, 10, [])
    campaign = load_campaign(tmp_path / "c")
    assert len(campaign.held_out) == 3 and not {r.condition for r in campaign.held_out} & {r.condition for r in campaign.training}
    for record in campaign.records:
        direction = "forward" if record.factors["direction"] > 0 else "backward"
        torque = float(record.condition.split("_")[2].removesuffix("Nm"))
        assert record.factors["load"] == pytest.approx(torque, abs=1.0)
        assert record.factors["temperature"] == pytest.approx(298.35, abs=0.01)
        found = dict(zip(record.axes["order"][::2], record.values[::2] + 1j * record.values[1::2]))
        assert list(found) == list(ORDERS[1:])
        for k, a in found.items():
            assert abs(a - amplitudes(direction, torque)[int(k)] * DEGREES) < 2e-3 * abs(a)
    assert not check_campaign(campaign).problems


def test_the_mean_is_there_for_who_knows_the_zero(clone, tmp_path):
    main(["campaign", "from-rv-te", str(clone), str(tmp_path / "c")])
    path = tmp_path / "c" / "campaign.toml"
    path.write_text(path.read_text().replace("# [quantities.", "[quantities.").replace('# zero = "abs', 'zero = "abs'))
    for record in load_campaign(tmp_path / "c").records:
        direction = "forward" if record.factors["direction"] > 0 else "backward"
        torque = float(record.condition.split("_")[2].removesuffix("Nm"))
        assert record.axes["order"][0] == 0.0
        assert record.values[0] == pytest.approx(amplitudes(direction, torque)[0].real * DEGREES, rel=1e-4)


def test_both_senses_side_by_side(tmp_path):
    """The simplified files, with their own names of columns; one sense has fewer rows."""
    folder = tmp_path / "data" / "simplified_dataset" / "Test_25degree" / "1000rpm"
    folder.mkdir(parents=True)
    forward, backward = angles("forward", 0.01), angles("backward", 359.99)
    columns = [forward % 360.0, curve("forward", 300, forward), backward % 360.0, curve("backward", 300, backward)]
    rows = [",".join(f"{v:.12g}" if k < 2 or i < 9790 else "" for k, v in enumerate(row)) for i, row in enumerate(zip(*columns))]
    head = "Poisition_Output_Reducer_Fw,Transmission_Error_Fw,Position_Output_Reducer_Bw,Transmission_Error_Bw"
    (folder / "1000.0rpm300.0Nm25.0deg.csv").write_text("\n".join([head, *rows]) + "\n")
    runs, wrong = measured_in(tmp_path)
    assert [run.condition for run in runs] == ["fw_1000rpm_300Nm_25degC", "bw_1000rpm_300Nm_25degC"] and not wrong
    for run, direction in zip(runs, ("forward", "backward")):
        expected = np.array(list(amplitudes(direction, 300).values())) * DEGREES
        assert np.abs(run.amplitudes - expected).max() < 1e-3 * 0.017 * DEGREES


def test_files_that_cannot_be_used_are_named_and_left_out(tmp_path, capsys):
    write_polished(tmp_path, "forward", 100, 900, 25)
    folder = write_polished(tmp_path, "forward", 100, 0, 25).parent
    (folder / "100.0rpm100.0Nm25.0deg.csv").write_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\n")
    (folder / "100.0rpm200.0Nm25.0deg.csv").write_text("theta,T\n1,2\n")
    short = (folder / "100.0rpm0.0Nm25.0deg.csv").read_text().splitlines()[:3000]
    (folder / "100.0rpm300.0Nm25.0deg.csv").write_text("\n".join(short))
    write_polished(tmp_path, "forward", 100, 400, 25, "100.0rpm800.0Nm25.0deg.csv")
    turned = "\n".join(reversed((folder / "100.0rpm0.0Nm25.0deg.csv").read_text().splitlines()[1:]))
    (folder / "100.0rpm10.0Nm25.0deg.csv").write_text("theta,theta_dot,tau_load,T,theta_TE\n" + turned)
    assert main(["campaign", "from-rv-te", str(tmp_path), str(tmp_path / "c"), "--json"]) == 1
    said = json.loads(capsys.readouterr().out)
    assert said["runs"] == 2
    for path, text in (
        ("100.0rpm100.0Nm", "git lfs pull"), ("100.0rpm200.0Nm", "has the columns theta, T; needed are theta, theta_TE"),
        ("100.0rpm300.0Nm", "columns theta, theta_TE [deg]: the angle spans 110.9 deg"), ("100.0rpm800.0Nm", "N.m, the file's name says 800 N.m: another condition"),
        ("100.0rpm10.0Nm", "falls though it turned forward"),
    ):  # fmt: skip
        assert any(path in line and text in line for line in said["left_out"]), text


def test_what_is_no_clone(tmp_path):
    with pytest.raises(InputFault, match="holds no file like 1000.0rpm100.0Nm25.0deg.csv"):
        measured_in(tmp_path)
    with pytest.raises(InputFault, match="there is no such folder or file"):
        measured_in(tmp_path / "no")


TABLE = """dir,rpm,T,tor,a0,a1,p1,a78,p78
fw,1000,25,900,60000,17000,-0.007,300,1.1
bw,1000,25,100,6600,17000,-0.007,100,1.2
bw,100,25,200,1280,17000,-0.007,100,1.2
bw,1000,25,900,21000,17000,-0.007,{a78},1.2
"""


def test_a_table_whose_mean_has_lost_its_sign(tmp_path):
    """The output lags: forward below the input, backward above it where the load is high; where nobody knows there is no order 0."""
    path = tmp_path / "orders.csv"
    path.write_text(TABLE.format(a78=280))
    runs, _ = measured_in(path)
    means = [run.amplitudes[0].real / DEGREES * 1e6 if run.orders[0] == 0.0 else None for run in runs]
    assert means == [pytest.approx(-60000.0), pytest.approx(-6600.0), None, pytest.approx(21000.0)]
    assert runs[3].amplitudes[-1] == pytest.approx(280e-6 * DEGREES * np.exp(1.2j))
    path.write_text(TABLE.format(a78="x"))
    with pytest.raises(InputFault, match=r"line 5: column a78 = 'x' is no number"):
        measured_in(path)
    path.write_text(TABLE.replace("-0.007,300", "-0.007,5,300"))
    with pytest.raises(InputFault, match=r"line 2: has 1 cells more than the head has columns"):
        measured_in(path)
    path.write_text(TABLE.replace("p78", "q78"))
    with pytest.raises(InputFault, match="has no column 'p78'"):
        measured_in(path)


def test_nothing_is_overwritten(clone, tmp_path, capsys):
    assert main(["campaign", "from-rv-te", str(clone), str(tmp_path)]) == 0
    assert main(["campaign", "from-rv-te", str(clone), str(tmp_path)]) == 2
    assert "exists already; choose another folder" in capsys.readouterr().err


def test_what_is_held_out_hangs_on_names_only():
    names = [f"c{k}" for k in range(50)]
    assert held_out(names, 0.2) == held_out(names, 0.2) and len(held_out(names, 0.2)) == 10


@pytest.mark.parametrize("forward, backward, share, expected", [(49, 15, 0.2, (10, 3)), (5, 5, 0.3, (2, 1)), (8, 0, 0.25, (2, 0)), (30, 2, 0.2, (6, 0))])
def test_each_sense_has_its_share_of_what_is_held_out(forward, backward, share, expected):
    """Drawn from all together, 13 of 49 and 15 had 2 backward ones."""
    names = [f"fw_{k}" for k in range(forward)] + [f"bw_{k}" for k in range(backward)]
    for seed in range(10):
        held = held_out(names, share, seed)
        counts = tuple(sum(name.startswith(sense) for name in held) for sense in ("fw", "bw"))
        assert sum(counts) == round(share * len(names)) and all(abs(a - b) <= 1 for a, b in zip(counts, expected))
    assert len({frozenset(held_out(names, share, seed)) for seed in range(10)}) > 1


@pytest.mark.skipif(not DATA.is_file(), reason=f"no measurements at {DATA}; set RVWEAR_DATA to their folder")
def test_the_rig_itself(tmp_path):
    assert main(["campaign", "from-rv-te", str(DATA), str(tmp_path / "c")]) == 0
    campaign = load_campaign(tmp_path / "c")
    assert (len(campaign.records), len(campaign.held_out)) == (64, 13)
    arcsec = np.pi / 648000.0
    first = [np.hypot(*r.values[:2]) / arcsec for r in campaign.records]
    assert min(first) > 55.0 and max(first) < 70.0
    # What the README of the data says: order 78 follows the load, with nothing at none.
    load = np.array([r.factors["load"] for r in campaign.records])
    amplitude = [np.hypot(*r.values[(r.axes["order"] == 78.0)]) / arcsec for r in campaign.records]
    assert np.corrcoef(load, amplitude)[0, 1] > 0.9
    assert not check_campaign(campaign).problems
