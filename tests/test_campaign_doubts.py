"""What cannot be is doubted, with file, column, value, unit and remedy; what can be is not."""

import re

import numpy as np
import pytest
from test_campaign_check import angle_file, campaign, codes, condition

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.doubts import path, suffices
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.row_order import jumps
from discrepancy.compare import beforehand
from discrepancy.doubts.plausible import fitting, scale_doubts
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record

RATED = 167.0
# Torque both ways; the RV20E-121 of the library turns by 1.1 arcmin at the rated torque, real ones by three times that and more.
LOOP = np.concatenate([np.linspace(0.0, RATED, 40), np.linspace(RATED, -RATED, 80), np.linspace(-RATED, 0.0, 40)])


def loop_file(folder, torque=LOOP, unit="arcmin", torque_unit="N.m", size=2.9, name="loop.csv"):
    np.savetxt(folder / name, np.column_stack([torque, size * LOOP / RATED if len(torque) == len(LOOP) else torque]), delimiter=",", header="T,phi", comments="")
    return (
        f'condition = "a"\nquantity = "hysteresis"\ntags.locked = "input"\nfile = "{name}"\n'
        f'columns.torque = {{ column = "T", unit = "{torque_unit}" }}\ncolumns.value = {{ column = "phi", unit = "{unit}" }}'
    )


def doubts(folder, run):
    campaign(folder, {"a": condition()}, [run])
    return scale_doubts(load_campaign(folder))


@pytest.mark.parametrize(("stated", "fits", "factor"), [("deg", "arcmin", "60"), ("rad", "arcmin", "3437.75"), ("arcsec", "arcmin", "60")])
def test_unit_that_the_model_cannot_believe_is_named_with_the_one_that_fits(tmp_path, stated, fits, factor):
    (found,) = doubts(tmp_path, loop_file(tmp_path, unit=stated))
    assert found.level == "warning" and f"loop.csv, column phi [{stated}]" in found.text and f" {stated}" in found.text
    assert f'"{fits}"' in found.remedy.partition("state unit = ")[2] and f"{factor} is the factor between {stated} and {fits}" in found.remedy


def test_right_units_and_softer_drives_are_believed(tmp_path):
    assert not doubts(tmp_path, loop_file(tmp_path))
    assert not doubts(tmp_path, loop_file(tmp_path, size=8 * 2.9))
    assert not doubts(tmp_path, 'condition = "a"\nquantity = "input_torque"\nvalue = "1.6 N.m"\nnoise = "0.1 N.m"')
    (found,) = doubts(tmp_path, 'condition = "a"\nquantity = "efficiency"\nvalue = "85 1"\nnoise = "1 1"')
    assert 'state unit = "%"' in found.remedy


def test_soft_drive_in_degrees_is_doubted_though_no_unit_is_near(tmp_path):
    """A unit that would be far off, too, is not offered."""
    (found,) = doubts(tmp_path, loop_file(tmp_path, unit="deg", size=10 * 2.9))
    assert found.remedy == "look at unit and scale of the column"


def test_a_loop_that_stays_near_no_torque_is_held_against_nothing(tmp_path):
    assert not doubts(tmp_path, loop_file(tmp_path, torque=1e-3 * LOOP))


def test_runs_that_are_off_alike_are_one_doubt(tmp_path):
    runs = [loop_file(tmp_path, unit="deg", size=2.9 + 0.01 * k, name=f"{k}.csv") + f"\nreplicate = {k}" for k in (1, 2, 3)]
    campaign(tmp_path, {"a": condition()}, [*runs, loop_file(tmp_path, name="right.csv") + "\nreplicate = 4"])
    (found,) = scale_doubts(load_campaign(tmp_path))
    assert "1.csv" in found.text and found.text.endswith("alike r1, r2")


def test_factors_between_units():
    assert fitting(206265.0, "rad", "rad")[0].unit == "arcsec"
    assert fitting(57.3, "rad", "rad")[0].unit == "deg" and fitting(1000.0, "mm", "m")[0].unit == "um"
    assert fitting(1.0, "deg", "rad") == [] and fitting(5.0, "barleycorn", "m") == []


def test_torque_that_no_reducer_takes(tmp_path):
    check = campaign(tmp_path, {"a": condition()}, [loop_file(tmp_path, 1000.0 * LOOP)])
    found = next(f for f in check.findings if f.code == "impossible torque")
    assert "167000 N.m (loop.csv, column T [N.m])" in found.text and "1000 times the rated 167" in found.text and 'unit = "N.mm"' in found.remedy
    kilo = campaign(tmp_path, {"a": condition()}, [loop_file(tmp_path, torque_unit="kN.m")])
    assert 'unit = "N.m"' in next(f for f in kilo.findings if f.code == "impossible torque").remedy
    assert not check.problems or {p.code for p in check.problems} == {"noise unknown"}
    assert "impossible torque" not in codes(campaign(tmp_path, {"a": condition()}, [loop_file(tmp_path, 2.5 * LOOP)]))


