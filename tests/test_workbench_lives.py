"""The workbench's server: lives and ensembles.  No browser."""


import pytest

from fmu_src.faults import InputFault
from workbench.folder import opened

pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')


def test_the_file_of_an_ensemble_is_that_of_the_form(tmp_path):
    from studies.ensemble.ensemble_file import load_ensemble
    from workbench.ensemble_step import text_of

    row = {"name": "bearing.clearance", "unit": "um", "distribution": "normal", "first": "2,5", "second": 0.4}
    given = {"model": "RV20E-121", "hours": "3000", "samples": "4", "scatters": [row], "limits": {"disc_flank_um": "5"}}
    (tmp_path / "ensemble.toml").write_text(text_of(opened(tmp_path), given), encoding="utf-8")
    # No model, though it names a reducer.
    assert opened(tmp_path).models() == []
    drawn = load_ensemble(tmp_path / "ensemble.toml")
    assert (drawn.samples, drawn.hours, drawn.limits, [s.name for s in drawn.scatters]) == (4, 3000.0, {"disc_flank_um": 5.0}, ["bearing_clearance"])
    with pytest.raises(InputFault, match="power of two"):
        text_of(opened(tmp_path), given | {"samples": 5})
    with pytest.raises(InputFault, match="no such distribution"):
        text_of(opened(tmp_path), given | {"scatters": [row | {"name": 'a" = 1'}]})
    with pytest.raises(InputFault, match="base samples: 4.5 is no whole number"):
        text_of(opened(tmp_path), given | {"samples": 4.5})
    with pytest.raises(InputFault, match="what scatters: there is no such"):
        text_of(opened(tmp_path), given | {"scatters": [row | {"name": ""}]})
    with pytest.raises(InputFault, match="x = 3: there is no such limit"):
        text_of(opened(tmp_path), given | {"limits": {"x = 3": "1"}})
    # With all digits.
    assert "hours = 123456.75\n" in text_of(opened(tmp_path), given | {"hours": "123456.75"})


def test_numbers_of_a_form_are_said_where_they_are_wrong():
    from workbench.form import exactly, number, whole
    from workbench.life_step import positive

    assert (number(" 2,5 ", "x"), whole("40", "pins"), positive({"hours": ""}, "hours"), exactly(123456.75)) == (2.5, 40, None, "123456.75")
    for text, said in (("a", "'a' is no number"), ("nan", "a finite number is needed"), ("1.5", "'1.5' is no whole number")):
        with pytest.raises(InputFault, match=f"pins: {said}"):
            whole(text, "pins")
    with pytest.raises(InputFault, match="torque = -1: must lie above 0"):
        positive({"torque": "-1"}, "torque")


def test_a_life_says_which_stiffness_it_shows():
    """44.3 of a life stood beside 50.0 of a loop without a word."""
    from workbench.life_step import PANES, curves

    shown = curves([0.0], [{name: 1.0 for _, _, lines in PANES for name, _ in lines}])
    assert "running, between half and all of the torque; with the input held" in shown["how"]
    assert [line["name"] for line in shown["panes"][-1]["lines"]] == ["running stiffness"]
    assert [line["name"] for line in shown["panes"][-2]["lines"]] == ["lost motion"] and "lost motion: input held, mean over a crank turn" in shown["how"]


def test_a_life_that_runs_says_which_pass_it_is_and_why_in_the_words_of_the_terminal():
    """Hours went from 10,000 back to 69 without a word, and the last of them were others than those of the result."""
    from cli.show.life import telling
    from studies.life import Life, LifeSettings
    from workbench.life_step import LATEST, PANES, so_far

    figures = {name: 1.0 for _, _, lines in PANES for name, _ in lines}
    begun = Life(LifeSettings(90.0), [0.0, 90.0], [figures] * 2, jumps=3, passes=1)
    again = Life(LifeSettings(90.0), [0.0, 2.5], [figures] * 2, jumps=6, passes=2, coarse=[[1.0]] * 4, over_turn=[[0.0, 6.0], [1.0, 7.0]])
    said = []
    tell = telling(said.append)
    for life in (begun, again):
        tell(life)
    first, second = (so_far(life, False) for life in (begun, again))
    assert (first["pass"], first["why"], second["pass"]) == (1, "", 2) and second["why"] in said and second["how"].endswith(LATEST)
    again.over_turn.append([2.5, 8.0])
    last = so_far(again, True)
    assert last["ended"] and last["panes"][2]["lines"][0]["values"][-1] == 8.0 and LATEST not in last["how"]


def test_a_life_of_a_model_file_is_called_after_it_and_its_command_names_it(tmp_path, monkeypatch):
    """It was called as one of its reducer, and stood where that one's does; the command spelled every number of the model."""
    from discrepancy.model_file import load_model
    from studies import kept_life
    from workbench.life_step import command, life

    def stop(path, wanted, *_):
        lives.append((path.name, wanted))
        raise kept_life.Paused(0.0)

    folder, lives = opened(tmp_path), []
    monkeypatch.setattr(kept_life, "live_to", stop)
    numbers = '[settings]\n"errors.pin.radius[3]" = "1 um"\n[effects.needle_clearance]\nadded = "2.1 um"\n'
    for name, model in (("model.toml", "RV20E-121"), ("gearbox 7.toml", "gearbox 7")):
        (tmp_path / name).write_text(f'[model]\nname = "{model}"\nreducer = "RV20E-121"\n{numbers}', "utf-8")
    for name in ("model.toml", "gearbox 7.toml", "RV20E-121"):
        assert life(folder, {"model": name, "hours": "10"}, 1, tmp_path)
    assert [(path, wanted.reducer.name) for path, wanted in lives] == [
        ("RV20E-121-model_life.nc", "RV20E-121-model"), ("gearbox 7_life.nc", "gearbox 7"), ("RV20E-121_life.nc", "RV20E-121"),
    ]  # fmt: skip
    wanted = lives[0][1]
    assert wanted.reducer.starts["needle_clearance_added"] == 2.1e-6 and wanted.reducer.starts["pin_radius_error[3]"] == 1e-6 and not wanted.settings
    texts = ["output.load_torque=100.0N.m"]
    assert command(load_model(tmp_path / "gearbox 7.toml"), 10.0, texts, tmp_path / "a.nc") == (
        f"rvwear life --reducer '{tmp_path / 'gearbox 7.toml'}' --hours 10 --set output.load_torque=100.0N.m --output {tmp_path / 'a.nc'}"
    )
    assert command(load_model("RV20E-121"), 10.0, [], tmp_path / "a.nc") == f"rvwear life --reducer RV20E-121 --hours 10 --output {tmp_path / 'a.nc'}"


def test_a_life_runs_at_the_load_and_the_speed_of_its_fields():
    """There was no field for the speed."""
    from workbench.life_step import settings_of

    assert settings_of({}) == [] and settings_of({"torque": "120", "speed": "900"}) == ["output.load_torque=120.0N.m", "input.speed=900.0rpm"]
    assert settings_of({"speed": "25 Hz"}) == ["input.speed=1500.0rpm"]
    with pytest.raises(InputFault, match="speed = -5: must lie above 0"):
        settings_of({"speed": "-5"})
