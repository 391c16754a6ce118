"""A reducer file of few numbers: what it leaves out follows or is usual, what does not fit is said, the parts are drawn."""

import json
import re
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import InputFault
from reducers.checking import check
from reducers.library import LIBRARY, available
from reducers.reducer import load_reducer, numbers_of
from reducers.usual import FILLED, RULES, derived, usual

MINE = Path(__file__).resolve().parents[1] / "docs" / "tutorials" / "files" / "mine.toml"


def changed(folder, *changes):
    text = MINE.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "a.toml").write_text(text, encoding="utf-8")
    return folder / "a.toml"


def test_eleven_numbers_and_five_counts_are_enough():
    mine = load_reducer(MINE)
    numbers = numbers_of(mine)
    assert sum(len(re.findall("value =", line)) for line in MINE.read_text(encoding="utf-8").splitlines()) == 11
    assert numbers["outer_race.radius"] == pytest.approx(14e-3) and numbers["wear.run_in_crank_speed"] == pytest.approx(585 * 2 * 3.14159265 / 60)
    assert mine.sources["run_in_crank_speed"].startswith("derived: input.speed times lobes") and mine.sources["hardness"].startswith("usual: assumed")
    assert mine.ranges["bearing_clearance"] == pytest.approx((1.5e-6, 5e-6))


@pytest.mark.parametrize("name", available())
def test_rules_give_what_the_library_states(name):
    """Geometry and speeds exactly; stiffness of a line contact within the range that is stated beside it."""
    reducer = load_reducer(name)
    numbers = numbers_of(reducer)
    for rule in RULES:
        value = derived(rule, numbers, reducer.topology)
        if rule.spread is None and "stiffness" not in rule.path:
            assert value == pytest.approx(numbers[rule.path], rel=1e-8), rule.path
    if not reducer.topology.output_pins:
        (rule,) = (r for r in RULES if r.path == "mesh.stiffness")
        value = derived(rule, numbers, reducer.topology)
        assert rule.spread[0] * value <= numbers["mesh.stiffness"] <= rule.spread[1] * value


def test_what_follows_follows_when_teeth_or_speed_change(tmp_path):
    before = numbers_of(load_reducer(MINE))
    now = numbers_of(load_reducer(changed(tmp_path, ("pins = 40", "pins = 36"), ("lobes = 39", "lobes = 35"))))
    ratio = 1 + 2.6 * 36
    assert now["wear.run_in_crank_speed"] == pytest.approx(before["input.speed"] / ratio * 35)


def test_a_stated_number_wins_and_a_stale_one_is_told(tmp_path):
    path = changed(tmp_path, ("[output]", '[wear]\nrun_in_crank_speed = { value = 644.6, unit = "rpm", source = "copied" }\n\n[output]'))
    found = check(load_reducer(path))
    assert numbers_of(found.reducer)["wear.run_in_crank_speed"] == pytest.approx(644.6 * 3.14159265 / 30)
    assert "wear.run_in_crank_speed = 644.6 rpm is stated, input.speed times lobes over the ratio make 585 rpm: correct one" in found.doubts[0]


@pytest.mark.parametrize("changes, said", [
    ([("value = 2.5, unit", "value = 5.5, unit")], r"pin\.radius = 5\.5 mm: 40 pins .* overlap.*topology\.pins smaller"),
    ([("value = 1.1, unit", "value = 1.6, unit")], r"crank\.eccentricity = 1\.6 mm: K1 = .* makes loops"),
    ([("value = 1.1, unit", "value = 1.49, unit"), ("value = 2.5, unit", "value = 4.4, unit")], "the flank is undercut"),
    ([('source = "39 over 15 teeth" }', 'source = "39 over 15 teeth" }\nsun_teeth = { value = 14, unit = "1", source = "counted" }')],
     r"first_stage\.sun_teeth = 14: with ratio 105 and topology\.pins 40 the planets would have 36\.4 teeth; .* a sun of 10 or 15 teeth"),
    ([("rollers = 16", "rollers = 40")], r"40 rollers do not fit .*fewer topology\.rollers"),
])  # fmt: skip
def test_what_cannot_be_made_is_said_where_and_how_to_mend_it(tmp_path, capsys, changes, said):
    path = changed(tmp_path, *changes)
    assert main(["reducer", "check", str(path), "--json"]) == 2
    (fault,) = json.loads(capsys.readouterr().out)["faults"]
    assert re.search(said, fault), fault


