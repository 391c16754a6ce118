"""A reducer that is completed as stiff, and with as much lost motion, as its catalogue says."""

import json
import re
import shlex

import pytest

from cli.main import main
from reducers.checking import check
from reducers.completion.again import given_again
from reducers.completion.command import words_of
from reducers.completion.given import given_with
from reducers.reducer import load_reducer
from studies.catalogue_stiffness import as_stiff_as
from studies.hysteresis import hysteresis


def test_what_the_catalogue_asked_for_is_counted_as_found_and_given_by_nobody(tmp_path, capsys):
    """Seven things given were six in words and five in numbers, the supports that nobody gave among these."""
    path = tmp_path / "mine.toml"
    options = ["--ratio", "105", "--rated", "412", "--cranks", "2", "--speed", "15", "--diameter", "190", "--stiffness", "108", "--lost-motion", "1"]
    assert main(["reducer", "new", *options, "--output", str(path)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    given = "ratio 105, rated torque 412 N m, diameter 190 mm, 2 cranks, 15 rpm of the output, 16 rollers a bearing (as usual), lost motion 1 arcmin"
    assert f"given: {given}, torsional stiffness 108 N m/arcmin; of the file's 53 numbers 4 follow from that alone" in said
    assert "2 were looked for to meet the catalogue (disc.equidistant_modification, crank.support_compliance), " in said
    assert main(["reducer", "check", str(path)]) == 0
    told = capsys.readouterr().out
    assert "53 numbers in the file (4 given or derived, 2 looked for to meet the catalogue, " in told
    # Files of a former version say that the supports were given.
    path.write_text(path.read_text().replace('"found: makes', '"given: makes'))
    assert main(["reducer", "check", str(path)]) == 0 and capsys.readouterr().out == told


def test_numbers_given_have_the_units_they_are_read_in_and_of_a_given_stiffness_nothing_is_left_open(tmp_path, capsys):
    """The line said "disc.equidistant_modification 3.253, crank.support_compliance 8.889e-09"; the form alone had the note, and whatever was given."""
    catalogue, note = ["reducer", "new", "--ratio", "129", "--rated", "1568", "--output", str(tmp_path / "mine.toml"), "--overwrite"], "scatters by a third"
    assert main([*catalogue, "--stiffness", "392", "--known", "disc.equidistant_modification=3.253um"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "torsional stiffness 392 N m/arcmin, disc.equidistant_modification 3.253 um; of the file's" in said and note not in said
    assert main([*catalogue, "--known", "carrier.compliance=2e-7rad/(N.m)", "--known", "mesh.friction=0.05"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "carrier.compliance 0.000687549 arcmin/(N m), mesh.friction 0.05; of" in said and note in said


def test_a_lost_motion_that_no_gap_makes_is_made_by_smaller_clearances_within_their_ranges(tmp_path, capsys):
    """The rule's gap was kept: 1.28 arcmin for the 0.8 of a catalogue, where 0.877 can be had without a gap and 0.8 with bearings that fit closer."""
    path = str(tmp_path / "mine.toml")
    catalogue = ["reducer", "new", "--ratio", "1:81", "--rated", "167Nm", "--cranks", "3", "--stiffness", "60Nm/arcmin", "--diameter", "145mm",
                 "--output", path, "--overwrite"]  # fmt: skip
    assert main([*catalogue, "--lost-motion", "0.8arcmin"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert re.search(r"bearing\.clearance = 2\.\d+ um \(assumed, range 1\.5 to 5 um\); --known NAME=VALUE where one was measured", said)
    made = load_reducer(path)
    assert hysteresis(made, []).lost_motion_arcmin == pytest.approx(0.8, rel=0.01)
    assert made.starts["equidistant_modification"] == 0.0 and made.ranges["bearing_clearance"] == pytest.approx((1.5e-6, 5e-6))
    assert made.sources["bearing_clearance"].startswith("completed: makes the lost motion that of the catalogue, 0.8 arcmin; assumed")
    assert made.sources["equidistant_modification"].startswith("completed: the least of its range, for the lost motion of the catalogue, 0.8 arcmin; flank")
    # As near as it goes, and what would meet it.
    assert main([*catalogue, "--lost-motion", "0.3arcmin"]) == 0
    out = capsys.readouterr().out
    assert "first_stage.backlash = 10 um (assumed, range 10 to 80 um), the least of their ranges" in " ".join(out.split())
    assert hysteresis(load_reducer(path), []).lost_motion_arcmin == pytest.approx(0.609, rel=0.01)
    [line] = [line for line in out.splitlines() if line.startswith("  rvwear reducer new")]
    assert main([*shlex.split(line)[1:], "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["tested"]["lost_motion"] == pytest.approx(0.3, rel=0.01) and [one["met"] for one in found["catalogue"]] == [True, True]
    assert main([*catalogue, "--lost-motion", "0.1arcmin"]) == 0
    assert "no smaller clearance would make it: look at --lost-motion" in " ".join(capsys.readouterr().out.split())
    assert main([*catalogue, "--lost-motion", "0.3arcmin", "--meet-lost-motion"]) == 2
    assert "nothing within the ranges makes a lost motion of 0.3 arcmin, the least is 0.6" in capsys.readouterr().err


def test_a_gap_that_makes_the_lost_motion_is_completed_with_its_range_and_nobody_s_measure(tmp_path, capsys):
    """It stood in the file as "given: measured", without a range; a lost motion that was given was not met, where a stiffness that was given is."""
    path = tmp_path / "mine.toml"
    usual = ["reducer", "new", "--ratio", "129", "--rated", "1568", "--cranks", "3", "--output", str(path), "--overwrite"]
    assert main(usual) == 0
    # Nobody said what the catalogue has.
    assert "arcmin; --stiffness and --lost-motion of the catalogue would make it that" in " ".join(capsys.readouterr().out.split())
    catalogue = [*usual, "--lost-motion", "0.8"]
    assert main(catalogue) == 0
    assert "(the catalogue's: 0.8)" in " ".join(capsys.readouterr().out.split())
    made = load_reducer(path)
    low, high = made.ranges["equidistant_modification"]
    assert low == 0.0 and low < made.starts["equidistant_modification"] < high
    assert made.sources["equidistant_modification"].startswith("completed: makes the lost motion that of the catalogue, 0.8 arcmin; flank gap by")
    found = check(made)
    assert not found.outdated and hysteresis(made, []).lost_motion_arcmin == pytest.approx(0.8, rel=5e-3)
    given = given_again(made)
    assert given.lost_motion == 0.8 and {name: 1e-6 * size for name, size in given.made.items()} == {
        "disc.equidistant_modification": pytest.approx(made.starts["equidistant_modification"])
    }
    assert "disc.equidistant_modification" not in given.known and "--lost-motion" in words_of(given)
    assert main([*catalogue, "--meet-lost-motion", "--known", "disc.equidistant_modification=3um"]) == 2
    assert "each says the gap of the flanks; keep one" in capsys.readouterr().err


def test_the_command_that_completes_a_file_again_keeps_what_its_catalogue_says(tmp_path, capsys):
    """It kept the supports that had made the stiffness: with two measured numbers 69.4 N.m/arcmin came of 60."""
    path = tmp_path / "mine.toml"
    asked = ["--ratio", "1:81", "--rated", "167Nm", "--cranks", "3", "--stiffness", "60Nm/arcmin", "--lost-motion", "0.8", "--diameter", "145mm"]
    assert main(["reducer", "new", *asked, "--output", str(path), "--name", "mine"]) == 0
    [again] = [line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("#   rvwear reducer new")]
    assert "--stiffness 60 " in again and "--lost-motion 0.8 " in again and "support_compliance" not in again
    words = shlex.split(again.removeprefix("#   rvwear "))[:-2]
    anew = tmp_path / "anew.toml"
    assert main([*words, "--known", "mesh.width=9mm", "--known", "crank.eccentricity=0.95mm", "--output", str(anew)]) == 0
    assert hysteresis(load_reducer(anew), []).stiffness_Nm_per_arcmin == pytest.approx(60.0, rel=2e-3)
    # So it is in the command that the check of a changed file prints, where a gap that is given tells no lost motion, too.
    assert main(["reducer", "new", *asked, "--known", "disc.equidistant_modification=1um", "--output", str(path), "--overwrite"]) == 0
    path.write_text(path.read_text(encoding="utf-8").replace("rollers = 16", "rollers = 14"), encoding="utf-8")
    told = check(load_reducer(path)).completing
    assert "--stiffness 60 " in told and "--lost-motion 0.8 " in told and "support_compliance" not in told


def test_a_doubtful_stiffness_asks_for_the_diameter_where_none_is_given():
    task = {"ratio": 153, "pins": None, "rated": 784.0, "cranks": 3}
    assert "give --diameter if the catalogue has it, or look at the unit" in as_stiff_as(given_with(**task), 212.0).doubts[-1]
    assert not any("torsional stiffness" in text for text in as_stiff_as(given_with(**task, diameter=239.0), 212.0).doubts)


def test_a_reducer_is_made_as_stiff_as_its_catalogue_says(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["reducer", "new", "--ratio", "121", "--pins", "40", "--rated", "167", "--diameter", "145", "--name", "m"]
    assert main([*words, "--stiffness", "50Nm/arcmin"]) == 0
    assert "um/kN makes the torsional stiffness that of the catalogue, 50 N m/arcmin" in " ".join(capsys.readouterr().out.split())
    made = load_reducer("m.toml")
    assert made.sources["crank_seat_compliance"] == "found: makes the torsional stiffness that of the catalogue, 50 N.m/arcmin"
    assert hysteresis(made, []).stiffness_Nm_per_arcmin == pytest.approx(50.0, rel=2e-3)
    # What is far from the rules is doubtful, what nothing makes is refused.
    assert main([*words, "--stiffness", "1700Nm/deg", "--overwrite"]) == 0
    assert "asks for crank.support_compliance" in " ".join(capsys.readouterr().out.split())
    for more, said in (
        (["--stiffness", "2000"], "with rigid crank supports the other numbers make it 274"), (["--stiffness", "0"], "must be 0.1 or more"),
        (["--stiffness", "50", "--known", "crank.support_compliance=1e-9m/N"], "keep one"),
    ):  # fmt: skip
        assert main([*words, *more, "--output", "no.toml"]) == 2
        assert said in " ".join(capsys.readouterr().err.split())
    assert not (tmp_path / "no.toml").exists()


@pytest.mark.parametrize(("typed", "said"), [
    ("210Nm/deg", "--stiffness 210Nm/deg is 3.5 N m/arcmin: it asks for crank.support_compliance = 5"), ("210Nm/deg", "; did you mean 210 N m/arcmin?"),
    ("210Nm/deg", "more than 5 times beyond what rules give, 2.57 um/kN to 9.31 um/kN, which make 174 to 493 N m/arcmin"),
    ("3.5", "--stiffness 3.5 N m/arcmin: it asks for "), ("3.5", "N m/arcmin; give --diameter if the catalogue has it, or look at its unit"),
    ("12600", "which is softer; did you mean 12600 N m/deg?"),
])  # fmt: skip
def test_a_stiffness_far_beyond_the_rules_is_refused_with_the_unit_that_was_meant(tmp_path, capsys, typed, said):
    """A file of supports sixty times as soft as any was written, with one doubt among its lines."""
    file = tmp_path / "a.toml"
    assert main(["reducer", "new", "--ratio", "153", "--rated", "784", "--stiffness", typed, "--output", str(file)]) == 2
    assert said in " ".join(capsys.readouterr().err.split()) and not file.exists()
