"""The workbench's server: curves and numbers of Look and Try.  No browser."""

import json
from dataclasses import replace

import numpy as np
import pytest

from fmu_src.faults import InputFault
from workbench import jobs
from workbench.folder import opened

pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')


def test_look_has_the_errors_of_a_signal_as_compare_has_them():
    from discrepancy.compare import by_signal
    from workbench.look import errors_of

    runs = [{"signal": signal, "held_out": held_out, "left_out": False, "unit": "rad", "error": error, "noise_floor": floor}
            for signal, held_out, error, floor in (("te", True, 6.0, 2.0), ("te", False, 3.0, 1.0), ("te", False, 4.0, 7.0), ("loop", False, 1.0, 1.0))]  # fmt: skip
    assert [(error["held_out"], round(error["ratio"], 6)) for error in errors_of("te", by_signal(runs))] == [(False, 0.707107), (True, 3.0)]


def test_a_slider_reaches_as_far_as_a_bench_is_likely_to_meet():
    from discrepancy.problem import Parameter
    from workbench.trying import around, slider

    bounded = slider(Parameter("clearance", "m", 0.0, 0.0, 1e-3, 2e-6, 1), True)
    assert (bounded["low"], round(bounded["high"], 9), bounded["unit"], bounded["bounds"]) == (0.0, 10.0, "µm", [0.0, 1000.0])
    assert bounded["of"] == ""
    assert slider(Parameter("drift", "1", 0.0, -5.0, 5.0, 0.01, description="drift in a run over the mean size (0: off)"), True)["of"] == "drift in a run over the mean size"
    carried = slider(around(Parameter("expansion", "1/K", 8e-6, -1e-4, 1e-4, 5e-7, 1), 0.0), True)
    assert carried["low"] < 0.0 < carried["off"] < carried["high"]
    # A phase error of 1.3" was told in arcsec by the diagnosis, in arcmin here.
    assert slider(Parameter("phase", "rad", 0.0, -1e-2, 1e-2, 5e-4), True)["unit"] == "arcsec"


def test_orders_are_shown_by_their_amplitude():

    from workbench.look import amplitudes_of

    assert amplitudes_of(np.array([78.0, 1.0, 78.0, 1.0]), np.array([3.0, 0.0, 4.0, -2.0])).tolist() == [2.0, 5.0]


def test_a_missing_sample_leaves_the_orders_and_a_large_gap_says_why_there_are_none():
    """One #NV in each file, and orders, waterfall and hovering were gone without a word."""
    from discrepancy.page.runs import Run
    from discrepancy.problem import Record
    from workbench.look import orders_of

    def run(condition, rows):
        angle = np.delete(np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False), rows)
        record = Record(f"r_{condition}", "transmission_error", "rad", condition, 1, np.cos(7 * angle), {"angle": angle}, {})
        return Run(record, np.ones(len(angle), bool), record.values, 0.5 * record.values, np.ones(len(angle)), np.zeros(len(angle), bool))

    [told], why = orders_of([run("cold", [80]), run("cold", [90]), run("warm", range(50, 90))], 10.0)
    assert (told["condition"], told["repetitions"], told["bridged"]) == ("cold", 2, "2 samples missing or far off are bridged.")
    assert [told[name][7] for name in ("measured", "predicted", "residual")] == pytest.approx([10.0, 5.0, 5.0], rel=1e-3) and max(told["measured"][8:]) < 0.02
    assert why.keys() == {"warm"} and why["warm"].startswith("r_warm: after 44.1 deg the angle leaps by 36.9 deg")


def test_only_what_there_is_is_exported(tmp_path):
    from workbench.steps import STEPS, export_step

    assert set(STEPS) == set(jobs.KINDS)
    with pytest.raises(InputFault, match="csv, xlsx"):
        export_step(opened(tmp_path), {"what": "compare", "ending": "exe"}, 1, tmp_path)


def test_of_many_samples_one_turn_is_tried():

    from discrepancy.problem import Record
    from workbench.thinned import FEW, thinned

    angle = np.linspace(0.0, 20.0 * np.pi, 50_001)
    many = Record("r", "transmission_error", "rad", "c", 1, np.sin(78 * angle), {"angle": angle}, {"direction": 1})
    few = thinned(many)
    assert 0.8 * FEW < len(few.values) <= FEW and few.axes["angle"].max() < 2.0 * np.pi
    assert np.allclose(few.values, np.sin(78 * few.axes["angle"])) and thinned(few) is few


