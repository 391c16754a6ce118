"""The final trial before it is run: its plan, its levels, what its scorer counts, and its files as a bench writes them."""

import json
import sys
import time
from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest

from benchmarks.blind_trial import nearest, tool
from benchmarks.blind_trial import run as trial_run
from benchmarks.blind_trial.final import final_plan
from benchmarks.blind_trial.generator import rivals
from benchmarks.blind_trial.generator.dense import dense_design
from benchmarks.blind_trial.generator.designs import Design, make_design
from benchmarks.blind_trial.generator.laws import CATALOGUE, GainFault, OffsetFault
from benchmarks.blind_trial.generator.make import LAWS, TRUE_PARAMETERS, Task, blocks_for, make
from benchmarks.blind_trial.generator.noise import Noise
from benchmarks.blind_trial.generator.outside import NEW, OUTSIDE
from benchmarks.blind_trial.generator.reducer import SOFT
from benchmarks.blind_trial.generator.strength import LONG, Ruler, axis_variance, whitener
from benchmarks.blind_trial.generator.trouble import BASES, NOISES, STIFF, TAILS
from benchmarks.blind_trial.generator.truth import Bench
from benchmarks.blind_trial.publish import peers_section
from benchmarks.blind_trial.results import finished, pack, unpack
from benchmarks.blind_trial.score import cases_of, misses, score
from benchmarks.blind_trial.targets import APART, TARGETS, Target, reached
from benchmarks.blind_trial.words import ABOUT, BASE_OFF, RESULTS, SEALS
from discrepancy.campaign.load import load_campaign


def test_final_plan_is_fixed_and_as_large_as_it_must_be():
    tasks = final_plan()
    assert tasks == final_plan()
    assert len(tasks) >= 1000
    assert [t.number for t in tasks] == list(range(len(tasks)))
    small = sum(t.size in ("small", "poor", "tiny") for t in tasks)
    assert small <= 2 * len(tasks) / 3
    strengths = Counter((t.laws[0], t.strength) for t in tasks if t.kind == "effect" and t.size != "poor")
    assert {law.name for law in CATALOGUE} == {name for name, _ in strengths}
    assert all(strengths[law.name, s] >= 1 for law in CATALOGUE for s in (4.0, 6.0, 8.0, 12.0, 20.0, 40.0))
    nulls = [t for t in tasks if t.kind == "null"]
    assert {t.trouble for t in nulls} == {"", *BASES, *NOISES}
    assert sum(t.size == "bench" for t in tasks) >= 50
    assert {t.laws[0] for t in tasks if t.kind == "outside"} == {law.name for law in OUTSIDE}
    # Any stretch of it is a mixture: it can be stopped.
    assert len({t.kind for t in tasks[:100]}) == 6


def test_new_outside_laws_are_in_no_catalogue():
    assert len(NEW) >= 5
    assert all(law.effect == "" and not law.acceptable for law in NEW)
    assert not {law.name for law in NEW} & {law.name for law in CATALOGUE}


def test_levels_are_those_that_were_asked_for():
    levels = {t.key: (t.least, t.most) for t in TARGETS}
    assert levels["first_from_10"] == (0.95, None)
    assert levels["set_holds_from_10"] == (0.99, None)
    assert levels["set_holds_6"] == (0.95, None)
    assert levels["set_size"] == (None, 1.5)
    assert levels["outside_20"] == (0.97, None)
    assert levels["false_alarms"] == (None, 0.02)
    assert levels["coverage"] == (0.92, 0.98)
    assert levels["experiments"] == (3.0, None)
    assert (levels["held_out_worse"], levels["held_out_12"], levels["held_out_20"]) == ((None, 0.02), (None, 0.45), (None, 0.25))
    assert APART == 3.0


