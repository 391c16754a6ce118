"""Tables on the screen: numbers are never cut, whatever stands beside them; above them of which model they are."""

from dataclasses import replace
from types import SimpleNamespace

import pandas as pd
import pytest
import xarray as xr
from bench_files import ARCMIN, TORQUE, TWIST

from cli.columns import in_lines, widest
from cli.screen import WIDTH, console
from cli.show import guesses
from cli.show.bench import show_bench
from cli.show.campaign import LEVELS, show_overview
from cli.show.comparison import show_figures
from cli.show.life import LIFE_COLUMNS, life_table
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.model_file import load_model
from discrepancy.page.changed_figures import figures_of_answer
from discrepancy.page.comparison import figures_section
from discrepancy.tables import figure_rows
from studies.standard.evaluation import Figure

LOCKED = "入力軸固定0deg"


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


def test_key_figures_have_conditions_whole(capsys):
    """`入力軸固定0deg` was shown as `入力軸固定0de` and, below it, `g`."""
    names = ["width of the loop at no torque", "torsional stiffness, forward, loading", "torsional stiffness, backward, unloading"]
    off = [KeyFigure("hysteresis[locked=input]", LOCKED, name, "rad", 2e-4, 1e-4, 1e-6, 2, True) for name in names]
    long = KeyFigure("transmission_error", "RV20E_50N.m_15rpm_38degC_forward", "order 40", "rad", 2e-5, 1e-5, 1e-6, 2, True)
    for figures, shown in ((off[:1], [LOCKED]), (off, [LOCKED]), ([*off, long], [LOCKED, "RV20E_50N.m_15rpm_", "38degC_forward"])):
        show_figures(figures, console(WIDTH), load_model("RV20E-121"), True)
        told = capsys.readouterr().out
        assert all(f" {name} " in told for name in shown) and widest(told.splitlines()) <= WIDTH


def test_key_figures_take_one_or_two_lines(capsys):
    """The sun's took seven, while conditions were broken beside it."""
    sun, axes = "sun (order 120 also 3 x crank against carrier), orders 120, 121", "torsional stiffness, backward, unloading"
    condition = "滞回曲线_输入轴锁定"
    figures = [KeyFigure("transmission_error", condition, name, "rad", 7.49e-5, 2.93e-5, 6e-8, 2, True) for name in (sun, "crank against carrier, orders 40, 80")]
    figures += [KeyFigure("hysteresis[locked=input]", condition, axes, "N.m/rad", 1.7e5, 1.72e5, 1.4e2, 3, True)]
    show_figures(figures, console(WIDTH), load_model("RV20E-121"), True)
    told = capsys.readouterr().out
    lines = [line.strip() for line in told.splitlines()]
    assert told.count(f" {condition} ") == 3 and widest(told.splitlines()) <= WIDTH
    assert any(line.startswith("sun, orders 120, 121  ") for line in lines) and "sun: order 120 also 3 x crank against carrier" in lines
    begin, end = lines.index("transmission_error:"), lines.index("hysteresis[locked=input]:")
    assert end - begin <= 6 and lines[end + 2].endswith("unloading")


def test_names_of_conditions_end_lines_where_words_of_them_do(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "64")
    conditions = {name: [Figure("hysteresis loss", 1.0, "arcmin", "what it is", (0.5, 1.5))] for name in (LOCKED, "warm_without_load_backward")}
    show_bench("RV20E-121", SimpleNamespace(name="s", title="t", text="x"), conditions, 167.0, 121.0, 2, None, False)
    told = capsys.readouterr().out
    assert f" {LOCKED} " in told and " warm_without_ " in told and " load_backward " in told and "hysteresis loss" in told


