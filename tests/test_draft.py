"""A recovered law becomes an effect's file that says the same as the law, at a place that is honest or at none."""

import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from cli.commands import drafting
from cli.main import main
from discrepancy.draft.choose import Draft, require_folder, write, written_to
from discrepancy.draft.expression import FORMS, expression_of
from discrepancy.draft.places import Drive, NoPlace, place_of
from discrepancy.draft.write import text_of
from discrepancy.inference.law.closed_forms import Form, closed_forms
from discrepancy.inference.law.recover import Recovered
from discrepancy.inference.law.waves import Growth
from fmu_src.effect_check import check_any_file
from fmu_src.faults import InputFault, RunFault

DRIVE = Drive(121.0, 39)
RPM = math.pi / 30.0
# Constants of each form over 200 to 2000 (rpm, say).
CONSTANTS = {
    "linear": {"a": 0.1, "b": 2e-4}, "quadratic": {"a": 0.1, "b": 2e-4, "c": 3e-7}, "exponential": {"a": 0.1, "b": 0.3, "c": 1e-3},
    "saturating": {"a": 0.1, "b": 0.4, "c": 300.0}, "threshold": {"a": 0.1, "b": 2e-4, "c": 900.0}, "step": {"a": 0.1, "b": 0.3, "c": 900.0},
    "bump": {"a": 0.1, "b": 0.3, "c": 900.0, "d": 250.0}, "periodic": {"a": 0.1, "b": 0.3, "c": -0.2, "k": 6e-3},
    "power": {"a": 0.1, "b": 0.3, "c": 2.5}, "logarithmic": {"a": 0.1, "b": 0.3},
}  # fmt: skip
TOLD = {"speed": (1.0 / RPM, 0.0, "rpm"), "temperature": (1.0, -273.15, "degC"), "hours": (1.0 / 3600.0, 0.0, "h"), "angle": (180.0 / math.pi, 0.0, "deg")}


def law_of(signal="input_torque", leading="speed", form="power", constants=None, factor=None, ends=(200.0, 2000.0), y_told=(1.0, ""), sure=0.1,
           growth=None):
    """A law over ``leading``, whose form holds over ``ends`` in the unit it is told in; constants are known within a share ``sure``."""
    p = constants or CONSTANTS[form]
    intervals = {k: (v - sure * abs(v), v + sure * abs(v)) for k, v in p.items()}
    scale, offset, unit = TOLD.get(leading, (1.0, 0.0, ""))
    x = [(v - offset) / scale for v in np.linspace(*ends, 8)]
    told = Form(form, "", p, intervals, 1.0, 0.9)
    return Recovered(signal, factor == "prediction", [], leading, factor, {"x": x, "y": x, "deviation": x}, [told], None, None, "the law",
                     (scale, offset, unit), y_told, growth)  # fmt: skip


def file_of(folder, law, name="mystery", zero_known=False):
    place = place_of(law, DRIVE, zero_known)
    expression = expression_of(law, place.level)
    path = folder / place.package / f"{name}.py"
    return Draft(name, path, text_of(name, law, place, expression, "bench", "RV20E-121"), law, place, expression)


