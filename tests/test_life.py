"""A life in jumps: error control, resumption, and independence of how the hours are cut."""

from types import SimpleNamespace

import numpy as np
import pytest

from cli.show.life import telling
from fmu_src.faults import InputFault, RunFault
from fmu_src.progress import told_to
from orchestrator.settings import Setting, parse_setting
from studies.checkpoint import load_checkpoint, save_checkpoint
from studies.coupled_master import CoupledMaster
from studies.duty import Segment
from studies.figure_units import OVER_TURN
from studies.held_input import lost_motion
from studies.hysteresis import hysteresis
from studies.kept_life import WantedLife, whole_life
from studies.life import Life, LifeSettings, live
from studies.meshing_cycle import HOUR, run_cycle
from studies.pair import make_pair
from studies.passes import before_of, pass_of
from studies.wear_figures import depths, peak_of_circle

# A sixth of the usual positions per turn, and no equilibria between them: the jumps, not the angles, are under test.
COARSE, UNDIVIDED = 12, Setting("largest_crank_step", 0.6)


def nothing(_):
    pass


def make_coarse(reducer, settings=(), **more):
    return make_pair(reducer, [UNDIVIDED, *settings], positions=COARSE, **more)


def run_life(reducer, settings, keep=nothing):
    pair = make_coarse(reducer)
    return live(pair, Life(settings), nothing, keep), pair


@pytest.fixture(scope="module")
def short(rv20e):
    return run_life(rv20e, LifeSettings(hours=400.0, first_jump=100.0))[0]


def test_hours_start_at_zero_and_end_where_asked(short):
    assert short.hours[0] == 0.0
    assert short.hours[-1] == pytest.approx(400.0, rel=1e-9)
    assert np.all(np.diff(short.hours) > 0.0)


def test_progress_says_that_hours_count_from_new_and_which_run_it_is(rv20e):
    """"hours of life: 525 of 10000" of the second run were read as hours of that run."""
    tasks, heard, ended = [], [], []
    wanted = WantedLife(rv20e, [UNDIVIDED], LifeSettings(hours=100.0, tolerance=0.1), COARSE)
    with told_to(SimpleNamespace(begin=tasks.append, end=lambda task: None, say=lambda text: None)):
        result = whole_life(wanted, lambda state: heard.append(tasks[-1].sentence()), ended=ended.append)
    # The count goes on once there is what it is of.
    assert heard[1].startswith("hours since new, pass 1 in 1 jump: 100 of 100")
    assert heard[2].startswith("hours since new, pass 2 in 2 jumps: 25 of 100")
    # The last that is told of a life that runs is what its result has; of the middle of the last jump it was.
    (life,) = ended
    assert life.over_turn_at_hours() == result[OVER_TURN].values.tolist() and life.over_turn[-1][0] == life.hours[-1] and life.passes >= 2


def test_wear_only_grows(short):
    for name in ("inner_raceway_um", "outer_raceway_um", "disc_flank_um", "pin_um"):
        assert np.all(np.diff([f[name] for f in short.figures]) > 0.0), name
    for before, after in zip(short.surfaces, short.surfaces[1:]):
        for name in before:
            assert np.all(after[name] >= before[name]), name
            assert np.all(before[name] >= 0.0), name


def test_every_recorded_hour_meets_the_tolerance(short):
    assert len(short.errors) == len(short.hours)
    assert max(short.errors) <= short.settings.tolerance


SPEED = 2000 * np.pi / 30
CASES = {
    "one way": {},
    "reversing": {"duty": (Segment(SPEED, 167.0, 0.5), Segment(-SPEED, -167.0, 0.5))},
    "fast running-in": {"settings": [Setting("running_in_excess", 4.0), Setting("running_in_time", 50 * HOUR)]},
}
DEMANDS = (0.1, 0.03, 0.01)


