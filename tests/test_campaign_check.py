"""The check says what a design lacks, and the commands show it."""

import argparse
import json
import shlex

import numpy as np
import pytest

from cli.commands import campaign as campaign_commands
from cli.show.campaign import show_pairs
from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.pairs import HOLDS_FOR, PAIRS
from discrepancy.campaign.pairs import Verdict as PairVerdict
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.campaign.template import write_template
from fmu_src.faults import InputFault


def campaign(folder, conditions: dict[str, str], runs: list[str], reducer="RV20E-121-rigid"):
    parts = [f'[campaign]\nname = "design"\nreducer = "{reducer}"\n']
    parts += [f"[conditions.{name}]\n{text}\n" for name, text in conditions.items()]
    parts += [f'[[runs]]\nid = "r{i}"\n{text}\n' for i, text in enumerate(runs)]
    (folder / "campaign.toml").write_text("\n".join(parts), encoding="utf-8")
    return check_campaign(load_campaign(folder))


def codes(check) -> set[str]:
    return {finding.code for finding in check.findings}


def status(check) -> dict[int, str]:
    return {verdict.pair.number: verdict.status for verdict in check.pairs}


def condition(speed=15, load=100, temperature=40, hours=0, **more) -> str:
    lines = [f'output_speed = "{speed} rpm"', f'load_torque = "{load} %"', f'temperature = "{temperature} degC"']
    lines += [f'hours = "{hours} h"', *(f"{key} = {json.dumps(value)}" for key, value in more.items())]
    return "\n".join(lines)


def angle_file(folder, name: str, turns: float, points: int) -> str:
    angle = np.linspace(0.0, 360.0 * turns, points)
    np.savetxt(folder / name, np.column_stack([angle, np.sin(angle)]), delimiter=",", header="phi,te", comments="")
    return (
        f'quantity = "transmission_error"\nfile = "{name}"\ncolumns.angle = {{ column = "phi", unit = "deg" }}\n'
        'columns.value = { column = "te", unit = "arcsec" }'
    )


def test_poor_design(tmp_path):
    run = angle_file(tmp_path, "short.csv", 0.6, 50)
    check = campaign(tmp_path, {"a": condition(direction="forward")}, [f'condition = "a"\n{run}'])
    # A diagnosis takes the noise from the scatter within the run, and is possible.
    assert not check.problems
    assert "scatter within runs, times 1.5" in next(f for f in check.findings if f.code == "noise guessed").text
    assert {
        "no held-out condition", "few levels of load", "one direction", "one mounting", "record too short",
        "sampling too coarse",
    } <= codes(check)  # fmt: skip
    load = next(f for f in check.findings if f.code == "few levels of load")
    assert "cubic stiffness and a backlash" in load.text
    short = next(f for f in check.findings if f.code == "record too short")
    assert "0.60 turns of the output" in short.text and "78 and 80" in short.text
    assert "separable" not in status(check).values()


def test_good_design_of_the_transmission_error(tmp_path):
    repeated = [angle_file(tmp_path, f"long{i}.csv", turns, 12_000) for i, turns in ((1, 3.0), (2, 3.001))]
    conditions = {
        f"{direction}{load}{mounting}": condition(15 if mounting == "1" else 10 + 5 * (load > 40), load, direction=direction, mounting=mounting, held_out=load == 70)
        for direction in ("forward", "reverse") for load in (10, 40, 70, 100, 150) for mounting in ("1", "2")
    } | {"moved": condition(direction="forward", hours=100, interventions=["ring_turned"])}  # fmt: skip
    runs = [f'condition = "{name}"\nreplicate = {i}\n{run}' for name in conditions for i, run in enumerate(repeated, 1)]
    check = campaign(tmp_path, conditions, runs)
    assert not check.findings
    found = status(check)
    assert {n for n, s in found.items() if s == "separable"} == {1, 6, 8, 9, 14, 15, 16, 18}
    assert {n for n, s in found.items() if s == "not separable"} == {12, 13}
    missing = next(verdict.missing for verdict in check.pairs if verdict.pair.number == 12)
    assert any("pins_exchanged" in text for text in missing)