def test_targets_say_what_they_ask_and_whether_it_was_met():
    share = Target("a", "", least=0.95)
    assert (share.level, share.told(0.9512), share.met(0.95), share.met(0.9499)) == ("at least 95 %", "95.1 %", True, False)
    span = Target("a", "", least=0.92, most=0.98)
    assert (span.level, span.met(0.99)) == ("92 to 98 %", False)
    assert (Target("a", "", most=1.5, digits=2).level, Target("a", "", most=1.5, digits=2).told(1.234)) == ("at most 1.5", "1.23")


def result(number, kind, verdict, names=(), effects=(), strength=0.0, **more) -> dict:
    """One line of a trial; ``rivals``, ``trouble``, ``size``, ``confusable``."""
    truth = {"kind": kind, "size": more.get("size", "small"), "strength": strength, "laws": [], "effects": list(effects), "acceptable": [], "fault": "",
             "rivals": more.get("rivals", {}), "trouble": more.get("trouble", "")}  # fmt: skip
    answer = {"verdict": verdict, "effects": [{"name": n, "parameters": {}} for n in names], "confusable": list(more.get("confusable", ())),
              "times": {"whole": 1.0}, "captured": 1.0}  # fmt: skip
    return {"number": number, "truth": truth, "answer": answer, "cpu": {"whole": 2.0}}


def figures_of(*results) -> dict:
    return score({r["number"]: r for r in results})


def test_what_no_test_can_tell_is_counted_apart_and_both_ways_are_shown():
    figures = figures_of(
        result(1, "effect", "set", ["play", "relief"], ["relief"], 12.0, confusable=["relief"], rivals={"play": 0.5, "drag": 8.0}),
        result(2, "effect", "one effect", ["drag"], ["drag"], 12.0, rivals={"offset": 4.0}),
        result(3, "effect", "one effect", ["gain"], ["gain"], 20.0),
    )  # fmt: skip
    assert figures["judged"]["first_from_10"]["share"] == pytest.approx(2 / 3)
    assert figures["told_apart"]["first_from_10"]["share"] == 1.0
    assert figures["judged"]["set_size"]["share"] == pytest.approx(4 / 3)
    assert figures["told_apart"]["set_size"]["share"] == 1.0
    assert (figures["apart"]["known"], figures["apart"]["campaigns"], figures["apart"]["effects"]) == (2, 1, {"relief": 1})
    assert figures["cpu"] == 6.0
    near, far = (result(k, "outside", "one effect", ["gain"], [""], 20.0, rivals={"gain": d}) for k, d in ((4, 1.0), (5, 9.0)))
    unnamed = figures_of(near | {"truth": near["truth"] | {"laws": [{"law": "humidity", "numbers": {}}]}}, far, result(6, "outside", "unknown", (), [""], 20.0))
    assert (unnamed["judged"]["outside_20"]["count"], unnamed["judged"]["outside_20"]["of"]) == (1, 3)
    assert (unnamed["told_apart"]["outside_20"]["count"], unnamed["told_apart"]["outside_20"]["of"]) == (1, 2)
    assert unnamed["apart_outside"] == {"humidity": 1}
    row = next(r for r in reached(figures) if r.target.key == "first_from_10")
    assert row.verdict == "**missed**"
    assert row.without == (1.0, 2)


def test_a_base_that_is_off_may_be_said_to_be_where_it_is():
    results = [result(k, "null", v, trouble=t) for k, (v, t) in enumerate([("none", STIFF), (BASE_OFF, STIFF), (BASE_OFF, ""), ("unknown", TAILS), ("none", "")])]
    figures = figures_of(*results)
    assert figures["judged"]["false_alarms"]["count"] == 2
    assert figures["alarms_by_trouble"][STIFF]["count"] == 0
    assert [c.number for c in misses(cases_of({r["number"]: r for r in results}))] == [2, 3]