# The tightest demand takes half of the time, and a duty's cycles cost twice as much.
@pytest.mark.parametrize("case, demands", [
    ("one way", DEMANDS), *((case, DEMANDS[:2]) for case in CASES if case != "one way"),
    *(pytest.param(case, DEMANDS, marks=pytest.mark.campaign) for case in CASES if case != "one way"),
])  # fmt: skip
def test_error_is_below_the_demand_and_cost_falls_with_it(rv20e, case, demands):
    make = lambda: make_coarse(rv20e, master_kind=CoupledMaster, **CASES[case])
    exact, hours, jumps = make(), 3000.0, 24
    for i in range(jumps):
        run_cycle(exact, hours * (2 * i + 1) / jumps**2)
    cycles = []
    for demand in demands:
        pair = make()
        cycles.append(live(pair, Life(LifeSettings(hours, demand)), nothing, nothing).cycles)
        assert np.max(np.abs(depths(pair) / depths(exact) - 1.0)) < demand, demand
    assert cycles == sorted(set(cycles)), "each tighter demand costs more"
    assert cycles[0] * 3 <= cycles[-1] or demands != DEMANDS


@pytest.mark.parametrize("limits, jumps", [({}, 1), ({"first_jump": 100.0}, 10), ({"largest_jump": 2000.0}, 10)])
def test_jumps_are_as_short_as_asked_for(limits, jumps):
    assert LifeSettings(10_000.0, 0.1, **limits).first_jumps() == jumps


def test_fault_of_long_jumps_is_cured_by_shorter_ones(rv20e):
    pair = make_coarse(rv20e)
    steps, cycle = pair.master.run, 400.0 / 4

    def run(count, each_step=None):
        if pair.wear.get("acceleration") * pair.turn_time * rv20e.topology.lobes > 1.01 * cycle * HOUR:
            raise RunFault("too much wear")
        steps(count, each_step)

    pair.master.run = run
    life = live(pair, Life(LifeSettings(hours=400.0, tolerance=0.1)), nothing, nothing)
    assert life.jumps >= 16 and life.hours[-1] == pytest.approx(400.0)


def test_a_reducer_that_is_worn_through_says_after_how_many_hours(rv20e):
    pair = make_coarse(rv20e)
    steps = pair.master.run

    def run(count, each_step=None):
        if pair.wear.get("operating_time") > 4.0 * HOUR:
            raise RunFault("no equilibrium")
        steps(count, each_step)

    pair.master.run = run
    with pytest.raises(RunFault, match=r"after 4\b.* of 1000 h, worn by up to .* um: no equilibrium"):
        live(pair, Life(LifeSettings(hours=1000.0, tolerance=0.1)), nothing, nothing)


def test_measuring_leaves_the_pair_as_it_was(rv20e):
    pair = make_coarse(rv20e)
    run_cycle(pair, 100.0)
    before = pair.master.save()
    life = Life(LifeSettings())
    life.note(pair)
    assert pair.master.save() == before


@pytest.mark.parametrize("reducer", ["rv20e", pytest.param("bx40e", marks=pytest.mark.campaign)])
def test_a_life_in_motion_is_not_worn_by_the_swing_that_accelerated_wear_strikes_up(request, reducer):
    """The load rings through a hundred turns: undamped, 10,000 h in two jumps wear the races of the RV20E-121 twice as deep."""
    ends = {}
    for fidelity in (0, 1):
        pair = make_coarse(request.getfixturevalue(reducer), [Setting("fidelity", fidelity)], master_kind=CoupledMaster)
        live(pair, Life(LifeSettings(10_000.0, 0.1)), nothing, nothing)
        ends[fidelity] = depths(pair)
    assert ends[1] == pytest.approx(ends[0], rel=0.05)
    omega = 2.0 * np.pi * {"rv20e": 86.3, "bx40e": 147.1}[reducer]
    record = pair.plant.record()
    assert record["swing_damping"][0] == pytest.approx(2.0 * 0.07 * omega * record["load_inertia"][0], rel=0.1)


class Killed(Exception):
    pass


def test_resumed_life_equals_the_uninterrupted_one(rv20e, short, tmp_path):
    path, inputs = tmp_path / "life.checkpoint", {"case": 1}
    pair = make_coarse(rv20e)

    def kill_in_the_finer_run(life):
        save_checkpoint(path, life, pair.master.save(), inputs)
        if life.coarse and len(life.hours) == 3:
            raise Killed

    with pytest.raises(Killed):
        live(pair, Life(short.settings), nothing, kill_in_the_finer_run)
    life, saved = load_checkpoint(path, inputs)
    again = make_coarse(rv20e)
    again.master.restore(saved)
    live(again, life, nothing, nothing)
    assert life.hours == short.hours
    assert life.figures == short.figures
    for ours, theirs in zip(life.surfaces, short.surfaces):
        assert all(np.array_equal(ours[name], theirs[name]) for name in theirs)