def value(quantity: str, text: str, where="a", **tags) -> str:
    words = "\n".join(f'tags.{k} = "{v}"' for k, v in tags.items())
    return f'quantity = "{quantity}"\ncondition = "{where}"\nvalue = "{text}"\nnoise = "{text}"\n{words}'


def test_what_is_not_separable_is_said_to_be_so_while_it_is_small(capsys):
    """The loops of two loads that a diagnosis told apart stood as "not separable"; pairs of what nobody measured filled the screen."""
    show_pairs([PairVerdict(PAIRS[0], "separable"), PairVerdict(PAIRS[1], "not separable", ("hours",)), *(
        PairVerdict(pair, "not visible", ("no wear is measured",)) for pair in PAIRS[2:4]
    )])  # fmt: skip
    shown = " ".join(capsys.readouterr().out.split())
    assert "not separable while small" in shown and "hours" in shown
    assert f"separable: {' / '.join(PAIRS[0].effects)}" in shown
    assert shown.count("not visible") == shown.count("no wear is measured") == 1


def test_wear_over_hours_speeds_and_loads(tmp_path):
    conditions = {
        "a": condition(hours=100), "b": condition(hours=50, speed=30), "c": condition(hours=1000, load=50),
        "d": condition(hours=2000, interventions=["grease_changed"]),
    }  # fmt: skip
    wear = [value("wear_depth", "1 um", c, surface=s) for c in conditions for s in ("flank", "pin", "inner_race")]
    cage = [value("cage_speed", "5 rpm", c) for c in conditions]
    found = status(campaign(tmp_path, conditions, wear + cage))
    assert {n: found[n] for n in (2, 3, 10, 12)} == dict.fromkeys((2, 3, 10, 12), "separable")
    # Nothing in this campaign shows play or transmission error.
    assert found[1] == found[13] == "not visible"
    without_cage = status(campaign(tmp_path, conditions, wear))
    assert without_cage[10] == "not separable"


def test_friction(tmp_path):
    conditions = {f"s{s}": condition(speed=s, load=l) for s, l in ((5, 50), (15, 100), (30, 150))}
    runs = [value("input_torque", "1 N.m", c) for c in conditions]
    check = campaign(tmp_path, conditions, runs)
    assert status(check)[11] == "separable"
    assert {"coupled factors", "no replicates", "direction not stated"} <= codes(check)


def test_condition_that_the_model_cannot_predict(tmp_path):
    check = campaign(tmp_path, {"a": 'direction = "forward"\noutput_speed = "15 rpm"'}, [value("input_torque", "1 N.m")])
    assert [finding.code for finding in check.problems] == ["condition incomplete"]
    assert "[conditions.a]" in check.problems[0].remedy and "load_torque" in check.problems[0].remedy


def test_numbers_without_noise_are_a_problem_where_nothing_else_was_measured(tmp_path):
    """check said "no diagnosis is possible" of a campaign that diagnose answered; single numbers say nothing of their noise."""
    numbers = [value("lost_motion", "50 arcsec", "a").replace('noise = "', '# noise = "')]
    alone = campaign(tmp_path, {"a": condition(direction="forward")}, numbers)
    assert [finding.code for finding in alone.problems] == ["noise unknown"]
    series = f'condition = "a"\n{angle_file(tmp_path, "te.csv", 1.0, 5000)}'
    beside = campaign(tmp_path, {"a": condition(direction="forward")}, [*numbers, series])
    assert not beside.problems and {"noise unknown", "noise guessed"} <= codes(beside)


def test_a_run_without_rows_is_no_problem_beside_others(tmp_path):
    (tmp_path / "empty.csv").write_text("phi,te\n")
    run = angle_file(tmp_path, "te.csv", 1.0, 5000)
    check = campaign(tmp_path, {"a": condition(direction="forward")}, [f'condition = "a"\n{run}', f'condition = "a"\nreplicate = 2\n{run.replace("te.csv", "empty.csv")}'])
    assert not check.problems and "no rows" in codes(check)


