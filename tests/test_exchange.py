"""What plant and wear unit exchange does not depend on the communication step: orders, balance, schemes, coarse signals."""

import numpy as np
import pytest
from stand import GIVEN, SHARED, crank_period, exchange, only, pair_of, records_of

from orchestrator.component import InProcess
from orchestrator.master import Master, StepControl
from orchestrator.opening import open_fmu
from rv_plant import plant
from studies.pair import CONNECTIONS, crank_turn_time
from wear_fmu import accumulator

VOLUMES = ("flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume")
CONSTANT = {"mesh_wear_law": 0, "raceway_wear_law": 0}
SCHEMES = ("gauss-seidel", "jacobi")
FIVE_DEGREES = np.radians(5.0)


def wired(reducer, step, acceleration=1.0, largest_crank_step=FIVE_DEGREES, **options):
    """The pair by a list of connections alone, as somebody does it by hand."""
    units = {"plant": InProcess("plant", reducer.specification("rv_plant")), "wear": InProcess("wear", reducer.specification("wear_fmu"))}
    units["wear"].set("acceleration", acceleration)
    units["plant"].set("largest_crank_step", largest_crank_step)
    master = Master(units, CONNECTIONS, step, **options)
    master.initialise()
    return master


def volumes(master):
    return np.array([master.components["wear"].number(name) for name in VOLUMES])


def given(master):
    """All that is exchanged, and how large each array may be."""
    master.fetched = [np.array(master.components[s.partition(".")[0]].get(s.partition(".")[2])).ravel() for s, _ in CONNECTIONS]
    return master.fetched


@pytest.fixture(scope="module")
def turn_time(rv20e):
    return crank_turn_time(rv20e, InProcess("plant", rv20e.specification("rv_plant")))


# Orders


@pytest.mark.parametrize("acceleration", [1.0, 1e6])
def test_one_step_and_two_halves_differ_by_the_cube_of_the_step(rv20e, turn_time, acceleration):
    """Local errors of a second-order exchange; means over the step differed in proportion to it."""
    differences = []
    for positions in (36, 72, 144, 288):
        # One equilibrium a step, or the plant would make two halves of one.
        master = wired(rv20e, turn_time / 72, acceleration, largest_crank_step=1.0)
        master.run(72)
        step = turn_time / positions
        kept, ends = master.snapshot(), []
        for halves in (1, 2):
            for k in range(halves):
                master.advance(master.time + k * step / halves, step / halves)
            ends.append(given(master))
            master.revert(kept)
        size = {"rad": 2 * np.pi, "rad/s": 70.0, "N.rad": 2000.0, "K": 300.0, "m": 1e-6, "m/rad": 1e-4}
        units = [master.components[s.partition(".")[0]].signal(s.partition(".")[2]).unit for s, _ in CONNECTIONS]
        differences.append(max(np.abs(a - b).max() / size[u] for a, b, u in zip(*ends, units)))
    # Contacts begin and end within steps: single ones are off the order, none is of the first.
    assert np.log(differences[0] / differences[-1]) / np.log(8) > 1.8


@pytest.mark.parametrize("scheme, order", [("gauss-seidel", 1.6), ("jacobi", 0.9)])
def test_fixed_steps_converge_with_the_order_of_their_scheme(rv20e, scheme, order):
    """Jacobi's wear unit sees everything one step later, which is of first order and does not add up."""
    ends = {}
    for steps in (80, 320, 5120):
        master = wired(rv20e, 0.1 / steps, scheme=scheme)
        master.run(steps)
        ends[steps] = volumes(master)
    coarse, fine = (np.abs(ends[n] / ends[5120] - 1).max() for n in (80, 320))
    assert np.log(coarse / fine) / np.log(4) > order


