"""A reducer that cannot be made is drawn all the same, with the place and the limit; a number that no such reducer has is doubted."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import InputFault, RunFault
from reducers.checking import check
from reducers.library import LIBRARY, available
from reducers.reducer import load_reducer
from rv_plant.parts import HOLES, LOOPS, NOWHERE, OUTPUT_HOLES, PINS, ROLLERS, ROOTS, UNDERCUT
from studies.report.assembly import at_rest
from studies.report.checked import page_of, parts
from studies.report.not_made import drawings, lens

MM, UM = 1e-3, 1e-6


def changed(name="RV20E-121", **numbers: float):
    reducer = load_reducer(name)
    return replace(reducer, starts=reducer.starts | numbers)


def stated(folder, name, pattern, text):
    """A file of the library with one line of it changed."""
    content, times = re.subn(pattern, text, (LIBRARY / f"{name}.toml").read_text(encoding="utf-8"), count=1)
    assert times == 1
    (folder / "mine.toml").write_text(content.replace(f'name = "{name}"', 'name = "mine"'), encoding="utf-8")
    return folder / "mine.toml"


NOT_MADE = [
    ("RV20E-121", {"eccentricity": 1.28 * MM}, UNDERCUT, r"radius must be below 1\.123 mm; give a smaller pin, or an eccentricity below 1\.235 mm"),
    ("RV20E-121", {"pin_radius": 5.5 * MM}, PINS, r"radius must be below 4\.08 mm"),
    ("RV20E-121", {"eccentricity": 1.45 * MM}, LOOPS, r"an eccentricity below 1\.3 mm"),
    ("RV20E-121", {"eccentricity": 1.3 * MM}, LOOPS, r"an eccentricity below 1\.3 mm"),
    ("RV20E-121", {"crank_circle_radius": 10 * MM}, HOLES, "overlap"),
    ("RV20E-121", {"crank_circle_radius": 36.5 * MM}, ROOTS, r"crank\.circle_radius below 35\.85 mm"),
    ("RV20E-121", {"outer_race_radius": 13.4 * MM}, ROLLERS, r"make 13\.25 mm"),
    ("RV20E-121", {"roller_length": 12 * MM}, NOWHERE, r"mesh\.width = 8\.82 mm"),
    ("cycloidal-actuator", {"output_pin_radius": 9 * MM}, OUTPUT_HOLES, r"radius must be below 5\.95 mm"),
    ("cycloidal-actuator", {"output_circle_radius": 27 * MM}, OUTPUT_HOLES, r"cuts the roots of the disc, 1\.95 mm from its centre.*below 0\.4 mm"),
    ("cycloidal-actuator", {"outer_race_radius": 12.3 * MM}, ROLLERS, r"make 12\.5 mm"),
]  # fmt: skip


@pytest.mark.parametrize("name, numbers, place, limit", NOT_MADE)
def test_what_cannot_be_made_is_drawn_with_the_place_and_its_limit(name, numbers, place, limit):
    """One line in metres without a limit stood there, and nothing was drawn."""
    found = check(changed(name, **numbers))
    [fault] = found.faults
    assert found.place == place and re.search(limit, fault) and " m " not in fault, fault
    figures = parts(found)
    marked = [trace for trace in figures[0].data if trace.get("name") == place and place]
    assert len(figures) == (2 if place else 1) and len(marked) == bool(place)
    assert all(trace["line"]["color"] == "#a3195b" for trace in marked)
    json.dumps([figure.data for figure in figures], allow_nan=False)
    if place:
        # What is marked stands in the closer look.
        (x0, x1), (y0, y1) = (figures[1].layout[axis]["range"] for axis in ("xaxis", "yaxis"))
        assert any(x is not None and x0 < x < x1 and y0 < y < y1 for x, y in zip(marked[0]["x"], marked[0]["y"]))


@pytest.mark.parametrize("name, numbers", [(name, numbers) for name, numbers, place, _ in NOT_MADE if place])
def test_who_computes_with_it_says_the_sentence_of_the_check(name, numbers):
    """The plant's own line, in metres and without a limit, stood under `solve`, `life` and in the workbench."""
    reducer = changed(name, **numbers)
    with pytest.raises(InputFault) as refused:
        at_rest(reducer)
    assert str(refused.value) == f"{name} cannot be made: {check(reducer).faults[0]}"


