"""Standard tests: one evaluation for the virtual bench and for measured files, against loops whose answer is known."""

import json
import re

import numpy as np
import pandas as pd
import pytest

from cli.main import main
from fmu_src.faults import InputFault
from orchestrator.settings import parse_setting
from studies.hysteresis import hysteresis
from studies.standard.evaluation import TESTS, Way, turning_points
from studies.standard.procedures import PROCEDURES, rated_of, ratio_of, run

RIGID = ("--reducer", "RV20E-121-rigid")
ARCMIN = np.radians(1.0) / 60.0
RATED, STIFFNESS, PLAY, WIDTH = 100.0, 50.0, 0.8, 0.3  # N.m, N.m/arcmin, arcmin


def loop(noise=0.0, cycles=1.0):
    """-T to +T and back by a spring of known stiffness beside a play, its two ways WIDTH apart."""
    phase = np.linspace(0.0, 2.0 * np.pi * cycles, int(4001 * cycles))
    torque = -RATED * np.cos(phase)
    rising = np.sin(phase) >= 0.0
    angle = torque / STIFFNESS + 0.5 * PLAY * np.tanh(torque / 0.2) + np.where(rising, -0.5, 0.5) * WIDTH
    random = np.random.default_rng(1)
    return {"output_torque": torque + noise * random.normal(size=len(torque)), "output_angle": ARCMIN * (angle + 0.1 * noise * random.normal(size=len(torque)))}


def figures(test, *curves, rated=RATED, ratio=121.0):
    return {figure.name: figure.value for figure in TESTS[test].evaluate(curves, rated, ratio)}


@pytest.mark.parametrize("noise, share", [(0.0, 1e-3), (0.05, 0.05)])
@pytest.mark.parametrize("cycles", [1.0, 1.6])
def test_loop_of_known_play_width_and_stiffness_is_read_as_it_is(noise, share, cycles):
    found = figures("lost-motion", loop(noise, cycles))
    assert found["lost_motion"] == pytest.approx(PLAY + 0.06 * RATED / STIFFNESS, rel=share)
    assert figures("stiffness", loop(noise, cycles))["torsional_stiffness"] == pytest.approx(STIFFNESS, rel=share)
    if noise == 0.0:
        assert found["backlash"] == pytest.approx(WIDTH, rel=0.05)


def test_turning_points_are_those_of_the_torque_and_not_of_its_noise():
    torque = np.concatenate([np.linspace(0, 1, 50), np.linspace(1, -1, 100), np.linspace(-1, 0, 50)])
    noisy = torque + 0.01 * np.random.default_rng(2).normal(size=200)
    points = turning_points(noisy)
    assert len(points) == 4 and abs(points[1] - 49) < 5 and abs(points[2] - 149) < 5


def test_an_encoder_that_starts_anew_at_each_turn_is_told():
    turning = np.linspace(0.0, 4.0 * np.pi, 400)
    good = {"output_angle": turning + ARCMIN * np.sin(39.0 * turning), "input_angle": 121.0 * turning}
    assert figures("transmission-error", good)["transmission_error"] == pytest.approx(120.0, rel=1e-2)
    for sense in (1.0, -1.0):
        with pytest.raises(InputFault, match="curve 1: output_angle starts anew at each turn"):
            figures("transmission-error", good | {"output_angle": sense * (turning % (2.0 * np.pi))})


def test_virtual_bench_agrees_with_the_hysteresis_study(rv20e):
    rated = rated_of(rv20e, [])[0]
    curves = [*PROCEDURES["lost-motion"](rv20e, []).values()]
    own = hysteresis(rv20e, [])
    assert figures("lost-motion", *curves, rated=rated)["lost_motion"] == pytest.approx(own.lost_motion_arcmin, rel=1e-3)
    assert figures("stiffness", *curves, rated=rated)["torsional_stiffness_reverse"] == pytest.approx(own.stiffness_reverse_Nm_per_arcmin, rel=3e-3)


