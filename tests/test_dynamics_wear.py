"""Wear in motion against wear in equilibria: equal at rated speed, not at the resonance."""

import json

import pytest

from fmu_src.faults import InputFault
from studies.dynamics_wear import Comparison, as_json, compare, compare_point
from studies.report.dynamics import write_dynamics_page


@pytest.fixture(scope="module")
def rated(rv20e):
    return compare_point(rv20e, [], "rated", 1.0, 1.0, 50.0, 1)


@pytest.fixture(scope="module")
def resonant(rv20e):
    return compare_point(rv20e, [], "resonance", 3.91, 1.0, 50.0, 1)


def test_both_agree_at_rated_speed(rated):
    assert all(abs(change) < 0.5 for change in rated.volume_change.values())
    assert all(difference < 2.0 for difference in rated.map_difference.values())
    assert abs(rated.depth_change["pin_um"]) < 1.0


def test_both_agree_at_rated_speed_of_the_other_reducer(bx40e):
    assert compare_point(bx40e, [], "rated", 1.0, 1.0, 50.0, 1).largest < 2.0


def test_the_load_swings_at_resonance_and_raceways_wear_more(resonant, rated):
    assert resonant.volume_change["inner_race_volume"] > 20.0
    assert resonant.passing_Hz == pytest.approx(3.91 * rated.passing_Hz)


def test_page_and_json_say_where_it_matters(rated, resonant, tmp_path):
    found = Comparison("RV20E-121", 50.0, 2.0, 86.3, [rated, resonant])
    assert [p.name for p in found.matters] == ["resonance"]
    assert "agree within 2 % at rated." in found.sentence()
    assert [p["matters"] for p in json.loads(json.dumps(as_json(found)))["points"]] == [False, True]
    text = write_dynamics_page(found, tmp_path / "new" / "page.html").read_text(encoding="utf-8")
    assert found.sentence() in text and text.count('class="plot"') == 6


def test_senseless_comparison_is_refused(rv20e):
    with pytest.raises(InputFault, match="positive"):
        compare(rv20e, [], [0.0], 50.0, 1, 2.0)