def test_shuffled_rows_are_found_in_their_file(tmp_path):
    shuffled = np.random.default_rng(1).permutation(LOOP)
    found = next(f for f in campaign(tmp_path, {"a": condition()}, [loop_file(tmp_path, shuffled)]).findings if f.code == "rows out of order")
    assert "torque (loop.csv, column T [N.m]) jumps back and forth" in found.text and "N.m at sample" in found.text and "order" in found.remedy


@pytest.mark.parametrize("name", ["angle", "torque"])
def test_orders_that_a_bench_makes_are_left_alone(name):
    rng = np.random.default_rng(2)
    rise = np.linspace(0.0, 10.0, 400)
    orderly = {
        "rise": rise, "fall": rise[::-1], "there and back": np.concatenate([rise, rise[::-1]]), "jitter": rise + 0.05 * rng.standard_normal(400),
        "gaps": np.delete(rise, range(100, 200)), "twice": np.concatenate([rise, rise]), "few": rng.permutation(rise[:10]), "loop": LOOP,
    }  # fmt: skip
    assert not [case for case, axis in orderly.items() if len(jumps(axis, name))]
    stairs = np.repeat([0.0, 50.0, 100.0, 150.0, 100.0, 50.0, 0.0, -50.0, -100.0, -150.0, -100.0, -50.0, 0.0], 30)
    assert not len(jumps(stairs, "torque")) and not len(jumps(rise % (2.0 * np.pi) + 0.001 * rng.standard_normal(400), "angle"))
    blocks = np.concatenate([rise[300:], rise[100:200], rise[200:300], rise[:100]])
    assert len(jumps(rng.permutation(rise), name)) > 100 and (name == "torque" or len(jumps(blocks[[*range(200), *range(300, 400), *range(200, 300)]], name)))


def test_samples_beyond_what_shows_anything(tmp_path):
    fine = np.interp(np.linspace(0.0, 1.0, 4000), np.linspace(0.0, 1.0, len(LOOP)), LOOP)
    found = next(f for f in campaign(tmp_path, {"a": condition()}, [loop_file(tmp_path, fine)]).findings if f.code == "needless samples")
    assert "4000 samples in run r0 (loop.csv, column phi [arcmin]), 400 suffice: steps of 1 %" in found.text and "average = { points = 10 }" in found.remedy
    assert "needless samples" not in codes(campaign(tmp_path, {"a": condition()}, [loop_file(tmp_path)]))
    run = angle_file(tmp_path, "te.csv", 1.0, 50_000)
    found = next(f for f in campaign(tmp_path, {"a": condition()}, [f'condition = "a"\n{run}']).findings if f.code == "needless samples")
    assert "per output turn" in found.text and "points = " in found.remedy


def test_jitter_of_a_torque_is_no_way():
    rng = np.random.default_rng(3)
    assert path(LOOP + 0.5 * rng.standard_normal(len(LOOP))) == pytest.approx(4.0 * RATED, rel=0.05)
    record = Record("r", "hysteresis", "rad", "c", 1, LOOP, {"torque": LOOP}, {})
    assert suffices(record, None)[0] == pytest.approx(400, abs=2)


def turned(friction, torque=LOOP, sign=1.0):
    """Turning [arcmin] of a loop that friction holds open; below 0 it runs the wrong way round."""
    rising = np.sign(np.gradient(torque))
    return sign * 2.9 * (torque - friction * rising) / RATED + np.random.default_rng(1).normal(0.0, 0.05, len(torque))


def loop_doubts(folder, turning, torque=LOOP):
    np.savetxt(folder / "loop.csv", np.column_stack([torque, turning]), delimiter=",", header="T,phi", comments="")
    run = (
        'condition = "a"\nquantity = "hysteresis"\ntags.locked = "input"\nfile = "loop.csv"\n'
        'columns.torque = { column = "T", unit = "N.m" }\ncolumns.value = { column = "phi", unit = "arcmin" }'
    )
    campaign(folder, {"a": condition()}, [run])
    return [finding for finding in check_campaign(load_campaign(folder)).findings if finding.code.startswith("loop")]


