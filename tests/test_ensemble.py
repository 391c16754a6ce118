"""Ensembles: the file, the lives, what is kept, distributions and sensitivities."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from stand import BACK, exchange

pytest.importorskip("SALib")

from cli.main import main
from exports.plain import plain
from fmu_src.faults import InputFault
from orchestrator.settings import parse_setting
from studies.coupled_master import CoupledMaster
from studies.duty import Segment
from studies.ensemble.ensemble_file import load_ensemble
from studies.ensemble.member import run, stiffness_figures
from studies.ensemble.sampling import independent_rows, points, tasks_of, values_of
from studies.ensemble.store import Store, content_of
from studies.ensemble.summary import censored, life_hours, sensitivity, share_beyond, summarise
from studies.held_input import lost_motion
from studies.meshing_cycle import count_cycle
from studies.pair import make_pair

TEXT = """
reducer = "RV20E-121-rigid"
samples = 2
hours = 60
tolerance = 0.1
[parameters]
bearing_clearance = { distribution = "uniform", low = 2, high = 6, unit = "um" }
pin_radius_error = { distribution = "normal", mean = 0, deviation = 0.5, unit = "um" }
[limits]
lost_motion_arcmin = 1.0
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(TEXT)
    return path


def test_compiled_steps_are_those_of_the_master(rv20e):
    pairs = [make_pair(rv20e), make_pair(rv20e, master_kind=CoupledMaster)]
    for pair in pairs:
        count_cycle(pair, 300.0)
        pair.set_operation(-100.0, 50.0)
        pair.master.run(30)
    # The master hands profile errors over when the next step begins, the compiled loop when one ends.
    exchange(pairs[0].wear.records, pairs[0].plant.records, BACK)
    assert pairs[0].master.save() == pairs[1].master.save()


def test_numbers_have_their_units_and_arrays_scatter_cell_by_cell(file):
    ensemble = load_ensemble(file)
    rows = points(ensemble)
    assert rows.shape == (8, 41) and independent_rows(ensemble).tolist() == [0, 3, 4, 7]
    values = values_of(ensemble, np.full(41, 0.5))
    assert values["bearing_clearance"] == pytest.approx(4e-6)
    assert values["pin_radius_error"] == pytest.approx(40 * [0.0])
    assert len(set(values_of(ensemble, rows[0])["pin_radius_error"])) == 40
    assert (points(ensemble) == rows).all()
    # Row 1 is row 0 with the first parameter's column from row 3.
    assert rows[1, 0] == rows[3, 0] and (rows[1, 1:] == rows[0, 1:]).all()


@pytest.mark.parametrize("change, words", [
    (("uniform", "normal"), "takes mean, deviation"), (("bearing_clearance", "bearing_clearence"), "did you mean"),
    (('unit = "um"', 'unit = "N"'), "unit"), (("low = 2", "low = 7"), "low < high"), (("low = 2", "low = nan"), r"parameters.bearing_clearance.low = nan: it should be a finite number"),
    (("hours = 60", "hours = inf"), "hours = inf: it should be a finite number"), (("samples = 2", "samples = 3"), "power of two"),
    (("lost_motion_arcmin", "lost_motion"), "no such figure"), (("bearing_clearance", "duty_torque_factor"), "no duty"),
])
def test_slips_in_the_file_are_told(file, change, words):
    file.write_text(TEXT.replace(*change, 1))
    with pytest.raises(InputFault, match=words):
        load_ensemble(file)


def test_wider_clearance_gives_more_lost_motion(file):
    ensemble = load_ensemble(file)
    task = tasks_of(ensemble)[0]
    found = [run(task.__class__(0, task.reducer, (), (), 100.0, 0.1, {"bearing_clearance": c})) for c in (2e-6, 6e-6)]
    tight, wide = (life["figures"]["lost_motion_arcmin"][-1] for life in found)
    assert wide > tight + 0.5 and found[0]["hours"][-1] == pytest.approx(100.0)


def test_lost_motion_of_a_new_reducer_is_that_of_its_life(rv20e):
    """It was 0.18 arcmin where a life told 0.91: between two torques in one step what friction held counted as no turning."""
    pair = make_pair(rv20e)
    assert stiffness_figures(pair)["lost_motion_arcmin"] == pytest.approx(lost_motion(pair), rel=0.05)
    # In motion, too: with the input held nothing moves.
    moving = make_pair(rv20e, [parse_setting("fidelity=dynamic", (rv20e.plant, rv20e.wear))])
    assert stiffness_figures(moving)["lost_motion_arcmin"] == pytest.approx(lost_motion(pair), rel=0.05)