def test_what_is_missing_is_named_still(tmp_path):
    with pytest.raises(InputFault, match=r"pin\.circle_radius: missing"):
        load_reducer(changed(tmp_path, ("circle_radius = { value = 60.0", "# circle_radius = { value = 60.0")))
    # Of races and rollers two are needed.
    with pytest.raises(InputFault, match=r"outer_race\.radius, roller\.radius: missing"):
        load_reducer(changed(tmp_path, ("radius = { value = 1.5", "# radius = { value = 1.5")))


def test_the_command_completes_what_is_rigid(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["reducer", "check", str(MINE), "--html", "mine.html", "--picture", "mine.svg", "--json"]) == 0
    shown = capsys.readouterr()
    told = json.loads(shown.out.partition("\nmine.html")[0])
    assert told["faults"] == [] and "so rigid" in told["doubts"][0]
    assert {p.name for p in tmp_path.iterdir()} == {"mine.html", "mine.svg", "mine_teeth.svg"}
    page, found = (tmp_path / "mine.html").read_text(), check(load_reducer(MINE))
    assert found.outcome == "its parts fit each other, but look at what is doubtful" and "Its parts fit each other, but look at what is doubtful" in page
    # A pin's diameter of 5 mm beside "pins up to 5.042 mm" read as nearly undercut, one of 7 mm as undercut.
    assert "largest radius of pins" in page and replace(found, doubts=[]).outcome == "its parts fit each other"
    assert main(shlex.split(told["completing"])[1:]) == 0
    completed = check(load_reducer("mine_completed.toml"))
    assert not completed.doubts and not completed.faults and not completed.completing
    stated = numbers_of(load_reducer(MINE))
    for name in ("pin.radius", "crank.eccentricity", "output.load_torque", "first_stage.ratio", "input.speed"):
        assert numbers_of(completed.reducer)[name] == pytest.approx(stated[name], rel=1e-6)


def test_friction_and_drag_that_nobody_stated_are_doubted(capsys):
    smooth = check(load_reducer("RV20E-121-rigid"))
    (said,) = [text for text in smooth.doubts if "without losses" in text]
    # 3.5 % of 1.38 N m at the input is what RV20E-121 has of each.
    assert said.startswith("mesh.friction, roller.friction, input.seal_torque, input.churning_torque: not stated")
    assert "mesh.friction 0.04 to 0.1, roller.friction 0.002 to 0.005, input.seal_torque 0.028 to 0.083 N.m" in said and smooth.completing
    real = load_reducer("RV20E-121")
    assert not any("without losses" in text for text in check(real).doubts)
    dry = check(replace(real, starts={**real.starts, "input_seal_torque": 0.0}))
    assert [text.partition(":")[0] for text in dry.doubts] == ["input.seal_torque"] and dry.completing


def test_what_is_usual_is_what_the_completion_takes():
    assert set(usual()) < FILLED and all(one.source.startswith("usual: ") for one in usual().values())


def test_a_number_in_another_unit_is_doubted(tmp_path):
    text = (LIBRARY / "RV20E-121-rigid.toml").read_text(encoding="utf-8")
    path = tmp_path / "mine.toml"
    path.write_text(text.replace('value = 8.82, unit = "mm"', 'value = 8.82, unit = "m"'), encoding="utf-8")
    found = check(load_reducer(path)).doubts
    assert any("mesh.width = 8820 mm is 170 times pin.circle_radius, where 0.1 to 0.2 (cycloid handbooks) is usual: look at its unit" in d for d in found)


def test_torque_and_speed_in_other_units_are_doubted():
    reducer = load_reducer("RV20E-121")
    starts = dict(reducer.starts)
    doubts = check(replace(reducer, starts={**starts, "load_torque": 1e3 * starts["load_torque"], "input_speed": 10.0 * starts["input_speed"]})).doubts
    soft = check(replace(reducer, starts={**starts, "elastic_modulus": 0.1 * starts["elastic_modulus"]})).doubts
    assert any("material.elastic_modulus = 20.7 GPa, where 200 to 212 GPa for steel is usual" in d for d in soft)
    assert any("times the cube root of the torque" in d for d in doubts) and any("turns the output at 165.3 rpm" in d for d in doubts)


def test_a_decimal_comma_in_quotes_and_a_file_that_is_not_there_are_told(tmp_path):
    text = (LIBRARY / "RV20E-121-rigid.toml").read_text(encoding="utf-8")
    path = tmp_path / "mine.toml"
    path.write_text(text.replace("value = 8.82", 'value = "8,82"'), encoding="utf-8")
    with pytest.raises(InputFault, match="'8,82': write 8.82, with a point and without quotes"):
        load_reducer(path)
    with pytest.raises(InputFault, match=r"there is no file .*minne\.toml; did you mean mine\.toml\?"):
        load_reducer(tmp_path / "minne.toml")


