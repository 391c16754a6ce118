"""Duty cycles: files, and wear of both flanks and both sides of the raceways."""

import numpy as np
import pytest

from fmu_src.faults import InputFault
from studies.duty import Segment, load_duty
from studies.meshing_cycle import run_cycle
from studies.pair import make_pair

FILE = """
[[segment]]
speed = { value = 2000, unit = "rpm" }
torque = { value = 167, unit = "N.m" }
share = 0.75

[[segment]]
speed = { value = -1000, unit = "rpm" }
torque = { value = -100, unit = "N.m" }
share = 0.25
"""


def write(folder, text):
    path = folder / "duty.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_file_is_read_in_si_units(tmp_path):
    first, second = load_duty(write(tmp_path, FILE))
    assert first.speed == pytest.approx(2000 * np.pi / 30)
    assert (second.torque, second.share) == (-100.0, 0.25)


@pytest.mark.parametrize("before, after, said", [
    ("share = 0.25", "share = 0.5", "add up to 1.25"),
    ("share = 0.25", "", "segment\\[2\\].share"),
    ('"rpm"', '"mm"', "'mm' does not fit"),
    ("value = -1000", "value = 0", "standing still"),
    ("value = -100,", "value = nan,", "finite"),
    ("[[segment]]", "[[part]]", "segment"),
])  # fmt: skip
def test_bad_file_is_told_what_is_wrong(tmp_path, before, after, said):
    with pytest.raises(InputFault, match=said):
        load_duty(write(tmp_path, FILE.replace(before, after, 1)))


def worn(rv20e, segments, hours=100.0):
    pair = make_pair(rv20e, positions=36, duty=tuple(segments))
    run_cycle(pair, hours)
    return pair.wear.record()


def test_reversing_wears_both_flanks_and_both_sides_alike(rv20e):
    speed = 2000 * np.pi / 30
    record = worn(rv20e, [Segment(speed, 167.0, 0.5), Segment(-speed, -167.0, 0.5)])
    tooth = record["disc_wear"][0].reshape(-1, 180).mean(axis=0)
    # Half of the first before the second and half after it: the same mean running-in.
    assert tooth[:90] == pytest.approx(tooth[:89:-1], rel=0.02, abs=0.005 * tooth.max())
    race = record["inner_race_wear"][0].reshape(-1, 360).mean(axis=0)
    assert race[:180].max() == pytest.approx(race[180:].max(), rel=0.02)


def test_mirrored_torque_and_speed_mirror_the_wear(rv20e):
    speed = 2000 * np.pi / 30
    there, back = (worn(rv20e, [Segment(s * speed, s * 167.0, 1.0)]) for s in (1.0, -1.0))
    for name, bins in (("disc_wear", 180), ("inner_race_wear", 360), ("outer_race_wear", 360)):
        one, other = (record[name][0].reshape(-1, bins).mean(axis=0) for record in (there, back))
        assert other[::-1] == pytest.approx(one, abs=0.01 * one.max()), name
    assert back["pin_depth"][0].mean() == pytest.approx(there["pin_depth"][0].mean(), rel=1e-3)


def test_one_way_torque_wears_one_flank(rv20e):
    record = worn(rv20e, [Segment(2000 * np.pi / 30, 167.0, 1.0)])
    tooth = record["disc_wear"][0].reshape(-1, 180).mean(axis=0)
    worn_side, other = max(tooth[:90].max(), tooth[90:].max()), min(tooth[:90].max(), tooth[90:].max())
    assert other < 0.05 * worn_side


def test_hours_are_those_of_all_segments(rv20e):
    record = worn(rv20e, [Segment(200.0, 167.0, 0.3), Segment(-100.0, 50.0, 0.7)], hours=40.0)
    assert record["operating_time"][0] / 3600.0 == pytest.approx(40.0, rel=1e-9)