def test_checkpoint_of_other_inputs_is_refused(short, rv20e, tmp_path):
    path = tmp_path / "life.checkpoint"
    pair = make_coarse(rv20e)
    save_checkpoint(path, short, pair.master.save(), {"positions": 24})
    with pytest.raises(InputFault, match="positions was 24, is 72"):
        load_checkpoint(path, {"positions": 72})


def test_broken_checkpoint_is_refused(tmp_path):
    path = tmp_path / "life.checkpoint"
    path.write_bytes(b"PK\x03\x04 cut off")
    with pytest.raises(InputFault, match="does not begin like a file of this kind .*; start anew with --restart"):
        load_checkpoint(path, {})


@pytest.mark.parametrize("bad", [{"hours": -1.0}, {"tolerance": 0.0}, {"first_jump": np.nan}, {"tolerance": 0.9}, {"tolerance": 1e-300}, {"first_jump": 1e-300}])
def test_senseless_settings_are_named(bad):
    with pytest.raises(InputFault, match=next(iter(bad))):
        LifeSettings(**bad).check()


def test_acceleration_counts_hours_and_distance(rv20e):
    pair = make_coarse(rv20e)
    run_cycle(pair, 123.0)
    assert pair.wear.get("operating_time") / HOUR == pytest.approx(123.0, rel=1e-12)
    speed = abs(pair.plant.get("crank_speed"))
    assert pair.wear.get("crank_travel") == pytest.approx(speed * 123.0 * HOUR, rel=1e-6)


def test_peak_of_a_rippled_hump_lies_at_its_middle():
    angle = 2 * np.pi * (np.arange(360) + 0.5) / 360
    hump = np.maximum(np.cos(angle - 1.234), 0.0) ** 2
    ripple = 1.0 + 0.002 * np.cos(90 * angle + 0.3)
    depth, place = peak_of_circle((hump * ripple)[None, :])
    assert place == pytest.approx(1.234, abs=np.radians(0.3))
    assert depth == pytest.approx(1.0, abs=0.003)


def test_the_pass_before_is_known_from_the_life_alone():
    """A page that looks after a pause has not seen it."""
    first, finer, worn = (Life(LifeSettings(90.0), jumps=n, passes=k, coarse=c) for n, k, c in ((3, 1, []), (6, 2, [[1.0]] * 4), (12, 3, [])))
    assert [before_of(life) for life in (first, finer, worn)] == [0, 3, 6]
    assert [pass_of(life) for life in (first, worn)] == ["pass 1 in 3 jumps", "pass 3 in 12 jumps"]


def test_a_life_that_begins_again_says_why():
    """Jumps of a finer run look like a restart."""
    lines: list[str] = []
    tell = telling(lines.append)
    figures = dict.fromkeys(("inner_raceway_um", "outer_raceway_um", "disc_flank_um", "pin_um"), 1.0)
    for jumps, hours, coarse in ((3, [0.0, 10.0], []), (3, [0.0, 10.0, 40.0], []), (6, [0.0, 2.5], [[1.0]]), (12, [0.0, 1.0], [])):
        tell(Life(LifeSettings(90.0), hours=hours, figures=[figures], jumps=jumps, coarse=coarse))
    assert [line for line in lines if "again" in line] == [
        "again from 0 h in 6 jumps, each a part of one of the 3 before: the difference is their error",
        "too much wear in one jump of 6: again from 0 h, in 12 jumps",
    ]
    assert len(lines) == 6


def test_a_life_tells_the_lost_motion_of_the_stiffness_test(rv20e, short):
    """The catalogue's figure stood nowhere in a life; the surfaces wear it up, and of a new reducer it is what the test reads."""
    lost = [figures["lost_motion_arcmin"] for figures in short.figures]
    assert lost[0] == pytest.approx(hysteresis(rv20e, []).lost_motion_arcmin, rel=2e-3) and all(np.diff(lost) > 0.0)
    pair = make_pair(rv20e, [parse_setting("output.load_torque=0", [rv20e.plant])])
    assert np.isnan(lost_motion(pair))