def test_what_is_left_out_of_what_is_tried_is_said():
    """One of two repetitions and every other sample stood there as if they were all."""
    from discrepancy.problem import Record
    from workbench.thinned import taken_words

    def run(name, count, condition="c", turns=1.0):
        return Record(name, "transmission_error", "rad", condition, 1, np.zeros(count), {"angle": np.linspace(0.0, turns * 2.0 * np.pi, count)}, {})

    whole, long = run("a", 900), run("b", 2000, turns=0.9)
    assert taken_words(whole, [whole, run("d", 900, "d")]) == ""
    assert taken_words(long, [whole, long, run("d", 900, "d")]) == "2 of 3 runs, one of each condition; of this one every 2nd sample (1,000 of 2,000 samples)"
    assert taken_words(run("t", 3001, turns=3.0), [whole]) == "of this one the first turn (1,000 of 3,001 samples)"
    assert taken_words(run("t", 9001, turns=3.0), [whole]) == "of this one the first turn, every 3rd sample (1,001 of 9,001 samples)"


def test_an_error_in_try_says_of_which_runs_and_samples_it_is():
    """0.971 of every other sample of one run, 0.916 of one run of each condition, fitted or held out, and 0.939 in Look stood without a word of it."""
    from discrepancy.problem import Record
    from workbench.thinned import looked_at, of_one, thinned

    def run(name, held):
        angle = np.linspace(0.0, 1.8 * np.pi, 1800)
        return Record(name, "transmission_error", "rad", name[0], 1, np.zeros(1800), {"angle": angle}, {}, held_out=held)

    runs = [run("a1", False), run("a2", False), run("b1", False), run("c1", True)]
    shown = [thinned(runs[k]) for k in (0, 2, 3)]
    assert looked_at(shown, runs) == "3 of 4 runs (2 fitted, 1 held out, together), 2,700 of their 5,400 samples"
    assert of_one(shown[2], runs[3]) == "this run alone (held out), 900 of its 1,800 samples"
    short = replace(runs[3], values=np.zeros(900), axes={"angle": runs[3].axes["angle"][:900]})
    assert looked_at([short], [short]) == "1 of 1 run" and of_one(short, short) == "this run alone (held out)"


def test_numbers_of_the_reducer_are_called_as_on_its_page_and_have_its_units(tmp_path):
    """carrier mass stood there in mg, and crank.support_compliance as crank_seat_compliance in nm/N."""
    from discrepancy.page.amounts import pretty
    from discrepancy.prediction.base_numbers import base_numbers
    from reducers.reducer import load_reducer
    from workbench.reducers import numbers
    from workbench.trying import base_number

    reducer = load_reducer("RV20E-121")
    on_page = {row["name"]: row for row in numbers(reducer)}
    told = [base_number(candidate, (reducer.plant, reducer.wear)) for candidate in base_numbers(reducer, ())]
    sliders = {one["title"]: one["parameters"][0] for one in told}
    assert len(sliders) == len(told) and sliders.keys() <= on_page.keys()
    assert {name: s["unit"] for name, s in sliders.items()} == {name: pretty(on_page[name]["unit"]) for name in sliders}
    assert all(s["called"] == name for name, s in sliders.items())
    mass, support = sliders["carrier.mass"], sliders["crank.support_compliance"]
    assert (mass["unit"], mass["off"], support["unit"], round(support["off"], 6)) == ("kg", 0.715, "µm/kN", 8.06)
    assert support["name"] == "crank_seat_compliance"


def test_results_are_told_without_numbers_that_json_lacks(tmp_path):

    from workbench.told import write_json

    write_json(tmp_path / "a.json", {"x": [1.0, float("nan"), np.float64(np.inf)], "y": np.arange(2)})
    assert json.loads((tmp_path / "a.json").read_text()) == {"x": [1.0, None, None], "y": [0, 1]}


def test_columns_of_a_comparison_are_read_without_parsing():

    from workbench.look import Columns

    columns = Columns()
    places = [columns.add(np.array(row)) for row in ([1.0, 2.0], [3.0])]
    found = np.frombuffer(columns.bytes(), "<f4")
    assert [found[p["from"] : p["from"] + p["count"]].tolist() for p in places] == [[1.0, 2.0], [3.0]]


def test_a_run_with_dropouts_and_a_sample_far_off_is_drawn_over_its_samples():

    from discrepancy.page.runs import Run
    from discrepancy.problem import Record
    from workbench.look import Columns, drawn

    angle = np.linspace(0.0, 6.0, 100)
    record = Record("r", "transmission_error", "rad", "c", 1, np.zeros(100), {"angle": angle}, {}, far_off=(50,))
    kept = np.arange(100) >= 10
    told = drawn(Run(record, kept, np.ones(90), np.zeros(90), np.full(90, 0.5), ~record.counted[kept]), 1.0, Columns(), {})
    assert told["samples"] == told["residual"]["count"] == 90 and told["aside"] == [40] and told["noise"] == 0.5