def test_losses_that_are_put_in_come_out(rv20e):
    settings = [parse_setting(text, [rv20e.plant]) for text in ("effects.drag.seal_torque=0.05", "effects.stribeck_friction.friction_coefficient=0.03")]
    rated, ratio = rated_of(rv20e, settings)[0], ratio_of(rv20e, settings)
    assert ratio == 121.0
    unloaded = PROCEDURES["no-load-torque"](rv20e, settings)
    for curve in unloaded.values():
        assert figures("no-load-torque", curve)["no_load_torque"] == pytest.approx(0.05, rel=1e-6)
    starting = figures("starting-torque", *PROCEDURES["starting-torque"](rv20e, settings).values(), ratio=ratio)
    assert starting["starting_torque_at_output"] == pytest.approx(0.05 * 121.0, rel=1e-6)
    shares = [figures("efficiency", curve, rated=rated)["efficiency"] for curve in PROCEDURES["efficiency"](rv20e, settings).values()]
    # Drag weighs less under more load: 0.05 N m of 167/121 N m at the rated torque, friction of the contacts besides.
    assert shares == sorted(shares) and shares[0] > 80.0 and shares[-1] < 100.0 / (1.0 + 0.05 * 121.0 / 167.0)


def test_without_errors_a_reducer_without_load_has_no_transmission_error_and_play_both_ways(rv20e):
    light, loaded = (figures("transmission-error", curve)["transmission_error"] for curve in PROCEDURES["transmission-error"](rv20e, []).values())
    assert light < 1e-6 and 5.0 < loaded < 9.0
    dynamic = figures("dynamic-lost-motion", *PROCEDURES["dynamic-lost-motion"](rv20e, []).values())["dynamic_lost_motion"]
    assert dynamic == pytest.approx(hysteresis(rv20e, []).lost_motion_arcmin, rel=0.02)


def test_what_a_rigs_drag_holds_shows_clearances_and_exactly_no_load_does_not(rv20e, capsys):
    """6 um: 3.7e-10 arcsec stood in the row of 0 N.m without a word; a tenth of a newton metre has what the rated torque has."""
    loose = [parse_setting("bearing.clearance=6um", [rv20e.plant, rv20e.wear])]
    held = run(rv20e, loose, rv20e.topology.lobes, 0.1, 209.4)
    assert figures("transmission-error", held)["transmission_error"] == pytest.approx(12.7, rel=0.01)
    floats = run(rv20e, loose, rv20e.topology.lobes, 0.0, 209.4)
    assert figures("transmission-error", floats)["transmission_error"] < 1e-6
    assert "0 N.m is exactly none: the output floats" in TESTS["transmission-error"].text



def test_measured_file_gives_the_number_of_the_bench_that_it_came_from(rv20e, tmp_path, capsys):
    curves = PROCEDURES["stiffness"](rv20e, [])
    rows = ["T kNm;turned;place"]
    for k, curve in enumerate(curves.values()):
        rows += [f"{t * 1e-3!r};{float(a / ARCMIN)!r};{k}" for t, a in zip(curve["output_torque"].tolist(), curve["output_angle"].tolist())]
    (tmp_path / "loops.csv").write_text("\n".join(rows), encoding="utf-8")
    columns = ["--column", "output_torque=T kNm:kN.m", "--column", "output_angle=turned:arcmin", "--column", "position=place"]
    found = []
    for more in ([], ["--measured", str(tmp_path / "loops.csv"), *columns]):
        assert main(["bench", "--standard", "stiffness", "--json", *RIGID, *more]) == 0
        found.append({f["name"]: (f["value"], f["spread"]) for f in json.loads(capsys.readouterr().out)["figures"]})
    for name, (value, spread) in found[0].items():
        assert found[1][name][0] == pytest.approx(value, rel=1e-9) and found[1][name][1] == pytest.approx(spread, rel=1e-9)
    assert main(["bench", "--standard", "stiffness", *RIGID, "--measured", str(tmp_path / "loops.csv"), *columns]) == 0
    shown = capsys.readouterr().out
    assert "torsional_stiffness_forward" in shown and "between 50 and 100 %" in shown and "16 curves" in shown


@pytest.mark.parametrize("columns, said", [
    ([], "no such column.*--column output_torque=HEADER:UNIT"),
    (["output_torque=T:N.m", "output_angle=a:kg"], "column 'a' as output_angle in kg"),
    (["output_torqe=T:N.m"], "did you mean output_torque"),
    (["output_torque=T:N.m", "output_angle=a:arcmin"], "a.csv: curve 1: the output torque goes from .* to 1 N.m; stiffness needs both senses up to 167 N.m"),
])  # fmt: skip
def test_what_a_file_lacks_is_said(tmp_path, columns, said, capsys):
    (tmp_path / "a.csv").write_text("T,a\n" + "\n".join(f"{np.sin(k)},{k}" for k in np.linspace(0, 7, 50)), encoding="utf-8")
    assert main(["bench", "--standard", "stiffness", "--measured", str(tmp_path / "a.csv"), *[x for c in columns for x in ("--column", c)]]) == 2
    assert re.search(said, capsys.readouterr().err)