@pytest.mark.parametrize("rows, code", [
    ("0,1\n1,2\n0.5,3\n", "time runs back"), ("0,1\n1,2\n2,3\n3,1\n90,3\n", "uneven sampling"), ("0,1\n1,\n2,3\n", "dropouts"),
])  # fmt: skip
def test_faults_of_a_record(tmp_path, rows, code):
    (tmp_path / "a.csv").write_text("t,T\n" + rows)
    run = (
        'condition = "a"\nquantity = "input_torque"\nfile = "a.csv"\ncolumns.time = { column = "t", unit = "s" }\n'
        'columns.value = { column = "T", unit = "N.m" }'
    )
    assert code in codes(campaign(tmp_path, {"a": condition()}, [run]))


def test_measured_speed_and_wrapped_encoder_and_slow_vibration(tmp_path):
    (tmp_path / "a.csv").write_text("t,phi,n,T\n0,0,15,1\n1,180,15.1,2\n2,359,15.2,1\n3,1,15,1\n")
    head = 'condition = "a"\nfile = "a.csv"\n'
    torque = (
        'quantity = "input_torque"\ncolumns.angle = { column = "phi", unit = "deg" }\n'
        'columns.value = { column = "T", unit = "N.m" }\ncolumns.output_speed = { column = "n", unit = "rpm" }'
    )
    vibration = (
        'quantity = "vibration"\ntags.location = "housing"\ncolumns.time = { column = "t", unit = "s" }\n'
        'columns.value = { column = "T", unit = "m/s^2" }'
    )
    check = campaign(tmp_path, {"a": condition()}, [head + torque, head + vibration])
    assert {"measured speed", "angle jumps", "sampling too coarse"} <= codes(check)


def test_all_pairs_name_real_quantities():
    assert [pair.number for pair in PAIRS] == list(range(1, len(PAIRS) + 1))
    assert all(set(pair.signals) <= QUANTITIES.keys() and pair.alternatives for pair in PAIRS)


@pytest.mark.parametrize("kind", ["csv", "parquet"])
@pytest.mark.parametrize("quantities", [("transmission_error", "hysteresis", "input_torque"), tuple(QUANTITIES)])
def test_template_loads_and_the_check_says_what_to_fill_in(tmp_path, kind, quantities):
    write_template(tmp_path / "new", quantities, kind)
    loaded = load_campaign(tmp_path / "new")
    assert loaded.quantities == quantities
    assert not loaded.records and len(loaded.unfilled) == 3 * len(quantities)
    assert {finding.code for finding in check_campaign(loaded).problems} == {"no rows"}


def test_template_filled_in(tmp_path):
    files = write_template(tmp_path, ("transmission_error",))
    for k, path in enumerate(files[1:]):
        with path.open("a") as file:
            file.writelines(f"{angle / 10},{angle % 7 + (angle + k) % 3 / 10}\n" for angle in range(11_000))
    check = check_campaign(load_campaign(tmp_path))
    assert not check.problems
    assert [record.name for record in check.campaign.held_out] == ["transmission_error_half_1"]


def command(*arguments: str) -> int:
    parser = argparse.ArgumentParser()
    campaign_commands.add_commands(parser.add_subparsers(dest="command", required=True))
    options = parser.parse_args(["campaign", *arguments])
    return options.run(options)


