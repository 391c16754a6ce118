"""``rvwear reducer new``: completed by design rules, checked as any other file, told what makes no reducer."""

import argparse
import json
import math
import re
import shlex

import pytest

from cli.commands.new_reducer import ratio_in
from cli.main import main
from fmu_src.faults import InputFault
from reducers.checking import check
from reducers.completion.command import words_of
from reducers.completion.complete import NOT_ALONE, UNITS, complete
from reducers.completion.doubts import rounded_ratio, sun_doubt
from reducers.completion.file import reducer_at
from reducers.completion.given import SUN, Given, of_ratio, usual_pins
from reducers.completion.known import known_numbers
from reducers.reducer import load_reducer
from rv_plant.parts import largest_pin
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
    assert "53 numbers in the file (5 given or derived, 17 by rule, 31 assumed), 1 filled in" in capsys.readouterr().out
    assert not rounded_ratio(Given(ratio=121.0, pins=40, rated=167.0))


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


def test_a_name_of_two_lines_is_refused_like_any_that_no_reducer_has(tmp_path, capsys):
    for name in ("a\nb", "x/y"):
        assert main([*RIG, "--output", str(tmp_path / "rig.toml"), "--name", name]) == 2
        assert f"reducer.name = {name!r}: String should match pattern" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


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