def test_an_alarm_without_a_name_names_nothing():
    """sbi's tests only say that something is missing: an alarm, which is no name for a law outside, and right for none within."""
    hidden = [result(1, "null", "none"), result(2, "effect", "one effect", ["drag"], ["drag"], 12.0), result(3, "effect", "set", ["gain"], ["drag"], 6.0),
              result(4, "outside", "unknown", (), [""], 20.0), result(5, "outside", "named but incomplete", ["gain"], [""], 20.0)]  # fmt: skip
    said = [{"BIC": ["drag.seals"], "sbi": []}, {"BIC": ["drag.seals"], "sbi": ["unknown"]}, {"BIC": []}, {"BIC": ["gain.x"], "sbi": ["unknown"]}, {"BIC": []}]
    lines = peers_section(cases_of({r["number"]: r | {"peers": p | {"seconds": ["1.0"]}} for r, p in zip(hidden, said)}))
    assert [line for line in lines if line.startswith(("| BIC", "| sbi", "| this"))] == [
        "| BIC | 1 of 1 | 1 of 1 | 1 of 1 | 1 of 2 | 1 of 2 |",
        "| sbi | 0 of 1 | 1 of 1 | 0 of 1 | 1 of 1 | 0 of 1 |",
        "| this diagnosis | 0 of 1 | 1 of 1 | 1 of 1 | 2 of 2 | 0 of 2 |",
    ]


def torque_ruler(laws) -> tuple[Ruler, list]:
    """Input torque at some speeds, white noise."""
    rng = np.random.default_rng(0)
    design = make_design(rng, ["torque"], "tiny")
    for s in design.series:
        s.noise = Noise(0.01)
    return Ruler(design, TRUE_PARAMETERS, Bench({})), [law(rng) for law in laws]


def test_distance_to_the_nearest_rival_is_what_projection_leaves():
    """An offset seen by a gain meter: both are linear, so that the sine of their angle is known."""
    ruler, (offset,) = torque_ruler([OffsetFault])
    offset.a, offset.sign = 0.01, 1.0
    gain = GainFault(np.random.default_rng(1))
    gain.a, left = 0.01, []
    a = ruler.column([offset])
    for gain.sign in (1.0, -1.0):
        b = ruler.column([gain])
        left.append(np.linalg.norm(a - b * max(a @ b, 0.0) / (b @ b)))
    assert rivals.distance(ruler, a, GainFault, np.random.default_rng(2)) == pytest.approx(min(left), rel=1e-3)
    assert rivals.distance(ruler, a, OffsetFault, np.random.default_rng(2)) == pytest.approx(0.0, abs=1e-3 * np.linalg.norm(a))


def test_every_other_effect_in_the_same_quantity_is_a_rival():
    ruler, (offset,) = torque_ruler([OffsetFault])
    found = rivals.distances(ruler, offset, np.random.default_rng(0))
    assert set(found) == {law.effect for law in CATALOGUE if "input_torque" in law.quantities} - {"sensor_offset"} | {"sensor_drift", rivals.NUMBERS}
    assert max(found.values()) <= ruler.size([offset]) * 1.001


def test_numbers_of_the_file_are_a_rival_as_far_as_they_may_be_off():
    """Of a soft reducer's input torque an offset of some seal torque is one of them, within its range; a law that is such a number has none of its own."""
    rng = np.random.default_rng(0)
    design = make_design(rng, ["torque"], "tiny")
    for s in design.series:
        s.noise = Noise(1e-4)
    ruler = Ruler(design, TRUE_PARAMETERS, Bench({}, name=SOFT))
    changes = rivals.base_changes(ruler)
    seal, whole = changes["input_seal_torque"], {*changes} - {"input_seal_torque", "input_churning_torque"}
    assert rivals.base_distance(ruler, seal, ()) <= 1.0
    # Twice as far off as its deviation is twice as unlikely; the others of its kind make up for some.
    assert 0.3 < rivals.base_distance(ruler, 4.0 * seal, ()) <= 4.0
    assert rivals.base_distance(ruler, 4.0 * seal, {"input_seal_torque", "input_churning_torque"}) > 3.0 * rivals.base_distance(ruler, 4.0 * seal, ())
    assert {"mesh_friction", "roller_friction"} <= whole


