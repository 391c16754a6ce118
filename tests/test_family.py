"""``rvwear family``: eight sizes from catalogue numbers, five dials for all of them."""

import json

import pytest

from cli.main import main
from pages.render import rendered_sections
from studies import family as series
from studies.family import DIALS, FITTED, SIZES, dial_of, member, stiffness_of
from studies.report.family import page_of

SMALL, LARGE = SIZES[1], SIZES[-1]


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    """Stiffness is within half a percent of that of the command."""
    monkeypatch.setattr(series, "STEPS", 8)
    monkeypatch.setattr(series, "ANGLES", 2)
    monkeypatch.setattr(series, "POSITIONS", 6)


def test_at_most_five_dials_within_their_ranges_and_none_for_one_size():
    assert len(DIALS) <= 5
    for name, value in DIALS.items():
        assert dial_of(name).low <= value <= dial_of(name).high
    assert not {size.name for size in SIZES} & {word for name in DIALS for word in name.split("_")}


def test_sizes_are_near_the_catalogue_without_a_dial_of_their_own():
    """Stiffness of all eight within 40 %, of the most within a quarter; the fitted dial stands where their mean is right."""
    ratios = {size.name: stiffness_of(series.reducer_of_size(size)) / size.stiffness for size in SIZES}
    assert all(0.75 < ratio < 1.4 for ratio in ratios.values())
    assert sum(abs(ratio - 1.0) <= series.SCATTER for ratio in ratios.values()) >= 7


def test_the_fit_finds_the_dial_that_is_set(monkeypatch):
    monkeypatch.setattr(series, "SIZES", SIZES[1:5:2])
    assert 3.0 < series.fitted_share() < 9.0


def test_lost_motion_and_efficiency_of_a_small_and_a_large_size(tmp_path):
    found = [member(SMALL), member(LARGE)]
    for one in found:
        assert one.lost_motion < one.size.lost_motion and 80.0 < one.efficiency[1.0, 15.0] < 90.0 and 50.0 < one.efficiency[0.1, 15.0] < 60.0
        assert one.start_up == pytest.approx(one.size.start_up, abs=8.5)
        # What is missing, put where it is said to be missing, gives the catalogue's stiffness.
        reducer = series.reducer_of_size(one.size)
        softer = reducer.starts["crank_seat_compliance"] * (1.0 + one.missing_at_cranks)
        assert stiffness_of(reducer, f"crank.support_compliance={softer!r}m/N") == pytest.approx(one.size.stiffness, rel=0.02)
    page = rendered_sections(page_of(DIALS, found))
    assert "Where the compliance sits" in page and "RV-450E" in page


def test_command_says_what_a_dial_may_be(capsys):
    for text, said in (("support_share=99", "beyond its range of 3 to 9"), ("rv20e=1", "the family has"), ("support_share", "NAME=VALUE")):
        assert main(["family", "--dial", text]) == 2
        assert said in capsys.readouterr().err


def test_command_prints_all_sizes(capsys, monkeypatch):
    monkeypatch.setattr(series, "SIZES", SIZES[1:2])
    assert main(["family", "--json", "--dial", f"{FITTED}=5"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["dials"][FITTED] == 5.0 and [one["size"]["name"] for one in told["sizes"]] == ["RV-20E"]
    assert len(told["sizes"][0]["efficiency"]) == 12