@pytest.mark.parametrize("form", FORMS)
def test_terms_are_the_form_in_si(form):
    law = law_of(form=form, y_told=(1000.0, "mN.m"))
    expression = expression_of(law, True)
    x = np.linspace(30.0, 205.0, 50)
    told = x / RPM
    wanted = closed_forms(np.array([200.0, 2000.0]))[form][2](told, *CONSTANTS[form].values()) / 1000.0
    names = {s.letter: s.value for s in expression.shapes} | {t.letter: t.size for t in expression.terms} | {"math": math, "max": max, "min": min}

    def total(at, what):
        u = (at - expression.zero) / expression.scale
        return sum(names[t.letter] * eval(getattr(t, what), {}, names | {"u": u}) for t in expression.terms)  # noqa: S307 (what drafts are made of)

    assert [total(v, "code") for v in x] == pytest.approx(wanted, rel=1e-4, abs=1e-8)
    slopes = [(total(v + 1e-5, "code") - total(v - 1e-5, "code")) / 2e-5 * expression.scale for v in x]
    assert [total(v, "slope") for v in x] == pytest.approx(slopes, rel=1e-4, abs=1e-6)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("signal", "leading", "factor"), [
    ("input_torque", "speed", None), ("input_torque", "temperature", "load"), ("no_load_torque", "speed", "direction"), ("efficiency", "load", None),
    ("cage_speed", "speed", "prediction"), ("cage_speed", "load", None), ("temperature", "load", None), ("hysteresis[locked=input]", "torque", None),
    ("transmission_error", "angle", "load"), ("lost_motion", "temperature", None), ("wear_depth[surface=flank]", "speed", "prediction"),
    ("wear_depth[surface=flank]", "hours", "prediction"), ("mass_loss", "temperature", "prediction"),
])  # fmt: skip
def test_every_draft_passes_the_check(tmp_path, form, signal, leading, factor):
    draft = file_of(tmp_path, law_of(signal, leading, form, factor=factor))
    write(draft)
    assert check_any_file(draft.file) == []
    assert "recovered from campaign 'bench'" in draft.text and draft.equation in draft.text and max(map(len, draft.text.splitlines())) < 200
    # The same draft again is no other file.
    write(draft)


def test_what_the_data_do_not_show_is_left_out():
    vague = law_of(form="quadratic", constants={"a": 0.1, "b": 2e-4, "c": 3e-7}, sure=1.5)
    assert [t.suffix for t in expression_of(vague, True).terms] == ["square"]
    # Of a loop's mean nobody knows where it is.
    place = place_of(law_of("hysteresis", "torque", "quadratic"), DRIVE, False)
    assert not place.level and "level" not in [t.suffix for t in expression_of(law_of(form="quadratic"), place.level).terms]


def test_fewest_constants_win_among_forms_that_are_nearly_as_sure():
    law = law_of(form="quadratic")
    power = law_of(form="power", constants={"a": 0.0, "b": 0.3, "c": 2.5}).forms[0]
    law.forms.append(Form(power.name, "", power.parameters, power.intervals, 1.0, 0.5))
    assert expression_of(law, True).form.name == "power"


def test_what_stands_before_a_law_multiplies_all_of_it(tmp_path):
    assert file_of(tmp_path, law_of("transmission_error", "angle", "periodic", factor="load")).equation.startswith("turning = M (b cos[")


@pytest.mark.parametrize(("signal", "leading", "form", "factor", "reason"), [
    ("vibration_order", "speed", "linear", None, "no force on the housing"),
    ("torsional_stiffness", "temperature", "linear", None, "slope of a loop"),
    ("wear_depth[surface=flank]", "speed", "linear", None, "no share of the wear"),
    ("wear_depth[surface=flank]", "load", "linear", "prediction", "load_exponent"),
    ("input_torque", "angle", "linear", None, "does not know"),
    ("transmission_error", "temperature", "linear", None, "zero that nobody knows"),
    ("hysteresis", "torque", "linear", "prediction", "in proportion to itself"),
    ("hysteresis", "torque", "linear", "load", "not the torque that turns"),
])  # fmt: skip
def test_what_has_no_place_says_why(signal, leading, form, factor, reason):
    with pytest.raises(NoPlace, match=reason):
        place_of(law_of(signal, leading, form, factor=factor), DRIVE, False)


def test_a_file_that_says_something_else_is_left_alone(tmp_path):
    draft = file_of(tmp_path, law_of())
    draft.file.parent.mkdir()
    draft.file.write_text("# mine\n")
    with pytest.raises(InputFault, match="mystery.py.*--name"):
        write(draft)
    assert draft.file.read_text() == "# mine\n"
    taken = file_of(tmp_path, law_of(), name="drag")
    with pytest.raises(InputFault, match="--name drag: there is an effect"):
        write(taken)
    assert not taken.file.exists()