def test_one_way_alone_is_no_loop():
    with pytest.raises(InputFault, match="one way alone"):
        figures("lost-motion", {"output_torque": np.linspace(-100, 100, 50), "output_angle": np.zeros(50)})


def test_figures_and_curves_are_exported_and_read_back(capsys, tmp_path):
    path = tmp_path / "loop.csv"
    assert main(["bench", "--standard", "stiffness", "--json", *RIGID, "--export", str(path)]) == 0
    figures = json.loads(capsys.readouterr().out)["figures"]
    written = pd.read_csv(path)
    assert list(written["value"]) == pytest.approx([f["value"] for f in figures]) and list(written["unit"]) == [f["unit"] for f in figures]
    columns = [f"--column={text}" for text in ("output_torque=output_torque [N.m]:N.m", "output_angle=output_angle [deg]:deg", "position=position")]
    assert main(["bench", "--standard", "stiffness", "--json", *RIGID, "--measured", str(tmp_path / "loop_curves.csv"), *columns]) == 0
    again = json.loads(capsys.readouterr().out)["figures"]
    assert [f["value"] for f in again] == pytest.approx([f["value"] for f in figures], rel=1e-9)


@pytest.mark.parametrize("test", TESTS)
@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_own_export_gives_the_same_figures_for_each_condition(test, ending, capsys, tmp_path):
    """Without --column: heads say the units; 0 and 6.1 arcsec of the transmission error were averaged to 3.1."""
    command = ["bench", "--standard", test, "--json", "--reducer", "RV20E-121"]
    assert main([*command, "--export", str(tmp_path / f"a.{ending}")]) == 0
    first = json.loads(capsys.readouterr().out)
    assert main([*command, "--measured", str(tmp_path / f"a_curves.{ending}")]) == 0
    again = json.loads(capsys.readouterr().out)
    assert again["curves"] == first["curves"] and len(again["figures"]) == len(first["figures"])
    for one, other in zip(first["figures"], again["figures"]):
        assert (one["condition"], one["name"]) == (other["condition"], other["name"])
        assert other["value"] == pytest.approx(one["value"], rel=1e-9, abs=1e-8)


def efficiency_file(path, **more):
    """Two loads, 60 samples each."""
    load = np.repeat([50.0, 150.0], 60)
    speed = np.full(120, 100.0)
    columns = {"input_torque": load / 121 / np.repeat([0.7, 0.8], 60), "input_speed": speed, "output_torque": load, "output_speed": speed / 121}
    pd.DataFrame(columns | more).to_csv(path, index=False)
    return ["bench", "--standard", "efficiency", "--json", *RIGID, "--measured", str(path)]


def told(capsys):
    return {figure["condition"]: figure["value"] for figure in json.loads(capsys.readouterr().out)["figures"]}


def test_loads_of_one_file_are_kept_apart_without_a_word(capsys, tmp_path):
    assert main(efficiency_file(tmp_path / "a.csv")) == 0
    assert told(capsys) == {"50 N.m": pytest.approx(70.0), "150 N.m": pytest.approx(80.0)}


def test_temperature_and_sense_are_conditions_and_positions_are_averaged_within(capsys, tmp_path):
    more = {"oil [degC]": np.tile(np.repeat([20.2, 59.8, 20.0], 20), 2), "direction": np.repeat(["forward", "backward"], 60), "run": np.tile([1, 2], 60)}
    assert main([*efficiency_file(tmp_path / "a.csv", **more), "--column", "temperature=oil [degC]", "--column", "position=run"]) == 0
    found = told(capsys)
    assert found == {
        "forward, 20.1 degC": pytest.approx(70.0), "forward, 59.8 degC": pytest.approx(70.0),
        "backward, 20.1 degC": pytest.approx(80.0), "backward, 59.8 degC": pytest.approx(80.0),
    }  # fmt: skip


def test_a_condition_that_is_too_short_is_named(capsys, tmp_path):
    name = np.repeat(["warm", "cold", "warm"], [50, 4, 66])
    assert main(efficiency_file(tmp_path / "a.csv", condition=name, output_torque=np.full(120, 50.0))) == 2
    assert "a.csv: cold: curve 1: 4 samples are too few" in capsys.readouterr().err


