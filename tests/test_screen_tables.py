"""Tables on the screen: numbers are never cut, whatever stands beside them; above them of which model they are."""

from dataclasses import replace

import xarray as xr

from cli.screen import WIDTH, console
from cli.show.comparison import show_figures
from cli.show.life import LIFE_COLUMNS, life_table
from discrepancy.key_figures import KeyFigure
from discrepancy.model_file import load_model
from discrepancy.page.comparison import figures_section


def test_a_lifes_numbers_are_whole_however_much_has_worn(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    life_table(xr.Dataset({name: ("hour", [0.0, 38153.25]) for name, _, _ in LIFE_COLUMNS}, {"hour": [0.0, 1e5]}, {"title": "a life"}))
    shown = capsys.readouterr().out
    assert shown.count("38153") == len(LIFE_COLUMNS)
    assert "…" not in shown
    # Of two stiffnesses the running one.
    assert "stiffness: running, between half and all of the torque" in " ".join(shown.split())


def test_key_figures_are_whole_beside_long_names(capsys):
    name, place = "torsional stiffness, backward, unloading", "RV20E_50N.m_15rpm_38degC_forward"
    show_figures([KeyFigure(f"signal_{k}", place, name, "1", 945.25, 1.25, 1.0, 2, True) for k in range(3)], console(WIDTH), load_model("RV20E-121"), True)
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= WIDTH
    assert any("off/noise" in line for line in lines)
    assert sum(line.rstrip().endswith(" 944") for line in lines) == 3


def test_key_figures_say_that_they_are_of_the_model_with_its_effects(capsys):
    """"measured against the base model" stood above those of a model file with an effect."""
    figures = [KeyFigure("transmission_error", "warm", "order 40", "rad", 2e-5, 1e-5, 1e-6, 2, True)]
    base = load_model("RV20E-121")
    better = replace(base, effects={"hole_position_errors": {}, "thermal_expansion": {}})
    for file, words in ((base, "the base model"), (better, "the model with hole position errors, thermal expansion")):
        show_figures(figures, console(WIDTH), file, True)
        assert f"key figures, measured against {words} as it was calibrated to this campaign" in " ".join(capsys.readouterr().out.split())
        assert f"what {words} predicts there" in figures_section(figures, file, True)[0].lead