# What a bench shows of a record without and with an effect, by name: compiled in, with all others off.
PROGRAM = """
import json, math, sys
import numpy as np
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.observe import OBSERVED
from discrepancy.problem import Record
from reducers.reducer import load_reducer

bench, found = Bench(load_reducer("RV20E-121-rigid"), {}), {}
for name, (quantity, tags, axes, factors, values) in json.loads(sys.stdin.read()).items():
    axes = {k: np.array(v) for k, v in axes.items()}
    size = len(next(iter(axes.values())))
    record = Record("a", quantity, "", "c", 1, np.zeros(size), axes, factors, tags=tags, zero_known=True)
    found[name] = [np.asarray(OBSERVED[quantity](bench, record, v)).tolist() for v in ({}, values)]
print(json.dumps(found))
"""
LOADED = {"load": 150.0, "temperature": 303.15, "direction": 1.0, "speed": 150.0}
SPEEDS = [40.0, 120.0, 200.0]
TORQUES = [-160.0, -60.0, 40.0, 150.0, 40.0]
ANGLES = list(np.linspace(0.0, 0.3, 7))


def over(signal, leading, axes, factors=LOADED, factor=None, form="linear", ends=(200.0, 2000.0), **constants):
    """(law, what a bench is asked)."""
    quantity, _, tag = signal.partition("[")
    tags = dict([tag[:-1].split("=")]) if tag else {}
    growth = constants.pop("growth", None)
    return law_of(signal, leading, form, constants, factor, ends, growth=growth), (quantity, tags, axes, factors)


WARM = {"form": "linear", "ends": (20.0, 60.0)}
CASES = {
    "torque_speed": over("input_torque", "speed", {"speed": SPEEDS}, a=0.02, b=1e-4),
    "torque_share": over("input_torque", "speed", {"speed": SPEEDS}, factor="prediction", a=0.05, b=1e-4),
    "torque_back": over("input_torque", "temperature", {"speed": SPEEDS}, LOADED | {"direction": -1.0}, "load and direction", **WARM, a=-1e-3, b=-1e-4),
    "efficient": over("efficiency", "speed", {"speed": SPEEDS}, a=-1e-4, b=-1e-6),
    "cage_share": over("cage_speed", "speed", {"speed": SPEEDS}, factor="prediction", a=0.01, b=1e-5),
    "cage_ahead": over("cage_speed", "load", {"load": [50.0, 150.0]}, LOADED, ends=(10.0, 200.0), a=0.01, b=1e-3),
    "warmer": over("temperature", "load", {"time": [0.0, 10.0]}, ends=(10.0, 200.0), a=1.0, b=0.02),
    "loop": over("hysteresis[locked=input]", "torque", {"torque": TORQUES}, form="quadratic", ends=(-160.0, 160.0), a=0.0, b=1e-7, c=1e-9),
    "wave": over("transmission_error", "angle", {"angle": ANGLES}, form="periodic", ends=(0.0, 360.0), a=0.0, b=2e-6, c=1e-6, k=0.096),
    "wave_back": over("transmission_error", "angle", {"angle": ANGLES}, LOADED | {"direction": -1.0}, form="periodic", ends=(0.0, 360.0),
                      a=0.0, b=2e-6, c=1e-6, k=0.096),
    "wave_side": over("transmission_error", "angle", {"angle": ANGLES}, LOADED | {"direction": -1.0}, "load and direction", form="periodic",
                      ends=(0.0, 360.0), a=0.0, b=2e-8, c=1e-8, k=0.096),
    "wave_warm": over("transmission_error", "angle", {"angle": ANGLES}, form="periodic", ends=(0.0, 360.0), a=0.0, b=2e-6, c=1e-6, k=0.096,
                      growth=Growth("temperature", 273.15, 65.0, 2.0)),
    "lost": over("lost_motion", "temperature", {"load": [150.0]}, **WARM, a=2e-5, b=1e-6),
    "worn_fast": over("wear_depth[surface=flank]", "speed", {"hours": [3.6e5, 7.2e5]}, factor="prediction", a=0.1, b=1e-4),
    "worn_warm": over("wear_depth[surface=inner_race]", "temperature", {"hours": [3.6e5, 7.2e5]}, factor="prediction", **WARM, a=0.1, b=0.01),
    "worn_long": over("wear_depth[surface=flank]", "hours", {"hours": [3.6e5, 1.8e6]}, factor="prediction", form="linear", ends=(10.0, 500.0), a=0.02, b=2e-4),
}  # fmt: skip