def test_controlled_steps_are_few_and_their_error_falls_with_the_tolerance(rv20e, turn_time):
    """0.2 s of the pair, base steps as the package suggests; fixed steps of the same error are the measure."""
    steps = round(0.2 / (turn_time / 72))
    ends, accepted = {}, {}
    for count in (160, 320, 640, 5120):
        master = wired(rv20e, steps * turn_time / 72 / count)
        master.run(count)
        ends[count] = volumes(master)
    error = {n: np.abs(ends[n] / ends[5120] - 1).max() for n in (160, 320, 640)}
    for tolerance in (1e-2, 1e-4):
        master = wired(rv20e, turn_time / 72, step_control=StepControl(tolerance))
        master.run(steps)
        accepted[tolerance] = master.controller.accepted
        ends[tolerance] = np.abs(volumes(master) / ends[5120] - 1).max()
        # Fixed steps are of second order: so many have the error of the controlled ones.
        equal = 320 * np.sqrt(error[320] / ends[tolerance])
        assert accepted[tolerance] < 3.0 * equal
        assert master.controller.accepted + master.controller.rejected < 1500
    assert ends[1e-4] < 0.5 * ends[1e-2] < 1e-3


def test_controlled_jacobi_steps_do_not_collapse(rv20e, turn_time):
    master = wired(rv20e, turn_time / 72, scheme="jacobi", step_control=StepControl(1e-3))
    master.run(36)
    assert master.controller.accepted + master.controller.rejected < 2000


@pytest.fixture(scope="module")
def recorded(rv20e, turn_time):
    """The plant's record at 2304 positions of a crank turn and a half."""
    records, series = records_of(rv20e.plant), []
    assert plant.initialise(records) == 0
    series.append(only(records).copy())
    for _ in range(2304):
        assert plant.step(records, 0.0, 1.5 * turn_time / 2304) == 0
        series.append(only(records).copy())
    return series


def fed(reducer, recorded, stride, names, **values):
    records = records_of(reducer.wear, **values)
    exchange(recorded[0], records, names)
    assert accumulator.initialise(records) == 0
    for row in recorded[stride::stride]:
        exchange(row, records, names)
        assert accumulator.step(records, 0.0, stride * 1e-5) == 0
    return only(records)


@pytest.mark.parametrize("names", [GIVEN, SHARED], ids=["running totals", "forces at the communication points"])
def test_the_wear_unit_alone_is_of_second_order_in_a_recorded_signal(rv20e, recorded, names):
    runs = {stride: fed(rv20e, recorded, stride, names) for stride in (1, 16, 64)}
    for name in VOLUMES:
        fine, coarse = (abs(runs[stride][name] / runs[1][name] - 1) for stride in (16, 64))
        assert coarse < 0.01 and np.log(coarse / fine) / np.log(4) > 1.6, name


def test_what_a_coarse_signal_leaves_open_is_counted(rv20e, recorded):
    totals, values = (fed(rv20e, recorded, 576, names, **CONSTANT) for names in (GIVEN, SHARED))
    fine = fed(rv20e, recorded, 1, GIVEN, **CONSTANT)
    assert (fine.coarse_steps, totals.coarse_steps, values.coarse_steps) == (0, 4, 4)
    # Two thirds of a turn between two points: the totals still have all that was pressed, the forces have not.
    assert totals.inner_race_volume == pytest.approx(fine.inner_race_volume, rel=1e-4)
    assert abs(values.inner_race_volume / fine.inner_race_volume - 1) > 1e-3
    assert totals.crank_travel == pytest.approx(fine.crank_travel, rel=1e-12)


def test_a_coarse_signal_is_warned_of_once(rv20e, turn_time):
    master = wired(rv20e, turn_time / 4)
    master.run(8)
    (text,) = (warning for warning in master.warnings if "coarse_steps" in warning)
    assert text.startswith("wear: between two communication points the cranks turned by more than 20 degrees")
    assert master.components["wear"].get("coarse_steps") == 8
    fine = wired(rv20e, turn_time / 72)
    fine.run(8)
    assert fine.warnings == []


@pytest.mark.parametrize("version", ["fmi2", "fmi3"])
def test_a_coarse_signal_is_said_once_in_the_log(native_fmus, version):
    unit = open_fmu("wear", native_fmus / version / "RvWear.fmu")
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    unit.set("mesh_force", 300.0)
    for i in range(3):
        unit.set("crank_angle", float(i + 1))
        unit.step(0.1 * i, 0.1)
    assert unit.get("coarse_steps") == 3
    assert sum("20 degrees" in message for message in unit.messages) == 1
    assert unit.cautions() != []
    unit.close()


