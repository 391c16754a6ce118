"""The workbench's server: reducers that are read or completed.  No browser."""


import pytest

from fmu_src.faults import InputFault
from workbench.folder import opened

pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')


def test_a_reducer_says_at_which_speed_it_runs_beside_that_of_its_rating(tmp_path):
    from workbench.reducers import shown

    found = shown(opened(tmp_path), "RV20E-121")["reducer"]
    assert "at 15 rpm" in found["lead"] and found["speed"] == (
        "runs at 2,000 rpm at the input, 16.5 rpm at the output (document, table 2; the catalogue rates at 15 rpm of the output)"
    )


def test_the_reducer_of_a_model_file_is_the_model_with_its_effects_and_their_numbers_stand_in_the_list(tmp_path):
    """Title and text were the base reducer's, and what the effect carries stood nowhere; what is set on it was the reducer's, too."""
    from workbench.reducers import shown

    folder = opened(tmp_path)
    base = """[model]
name = "RV20E-121"
reducer = "RV20E-121"
[settings]
bearing.clearance = "3 um"
"""
    (folder.root / "without.toml").write_text(base, encoding="utf-8")
    (folder.root / "model.toml").write_text(base + """[effects.hole_position_errors]
disc_hole_shift_1 = {value = 4.0, unit = "um", low = 3.995, high = 4.005}
[effects.sensor_drift]
sensor_drift = { value = 0.02 }
""", encoding="utf-8")  # fmt: skip
    found = shown(folder, "model.toml")["reducer"]
    effects = "RV20E-121 with hole position errors, sensor drift"
    assert found["title"] == "model.toml (RV20E-121) with hole position errors, sensor drift" and found["lead"].startswith(f"The model is {effects}. Of the reducer: ")
    rows = {row["name"]: (row["value"], row["unit"], row["source"]) for row in (*found["added"], *found["numbers"])}
    assert rows["effects.hole_position_errors.disc_hole_shift_1"] == ("4.0000", "µm", "model.toml, interval 3.9950 to 4.0050")
    assert rows["effects.sensor_drift.sensor_drift"] == ("0.020000", "", "model.toml")
    assert rows["bearing.clearance"] == ("3.0000", "µm", "model RV20E-121")
    plain = shown(folder, "RV20E-121")["reducer"]
    # Drawn with the forces that it has.
    carried = [int(shown(folder, name)["reducer"]["figures"][1]["caption"].partition("carries ")[2].split()[0]) for name in ("without.toml", "model.toml")]
    assert carried[1] > carried[0] + 5
    assert plain["title"] == "RV20E-121" and plain["added"] == [] and not plain["lead"].startswith("The model is")


def test_numbers_given_are_counted_as_the_command_line_does(tmp_path):
    from workbench.reducers import completed

    page = completed(opened(tmp_path), {"ratio": "121", "pins": "40", "rated": "167", "known": {"pin.radius": "2mm"}})["page"]
    assert page["finding"] == "53 numbers: 5 follow from what is given alone, 18 come by published rules, 30 are assumed", page["finding"]


def test_a_reducer_is_completed_as_stiff_as_its_catalogue_and_its_stiffness_stands_beside_it(tmp_path):
    """The command's number, by the command's units; without one the form says that nobody asked for it."""
    from workbench.reducers import completed

    folder, asked = opened(tmp_path), {"ratio": "153", "rated": "0,784kNm", "cranks": "3"}

    def stiffness(found):
        return next((c["value"], c["note"]) for c in found["page"]["cards"] if c["label"] == "torsional stiffness")

    by_rules = completed(folder, asked)
    assert float(stiffness(by_rules)[0]) > 300.0 and stiffness(by_rules)[1].startswith("not given") and "--stiffness" not in by_rules["command"]
    found = completed(folder, {**asked, "stiffness": "212Nm/arcmin"})
    assert float(stiffness(found)[0]) == pytest.approx(212.0, rel=2e-3) and stiffness(found)[1] == "212 asked for"
    # What the rules leave open is none where it was given.
    assert [any("scatters by a third" in text for text in one["page"]["warnings"]) for one in (by_rules, found)] == [True, False]
    assert "--rated 784 " in found["command"] and "--stiffness 212 " in found["command"] and "support_compliance" not in found["command"]
    assert any("give 'outer diameter of the housing' if the catalogue has it" in text for text in found["page"]["warnings"])
    with pytest.raises(InputFault, match="torsional stiffness of the catalogue"):
        completed(folder, {**asked, "stiffness": "212kg"})
    # Far beyond the rules it is a mistaken unit, here as on the command line.
    with pytest.raises(InputFault, match=r"^'torsional stiffness of the catalogue' 212\.5 Nm/deg is 3\.54167 N m/arcmin: it asks for .* did you mean 212\.5 N m/arcmin\?"):
        completed(folder, {**asked, "stiffness": "212,5 Nm/deg", "save": True})
    assert not folder.models()


def test_a_gap_that_makes_the_lost_motion_is_no_measured_one_on_the_page(tmp_path):
    from workbench.reducers import completed

    folder, asked = opened(tmp_path), {"ratio": "129", "rated": "1568", "meets_lost_motion": True}
    found = completed(folder, asked)
    (gap,) = [row for row in found["numbers"] if row["name"] == "disc.equidistant_modification"]
    assert not gap["given"] and gap["range"].startswith("0 to ") and "--lost-motion 1 " in found["command"]
    (card,) = [card for card in found["page"]["cards"] if card["label"] == "lost motion"]
    assert float(card["value"]) == pytest.approx(1.0, rel=5e-3) and card["note"] == f"1 of the catalogue; taken for it: {gap['name']} = {float(gap['value']):.3g} µm"
    with pytest.raises(InputFault, match="^'refuse where no gap.*' is ticked and disc.equidistant_modification is typed in 'Every number"):
        completed(folder, {**asked, "known": {"disc.equidistant_modification": "3um"}})


def test_a_reducer_is_completed_refused_and_saved_once(tmp_path):
    from workbench.reducers import completed

    folder = opened(tmp_path)
    asked = {"ratio": "121", "pins": "40", "rated": "167", "known": {"pin.radius": "2mm"}, "name": "mine"}
    with pytest.raises(InputFault, match="^ratio 8100: must lie"):
        completed(folder, {**asked, "ratio": "8100"})
    # "meet lost motion ... give known bearing.clearance=..." stood there, and the path of a file that is not there.
    with pytest.raises(InputFault, match=r"^'refuse where no gap.*'lost motion of the catalogue', or type bearing.clearance in 'Every"):
        completed(folder, {**asked, "lost_motion": "0.1", "meets_lost_motion": True})
    with pytest.raises(InputFault, match=r"^\[bearing\] clearance = 9000 um: "):
        completed(folder, {**asked, "known": {"bearing.clearance": "9mm"}})
    assert completed(folder, {**asked, "save": True})["saved"] == "mine.toml"
    with pytest.raises(InputFault, match="not overwritten"):
        completed(folder, {**asked, "save": True})
    assert folder.models() == ["mine.toml"]