def wanted(law, asked, base):
    """What the law itself says."""
    quantity, _, axes, factors = asked
    places = {k: np.full(len(base), v) for k, v in factors.items()} | {k: np.array(v) for k, v in axes.items()}
    factor, offset, _ = law.x_told
    x = factor * places[law.leading] + offset
    form = law.forms[0]
    y = closed_forms(np.array([v * factor + offset for v in law.points["x"]]))[form.name][2](x, *form.parameters.values())
    way = {"prediction": base, "load and direction": places["load"] * places["direction"], None: 1.0}[law.factor]
    return way * y * (law.growth.of(factors) if law.growth else 1.0)


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """By case: what is measured without and with the draft; all are compiled into one pair of units."""
    folder, asked = tmp_path_factory.mktemp("drafts"), {}
    for name, (law, question) in CASES.items():
        draft = file_of(folder, law, name, zero_known=True)
        write(draft)
        numbers = {f"{name}_{t.suffix}": draft.place.sign * t.size for t in draft.expression.terms}
        asked[name] = (*question, numbers | {f"{name}_{s.suffix}": s.value for s in draft.expression.shapes})
    done = subprocess.run([sys.executable, "-c", PROGRAM], input=json.dumps(asked), capture_output=True, text=True, timeout=300,
                          env={**os.environ, "RVWEAR_EFFECTS": str(folder)})  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


# To first order: what a share of the load's power costs of an efficiency, how a depth follows wear that spreads as it goes on, the
# turning between two torques of the standard loop.
ROUGHLY = {"efficient": 0.01, "worn_fast": 0.1, "worn_warm": 0.1, "worn_long": 0.25, "lost": 0.02}


@pytest.mark.parametrize("name", CASES)
def test_what_is_measured_changes_by_the_law(name, shown):
    law, asked = CASES[name]
    base, now = (np.array(v) for v in shown[name])
    assert now - base == pytest.approx(wanted(law, asked, base), rel=ROUGHLY.get(name, 2e-3), abs=1e-9)


def campaign_of(folder, law, seed, strength, size):
    """A campaign of the blind trial's generator that hides a law outside the catalogue."""
    from benchmarks.blind_trial.generator.make import Task, make

    task = Task(1, seed, "outside", (law,), strength, size)
    make(task, folder, folder / "sealed")
    return folder / task.name


def extended(campaign, folder, capsys):
    """What ``rvwear extend --draft`` says."""
    code = main(["extend", "RV20E-121-rigid", str(campaign), "--draft", str(folder), "--output", str(folder / "better.toml"), "--json"])
    out = capsys.readouterr()
    assert code in (0, 1), out.err
    return json.loads(out.out)