def test_beside_a_law_its_size_tells_nothing():
    ruler, (offset, gain) = torque_ruler([OffsetFault, GainFault])
    both = ruler.beside(gain)
    assert both.size([gain]) == pytest.approx(0.0, abs=1e-9 * ruler.size([gain]))
    a, b = ruler.column([offset]), ruler.column([gain])
    assert both.size([offset]) == pytest.approx(np.linalg.norm(a - b * (a @ b) / (b @ b)), rel=1e-9)


def test_command_says_how_near_other_effects_come(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["nearest", "wrong zero", "--strength", "12", "--size", "tiny", "--seed", "3"])
    assert nearest.main() == 0
    out = capsys.readouterr().out
    assert "wrong zero, d' 12.0, in input_torque" in out
    assert "sensor_gain: d' " in out


def test_long_records_are_whitened_as_short_ones():
    """By frequencies as by Cholesky's factor: the same size of the same change."""
    n = LONG - 10
    noise = Noise(0.5, 0.7, 0.6, 0.4, offset=0.3, drift=0.6, quantum=0.1)
    angle = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    change, extra = np.cos(5.0 * angle) + 0.2 * np.sin(90.0 * angle) + 0.1, np.full(n, 0.01)
    short = np.linalg.norm(whitener(noise, np.zeros(n), extra)(change))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("benchmarks.blind_trial.generator.strength.LONG", 10)
        long = np.linalg.norm(whitener(noise, np.zeros(n), extra)(change))
    assert long == pytest.approx(short, rel=0.01)


def test_noise_of_an_axis_goes_with_the_slope():
    series = SimpleNamespace(axes={"torque": np.array([0.0, 1.0, 3.0, 2.0])})
    design = Design("x", axis_noise={"torque": 0.1})
    assert axis_variance(design, series, np.array([0.0, 2.0, 6.0, 4.0])) == pytest.approx(np.full(4, 0.04))
    assert not axis_variance(Design("x"), series, np.zeros(4)).any()


def test_bench_files_hold_what_plain_ones_do(tmp_path, monkeypatch):
    """Semicolons, decimal commas, other units: the same numbers in SI."""
    monkeypatch.setattr("benchmarks.blind_trial.generator.dense.SAMPLES", 300)
    monkeypatch.setattr("benchmarks.blind_trial.generator.dense.STEPS", 30)
    styles = set()
    for seed in range(6):
        truth = make(Task(seed, seed, "null", size="bench"), tmp_path, tmp_path / "sealed")
        campaign = load_campaign(tmp_path / f"campaign_{seed:05d}")
        styles.add(next(campaign.folder.glob("*.csv")).read_text(encoding="utf-8").splitlines()[0])
        assert sum(len(r.values) for r in campaign.records) == truth["samples"]
        for r in campaign.records:
            if r.quantity == "hysteresis":
                assert 160.0 < r.axes["torque"].max() < 170.0
                assert 3e-4 < np.ptp(r.values) < 5e-3
            if r.quantity == "transmission_error":
                assert np.ptp(r.axes["angle"]) == pytest.approx(2.0 * np.pi, rel=0.01)
        assert [c.factors["speed"] for c in campaign.conditions.values()] == pytest.approx([121 * 8 * np.pi / 30] * len(campaign.conditions))
    assert len(styles) >= 2


def test_stopping_leaves_what_is_done(tmp_path, monkeypatch, capsys):
    tasks = [Task(k, 20 + k, "null", size="tiny") for k in range(3)]
    asked = []

    def answer(folder):
        asked.append(folder.name)
        if len(asked) == 2:
            raise KeyboardInterrupt
        return {"verdict": "none", "effects": [], "times": {"whole": 0.1}}

    monkeypatch.setattr("benchmarks.blind_trial.tool.answer_of", answer)
    assert set(trial_run.trial(tasks, tmp_path, jobs=1)) == {0}
    assert "1 of 3 are done" in capsys.readouterr().err
    done = trial_run.trial(tasks, tmp_path, jobs=1)
    assert set(done) == {0, 1, 2}
    assert asked == [tasks[0].name, tasks[1].name, tasks[1].name, tasks[2].name]
    assert all(r["cpu"]["whole"] >= r["cpu"]["making"] > 0.0 for r in done.values())
    assert "min of CPU so far" in capsys.readouterr().out


