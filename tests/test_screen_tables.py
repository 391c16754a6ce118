"""Tables on the screen: numbers are never cut, whatever stands beside them."""

import xarray as xr

from cli.screen import WIDTH, console
from cli.show.comparison import show_figures
from cli.show.life import LIFE_COLUMNS, life_table
from discrepancy.key_figures import KeyFigure


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
    show_figures([KeyFigure(f"signal_{k}", place, name, "1", 945.25, 1.25, 1.0, 2, True) for k in range(3)], console(WIDTH), True)
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= WIDTH
    assert any("off/noise" in line for line in lines)
    assert sum(line.rstrip().endswith(" 944") for line in lines) == 3