def test_a_duty_scatters_by_factors(rv20e, file):
    task = tasks_of(load_ensemble(file))[0]
    duty = (Segment(209.0, 100.0, 0.5), Segment(-209.0, -100.0, 0.5))
    made = [run(task.__class__(0, rv20e, (), duty, 50.0, 0.3, {"duty_torque_factor": f})) for f in (0.5, 1.5)]
    light, heavy = (life["figures"]["inner_raceway_um"][-1] for life in made)
    assert heavy > 2.0 * light


def test_an_impossible_reducer_is_a_failed_life_not_a_failed_run(rv20e, file):
    task = tasks_of(load_ensemble(file))[0]
    assert "makes loops of the profile" in run(task.__class__(3, rv20e, (), (), 100.0, 0.1, {"eccentricity": 1.4e-3}))["fault"]


def test_a_life_is_kept_once_and_a_torn_line_is_done_again(tmp_path):
    path = tmp_path / "x.lives"
    store = Store(path, {"a": (1, 2)})
    one, other = ({"number": 0, "fault": text} for text in ("a", "b"))
    assert store.add(one) and not store.add(other)
    with path.open("a") as file:
        file.write('{"number": 1, "v')
    again = Store(path, {"a": [1, 2]})
    assert again.lives == {0: one} and again.add({"number": 1, "fault": "c"})
    assert sorted(Store(path, {"a": [1, 2]}).lives) == [0, 1]
    with pytest.raises(InputFault, match="another ensemble"):
        Store(path, {"a": [1, 3]})


def test_life_ends_at_the_first_limit():
    life = {"hours": [0.0, 100.0, 200.0], "figures": {"a": [0.0, 1.0, 3.0], "b": [0.0, 0.1, 0.2]}}
    assert life_hours(life, {"a": 2.0, "b": 5.0}) == pytest.approx(150.0)
    assert life_hours(life, {"a": 2.0, "b": 0.05}) == pytest.approx(50.0)
    assert life_hours(life, {"b": 5.0}) == np.inf
    spans = censored([50.0, 150.0, np.inf, np.inf, np.inf], 200.0, 1)
    assert spans["q05"]["value"] == 50.0 and spans["q95"]["value"] is None
    assert share_beyond([False] * 10)["high"] > 0.2


def test_sensitivities_are_those_of_a_known_function(file):
    """y = 3 a + mean of b (41 columns): Sobol' indices are the shares of the variance."""
    file.write_text(TEXT.replace("samples = 2", "samples = 1024"))
    ensemble = load_ensemble(file)
    rows = points(ensemble)
    y = 3.0 * rows[:, 0] + np.sqrt(40.0) * rows[:, 1:].mean(axis=1)
    found = sensitivity(ensemble, y.tolist())
    assert list(found) == ["bearing_clearance", "pin_radius_error"]
    assert found["bearing_clearance"]["total"] == pytest.approx(0.9, abs=0.03)
    assert found["pin_radius_error"]["alone"] == pytest.approx(0.1, abs=0.03)


def test_command_goes_on_where_it_was_interrupted(file, tmp_path, capsys):
    """Ctrl-C after the first lives; the same command does the rest in processes, and each life is what it is alone."""
    output = tmp_path / "found.json"
    command = [sys.executable, "-m", "cli", "ensemble", str(file), "--jobs", "1"]
    started = subprocess.Popen([*command, "--output", str(output)], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    lives = output.with_suffix(".lives")
    while started.poll() is None and (not lives.exists() or lives.read_text().count("\n") < 2):
        time.sleep(0.02)
    os.kill(started.pid, signal.SIGINT)
    assert started.wait() in (0, 130)
    before = lives.read_text()
    assert main(["ensemble", str(file), "--jobs", "2", "--output", str(output), "--json"]) == 0
    said = capsys.readouterr()
    found = json.loads(said.out)
    assert lives.read_text().startswith(before) and "are there already" in said.err
    assert found["lives_done"] == 8 and found["lives_in_distributions"] == 4
    assert found["sensitivity"]["lost_motion_arcmin"]
    drawn = load_ensemble(file)
    kept = {life["number"]: life for life in map(content_of, lives.read_text().splitlines()) if "number" in life}
    some = tasks_of(drawn)[:4]
    assert [kept[task.number] for task in some] == [run(task) for task in some]
    assert plain(summarise(drawn, kept, 8)) == {k: v for k, v in found.items() if k not in ("lives", "scatters", "bands")}


@pytest.mark.cluster
def test_lives_survive_workers_that_are_killed():
    from benchmarks.many import killed_workers

    found = killed_workers(samples=4, kills=2)
    assert found.killed == 2 and found.lost == 0 and found.twice == 0 and found.different == 0