def test_one_command_from_unknown_to_a_model_that_is_better(tmp_path, capsys, monkeypatch):
    """Without the catalogue, which costs most of the time and does not know the law."""
    from discrepancy import remembered, verdict
    from discrepancy.prediction.physical_model import PhysicalModel

    answers = []

    def diagnose(file, campaign, jobs):
        model = PhysicalModel(file, campaign)
        model.candidates = ()
        answers.append(verdict.diagnose(file, campaign, model=model))
        return answers[0]

    monkeypatch.setattr(remembered, "diagnosed", diagnose)
    campaign = campaign_of(tmp_path, "drag with speed^2.5", 21, 40.0, "small")
    said = extended(campaign, tmp_path / "mine", capsys)
    step, draft = said["step"], said["draft"]
    assert said["verdict"] == "helped" and step["kept"] and step["held_out_after"] < 1.5 < 5.0 < step["held_out_before"]
    assert draft["effect"] == "input_torque_over_speed" and (draft["unit"], draft["hook"]) == ("rv_plant", "after") and not draft["beside"]
    text = (tmp_path / "mine" / "rv_plant" / "input_torque_over_speed.py").read_text()
    assert "Source: recovered from campaign 'campaign_00001'." in text and draft["equation"] in text
    # Torque at the largest measured speed, of what the generator hid.
    hidden = json.loads((tmp_path / "sealed" / "campaign_00001.json").read_text())["laws"][0]["numbers"]["a"] * (2400.0 * RPM / 209.4) ** 2.5
    kept = said["effects"]["input_torque_over_speed"]
    assert sum(p["value"] for p in kept.values()) == pytest.approx(hidden, rel=0.1)
    # ``rvwear diagnose --draft FILE`` writes the same law and stops there.
    file = written_to(answers[0], tmp_path / "rv_plant" / "ventilation.py")
    assert file.read_text() == text.replace("input_torque_over_speed", "ventilation") and check_any_file(file) == []


# Laws that the catalogue does not have: a loss over speed, a turning over torque, a turning over angle.
OUTSIDE = [("drag with speed^2.5", 21, 40.0, "small"), ("foot that lifts with the square of the torque", 14, 20.0, "tiny"), ("belt at order 5.5", 18, 20.0, "small")]


@pytest.mark.campaign
@pytest.mark.parametrize("outside", OUTSIDE, ids=lambda outside: outside[0])
def test_outside_laws_are_drafted_against_the_whole_catalogue(tmp_path, capsys, outside):
    said = extended(campaign_of(tmp_path, *outside), tmp_path / "mine", capsys)
    step = said["step"]
    assert said["verdict"] == "helped" and step["held_out_after"] < 1.3 < 4.0 < step["held_out_before"]


@pytest.mark.parametrize(("alone", "beside", "chosen"), [(1.5, 1.48, 0), (1.5, 1.2, 1), (1.5, None, 0), (None, 1.2, 1), (None, None, None)])
def test_what_is_named_must_earn_its_place_beside_a_law(tmp_path, monkeypatch, alone, beside, chosen):
    """By the error on fitted runs; what cannot be fitted is not taken."""
    errors = {"alone": alone, "beside": beside}

    def child(options, draft, more, as_json):
        error = errors[draft.name]
        return subprocess.CompletedProcess([], 1, "" if error is None else json.dumps({"step": {"training_after": error}}))

    monkeypatch.setattr(drafting, "child", child)
    drafts = [file_of(tmp_path, law_of(), name=name) for name in errors]
    if chosen is None:
        with pytest.raises(RunFault, match="alone.py and .*beside.py: could not be fitted"):
            drafting.better(None, drafts)
    else:
        assert drafting.better(None, drafts) is drafts[chosen]


def test_effects_lie_in_one_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("RVWEAR_EFFECTS", str(tmp_path / "mine"))
    with pytest.raises(InputFault, match="--draft .*mine"):
        require_folder(tmp_path / "other")
    require_folder(tmp_path / "mine")
    assert main(["extend", "RV20E-121", str(tmp_path / "none"), "--draft", str(tmp_path), "--effect", "drag"]) == 2
    capsys.readouterr()


def test_a_wave_whose_size_goes_with_a_condition(tmp_path):
    def drafted(growth):
        return file_of(tmp_path, law_of("transmission_error", "angle", "periodic", factor="direction", growth=growth))

    draft = drafted(Growth("temperature", 273.15, 65.0, 2.0, 0.1))
    write(draft)
    assert check_any_file(draft.file) == [] and draft.equation.startswith("turning = ((T - 273.15)/65)^q side (b cos[")
    assert [(s.letter, s.value, s.low, s.high) for s in draft.expression.shapes[1:]] == [("q", 2.0, 0.05, 8.0)]
    with pytest.raises(NoPlace, match="goes with the hours, which the plant does not know; it knows load, speed, temperature"):
        drafted(Growth("hours", 0.0, 3.6e6, 1.0))