def test_a_diagnosis_that_does_not_end_is_no_answer(tmp_path, monkeypatch):
    monkeypatch.setattr(tool, "LONGEST", 0.05)
    monkeypatch.setattr(tool, "load_campaign", lambda folder: time.sleep(5.0))
    found = tool.answer_of(tmp_path)
    assert found["verdict"] == "crash"
    assert "no answer within" in found["error"]
    assert found["times"]["whole"] < 2.0


def test_a_busy_machine_leaves_a_diagnosis_its_cpu_time(tmp_path, monkeypatch):
    waits = 0.4

    def answer(*_, **__):
        begun = time.process_time()
        time.sleep(waits)  # as if other work had the core
        while time.process_time() - begun < 0.1:
            pass
        return SimpleNamespace(in_si=lambda: {"verdict": "none", "effects": []})

    monkeypatch.setattr(tool, "LONGEST", 0.2)
    monkeypatch.setattr(tool, "load_campaign", lambda folder: None)
    monkeypatch.setattr(tool, "model_of", lambda campaign: SimpleNamespace(reducer=SimpleNamespace(name="any")))
    monkeypatch.setattr(tool, "PhysicalModel", lambda file, campaign: SimpleNamespace(bench=SimpleNamespace(), rough_bench=SimpleNamespace()))
    monkeypatch.setattr(tool, "diagnose", answer)
    assert tool.answer_of(tmp_path)["verdict"] == "none"
    waits = 5.0
    assert "no answer within" in tool.answer_of(tmp_path)["error"]


def test_a_bench_shows_both_of_two_laws():
    rng = np.random.default_rng(0)
    task = Task(0, 0, "pair", ("slipping clock", "wrong gain"), 12.0, "bench")
    truths = [LAWS[name](rng) for name in task.laws]
    assert blocks_for(rng, task, truths) == ["te", "torque"]
    design = dense_design(rng, ["te", "torque"])
    assert design.quantities() == {"transmission_error", "input_torque"}
    # Laws of the temperature show where several conditions are measured.
    several = dense_design(rng, ["loops"], several=True)
    assert len({several.conditions[s.condition].temperature for s in several.series if s.condition not in several.held_out}) == 2


def test_a_folder_belongs_to_one_plan(tmp_path):
    assert trial_run.other_plan(tmp_path / ABOUT, 1, False) == ""
    (tmp_path / ABOUT).write_text(json.dumps({"seed": 1, "commit": "x", "campaigns": 5}), encoding="utf-8")
    assert trial_run.other_plan(tmp_path / ABOUT, 1, False) == ""
    assert "seed 1" in trial_run.other_plan(tmp_path / ABOUT, 2, False)
    assert trial_run.other_plan(tmp_path / ABOUT, 1, True)


def test_a_trial_goes_on_from_what_was_packed(tmp_path):
    first, second, place = tmp_path / "first", tmp_path / "second", tmp_path / "kept.json.xz"
    first.mkdir()
    (first / ABOUT).write_text(json.dumps({"commit": "abc", "seed": 7, "final": True, "campaigns": 3}), encoding="utf-8")
    (first / SEALS).write_text("ff  campaign_00001\n", encoding="utf-8")
    (first / RESULTS).write_text(json.dumps({"number": 1, "answer": {"verdict": "none"}}) + "\n{\"numb", encoding="utf-8")
    pack(first, place)
    unpack(second, place)
    assert finished(second) == finished(first) == {1: {"number": 1, "answer": {"verdict": "none"}}}
    assert (second / SEALS).read_text(encoding="utf-8") == (first / SEALS).read_text(encoding="utf-8")
    assert trial_run.commits(second / ABOUT).startswith("abc, ")
