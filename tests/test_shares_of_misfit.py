"""Shares of the misfit are those of what is really off, and the headline names the signal that the table of errors shows furthest off."""

from types import SimpleNamespace

import numpy as np
import pytest
from nothing import Nothing

from cli.show import comparison as shows
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.misfit.localise import Group, Localisation, Localiser
from discrepancy.page import amounts, comparison, whys
from discrepancy.page.maps import place_table
from discrepancy.problem import Record

TURN = 2.0 * np.pi
LOOP = "hysteresis[locked=input]"


def error(replicate):
    """One line beside noise of 1."""
    angle = np.linspace(0.0, TURN, 1000, endpoint=False)
    values = 3.0 * np.cos(78 * angle) + np.random.default_rng(replicate).normal(0.0, 1.0, 1000)
    return Record(f"te{replicate}", "transmission_error", "rad", "a", replicate, values, {"angle": angle}, {"load": 50.0})


def loop(replicate):
    """Off all over by 90 times its noise of 1."""
    torque = 100.0 * np.sin(np.linspace(0.0, TURN, 400))
    values = 90.0 * np.sqrt(3.0) * torque / 100.0 * np.abs(torque) / 100.0 + np.random.default_rng(10 + replicate).normal(0.0, 1.0, 400)
    return Record(f"loop{replicate}", "hysteresis", "rad", "b", replicate, values, {"torque": torque}, {}, tags={"locked": "input"})


def test_a_signal_that_is_off_all_over_has_the_share_of_what_it_is_off():
    """Loops of 90 times their noise had 20 % beside transmission errors of 2.5 times theirs: 99 % and more in chi-square."""
    space = Workspace(Nothing([make(k) for make in (error, loop) for k in (1, 2)]))
    space.fit_base()
    found = Localiser(space, {"ring pins": (78.0,)}).test(space.base)
    of_loops = sum(g.share for g in found.findings if g.signal == LOOP)
    assert {g.signal for g in found.findings} == {LOOP, "transmission_error"} and of_loops > 0.99
    assert sum(g.share for g in found.findings) == pytest.approx(1.0)
    # Tests stay as strict as they were: a signal that is off all over is no evidence for one function of it.
    straight = next(g for g in found.largest if g.signal == LOOP)
    assert found.largest[0] is straight and straight.statistic < 1e-2 * straight.chi_square
    assert found.to_dict()["findings"][0]["signal"] == LOOP and {"chi_square", "share"} <= set(found.to_dict()["findings"][0])


def groups():
    """As they were of pins out of round: the loops are further off, the error's orders the more significant."""
    return [Group("transmission_error", "orders: crank against carrier", "everywhere", 2795.0, 4, 100.0, 1e-72, 3e-70, 0.004, 18116.0),
            Group(LOOP, "branch of torque", "everywhere", 844.0, 3, 100.0, 1e-48, 9e-47, 0.68, 6228047.0)]  # fmt: skip


def compared(signals):
    rows = [{"signal": name, "held_out": False, "left_out": False, "ratio": ratio} for name, ratio in signals]
    return SimpleNamespace(signals=rows, runs=rows, diagnostician=SimpleNamespace(localisation=Localisation(groups(), {}, 0.004)))


def test_the_headline_names_the_signal_that_is_furthest_off():
    """"The misfit is most significant in transmission error" stood there, beside an error of 2.55 times the noise and loops of 89.5 times."""
    text = comparison.finding(compared([("transmission_error", 2.55), (LOOP, 89.5)]))
    assert f"What is off most in {amounts.signal_title(LOOP)}: branch of torque" in text
    assert "transmission error" not in text and "68 % of all misfit" in text
    # Where nothing in the worst signal is significant, the largest share is told.
    assert "branch of torque" in comparison.finding(compared([("input_torque", 3.0), ("transmission_error", 2.55)]))


def test_the_largest_share_stands_first(capsys):
    shows.show_localisation(Localisation(groups(), {}, 0.004))
    shown = capsys.readouterr().out
    assert shown.index("branch of torque") < shown.index("crank against carrier") and "68 %" in shown and "< 1 %" in shown
    places = [{"signal": g.signal, "feature": g.feature, "dependence": g.dependence, "statistic": g.statistic, "width": g.width, "dof": g.dof, "p": g.p,
               "share": g.share, "chi_square": g.chi_square} for g in groups()]  # fmt: skip
    assert [row[1] for row in place_table(places, 0.004).rows] == ["branch of torque", "orders: crank against carrier"]
    assert "6,230,000 of chi-square, tested as 844 as its signal is off all over" in whys.of_place(places[1], 0.004).data


def test_what_is_held_out_is_counted_in_runs_and_conditions():
    """"16 runs at 8 conditions, 2 of them held out" was read as two conditions: it was two runs of one."""
    result = SimpleNamespace(model=SimpleNamespace(file=SimpleNamespace(effects={}), records=[]))
    runs = [SimpleNamespace(record=SimpleNamespace(condition=name, held_out=held)) for name, held in (("a", False), ("a", False), ("b", True), ("b", True))]
    assert comparison.conditions(result, runs) == "4 runs at 2 conditions; held out: 2 runs at 1 condition; model without further effects"
    assert comparison.conditions(result, runs[:2]).startswith("2 runs at 1 condition; held out: none;")