def test_a_completed_file_is_held_against_its_catalogue(tmp_path, capsys):
    """Nothing of it was said where a stiffness and a lost motion were missed."""
    path, page = tmp_path / "a.toml", tmp_path / "a.html"
    words = ["reducer", "new", "--ratio", "81", "--rated", "167", "--cranks", "3", "--diameter", "145", "--stiffness", "60", "--lost-motion", "0.8"]
    assert main([*words, "--output", str(path), "-q"]) == 0
    capsys.readouterr()
    assert main(["reducer", "check", str(path)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "of the catalogue: torsional stiffness 60 N m/arcmin asked, 60 reached; lost motion 0.8 arcmin asked, 0.80" in said and "misses" not in said
    # Somebody measured the clearance.
    text = re.sub(r'(?m)^clearance = .*$', 'clearance = { value = 4.0, unit = "um", source = "measured" }', path.read_text(encoding="utf-8"))
    path.write_text(text, encoding="utf-8")
    assert main(["reducer", "check", str(path), "--html", str(page), "--json"]) == 0
    told = json.loads(capsys.readouterr().out.partition(f"\n{page}")[0])
    stiff, lost = told["catalogue"]
    assert (stiff["asked"], stiff["met"], lost["asked"], lost["met"], lost["unit"]) == (60.0, True, 0.8, False, "arcmin") and lost["miss"] > 0.2
    assert any(re.match(r"lost motion 1\.\d+ arcmin misses the catalogue's 0\.8 arcmin, 0\.\d+ too much: ", text) for text in told["doubts"])
    assert "--known bearing.clearance=4um" in told["completing"] and "--lost-motion 0.8" in told["completing"]
    assert re.search(r"0\.8 of the catalogue, 0\.\d+ too much", page.read_text(encoding="utf-8"))


def test_a_completed_file_is_drawn_with_its_housing_as_when_it_was_made(tmp_path):
    """It had lost it, and filled the frame otherwise."""
    from reducers.completion.complete import complete
    from reducers.completion.given import given_with
    from studies.report.checked import parts
    from studies.report.completed import page_of

    given = given_with(ratio=105.3, pins=40, rated=500.0, diameter=230.0)
    assert main(["reducer", "new", "--ratio", "105.3", "--pins", "40", "--rated", "500", "--diameter", "230", "--output", str(tmp_path / "a.toml"), "-q"]) == 0
    reducer = load_reducer(tmp_path / "a.toml")
    [made, _] = page_of(complete(given), reducer, []).sections[0].figures
    [whole, _] = parts(check(reducer))
    assert len(whole.data) == len(made.data) and whole.layout["xaxis"]["range"] == pytest.approx(made.layout["xaxis"]["range"])
    # A scale stands below it and beside its teeth: nothing else of a drawing says how large it is.
    for figure in parts(check(reducer)):
        x, [length] = figure.data[-1]["x"], figure.layout["annotations"]
        assert length["text"] == f"{max(x) - min(x):g} mm" and 0.05 < (max(x) - min(x)) / np.ptp(figure.layout["xaxis"]["range"]) <= 0.2
    # Nobody knows that of a file without one.
    assert len(parts(check(load_reducer(MINE)))[0].data) == len(made.data) - 1


def test_a_ring_made_of_a_diameter_is_doubted_as_such_and_of_what_its_lost_motion_is_read_is_said(tmp_path, capsys):
    """Of the program's own choice it was said to look at its unit, and two positions read 0.95 where sixteen read 1."""
    path, doubt = tmp_path / "own.toml", "pin.circle_radius = 80.66 mm, made as 0.363 times the outer diameter of 222 mm, is 0.841 times the cube root"
    words = ["reducer", "new", "--ratio", "121", "--rated", "882", "--stiffness", "221", "--lost-motion", "1", "--diameter", "222", "--output", str(path)]
    assert main(words) == 0
    first = " ".join(capsys.readouterr().out.split())
    assert main(["reducer", "check", str(path)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    for text in (first, said):
        assert doubt in text and "here from 81.52 mm on: measure the radius and give --known pin.circle_radius=..., or look at --rated and --diameter" in text
    assert "1 reached; as rvwear hysteresis reads them, means of 16 positions" in said and "and at their units" not in said
    for angles, note in (("2", True), ("16", False)):
        assert main(["hysteresis", "--reducer", str(path), "--steps", "4", "--angles", angles]) == 0
        assert ("fewer positions, other figures: rvwear reducer check takes the mean of 16" in " ".join(capsys.readouterr().out.split())) is note
    assert main([*words, "--known", "pin.circle_radius=80.66mm", "--overwrite"]) == 0
    assert "look at both, and at their units" in " ".join(capsys.readouterr().out.split())