def test_commands(tmp_path, capsys):
    folder = str(tmp_path / "new")
    assert command("template", folder, "--quantities", "hysteresis", "--json") == 0
    assert len(json.loads(capsys.readouterr().out)["files"]) == 4
    assert command("check", folder) == 1
    shown = capsys.readouterr().out
    assert "holds no complete row" in shown and "needle clearance / raceway wear" in shown
    # A diagnosis may separate what the conditions alone do not.
    assert "for effects just above the noise" in " ".join(shown.split())
    for k, path in enumerate((tmp_path / "new").glob("*.csv")):
        path.write_text("torque [N.m],value [arcmin]\n" + "".join(f"{t},{t / 50 + (t + k) % 3 / 100}\n" for t in range(-167, 168)))
    assert command("check", folder, "--json") == 0
    report = json.loads(capsys.readouterr().out)
    assert report["problems"] == [] and len(report["pairs"]) == len(PAIRS)
    assert report["pairs"][3]["status"] == "separable" and report["pairs_hold_for"] == HOLDS_FOR
    # Where the files lie elsewhere, the command that goes on says so, too.
    elsewhere = tmp_path / "my files"
    elsewhere.mkdir()
    for path in (tmp_path / "new").glob("*.csv"):
        path.rename(elsewhere / path.name)
    assert command("check", folder, "--data", str(elsewhere)) == 0
    assert capsys.readouterr().out.endswith(f"next  {shlex.join(['rvwear', 'compare', 'RV20E-121', folder, '--data', str(elsewhere)])}\n")
    with pytest.raises(InputFault, match="exists already; .* nothing is overwritten"):
        command("template", folder)
    with pytest.raises(InputFault, match="--quantities noise: not a quantity"):
        command("template", str(tmp_path / "other"), "--quantities", "noise")
    with pytest.raises(InputFault, match="--format xls: choose one of csv, parquet"):
        command("template", str(tmp_path / "other"), "--format", "xls")


def lagging(folder, more: str, keys: str = ""):
    """A transmission error of 1 arcsec about a lag of 30."""
    run = angle_file(folder, "te.csv", 1.0, 100)
    table = np.loadtxt(folder / "te.csv", delimiter=",", skiprows=1)
    np.savetxt(folder / "te.csv", table - [0.0, 30.0], delimiter=",", header="phi,te", comments="")
    return campaign(folder, {"a": condition() + more}, [f'condition = "a"\n{keys}{run}'])


def test_means_that_are_not_used_are_said_with_their_size(tmp_path):
    check = lagging(tmp_path, "")
    found = next(f for f in check.findings if f.code == "means not used")
    assert "a mean of -30" in found.text and "arcsec" in found.text and 'zero = "absolute" in [quantities.transmission_error]' in found.remedy
    assert check.campaign.records[0].free_zero


@pytest.mark.parametrize(("more", "keys"), [('\n[quantities.transmission_error]\nzero = "absolute"', ""), ("", 'zero = "absolute"\n')])
def test_a_zero_that_is_known_makes_the_mean_count(tmp_path, more, keys):
    check = lagging(tmp_path, more, keys)
    assert "means not used" not in codes(check) and not check.campaign.records[0].free_zero


def test_only_what_has_a_zero_may_declare_it(tmp_path):
    with pytest.raises(InputFault, match=r"runs\[1\] \(r0\)\.zero = 'absolute': input_torque has no zero"):
        campaign(tmp_path, {"a": condition()}, [value("input_torque", "1 N.m") + '\nzero = "absolute"'])
    with pytest.raises(InputFault, match="input_torque.*no zero to declare"):
        campaign(tmp_path, {"a": condition() + '\n[quantities.input_torque]\nzero = "free"'}, [value("input_torque", "1 N.m")])


def test_repetition_that_stands_out_is_named_with_file_and_size(tmp_path):
    runs = []
    for k, span in enumerate((14, 18, 111, 23, 16)):
        torque = np.concatenate([np.linspace(-100, 100, 60), np.linspace(100, -100, 60)])
        np.savetxt(tmp_path / f"r{k}.csv", np.column_stack([torque, span * torque / 200.0]), delimiter=",", header="T,phi", comments="")
        runs.append(
            f'quantity = "hysteresis"\ncondition = "a"\nreplicate = {k + 1}\ntags.locked = "output"\nfile = "r{k}.csv"\n'
            'columns.torque = { column = "T", unit = "N.m" }\ncolumns.value = { column = "phi", unit = "arcmin" }'
        )
    (found,) = [f for f in campaign(tmp_path, {"a": condition()}, runs).findings if f.code == "outlying repetition"]
    assert "run r2 (replicate 3, of 5" in found.text and "spans 111 arcmin, the others 14 to 23" in found.text and "r2.csv, column phi [arcmin]" in found.text