def test_a_ramp_is_no_condition_and_a_load_seen_in_passing_is_not_averaged(capsys, tmp_path):
    assert main([*efficiency_file(tmp_path / "a.csv", t=np.linspace(20, 60, 120)), "--column", "temperature=t:degC"]) == 2
    assert "temperature goes from 20 to 60 degC without steps" in capsys.readouterr().err
    load = np.repeat([50.0, 100.0, 150.0], [58, 4, 58])
    assert main(efficiency_file(tmp_path / "a.csv", output_torque=load)) == 2
    assert "output_torque holds several values (50, 100, 150 N m), some in fewer than 8 samples" in capsys.readouterr().err


def test_names_of_figures_are_never_cut(capsys):
    assert main(["bench", "--standard", "no-load-torque", "--reducer", "RV20E-121"]) == 0
    assert "no_load_torque_largest" in capsys.readouterr().out


def test_a_dense_loop_is_read_in_its_play():
    """A line through what lies about no torque blurred the play: 0.11 instead of 0.5 arcmin."""
    torque = np.linspace(-100.0, 100.0, 8_001)
    rising = Way(torque, 1e-5 * torque + 0.5e-4 * np.tanh((torque - 0.5) / 0.1))
    assert rising.at(0.5) == pytest.approx(0.5e-5, abs=1e-7)
    assert rising.at(1.0) == pytest.approx(6e-5, rel=0.02)
    # Noise about a straight way is averaged.
    rng = np.random.default_rng(3)
    noisy = [Way(torque, 1e-5 * torque + 1e-5 * rng.standard_normal(len(torque))).at(20.0) for _ in range(50)]
    assert np.std(noisy) < 0.3e-5


def cut_loop(path, head, kept):
    """A loop of play 2 arcmin that begins at rest, of the samples whose torques [N m] are ``kept``; the test is that of 167 N m."""
    torque = 160.0 * np.interp(np.linspace(0.0, 5.0, 501), np.arange(6.0), [-1, 0, 1, 0, -1, 0])
    angle = torque / 50.0 + np.tanh(torque / 2.0) - 0.1 * np.sign(np.gradient(torque))
    rows = [f"{t:.5f};{a:.7f}".replace(".", ",") for t, a in zip(torque, angle) if kept(t)]
    path.write_text("\n".join([head, *rows]), encoding="utf-8")
    return ["bench", "--standard", "lost-motion", "--torque", "167", "--measured", str(path)]


@pytest.mark.parametrize("head", ["Drehmoment [Nm];Verdrehung [arcmin]", "couple (N.m);angle sortie (arcmin)", "输出扭矩(Nm);扭转角(角分)", "T_N.m;output_angle_arcmin"])
def test_heads_are_known_as_campaign_from_knows_them(tmp_path, head, capsys):
    """All but output_torque and output_angle had to be said by --column."""
    command = cut_loop(tmp_path / "loop.csv", head, lambda torque: True)
    assert main([*command, "--json"]) == 0
    found = {f["name"]: f["value"] for f in json.loads(capsys.readouterr().out)["figures"]}
    assert found["lost_motion"] == pytest.approx(2.0 * (5.01 / 50.0 + np.tanh(5.01 / 2.0)), rel=0.01) and found["backlash"] == pytest.approx(0.2, rel=0.1)


@pytest.mark.parametrize("head", ["Drehmoment;Verdrehung [arcmin]", "Drehmoment [Nm];Verdrehung"])
def test_a_head_without_a_unit_is_not_guessed(tmp_path, head, capsys):
    assert main(cut_loop(tmp_path / "loop.csv", head, lambda torque: True)) == 2
    assert "Say which column is what: --column output_torque=HEADER:UNIT" in capsys.readouterr().err


def test_nothing_is_read_across_samples_that_a_file_leaves_out(tmp_path, capsys):
    """A backlash was read by a line over the play, and a lost motion between 19 and -19 N m, without a word."""
    command = cut_loop(tmp_path / "loop.csv", "T [Nm];turn [arcmin]", lambda torque: abs(torque) > 4.0)
    assert main([*command, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [f["name"] for f in told["figures"]] == ["lost_motion"]
    assert [(u["name"], u["why"]) for u in told["unread"]] == [
        ("backlash", "with rising torque nothing between -4.8 and 4.8 N.m, with falling torque nothing between -4.8 and 4.8 N.m")
    ]
    assert main(command) == 0
    assert "backlash is not read: with rising torque nothing between" in " ".join(capsys.readouterr().out.split())
    assert main(cut_loop(tmp_path / "loop.csv", "T [Nm];turn [arcmin]", lambda torque: abs(torque) > 19.0)) == 2
    assert re.search(r"lost_motion is not read: with rising torque nothing between -19\.2 and 19\.2 N m", capsys.readouterr().err)
