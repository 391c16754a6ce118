"""Reducers delivered worn: units start with what a life left, in every flavour, and go on as that life would."""

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import InputFault, RunFault
from fmu_src.package import build_fmu, build_native
from fmu_src.start_arrays import decode, encode
from orchestrator.component import InProcess
from orchestrator.fmu import Fmu
from studies.coupled_master import CoupledMaster
from studies.life import Life, LifeSettings, live
from studies.pair import make_pair
from studies.wear_figures import wear_figures
from studies.worn import hours_of, worn_reducer

HOURS = 5000.0


@pytest.fixture(scope="module")
def worn(rv20e):
    return worn_reducer(rv20e, HOURS)


@pytest.fixture(scope="module")
def life(rv20e):
    """The pair after its life."""
    pair = make_pair(rv20e, master_kind=CoupledMaster)
    live(pair, Life(LifeSettings(HOURS)), lambda life: None, lambda life: None)
    return pair


def started(specification):
    unit = InProcess("unit", specification)
    unit.exit_initialisation()
    return unit


def test_arrays_travel_as_text():
    values = np.random.default_rng(1).normal(size=(3, 5))
    assert np.array_equal(decode(encode(values), (3, 5)), values)
    assert decode(encode(7.5), ()) == 7.5
    for text, shape in (("!", (1,)), (encode(values), (4, 5))):
        with pytest.raises(ValueError, match="start values of an array of shape"):
            decode(text, shape)


def test_surfaces_are_those_of_the_life(worn, life):
    unit, lived = started(worn.specification("wear_fmu")), life.wear.record()
    for name in ("disc_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear"):
        assert np.abs(unit.records[name] - lived[name]).max() < 1e-12
    ours, theirs = wear_figures(unit.records), wear_figures(lived)
    for name in ("disc_flank_um", "pin_um", "inner_raceway_um", "outer_raceway_um"):
        assert ours[name] == pytest.approx(theirs[name], rel=1e-6) and ours[name] > 0.5
    assert unit.number("operating_time") == HOURS * 3600.0


def mean_lag(step, lag, steps):
    total = 0.0
    for n in range(steps):
        step(n)
        total += lag() / steps
    return total


def test_it_goes_on_as_the_life_would(worn, life, rv20e):
    """Mean lag of a full meshing cycle and depths after it are those of the pair that has lived, as a pair and as one unit."""
    lived, size, steps = life.master.save(), life.master.step_size, 72 * worn.topology.lobes
    life.wear.set("acceleration", 1.0)
    pair, both, new = make_pair(worn), started(worn.specification("rv_reducer")), make_pair(rv20e)
    as_pair = mean_lag(lambda n: pair.master.run(1), lambda: pair.plant.number("lag"), steps)
    as_one = mean_lag(lambda n: both.step(n * size, size), lambda: both.number("lag"), steps)
    theirs = mean_lag(lambda n: life.master.run(1), lambda: life.plant.number("lag"), steps)
    assert as_pair == pytest.approx(theirs, rel=5e-3) and as_one == pytest.approx(theirs, rel=5e-3)
    assert theirs > 1.4 * mean_lag(lambda n: new.master.run(1), lambda: new.plant.number("lag"), 72)
    depth = life.wear.get("flank_depth").max()
    assert pair.wear.get("flank_depth").max() == pytest.approx(depth, rel=1e-6)
    assert both.number("worst_flank_depth") == pytest.approx(depth, rel=1e-6)
    life.master.restore(lived)


def test_unit_of_both_meets_its_worn_surfaces_at_once(worn, rv20e):
    new, old = started(rv20e.specification("rv_reducer")), started(worn.specification("rv_reducer"))
    assert old.number("lag") > 1.5 * new.number("lag")
    assert old.number("lost_motion") > 1.5 * new.number("lost_motion")
    assert old.records["new_lost_motion"][0] == new.number("lost_motion")
    assert old.number("worst_flank_depth") == pytest.approx(4.03e-6, rel=0.01)
    # Two turns: life is judged by the last one, not by all the hours before.
    for n in range(144):
        old.step(n * 1.3e-3, 1.3e-3)
    assert 1000.0 < old.number("remaining_life") / 3600.0 < 100_000.0


def test_every_flavour_starts_worn(worn, tmp_path):
    specification = worn.specification("wear_fmu")
    inside = started(specification)
    paths = [build_fmu("RvWear", specification, 1e-3, "rvwear test", tmp_path), *build_native("RvWear", specification, 1e-3, "rvwear test", tmp_path)]
    for path in paths:
        unit = Fmu("wear", path)
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        for name in ("flank_depth", "mesh_profile_error", "roller_profile_slope", "operating_time"):
            assert np.array_equal(unit.get(name), inside.get(name)) and np.any(unit.get(name))
        assert "delivered as after 5000 hours" in unit.description.description
        unit.close()


def test_what_begins_new_refuses_worn_units(worn, rv20e, tmp_path):
    for name, unit in (("RvPlant", "rv_plant"), ("RvWear", "wear_fmu")):
        build_native(name, worn.specification(unit), 1e-3, "rvwear test", tmp_path, ("3",))
    with pytest.raises(InputFault, match=r"RvWear.fmu is of a reducer that is delivered worn, after 5000 h.*rvwear build --reducer RV20E-121"):
        make_pair(rv20e, fmus=tmp_path / "fmi3")


@pytest.mark.parametrize("text, hours", [("5000h", 5000.0), ("200 days", 4800.0), ("1800", 1800.0), ("7.2e6 s", 2000.0)])
def test_hours_have_units(text, hours):
    assert hours_of(text) == pytest.approx(hours)


@pytest.mark.parametrize("text, said", [
    ("-5h", r"worn = '-5h': operating hours between 0 and 876600 h are needed; a new reducer needs no --worn"),
    ("0h", "operating hours between 0"), ("nan", "operating hours between 0"), ("inf h", "operating hours between 0"), ("1e9 h", "operating hours between 0"),
    ("5000km", "'km' is no unit of time; operating hours are meant: 5000h"), ("long", "a time is needed, with its unit: 5000h"), ("", "a time is needed"),
])
def test_no_such_time_is_told(text, said, tmp_path, capsys):
    with pytest.raises(InputFault, match=said):
        hours_of(text)
    assert main(["build", f"--worn={text}", "--output", str(tmp_path)]) == 2
    assert "worn = " in capsys.readouterr().err and not list(tmp_path.iterdir())


def test_life_that_is_not_lived_is_told(rv20e, monkeypatch):
    def worn_out(*arguments):
        raise RunFault("RvPlant at time 3 s: no equilibrium")

    monkeypatch.setattr("studies.worn.live", worn_out)
    with pytest.raises(InputFault, match="worn = 80000 h: RV20E-121-rigid does not live as long at its rated speed and torque: RvPlant at time 3 s"):
        worn_reducer(rv20e, 80_000.0)
