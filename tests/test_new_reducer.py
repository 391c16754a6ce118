"""``rvwear reducer new``: completed by design rules, checked as any other file, told what makes no reducer."""

import argparse
import json
import math
import re
import shlex

import numpy as np
import pytest

from cli.commands.new_reducer import ratio_in
from cli.main import main
from fmu_src.faults import InputFault
from pages.render import rendered_sections
from reducers.checking import check
from reducers.completion.again import given_again
from reducers.completion.command import words_of
from reducers.completion.complete import NOT_ALONE, UNITS, complete
from reducers.completion.doubts import rounded_ratio, sun_doubt
from reducers.completion.file import reducer_at
from reducers.completion.given import SUN, Given, given_with, of_ratio, usual_pins
from reducers.completion.known import known_numbers
from reducers.reducer import load_reducer
from rv_plant.parts import largest_pin
from studies.catalogue_stiffness import as_stiff_as
from studies.completed_ranges import Influence, influences, what_matters
from studies.hysteresis import hysteresis
from studies.report.assembly import contact_points, outline, pin_forces, pin_places
from studies.report.completed import page_of
from workbench.reducers import findings, given_of, rows_of

RIG = ["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "1600"]


def test_a_completed_file_is_a_reducer_file_and_marks_every_number(tmp_path, capsys):
    path = tmp_path / "rig.toml"
    assert main([*RIG, "--name", "rig", "--output", str(path), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    reducer = load_reducer(path)
    assert reducer.name == "rig" and reducer.topology.lobes == 39 and reducer.topology.cranks == 3
    assert reducer.starts["first_stage_ratio"] == 2.0 and reducer.starts["load_torque"] == 1600.0
    assert {n["name"] for n in told["numbers"]} == set(UNITS)
    assert all(s.startswith(("completed: ", "given: ")) for s in reducer.sources.values())
    for n in told["numbers"]:
        assert n["range"][0] <= n["value"] <= n["range"][1], n["name"]
    # Whatever may move alone is held in the file to lie in its range; races and rollers fit each other and teeth are whole.
    free = {n["name"] for n in told["numbers"] if n["range"][0] < n["range"][1]} - set(NOT_ALONE)
    assert len(reducer.ranges) == len(free)
    assert reducer.ranges["pin_radius"][0] < reducer.starts["pin_radius"] < reducer.ranges["pin_radius"][1]


def test_what_was_given_is_counted_and_a_rounded_ratio_is_said(tmp_path, capsys):
    """In the sum of the command, and of the check of its file."""
    path = str(tmp_path / "mine.toml")
    assert main(["reducer", "new", "--ratio", "105.3", "--pins", "40", "--rated", "500", "--diameter", "230", "--known", "pin.radius=3mm", "--output", path]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "planets of 60 and a sun of 23 teeth with 40 pins make 105.348, which the file has" in said
    assert "given: ratio 105.3, 40 pins, rated torque 500 N m, diameter 230 mm, 15 rpm of the output (as usual), 16 rollers a bearing (as usual), pin.radius 3 mm; of the file's 53 numbers 5 follow" in said
    assert "from that alone (pin.radius, first_stage.ratio, input.speed, output.load_torque, wear.run_in_crank_speed), 17 come by published rules, 31 are assumed;" in said
    assert main(["reducer", "check", path]) == 0
    assert "53 numbers stated (5 given, 17 by rule, 31 assumed), 1 filled in" in capsys.readouterr().out
    assert not rounded_ratio(Given(ratio=121.0, pins=40, rated=167.0))


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
    assert "53 numbers stated (4 given, 2 looked for to meet the catalogue, " in told
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


@pytest.mark.parametrize("text", ["121", "1:121", "121:1", "1 : 121", "1/121"])
def test_a_ratio_is_read_as_a_catalogue_prints_it(text):
    """It was a unit ":121" that nobody knows, or no number."""
    assert of_ratio(text) == "121"
    assert given_of({"ratio": text, "rated": "167"})[0].ratio == 121.0 and ratio_in(text) == 121.0
    with pytest.raises(argparse.ArgumentTypeError, match="write 121, or 1:121"):
        ratio_in("121 to 1")


@pytest.mark.parametrize(("typed", "said"), [
    (["--speed", "15rpm"], "15 rpm of the output, 16 rollers a bearing (as usual);"),
    (["--speed", "15", "--rollers", "16"], "15 rpm of the output, 16 rollers a bearing;"),
    ([], "15 rpm of the output (as usual), 16 rollers a bearing (as usual);"),
])  # fmt: skip
def test_what_was_typed_is_not_said_to_be_usual(typed, said, tmp_path, capsys):
    """A speed of 15 rpm that was given was told as one that nobody gave."""
    assert main(["reducer", "new", "--ratio", "121", "--rated", "167", *typed, "--output", str(tmp_path / "mine.toml")]) == 0
    assert said in " ".join(capsys.readouterr().out.split())


def test_pins_that_nobody_counted_are_assumed_and_said_to_be(tmp_path, capsys):
    """No catalogue has them; where the usual number makes no whole teeth, the nearest that does."""
    path = tmp_path / "mine.toml"
    assert main(["reducer", "new", "--ratio", "121", "--rated", "167", "--output", str(path)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "40 pins are assumed, as many as reducers of this kind have: count them" in said
    assert "given: ratio 121, rated torque 167 N m, 15 rpm of the output (as usual), 16 rollers a bearing (as usual); of the file's" in said
    assert load_reducer(path).topology.pins == 40
    text = path.read_text()
    assert "pins = 40  # assumed: nobody counted them" in text and "rvwear reducer new --ratio 121 --rated 167" in text
    assert usual_pins(361.0) == 45 and not Given(361.0, 40, 1.0).suns
    assert main(["reducer", "new", "--ratio", "121", "--lobes", "39", "--rated", "167", "--output", str(path), "--overwrite"]) == 0
    assert "assumed, as many as" not in capsys.readouterr().out
    # None at all is no number that nobody counted.
    assert main(["reducer", "new", "--ratio", "121", "--pins", "0", "--rated", "167", "--output", str(tmp_path / "none.toml")]) == 2
    assert "--pins 0: must lie from 8 to 200" in capsys.readouterr().err


def test_rules_hold_in_what_is_completed():
    values = {k: n.value for k, n in complete(Given(121, 40, 412.0, 190.0)).numbers.items()}
    ring, pin = values["pin.circle_radius"], values["pin.radius"]
    assert 0.33 * 190.0 < ring < 0.40 * 190.0
    assert 0.65 < 40 * values["crank.eccentricity"] / ring < 0.9
    assert 1.15 < ring * math.sin(math.pi / 40) / pin < 2.0
    assert values["inner_race.radius"] + 2.0 * values["roller.radius"] == pytest.approx(values["outer_race.radius"])
    # Sun (d1) and two planets (3 d1) with their axes half of both apart fill 0.8 to 1.1 of the ring of pins.
    assert 0.8 < 7.0 * values["crank.circle_radius"] / 2.0 / (2.0 * (ring + pin)) < 1.1


def test_masses_are_those_reckoned_for_reducers_of_that_size():
    # Reckoned from the geometry of the parts of an RV-40E: disc, crank with planet, carrier.
    known = known_numbers([
        "pin.circle_radius=69.5mm", "pin.radius=3mm", "crank.circle_radius=37mm", "mesh.width=15mm", "outer_race.radius=19mm", "roller.radius=2.5mm",
        "crank.eccentricity=1.3mm", "roller.length=12mm",
    ])  # fmt: skip
    numbers = complete(Given(121, 40, 412.0, known=known)).numbers
    for name, reckoned in (("disc.mass", 1.106), ("disc.inertia", 2.94e-3), ("crank.mass", 0.407), ("crank.inertia", 6.9e-5),
                           ("carrier.mass", 2.18), ("carrier.inertia", 4.2e-3)):
        assert numbers[name].value == pytest.approx(reckoned, rel=0.03), name


def test_what_is_known_stays_and_carries_on():
    plain, known = complete(Given(81, 40, 1600.0)), complete(Given(81, 40, 1600.0, known=known_numbers(["pin.circle_radius=0.11 m", "outer_race.radius=25mm"])))
    assert known.numbers["pin.circle_radius"].value == pytest.approx(110.0) and known.numbers["pin.circle_radius"].is_given
    assert known.numbers["pin.circle_radius"].low == known.numbers["pin.circle_radius"].high
    # With the ring known, its share of the pins' uncertainty is gone.
    assert known.numbers["pin.radius"].high / known.numbers["pin.radius"].value < plain.numbers["pin.radius"].high / plain.numbers["pin.radius"].value
    assert known.numbers["inner_race.radius"].value + 2.0 * known.numbers["roller.radius"].value == pytest.approx(25.0)


def test_undercut_begins_where_the_published_condition_says():
    # r/R < sqrt(27 z_c (1 - K1^2)) / (z_c + 2)^1.5 while the sharpest point lies on the flank.
    for k1 in (0.65, 0.75, 0.9):
        published = math.sqrt(27.0 * 39.0 * (1.0 - k1 * k1)) / 41.0**1.5
        assert largest_pin(1.0, k1 / 40.0, 40) == pytest.approx(published, rel=1e-4)


@pytest.mark.parametrize("change, said", [
    ({"ratio": 80.33}, r"--ratio 80.33 with --pins 40: the first stage would need 1.983.*nearest is 80;"),
    ({"ratio": 5.0}, r"--ratio 5 with --pins 40.*nearest is 21"),
    ({"lobes": 40}, r"--pins 40 and --lobes 40: the pins do not close the ring.*--pins 41 or --lobes 39"),
    ({"rated": -1.0}, r"--rated -1 N m: must lie from 1"),
    ({"ratio": math.nan}, r"--ratio nan: must lie"),
    ({"ratio": 281.0}, r"--ratio 281 with --pins 40 and 3 cranks: planets of 70 teeth around a sun of 10 overlap; give --cranks 2"),
    ({"cranks": 4}, r"--cranks 4: must lie from 2 to 3"),
    ({"known": {"pin.radius": 12.0}}, r"pin.radius = 12 mm: 40 pins on a circle of 122.9 mm radius overlap.*below 9.646 mm"),
    ({"known": {"pin.radius": 9.5, "crank.eccentricity": 2.5}}, r"pin.radius = 9.5 mm: the flank is undercut.*below 8\.\d+ mm"),
    ({"known": {"crank.eccentricity": 4.0}}, r"crank.eccentricity = 4 mm: K1 = e z_p / R_p = 1.3 makes loops.*below 3.074 mm"),
    ({"known": {"outer_race.radius": 60.0}}, r"outer_race.radius = 60 mm: .*the disc's roots"),
    ({"known": {"crank.circle_radius": 26.0, "outer_race.radius": 24.0}, "cranks": 3}, r"outer_race.radius = 24 mm: the holes of 3 cranks .* overlap"),
    ({"known": {"inner_race.radius": 20.0, "roller.radius": 3.0, "outer_race.radius": 27.0}}, r"do not fit each other.*make 26 mm"),
    ({"known": {"roller.radius": 6.0}}, r"roller.radius = 6 mm: 16 rollers do not fit"),
    ({"known": {"roller.length": 30.0}}, r"roller.length = 30 mm: longer than the disc is wide \(mesh.width = 17.39 mm\)"),
    ({"ratio": 141.0, "pins": 48, "known": {"first_stage.sun_teeth": 13.0}},
     r"first_stage.sun_teeth = 13: with --ratio 141 and --pins 48 the planets would have 37.92 teeth; whole planets go with a sun of 12 or 24 teeth"),
    ({"known": {"first_stage.sun_teeth": 12.5}}, r"first_stage.sun_teeth = 12.5: .* the planets would have 25 teeth; .* a sun of 12 or 13 teeth"),
    ({"diameter": 150.0, "known": {"pin.circle_radius": 80.0}}, r"--diameter 150 mm: a ring of pins of \d+.* mm does not fit inside"),
])  # fmt: skip
def test_what_makes_no_reducer_is_told_option_value_unit_and_remedy(change, said):
    with pytest.raises(InputFault, match=said):
        complete(Given(**{"ratio": 81.0, "pins": 40, "rated": 1600.0} | change))


@pytest.mark.parametrize("text, said", [
    ("pin.radius", "write NAME=VALUE with a unit"),
    ("pin.radus=3mm", r"no number 'pin.radus' to complete; did you mean pin.radius"),
    ("pin.radius=3", r"give a number with its unit, for instance --known pin.radius=3mm"),
    ("pin.radius=3kg", "unit 'kg' does not fit"),
    ("pin.radius=-3mm", "must be a finite number above 0 mm"),
    ("first_stage.ratio=2", "follows from --ratio and --pins"),
])  # fmt: skip
def test_a_measure_that_cannot_be_used_is_told(text, said):
    with pytest.raises(InputFault, match=f"--known {text}.*{said}"):
        known_numbers([text])


def test_nothing_is_overwritten_unless_told(tmp_path, capsys):
    path = tmp_path / "rig.toml"
    path.write_text("mine", encoding="utf-8")
    assert main([*RIG, "--output", str(path)]) == 2
    assert "exists already and is not overwritten" in capsys.readouterr().err and path.read_text(encoding="utf-8") == "mine"
    assert main([*RIG, "--output", str(path), "--overwrite"]) == 0
    assert load_reducer(path).name == "ratio-81-1600Nm"
    assert main([*RIG, "--output", str(tmp_path / "rig.txt")]) == 2
    assert "must end in .toml" in capsys.readouterr().err


def test_a_ring_that_does_not_fit_the_torque_is_doubtful():
    far = complete(Given(81, 40, 1600.0, 150.0)).doubts[0]
    assert "made as 0.363 times the outer diameter of 150 mm" in far and "usual (cycloid handbooks): look at --rated and --diameter, and at their units" in far
    given = complete(Given(81, 40, 1600.0, known={"pin.circle_radius": 54.5})).doubts[0]
    assert "usual (cycloid handbooks): look at both" in given and "made" not in given
    assert complete(Given(81, 40, 1600.0)).doubts == [] and complete(Given(81, 40, 1600.0, known={SUN: 18})).doubts == []


@pytest.mark.parametrize("reducer, rated, tested, outside", [("RV20E-121-rigid", "167", 8, {"pin.radius"}), ("BX-40E-rigid", "412", 4, set())])
def test_the_librarys_reducers_from_catalogue_numbers_alone(tmp_path, capsys, reducer, rated, tested, outside):
    path = tmp_path / "new.toml"
    words = ["reducer", "new", "--ratio", "121", "--pins", "40", "--rated", rated, "--output", str(path), "--overwrite", "--against", reducer]
    assert main([*words, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["against"]
    held = [row for row in rows if row["tests"]]
    assert len(held) == tested and {row["name"] for row in held if not row["inside"]} == outside
    # Neither what the file assumes itself nor what was assumed with it in sight counts.
    assert not any(row["source"].startswith("assumed") or row["name"].startswith(("outer_race", "wear.")) for row in held)
    (ring,) = [row for row in rows if row["name"] == "pin.circle_radius"]
    full = load_reducer(reducer)
    assert ring["in_file"] == pytest.approx(1e3 * full.starts["pin_circle_radius"])
    assert main(words) == 0
    assert f"of {tested} numbers that {reducer} has from its source" in " ".join(capsys.readouterr().out.split())


@pytest.fixture(scope="module")
def rig():
    return complete(Given(81, 40, 1600.0))


def test_the_drawing_is_to_scale_and_every_pin_touches_both_discs(rig):
    reducer = reducer_at(rig, {})
    radius = 1e3 * reducer.starts["pin_radius"]
    for d in range(2):
        drawn, pins = outline(reducer, d), pin_places(reducer)
        nearest = np.abs(pins[:, None] - drawn[None, :]).min(axis=1)
        # An unmodified disc touches all pins; the drawn points lie some tenths of a millimetre apart.
        assert nearest == pytest.approx(radius, abs=0.02)
        points, normals = contact_points(reducer, d)
        assert np.abs(points - pins) == pytest.approx(radius) and np.abs(normals) == pytest.approx(1.0)
        assert np.abs(points[:, None] - drawn[None, :]).min(axis=1).max() < 0.51 * np.abs(np.diff(drawn)).max()
    # Together the forces carry the torque about the ring's centre.
    force = pin_forces(reducer)
    moments = [float(np.sum(force[d] * np.imag(np.conj(contact_points(reducer, d)[0]) * contact_points(reducer, d)[1]))) for d in range(2)]
    assert abs(sum(moments)) * 1e-3 == pytest.approx(1600.0, rel=0.03)


def test_page_shows_parts_numbers_and_influences(rig):
    found = [Influence("K1", "lost_motion_arcmin", 0.5, 1.0, 1.3), Influence("gap", "lost_motion_arcmin", 1.0, 1.0, 1.001)]
    page = page_of(rig, reducer_at(rig, {}), found)
    html = rendered_sections(page)
    assert "completed reducer" in html and "eccentricity times pins" in html
    (table,) = page.sections[1].tables
    assert [row[0] for row in table.rows] == ["lost motion"] and table.rows[0][-1] == "40"
    assert len(page_of(rig, reducer_at(rig, {}), []).sections) == 2


def test_a_name_of_two_lines_is_refused_like_any_that_no_reducer_has(tmp_path, capsys):
    for name in ("a\nb", "x/y"):
        assert main([*RIG, "--output", str(tmp_path / "rig.toml"), "--name", name]) == 2
        assert f"reducer.name = {name!r}: String should match pattern" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_ranges_move_the_signals_that_they_must():
    found = {(one.dial, one.signal): one for one in influences(complete(Given(121, 40, 167.0)), ("gap", "wear.mesh_coefficient"))}
    lost, stiffness = "lost_motion_arcmin", "torsional_stiffness_Nm_per_arcmin"
    gap = found["gap", lost]
    # From no gap to half an arcmin on either flank.
    assert gap.high - gap.low == pytest.approx(1.0, abs=0.1)
    wear = found["wear.mesh_coefficient", "disc_flank_um"]
    # A flank wears with its coefficient, and less the more it has spread the load by then.
    assert 2.0 < wear.high / wear.middle < 5.0 and 2.0 < wear.middle / wear.low <= 5.0
    assert found["wear.mesh_coefficient", stiffness].share == 0.0 and found["wear.mesh_coefficient", lost].share == 0.0
    # Losses and frequencies are signals of a bench, too: neither hangs on what wears, both are there.
    for signal in ("efficiency_percent", "no_load_torque_Nm", "natural_frequency_1_Hz", "natural_frequency_2_Hz"):
        assert found["gap", signal].middle > 0.0 and found["wear.mesh_coefficient", signal].share == 0.0
    strongest = what_matters(list(found.values()))
    assert strongest[lost][0].dial == "gap" and strongest["disc_flank_um"][0].dial == "wear.mesh_coefficient"


def test_seals_move_the_torque_without_load_and_masses_the_frequencies():
    found = {(one.dial, one.signal): one for one in influences(complete(Given(121, 40, 167.0)), ("seal_share", "carrier_bulk"))}
    seals, mass = found["seal_share", "no_load_torque_Nm"], found["carrier_bulk", "natural_frequency_1_Hz"]
    assert seals.low < seals.middle < seals.high and mass.high < mass.low
    assert found["seal_share", "efficiency_percent"].high < found["seal_share", "efficiency_percent"].low
    assert found["carrier_bulk", "efficiency_percent"].share < 1e-6


def test_the_command_draws_and_tells_what_matters(tmp_path, capsys, monkeypatch):
    one = Influence("K1", "lost_motion_arcmin", 0.5, 1.0, 1.3)
    monkeypatch.setattr("studies.completed_ranges.influences", lambda completion, advance: advance() or [one])
    page, words = tmp_path / "rig.html", [*RIG, "--output", str(tmp_path / "rig.toml"), "--overwrite", "--sensitivity"]
    assert main([*words, "--html", str(page), "--json"]) == 0
    (told,) = json.loads(capsys.readouterr().out)["sensitivity"]
    assert told["dial"] == "K1" and told["share"] == pytest.approx(0.4)
    assert "The parts to scale" in page.read_text(encoding="utf-8")
    assert main(words) == 0
    assert "eccentricity times pins over pin circle" in capsys.readouterr().out
    assert main([*RIG, "--output", str(tmp_path / "other.toml"), "--html", str(tmp_path / "rig.pdf")]) == 2
    assert "must end in .html" in capsys.readouterr().err and not (tmp_path / "other.toml").exists()


def test_a_number_that_moves_only_with_others_says_what_moves_it(tmp_path, capsys):
    """In the file, and where somebody changed it alone; the command that is named does it, and what was given before stays."""
    path = tmp_path / "my81.toml"
    assert main(["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "412", "--cranks", "3", "--known", "pin.radius=4mm",
                 "--name", "my81", "--output", str(path), "-q"]) == 0  # fmt: skip
    text = path.read_text(encoding="utf-8")
    assert "# may be 10, 11, 12, 13, 14, 15, 16, 17, 18, 19 or 20, but not alone, for teeth are whole: complete again with --known first_stage.sun_teeth=11" in text
    assert "not alone, for races and rollers fit each other: complete again with --known roller.radius=...mm" in text
    path.write_text(text.replace("sun_teeth = { value = 10.0", "sun_teeth = { value = 12.0"), encoding="utf-8")
    assert main(["reducer", "check", str(path)]) == 2
    said = capsys.readouterr().err
    assert "[first_stage] sun_teeth = 12: the file's range is another single value" in said and "12 1" not in said
    words = shlex.split(re.search("complete again: (rvwear .*?); or leave", said)[1])
    assert words[1:11] == ["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "412", "--speed", "15"]
    assert "first_stage.sun_teeth=12" in words and "pin.radius=4mm" in words
    assert main([*words[1:], "--output", str(tmp_path / "anew.toml"), "-q"]) == 0
    assert load_reducer(tmp_path / "anew.toml").starts["sun_teeth"] == 12.0


def test_a_range_of_a_number_without_unit_is_told_without_one(tmp_path):
    path = tmp_path / "a.toml"
    assert main([*RIG, "--output", str(path), "-q"]) == 0
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("poisson_ratio = { value = 0.3,", "poisson_ratio = { value = 0.4,"), encoding="utf-8")
    with pytest.raises(InputFault, match=r"value = 0\.4 lies outside; give \[lowest, highest\]$"):
        load_reducer(path)


def test_what_was_completed_from_other_teeth_is_outdated_when_somebody_changes_them(tmp_path, capsys):
    path = tmp_path / "ratio-81-412Nm.toml"
    assert main(["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "412", "--cranks", "3", "--output", str(path), "-q"]) == 0
    assert not check(load_reducer(path)).outdated
    text = path.read_text(encoding="utf-8").replace("pins = 40\nlobes = 39", "pins = 41\nlobes = 40")
    path.write_text(text, encoding="utf-8")
    found = check(load_reducer(path))
    said = "\n".join(found.doubts)
    assert "input.speed = 1215 rpm was completed (ratio times output speed) from other numbers than the file has now, of which it would be 1245 rpm" in said
    assert "wear.run_in_crank_speed = 585 rpm was completed" in said and "of which it would be 600 rpm" in said
    assert "reducer.name = ratio-81-412Nm is made of other numbers than the file has now, of which it would be ratio-83-412Nm" in said
    assert 'reducer.description says "ratio 81, rated 412 N m at 15 rpm", and would be "ratio 83, rated 412 N m at 15 rpm of the output' in said
    assert main(["reducer", "check", str(path)]) == 0
    assert f"completed anew with what the file gives: {found.completing}" in " ".join(capsys.readouterr().out.split())
    assert findings(found) == [*found.outdated, f"of a number that was measured say so as its source; the others are completed anew by: {found.completing}"]
    anew = tmp_path / "anew.toml"
    assert main([*shlex.split(found.completing)[1:], "--output", str(anew), "-q"]) == 0
    assert not check(load_reducer(anew)).doubts and load_reducer(anew).name == "ratio-83-412Nm"


@pytest.mark.parametrize("options", [
    ["--ratio", "105.3", "--pins", "40", "--rated", "500", "--diameter", "230", "--known", "pin.radius=3mm"],
    ["--ratio", "127.7", "--pins", "40", "--rated", "1600", "--speed", "7.5", "--lost-motion", "0.4", "--rollers", "14", "--cranks", "2"],
    ["--ratio", "81", "--pins", "40", "--rated", "1600", "--known", "first_stage.sun_teeth=13", "--known", "roller.radius=3.5mm"],
])  # fmt: skip
def test_a_completed_file_that_nobody_changed_is_not_outdated(tmp_path, options):
    path = tmp_path / "a.toml"
    assert main(["reducer", "new", *options, "--output", str(path), "-q"]) == 0
    assert not check(load_reducer(path)).outdated


def test_what_somebody_measured_counts_for_given_and_what_hangs_on_it_is_outdated(tmp_path):
    path = tmp_path / "a.toml"
    assert main([*RIG, "--output", str(path), "-q"]) == 0
    text = re.sub(r"circle_radius = \{ value = 122\.9\S+ unit = \"mm\", range = \[.*?\], source = \".*?\" \}",
                  'circle_radius = { value = 110.0, unit = "mm", source = "measured" }', path.read_text(encoding="utf-8"), count=1)  # fmt: skip
    path.write_text(text, encoding="utf-8")
    found = check(load_reducer(path))
    assert any(one.startswith("pin.radius = 6.3") and "R_p sin(pi/z_p)" in one for one in found.outdated)
    assert not any(one.startswith("pin.circle_radius") for one in found.outdated) and "--known pin.circle_radius=110mm" in found.completing


@pytest.mark.parametrize(("options", "said"), [
    (["--ratio", "105.3", "--rated", "500"], ["pins are assumed", "--ratio 105.3 is taken for a rounded one"]),
    (["--ratio", "81", "--pins", "40", "--rated", "1600", "--diameter", "150"], ["pin.circle_radius = "]),
    (["--ratio", "121", "--pins", "40", "--rated", "412", "--stiffness", "40Nm/arcmin"], ["a torsional stiffness of 40 N.m/arcmin asks for crank.support"]),
])  # fmt: skip
def test_the_check_of_a_file_repeats_what_was_doubtful_when_it_was_made(tmp_path, capsys, options, said):
    path = str(tmp_path / "a.toml")
    assert main(["reducer", "new", *options, "--output", path, "--json"]) == 0
    made = json.loads(capsys.readouterr().out.partition("\n" + path)[0])["doubts"]
    assert made == [text for text in check(load_reducer(path)).doubts if text in made] and all(any(words in text for text in made) for words in said)


def test_a_sun_with_few_teeth_is_doubted_with_the_reason():
    (said,) = sun_doubt(8)
    assert "undercut without profile shift (2 / sin^2 20 deg = 17.1, standard basic rack of ISO 53); so few need 0.53 modules" in said
    # Ten teeth are made with a shift of 0.42.
    assert not sun_doubt(9) and not sun_doubt(17)


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


def test_compliances_stand_on_screens_in_the_units_that_people_read(tmp_path, capsys):
    """Table, page and form had them in m/N and rad/(N.m), the commands too."""
    catalogue = ["reducer", "new", "--ratio", "129", "--rated", "1568", "--cranks", "3", "--output", str(tmp_path / "mine.toml"), "--overwrite"]
    assert main([*catalogue, "--known", "first_stage.compliance=10um/kN", "--against", "RV20E-121"]) == 0
    said = capsys.readouterr().out
    assert re.search(r"carrier\.compliance +4\.719e-05 +arcmin/\(N m\) +1\.03e-05 to 0\.000217 ", said) and re.search(r"support_compliance +[\d.]+ +um/kN", said)
    completion = complete(Given(129, 40, 1568.0, cranks=3, known=known_numbers(["first_stage.compliance=10um/kN", "carrier.compliance=2e-7rad/(N.m)"])))
    (table, dials) = page_of(completion, reducer_at(completion, {}), []).sections[-1].tables
    shown = {row["name"]: row for row in rows_of(completion)}
    for name, value, unit in (("first_stage.compliance", "10", "um/kN"), ("carrier.compliance", "0.00068755", "arcmin/(N.m)")):
        assert (shown[name]["value"], shown[name]["unit"]) == (value, unit) and [name, value, unit] in [row[:3] for row in table.rows]
    units = {row["unit"] for row in shown.values()} | {row[2] for row in table.rows} | {row[3] for row in dials.rows} | set(said.split())
    assert not units & {"m/N", "rad/(N.m)", "kg.m^2", "1/Pa", "N/m"}
    words = words_of(completion.given)
    # What somebody typed in SI stays as it was typed.
    assert "first_stage.compliance=10um/kN" in words and "carrier.compliance=2e-07rad/(N.m)" in words
    assert known_numbers(["first_stage.compliance=10um/kN"]) == {"first_stage.compliance": pytest.approx(1e-8)}