@pytest.mark.parametrize("command", [["solve"], ["life", "--hours", "10"]])
def test_commands_say_key_value_limit_and_remedy(command, tmp_path, monkeypatch, capsys):
    path = stated(tmp_path, "RV20E-121", r"eccentricity = \{ value = 0\.9", "eccentricity = { value = 1.6")
    monkeypatch.chdir(tmp_path)
    assert main([*command, "--reducer", str(path)]) == 2
    told = capsys.readouterr()
    assert told.out == "" and told.err == (
        f"rvwear {command[0]}: mine cannot be made: crank.eccentricity = 1.6 mm: K1 = e z_p / R_p = 1.23 makes loops of the profile; it must be below 1:"
        " an eccentricity below 1.3 mm, or pin.circle_radius above 64 mm\n"
    )
    # An option as much as a file, and a bench at its conditions.
    assert main([*command, "--set", "pin.radius=4.2mm"]) == 2
    assert "RV20E-121 cannot be made: pin.radius = 4.2 mm: 40 pins on a circle of 52 mm radius overlap; " in capsys.readouterr().err


def test_the_limits_are_those_of_the_plant():
    """An equidistant modification counts with the pin: the check passed what the plant then refused."""
    for ecc, gap in ((1.2 * MM, 0.0), (1.2 * MM, 20 * UM)):
        reducer = changed(eccentricity=ecc, equidistant_modification=gap)
        most = check(reducer).figures["largest_pin_mm"] * MM
        fits, cut = (replace(reducer, starts=reducer.starts | {"pin_radius": share * most}) for share in (0.9999, 1.0001))
        assert not check(fits).faults and check(cut).place == UNDERCUT
        at_rest(fits)
        with pytest.raises(InputFault, match="undercut"):
            at_rest(cut)
    [fault] = check(cut).faults
    assert "disc.equidistant_modification = 20 um" in fault
    limit = float(re.search(r"eccentricity below ([\d.]+) mm", fault)[1])
    assert not check(replace(cut, starts=cut.starts | {"eccentricity": 0.999 * limit * MM})).faults


def test_page_and_workbench_say_and_draw_it(tmp_path, capsys):
    path, page = stated(tmp_path, "RV20E-121", r"eccentricity = \{ value = 0\.9", "eccentricity = { value = 1.28"), tmp_path / "a.html"
    assert main(["reducer", "check", str(path), "--html", str(page), "--picture", str(tmp_path / "a.svg"), "-q"]) == 2
    text = page.read_text(encoding="utf-8")
    assert "radius must be below 1.123 mm" in text and "Where it cannot be made" in text and "In red: undercut flank" in text
    assert (tmp_path / "a.svg").exists() and (tmp_path / "a_teeth.svg").exists()
    pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')
    from workbench.folder import opened
    from workbench.reducers import shown

    found = shown(opened(tmp_path), "mine.toml")["reducer"]
    assert "radius must be below 1.123 mm" in found["findings"][0] and [f["title"] for f in found["figures"]] == ["The parts to scale", "Where it cannot be made"]


def test_a_reducer_without_an_equilibrium_is_drawn_without_forces(monkeypatch):
    def fails(*_):
        raise RunFault("plant: no equilibrium")

    monkeypatch.setattr("studies.report.assembly.at_rest", fails)
    [whole], why = drawings(load_reducer("RV20E-121"), None)
    assert "No forces are drawn" in whole.caption and why == "no forces are drawn: plant: no equilibrium"
    page = page_of(check(load_reducer("RV20E-121")))
    assert why in page.warnings


def test_circles_have_a_lens_in_common():
    area = lens(0j, 2.0 + 0j, 1.25)
    assert np.abs(area).max() == pytest.approx(1.25) and area.real.min() == pytest.approx(0.75) and area[0] == pytest.approx(area[-1])
    assert lens(0j, 3.0 + 0j, 1.25).size == 0