def test_there_and_back_within_a_step_wears_what_was_pressed(rv20e):
    """The cranks end where they began: only the totals tell that they moved."""
    records = records_of(rv20e.wear, **CONSTANT)
    assert accumulator.initialise(records) == 0
    r = only(records)
    r.crank_path, r.roller_force_path = 0.4, 0.4 * 500.0
    assert accumulator.step(records, 0.0, 1.0) == 0
    r = only(records)
    rolled = 0.4 * (1 + 1 / 39) * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius) * r.outer_race_radius
    expected = 2 * 2 * 16 * r.raceway_wear_coefficient / r.hardness * 500.0 * r.slip_ratio_outer * rolled
    assert r.outer_race_volume == pytest.approx(expected, rel=1e-12)
    assert r.coarse_steps == 1 and r.crank_travel == 0.4


# Balance


@pytest.mark.parametrize("late", [False, True], ids=SCHEMES)
def test_what_the_plant_pressed_and_slid_is_what_the_wear_unit_removed(rv20e, late):
    """Over steps of any length, forward, at rest and backward; volumes by Archard's law from the totals alone."""
    machine, surface = pair_of(rv20e, **CONSTANT)
    assert plant.initialise(machine) == 0
    exchange(machine, surface, GIVEN)
    assert accumulator.initialise(surface) == 0
    w, before, removed, pressed = only(surface), only(machine).copy(), 0.0, 0.0
    speed = float(machine["input_speed"][0])
    for i, (duration, sense) in enumerate([(1e-3, 1), (1e-5, 1), (2e-2, 1), (3e-3, 0), (5e-3, -1), (7e-4, -1), (1e-1, 1)]):
        machine["input_speed"] = sense * speed
        seen = machine.copy() if late else machine
        assert plant.step(machine, 0.0, duration) == 0
        exchange(seen, surface, GIVEN)
        assert accumulator.step(surface, 0.0, duration) == 0, i
        p = only(seen)
        path = p.crank_path - before.crank_path
        if path > 0.0:
            force = (p.mesh_force_path - before.mesh_force_path) / path
            pressed = pressed + force * path
            removed += (force * slid(w, before.crank_angle, p.crank_angle)).sum() * w.mesh_wear_coefficient / w.hardness
        before = p.copy()
    w = only(surface)
    assert pressed == pytest.approx(before.mesh_force_path, rel=1e-12, abs=1e-9)
    assert w.flank_volume == pytest.approx(removed, rel=1e-11)
    assert w.crank_travel == pytest.approx(before.crank_path, rel=1e-12)


def slid(r, start, end):
    """Sliding length of every contact between two crank angles [m], by the unit's table."""
    bins = r.arc.shape[0]
    whole = np.concatenate([[0.0], np.cumsum(r.slide)])

    def to(angle):
        disc, pin = np.arange(r.mesh_force.shape[0])[:, None], np.arange(r.mesh_force.shape[1])[None, :]
        place = ((len(pin[0]) - 1) * pin / len(pin[0]) + angle / (2 * np.pi) + disc / r.mesh_force.shape[0]) * bins
        return np.floor(place / bins) * whole[-1] + np.interp(place % bins, np.arange(bins + 1), whole)

    return np.abs(to(end) - to(start))


# Schemes


def test_a_pair_wired_by_hand_has_the_same_profile_errors_in_either_scheme(rv20e, turn_time):
    """Fresh wear, counted a million times; each unit's place in the list does not matter either."""
    masters = [wired(rv20e, turn_time / 72, 1e6, scheme=scheme) for scheme in SCHEMES]
    for _ in range(3):
        for master in masters:
            master.run(72)
        one, other = (master.components["wear"] for master in masters)
        assert one.get("profile_angle") == pytest.approx(other.get("profile_angle"), abs=2e-4)
        for name in ("mesh_profile_error", "roller_profile_error"):
            assert np.abs(one.get(name) - other.get(name)).max() < 0.01 * one.get(name).max()
    assert [m.components["wear"].records["lateness"][0] for m in masters] == [accumulator.ON_TIME, accumulator.LATE]
    assert crank_period(masters[0].components["plant"].records) > 0.0