def test_runs_of_a_proposal_break_names_where_their_words_end(capsys, tmp_path):
    for k in (1, 2):
        name = f"RV20E-121_serial_00417_bench_three_hysteresis_{LOCKED}_run{k}_with_the_new_encoder_on_the_output.csv"
        pd.DataFrame({"torque [N.m]": TORQUE, "twist [arcmin]": TWIST / ARCMIN}).to_csv(tmp_path / name, index=False)
    guesses.show(propose([tmp_path], Wishes("RV20E-121")))
    told = capsys.readouterr().out
    assert "│ RV20E-121_serial_00417_bench_three_ │" in told and f" three_{LOCKED}_with_ " in told and told.count(" the_new_encoder_on_the_output │") == 2


@pytest.mark.parametrize(("name", "width", "lines"), [
    (LOCKED, 13, ["入力軸固", "定0deg"]), (LOCKED, 14, [LOCKED]), ("RV20E_50N.m_15rpm_38degC", 20, ["RV20E_50N.m_", "15rpm_38degC"]),
    ("abcdefghijk", 10, ["abcdef", "ghijk"]), ("warm and dry", 9, ["warm", "and dry"]), ("温度条件高速", 11, ["温度条", "件高速"]), ("", 5, [""]),
])  # fmt: skip
def test_where_a_name_is_broken(name, width, lines):
    assert in_lines(name, width).split("\n") == lines


def test_overview_of_a_campaign_has_whole_heads_and_says_once_what_is_alike(capsys):
    """Heads were cut to ``condi… repli… tempe…``, over columns of which half said 1 in every row."""
    row = {"quantity": "transmission_error", "runs": 1200, "held_out": 120, "conditions": 60, "replicates": 20, "values": 1234567}
    show_overview("bench 7", [row | dict.fromkeys(LEVELS, 12), row | {"quantity": "hysteresis"} | dict.fromkeys(LEVELS, 1)], console(WIDTH))
    every = capsys.readouterr().out
    assert "…" not in every and widest(every.splitlines()) <= WIDTH
    assert every.count("1234567") == 2 and all(end in every for end in ("ratures", "repli-", "tings")) and "at most" not in every
    alike = dict(zip(LEVELS, (3, 2, 1, 0, 1, 1)))
    show_overview("bench 7", [row | alike, row | {"load": 0, "speed": 0} | dict.fromkeys(list(alike)[2:], 0)], console(WIDTH))
    fewer = capsys.readouterr().out
    assert "one temperature, one direction, one mounting at most; no hours stated" in fewer
    assert "loads  speeds" in fewer and "direc-" not in fewer and "hours " not in fewer.replace("no hours stated", "")


def test_key_figures_of_a_diagnosis_are_those_with_what_it_names_too(capsys):
    """A loop of 0.323 arcmin stood beside 0.271 of the base model, and nowhere what the named effect makes of it."""
    before = [KeyFigure("hysteresis[locked=input]", LOCKED, name, "rad", 9.4e-5, 7.9e-5, 3e-7, 2, True) for name in ("lost motion", "mean width of the loop")]
    after = [replace(f, model=9.41e-5) for f in before]
    show_figures(before, console(WIDTH), load_model("RV20E-121"), True, after, "play")
    told = capsys.readouterr().out
    assert "and with play in it" in " ".join(told.split()) and told.count("50.0 -> 0.3") == 2 and widest(told.splitlines()) <= WIDTH
    answer = SimpleNamespace(figures=before, figures_after=after, added="play", model=SimpleNamespace(file=load_model("RV20E-121")),
                             diagnosis=SimpleNamespace(nuisances={"zero": 1.0}))  # fmt: skip
    [section] = figures_of_answer(answer)
    assert "with the effect" in section.tables[0].head and section.tables[0].rows[0][-2:] == ["0.3235 arcmin", "50.0 → 0.333"]
    columns = {column.name: column.values for column in figure_rows(before, after).columns}
    assert columns["off_in_noise_with_effect"][0] == pytest.approx(-1.0 / 3.0)
    assert "with_effect" not in {column.name for column in figure_rows(before).columns}