@pytest.mark.parametrize("name", available())
def test_nothing_of_the_library_is_beyond_what_is_usual(name):
    assert not [text for text in check(load_reducer(name)).doubts if "is usual" in text]


@pytest.mark.parametrize("pattern, text, said", [
    (r'clearance = \{ value = 2\.0, unit = "um", range = \[1\.5, 5\.0\], source = "[^"]*"', 'clearance = { value = 60, unit = "um", source = "drawing 12"',
     "bearing.clearance = 60 um, where 1.5 to 5 um is usual (assumed: matched grinding, 3 to 10 um diametral)"),
    (r"width = \{ value = 8\.82", "width = { value = 14",
     "mesh.width = 14 mm, where 5.2 to 10.4 mm is usual (width of a disc over pin circle radius 0.1 to 0.2; cycloid handbooks"),
    (r"equidistant_modification = \{ value = 0\.0", "equidistant_modification = { value = 50",
     "disc.equidistant_modification = 50 um and disc.shift_modification = 0 um leave a gap of 50 um at the flanks, where 0 to 10.2 um is usual"),
    (r"friction = \{ value = 0\.06, unit = \"1\", range = \[[^\]]*\]", 'friction = { value = 0.2, unit = "1"', "mesh.friction = 0.2, where 0.04 to 0.1 is usual"),
    (r"support_compliance = \{ value = [\d.e-]+, unit = \"m/N\", range = \[[^\]]*\]", 'support_compliance = { value = 8e-8, unit = "m/N"',
     "crank.support_compliance = 80 um/kN, where 4.42 to 11.7 um/kN is usual (compliance of a crank's bearing in place over that of its rollers 3 to 9; fitted"),
])  # fmt: skip
def test_a_stated_number_that_no_such_reducer_has_is_doubted_and_not_refused(tmp_path, pattern, text, said):
    """A clearance of 60 um passed without a word."""
    found = check(load_reducer(stated(tmp_path, "RV20E-121", pattern, text)))
    assert [doubt for doubt in found.doubts if doubt.startswith(said)], found.doubts
    assert not found.faults and found.outcome.endswith("look at what is doubtful")
    pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')
    from workbench.folder import opened
    from workbench.reducers import shown

    assert [text.replace(" um", " µm") for text in found.doubts] == shown(opened(tmp_path), "mine.toml")["reducer"]["doubts"]


def test_what_one_modification_adds_and_the_other_takes_back_is_usual():
    reducer = load_reducer("RV20E-121")
    both = replace(reducer, starts=reducer.starts | {"equidistant_modification": 20 * UM, "shift_modification": 14 * UM})
    assert not [text for text in check(both).doubts if "modification" in text]


def test_a_number_of_which_something_is_said_is_not_doubted_twice():
    reducer = load_reducer("RV20E-121")
    far = check(replace(reducer, starts=reducer.starts | {"mesh_width": 8.82, "roller_friction": 0.0})).doubts
    assert len([text for text in far if text.startswith("mesh.width")]) == 1 and len([text for text in far if "roller.friction" in text]) == 1


def test_what_is_given_to_a_completion_is_doubted_in_the_same_words(tmp_path, capsys):
    path = tmp_path / "a.toml"
    words = ["reducer", "new", "--ratio", "121", "--rated", "167", "--pins", "40", "--known", "bearing.clearance=60um", "--output", str(path), "-q"]
    assert main([*words, "--json"]) == 0
    made = json.loads(capsys.readouterr().out)["doubts"]
    assert [text for text in made if text.startswith("bearing.clearance = 60 um, where 1.5 to 5 um is usual")]
    assert main(["reducer", "check", str(path), "--json", "-q"]) == 0
    assert {*made} <= {*json.loads(capsys.readouterr().out)["doubts"]}


def test_a_plain_drive_of_plastic_is_held_against_nothing_and_one_of_steel_against_what_all_have():
    def doubts(modulus):
        return [text for text in check(changed("cycloidal-actuator", elastic_modulus=modulus, bearing_clearance=60 * UM)).doubts if "is usual" in text]

    assert not [text for text in doubts(2.4e9) if "clearance" in text]
    assert [text for text in doubts(207e9) if text.startswith("bearing.clearance = 60 um")]