def test_each_quantity_of_which_nothing_is_held_out_is_said(tmp_path):
    conditions = {f"t{t}": condition(temperature=t, held_out=t == 30) for t in (20, 30, 40)} | {f"s{s}": condition(speed=s) for s in (5, 10, 15)}
    runs = [value("input_torque", "1 N.m", name) for name in conditions if name[0] == "t"] + [value("efficiency", "60 %", name) for name in conditions if name[0] == "s"]
    two = [value("torsional_stiffness", "50 N.m/arcmin", name) for name in ("s5", "s10")]
    (said,) = [f for f in campaign(tmp_path, conditions, runs + two).findings if f.code == "no held-out condition"]
    assert said.text == "efficiency: none of its 3 conditions is held out: an effect that shows in efficiency alone cannot be proven"
    conditions["s10"] += "\nheld_out = true"
    assert "no held-out condition" not in codes(campaign(tmp_path, conditions, runs + two))


def test_sample_far_off_is_named_with_run_file_place_and_size(tmp_path):
    rng = np.random.default_rng(1)
    angle = np.arange(0.0, 3600.0, 6.0)
    runs = []
    for k in range(2):
        error = 4.0 * np.sin(np.radians(2 * angle)) + 0.4 * rng.standard_normal(len(angle))
        error[250] += 180.0 * k
        np.savetxt(tmp_path / f"r{k}.csv", np.column_stack([angle, error]), delimiter=",", header="phi,e", comments="", fmt="%.3f")
        runs.append(
            f'quantity = "transmission_error"\ncondition = "a"\nreplicate = {k + 1}\nfile = "r{k}.csv"\n'
            'columns.input_angle = { column = "phi", unit = "deg" }\ncolumns.value = { column = "e", unit = "arcsec" }'
        )
    (found,) = [f for f in campaign(tmp_path, {"a": condition()}, runs).findings if f.code == "outlying samples"]
    assert found.text.startswith("run r1 (r1.csv, column e [arcsec]): 1 of 600 samples stands ") and "times the noise off its neighbours" in found.text
    # At the angle as the file counts it, which is the input's.
    assert found.text.endswith(" arcsec at 1500 deg (sample 251)") and "left out of fit, errors, key figures and axes of charts" in found.remedy


@pytest.mark.parametrize(("reach", "told"), [(1.0, None), (0.6, "there are 5")])
def test_torques_that_the_loops_have_are_not_asked_for(tmp_path, reach, told):
    """Loops to all of the rated torque were asked for torques to all of it: of levels near each other the lowest stood for the end."""
    torque = reach * 167.0 * np.concatenate([[1.0, 0.985, 0.5, 0.3, 0.2, 0.05], -np.array([0.05, 0.5, 1.0])])
    np.savetxt(tmp_path / "loop.csv", np.column_stack([torque, torque]), delimiter=",", header="t,y", comments="")
    run = ('condition = "a"\nquantity = "hysteresis"\ntags.locked = "input"\nfile = "loop.csv"\ncolumns.torque = { column = "t", unit = "N.m" }\n'
           'columns.value = { column = "y", unit = "arcsec" }')  # fmt: skip
    check = campaign(tmp_path, {"a": 'direction = "forward"\n'}, [run])
    found = next(verdict for verdict in check.pairs if verdict.pair.number == 7)
    if told is None:
        assert found.status == "separable"
    else:
        # What there is stands beside what is asked for.
        assert found.status == "not separable" and told in found.missing[0] and "60 % of the rated" in found.missing[0]