def test_what_is_left_in_try_is_told_without_samples_far_off():

    from discrepancy.problem import Record
    from workbench.trying import error_of

    record = Record("r", "transmission_error", "rad", "c", 1, np.array([1.0, 100.0, -1.0]), {}, {}, far_off=(1,))
    assert error_of(record, np.zeros(3)) == 1.0


def moved(angle, by):

    return 10.0 * np.sin(angle) + 3.0 * np.sin(80.0 * (angle + by))


@pytest.mark.parametrize("named, free", [("lag_share", True), ("angle_zero[1]", True), ("sensor_gain", False)])
def test_a_tried_curve_stands_from_its_own_zero_where_that_is_free(named, free):
    """A tried effect that moves the lag was held against the measurement with the lag of the base model, and looked worse than it is."""

    from discrepancy.problem import ERROR, Parameter, Record
    from workbench.own_zero import at_own_zero
    from workbench.trying import error_of

    angle = np.linspace(0.0, 2.0 * np.pi, 1200, endpoint=False)
    record = Record("r", ERROR, "rad", "c", 1, moved(angle, 2e-3), {"angle": angle}, {"direction": 1}, mounting="1", of_output=True)
    nuisances = [Parameter(named, "1", 0.0, -1.0, 1.0, 0.1, 0)]
    before, after = error_of(record, moved(angle, 0.0)), error_of(record, at_own_zero(record, moved(angle, 0.0), nuisances))
    assert before > 0.3 and (after < 0.1 * before if free else after == before)


def test_nothing_else_is_moved_in_try():

    from discrepancy.problem import Parameter, Record
    from workbench.own_zero import at_own_zero

    torque = np.linspace(-1.0, 1.0, 50)
    loop = Record("r", "hysteresis", "rad", "c", 1, torque + 1.0, {"torque": torque}, {"direction": 1}, mounting="1")
    assert at_own_zero(loop, torque, [Parameter("angle_zero[1]", "rad", 0.0, -1.0, 1.0, 0.1, 0)]) is torque


def test_look_tells_calibrated_numbers_as_compare_does():
    """In Look they had no deviation at all."""
    from types import SimpleNamespace

    from discrepancy.inference.base_fit.fit import fit_of
    from discrepancy.problem import Parameter
    from workbench.look import calibrated

    lag = Parameter("lag_share", "1", 1.0, 0.0, 10.0, 0.3, description="lag of the output")

    def told(left: float):
        base = fit_of([lag], {"lag_share": 1.017}, np.full(2, left), np.full((2, 1), 20.0))
        space = SimpleNamespace(base=base)
        return calibrated(SimpleNamespace(model=SimpleNamespace(nuisances=(lag,)), nuisances=base.values, diagnostician=SimpleNamespace(space=space)))

    assert told(0.0) == [{"name": "lag_share", "value": "1.017 ± 0.035", "meaning": "lag of the output"}]
    assert told(20.0)[0]["value"] == "1.017"


def test_a_move_of_the_hand_goes_before_the_exact_curve(monkeypatch):
    """It waited for its end: a median of 240 ms where the hand moved again after 0.6 s."""
    import threading
    import time

    from fmu_src.threads import Once
    from workbench import trying

    computing, told = threading.Event(), []

    def drawn(models, run, values, roughly, in_look):
        kept = Once(100_000)
        for n in range(0 if roughly else 20_000):
            kept.get(n, lambda: time.sleep(1e-3))
            computing.set()
        return {"roughly": roughly}, np.zeros((5, 1))

    def changes_of(found, values, in_look):
        return drawn([found], "", values, False, in_look)

    monkeypatch.setattr(trying, "drawn", drawn)
    monkeypatch.setattr(trying, "changes_of", changes_of)
    trial = trying.Trial()
    for name in ("opened", "at_hand"):
        monkeypatch.setattr(trial, name, lambda folder, model: object())
    for slow in (lambda: trial.curve(None, "m", "r", {})[0], lambda: trial.everywhere(None, "m", {})):
        computing.clear()
        exact = threading.Thread(target=lambda: told.append(slow()))
        exact.start()
        assert computing.wait(10.0)
        begun = time.perf_counter()
        assert trial.curve(None, "m", "r", {}, roughly=True)[0] == {"roughly": True}
        assert time.perf_counter() - begun < 2.0
        exact.join(10.0)
    assert told == [{"late": True}, None]