def test_a_loop_that_gives_work_is_doubted_and_one_that_takes_it_is_not(tmp_path):
    assert not loop_doubts(tmp_path, turned(10.0)) and not loop_doubts(tmp_path, turned(0.0))
    (found,) = loop_doubts(tmp_path, turned(-10.0))
    gap = float(re.search(r"([\d.]+) arcmin less", found.text)[1])
    assert gap == pytest.approx(2.0 * 10.0 * 2.9 / RATED, rel=0.1) and "loop.csv, column phi" in found.text and "order of time" in found.remedy
    assert len(loop_doubts(tmp_path, turned(10.0)[::-1], LOOP[::-1])) == 1


def test_a_loop_that_turns_against_its_torque_is_doubted(tmp_path):
    (found,) = loop_doubts(tmp_path, turned(10.0, sign=-1.0))
    assert "opposite senses" in found.text and "scale = -1" in found.remedy


@pytest.mark.parametrize(("turns", "seconds", "role", "said"), [
    (1.02 * 121, None, "angle", "494 s at the stated 15 rpm"), (1.02 * 121, None, "input_angle", ""), (1.02, None, "angle", ""),
    (121.0, 4.0, "angle", "121 times the stated 15 rpm"), (1.0, 4.0, "angle", ""), (1.0, 40.0, "angle", "0.1 times the stated"),
])  # fmt: skip
def test_an_angle_that_runs_on_like_the_input_is_doubted(tmp_path, turns, seconds, role, said):
    run = angle_file(tmp_path, "te.csv", turns, 4000).replace("columns.angle", f"columns.{role}")
    if seconds:
        table = np.loadtxt(tmp_path / "te.csv", delimiter=",", skiprows=1)
        np.savetxt(tmp_path / "te.csv", np.column_stack([table, np.linspace(0.0, seconds, 4000)]), delimiter=",", header="phi,te,t", comments="")
        run += '\ncolumns.time = { column = "t", unit = "s" }'
    check = campaign(tmp_path, {"a": condition()}, [f'condition = "a"\n{run}'])
    found = [f for f in check.findings if f.code == "rate of the angle"]
    assert bool(found) == bool(said)
    if said:
        assert said in found[0].text and ("input_angle=phi" in found[0].remedy) == (turns > 100)


def test_a_comparison_begins_with_an_angle_that_cannot_be(tmp_path):
    run = angle_file(tmp_path, "te.csv", 1.02 * 121, 4000)
    campaign(tmp_path, {"a": condition()}, [f'condition = "a"\n{run}'])
    found = load_campaign(tmp_path)
    said = beforehand(PhysicalModel(load_model("RV20E-121-rigid"), found), [])
    assert any("494 s at the stated 15 rpm" in text and "input_angle=phi" in text for text in said)


@pytest.mark.parametrize(("end", "more", "doubted"), [(-1.0, {}, True), (-1.0, {"direction": "forward"}, True), (-1.0, {"direction": "reverse"}, False), (1.0, {}, False)])
def test_an_angle_that_falls_though_it_turned_forward_is_doubted(tmp_path, end, more, doubted):
    check = campaign(tmp_path, {"a": condition(**more)}, [f'condition = "a"\n{angle_file(tmp_path, "te.csv", end, 4000)}'])
    assert ("sense of the angle" in codes(check)) == doubted


@pytest.mark.parametrize("turns", [1.0, 1.02 * 121])
def test_of_shuffled_rows_only_that_is_said(tmp_path, turns):
    """A remedy for the jumps and the sense of such an angle would spoil it; a comparison says it, too."""
    run = angle_file(tmp_path, "te.csv", turns, 4000)
    table = np.loadtxt(tmp_path / "te.csv", delimiter=",", skiprows=1)
    # So that it falls by its ends, too.
    shuffled = np.random.default_rng(3).permutation(table)
    shuffled = shuffled[::-1] if shuffled[:500, 0].mean() < shuffled[-500:, 0].mean() else shuffled
    np.savetxt(tmp_path / "te.csv", shuffled, delimiter=",", header="phi,te", comments="")
    loop = loop_file(tmp_path)
    table = np.loadtxt(tmp_path / "loop.csv", delimiter=",", skiprows=1)
    np.savetxt(tmp_path / "loop.csv", np.random.default_rng(1).permutation(table), delimiter=",", header="T,phi", comments="")
    check = campaign(tmp_path, {"a": condition()}, [f'condition = "a"\n{run}', loop])
    others = {"angle jumps", "sense of the angle", "rate of the angle", "uneven sampling", "loop the wrong way round"}
    assert sum(f.code == "rows out of order" for f in check.findings) == 2 and not others & codes(check)
    said = beforehand(PhysicalModel(load_model("RV20E-121-rigid"), load_campaign(tmp_path)), [])
    assert sum("jumps back and forth" in text for text in said) == 2 and not any("falls" in text for text in said)
