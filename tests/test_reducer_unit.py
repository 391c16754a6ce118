"""RvReducer: plant and wear in one unit give what the pair gives."""

import fmpy.validation
import numpy as np
import pytest
from stand import BACK

from fmu_src.faults import InputFault, RunFault
from fmu_src.link import compiler, host_platform
from fmu_src.native import NativeFault, host_triple, object_codes
from fmu_src.package import build_fmu, build_native, triples_for
from orchestrator.component import InProcess
from orchestrator.opening import open_fmu
from orchestrator.settings import Setting
from reducers.reducer import load_reducer
from rv_reducer.reducer import OF_WEAR
from rv_reducer.variables import LIMITS
from studies.hysteresis import hysteresis
from studies.pair import crank_turn_time, make_pair

ARCMIN = np.degrees(1.0) * 60.0
HOUR = 3600.0


@pytest.fixture(scope="module")
def one_unit_fmus(rv20e, tmp_path_factory):
    """Folder of RvReducer.fmu, editable, with the native ones in fmi2 and fmi3."""
    try:
        compiler(host_platform(), False)
    except NativeFault as fault:
        pytest.skip(f"no native FMUs: {fault}")
    specification, folder = rv20e.specification("rv_reducer"), tmp_path_factory.mktemp("reducer")
    codes = object_codes(specification, triples_for(False))
    build_fmu("RvReducer", specification, 1e-3, "rvwear test", folder, codes[host_triple()])
    build_native("RvReducer", specification, 1e-3, "rvwear test", folder, codes=codes)
    return folder


def make_unit(reducer, **values):
    unit = InProcess("reducer", reducer.specification("rv_reducer"))
    for name, value in values.items():
        unit.set(name, value)
    return unit


def run(unit, steps, step, start=0):
    if start == 0:
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
    for i in range(start, start + steps):
        unit.step(i * step, step)
    return unit


def run_with_wear(reducer, steps, acceleration=1e6, **values):
    """The unit through ``steps`` positions of 72 a crank turn."""
    unit = make_unit(reducer, acceleration=acceleration, **values)
    return run(unit, steps, crank_turn_time(reducer, unit) / 72)


@pytest.mark.parametrize("values", [
    {}, {"pins": 1, "load_torque": -100.0, "lobe_profile_error": 2e-6, "grease_life": 1e7, "temperature": 320.0},
    {"fidelity": 1, "dynamic_tolerance": 0.03},
], ids=["ideal", "standing pins, errors", "in motion"])  # fmt: skip
def test_it_equals_the_pair(rv20e, values):
    steps = 200
    pair = make_pair(rv20e, [Setting(name, value) for name, value in values.items()])
    pair.wear.set("acceleration", 1e6)
    pair.master.run(steps)
    unit = run_with_wear(rv20e, steps, **values)
    # The pair's wear unit does not know how far the plant will turn, the one unit does: their lines meet at the next position.
    lines = set(BACK)
    # Bodies in motion also feel where the lines begin.
    near = 1e-4 if values.get("fidelity") else 1e-10
    # Forces that cancel are rounding, and the one unit has a tolerance of its own in motion.
    others = {"dynamic_tolerance", "housing_force_x", "housing_force_y", "residual", "mesh_error_start", "roller_error_start", "ideal_output_rest", "cage_rest"}
    for name, component, left_out in (("plant", pair.plant, lines | others), ("wear", pair.wear, lines)):
        for v in component.table.variables:
            if v.role != "scratch" and v.name not in left_out:
                alone, together = component.records[v.name], unit.records[name][v.name]
                assert np.allclose(together, alone, rtol=near, atol=near * np.abs(alone).max()), v.name
    ahead = -2 * np.pi / 72 * np.sign(pair.plant.number("input_speed"))
    for name in ("mesh", "roller"):
        alone, together = (
            r[f"{name}_profile_error"] + r[f"{name}_profile_slope"] * (r["crank_angle"] + ahead - r["profile_angle"])
            for r in (pair.wear.records[0], unit.records["wear"][0])
        )
        assert together == pytest.approx(alone, rel=0.0, abs=near * alone.max())
    assert unit.get("worst_flank_depth") == unit.get("flank_depth").max() > 0.0
    assert unit.get("worst_pin_depth") == unit.records["pin_depth"].max() > 0.0
    races = unit.get("inner_race_depth").max(), unit.get("outer_race_depth").max()
    assert unit.get("worst_race_depth") == max(races) > 0.0


def test_looks_at_lost_motion_change_nothing_else(rv20e):
    often, never = (run_with_wear(rv20e, 100, judgement_interval=interval) for interval in (0.0, 1e9))
    judged = {"judgement_interval", "lost_motion", "remaining_life", "limited_by", "turned", "judged_time",
              "judged_flank_volume", "judged_inner_volume", "judged_outer_volume", "z_forward", "z_backward", "own_rate",
                  "estimated_lost_motion", "estimated_remaining", "estimated_time"}  # fmt: skip
    for v in often.table.variables:
        if v.role != "scratch" and v.name not in judged:
            assert (often.records[v.name] == never.records[v.name]).all(), v.name


def test_lost_motion_is_that_of_the_stiffness_test(rv20e):
    """There averaged over the input angle, here at one."""
    unit = run_with_wear(rv20e, 1)
    assert unit.get("lost_motion") * ARCMIN == pytest.approx(hysteresis(rv20e, []).lost_motion_arcmin, rel=0.15)
    wider = run_with_wear(rv20e, 1, bearing_clearance=10e-6)
    assert wider.get("lost_motion") > 2.0 * unit.get("lost_motion")


def test_lost_motion_is_the_same_whether_the_input_stands_or_turns():
    """What friction held while the input stood was in that of the new reducer, and was taken for wear's once it turned."""
    reducer = load_reducer("RV20E-121")
    standing, turning = (run(make_unit(reducer, **values), 0, 1.0) for values in ({"input_speed": 0.0}, {}))
    assert standing.number("lost_motion") == pytest.approx(turning.number("lost_motion"), rel=1e-9) and standing.number("input_speed") == 0.0
    smooth = [Setting(name, 0.0) for name in ("mesh_friction", "mesh_friction_excess")]
    without, loop = (hysteresis(reducer, settings, locked_at=0.0).lost_motion_arcmin for settings in (smooth, []))
    assert standing.number("lost_motion") * ARCMIN == pytest.approx(without, rel=1e-4) and loop > 1.005 * without


@pytest.mark.parametrize("flavour", ["kernels", "python", "fmi2", "fmi3"])
def test_a_torque_that_no_reducer_takes_is_said_once(request, rv20e, flavour):
    """At the start and at each look at lost motion, never between: a step costs nothing more."""
    if flavour == "kernels":
        calm, unit = (make_unit(rv20e, load_torque=torque) for torque in (-800.0, -1000.0))
        assert run(calm, 1, 1e-3).unit.due_cautions(calm.records) == {}
    else:
        folder = request.getfixturevalue("one_unit_fmus")
        unit = open_fmu("reducer", (folder if flavour == "python" else folder / flavour) / "RvReducer.fmu")
        unit.set("output.load_torque", -1000.0)
    run(unit, 3, 1e-3)
    assert unit.get("life.overloads" if flavour != "kernels" else "overloads") == 1
    said = unit.cautions() if flavour == "kernels" else unit.messages
    assert sum("beyond 5 times life.rated_torque" in text for text in said) == 1
    if flavour != "kernels":
        unit.close()


def test_remaining_life_is_that_of_the_run_beyond_it(rv20e):
    """Run in, the depth grows nearly along a straight line: the limit is reached when it was foretold."""
    limit = 1e-6
    unit = run_with_wear(
        rv20e, 6 * 72, run_in_ratio=1.0, flank_depth_limit=limit, race_depth_limit=0.0, lost_motion_limit=0.0,
        load_exponent=0.0,
    )  # fmt: skip
    foretold = unit.get("operating_time") + unit.get("remaining_life")
    assert LIMITS[unit.get("limited_by")] == "flank depth"
    step, i = crank_turn_time(rv20e, unit) / 72, 6 * 72
    unit.set("acceleration", 4e6)
    while unit.get("worst_flank_depth") < limit:
        run(unit, 1, step, i)
        i += 1
    assert unit.get("operating_time") == pytest.approx(foretold, rel=0.1)
    run(unit, 72, step, i)
    assert unit.get("remaining_life") == 0.0


def through(reducer, segments, step, **values):
    """The unit after each of ``segments``, (sense of turning, duration [s]), in equal communication steps."""
    unit = make_unit(reducer, **values)
    speed, start = float(unit.get("input_speed")), 0.0
    unit.set("input_speed", segments[0][0] * speed)
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    for sense, duration in segments:
        unit.set("input_speed", sense * speed)
        count = max(1, round(duration / step))
        for i in range(count):
            unit.step(start + i * duration / count, duration / count)
        start += duration
    return unit


JUDGED = ("worst_flank_depth", "worst_pin_depth", "worst_race_depth", "remaining_life", "lost_motion", "operating_time")


STEADY = {"forward": [(1, 0.2)], "backward": [(-1, 0.2)]}
REVERSAL = [(1, 0.2), (0, 0.1), (-1, 0.2)]
DIVIDED = [
    pytest.param(acceleration, segments, fidelity, id=f"{name}, {'dynamic' if fidelity else 'quasi-static'}, {acceleration:g}")
    for name, segments in STEADY.items() for fidelity in (0, 1) for acceleration in (1.0, 1e5)
]  # fmt: skip
DIVIDED += [pytest.param(acceleration, REVERSAL, 0, id=f"reversal, quasi-static, {acceleration:g}") for acceleration in (1.0, 1e5)]
# The blow of a reversal takes most of the time; what it wears does not know how often it counts.
DIVIDED += [pytest.param(1e5, REVERSAL, 1, id="reversal, dynamic, 1e5"),
            pytest.param(1.0, REVERSAL, 1, id="reversal, dynamic, 1", marks=pytest.mark.campaign)]  # fmt: skip


@pytest.mark.parametrize("acceleration, segments, fidelity", DIVIDED)
def test_it_divides_its_steps_itself(rv20e, fidelity, segments, acceleration):
    """Figures do not depend on the communication step; those that hold over a turn need one."""
    values = {"fidelity": fidelity, "acceleration": acceleration}
    finest = through(rv20e, segments, 2e-5, **values)
    for step in (7e-4, 9e-3, 0.2):
        unit = through(rv20e, segments, step, **values)
        for name in JUDGED:
            # The forecast takes growth from all that was worn off, the blow of a reversal in motion included.
            within = 5e-3 if fidelity and len(segments) > 1 and name == "remaining_life" else 2e-3
            assert unit.get(name) == pytest.approx(finest.get(name), rel=within, abs=0.0), (step, name)
        assert unit.get("operating_time") == pytest.approx(acceleration * sum(d for _, d in segments), rel=1e-9)
    assert finest.get("worst_flank_depth") > 0.0


def test_a_second_at_once_is_no_long_step(rv20e):
    coarse, fine = (through(rv20e, [(1, 1.0)], step, acceleration=1e6) for step in (1.0, 1e-3))
    for name in JUDGED:
        assert coarse.get(name) == pytest.approx(fine.get(name), rel=2e-3, abs=0.0), name


def test_shortest_steps_wear_too(rv20e):
    """A microsecond at a time, from one place where the surfaces wear to the next."""
    short, long = (through(rv20e, [(1, 2.6e-3)], step, acceleration=1e6) for step in (1e-6, 2.6e-3))
    assert short.get("worst_flank_depth") == pytest.approx(long.get("worst_flank_depth"), rel=2e-3, abs=0.0)
    assert short.get("worst_flank_depth") > 0.0


def test_without_limits_there_is_no_end(rv20e):
    unit = run_with_wear(rv20e, 80, flank_depth_limit=0.0, race_depth_limit=0.0, lost_motion_limit=0.0)
    assert unit.get("remaining_life") == 1e12
    assert LIMITS[unit.get("limited_by")] == "none"


def test_faults_of_either_part_are_told(rv20e):
    with pytest.raises(InputFault, match="crank.eccentricity = 3 mm: K1 = .* makes loops"):
        run(make_unit(rv20e, eccentricity=3e-3), 1, 1e-3)
    unit = run(make_unit(rv20e, acceleration=1e6), 1, 1e-3)
    before = unit.save()
    unit.set("input_speed", 1e5)
    with pytest.raises(RunFault, match="more than 100,000 internal steps"):
        unit.step(1e-3, 3600.0)
    unit.set("input_speed", rv20e.starts["input_speed"])
    assert unit.save() == before
    assert "crank_angle_before" in unit.unit.faults[OF_WEAR + 3]


@pytest.mark.campaign
@pytest.mark.parametrize("flavour", [".", "fmi2", "fmi3"])
def test_fmus_are_valid_and_equal_the_kernels(rv20e, one_unit_fmus, flavour):
    path = one_unit_fmus / flavour / "RvReducer.fmu"
    assert fmpy.validation.validate_fmu(str(path)) == []
    step, fmu = 1e-3, open_fmu("reducer", path)
    fmu.set("acceleration", 1e6)
    run(fmu, 80, step)
    own = run(make_unit(rv20e, acceleration=1e6), 80, step)
    outputs = [v.name for v in own.table.of_role("output")]
    for name in outputs:
        assert np.allclose(fmu.get(name), own.get(name), rtol=1e-9, atol=1e-14), name
    # A saved state goes on as it went.
    saved = fmu.save()
    first = [np.array(run(fmu, 40, step, 80).get(name)) for name in outputs]
    fmu.restore(saved)
    again = [np.array(run(fmu, 40, step, 80).get(name)) for name in outputs]
    assert all((a == b).all() for a, b in zip(first, again))
    # Refused in the second of many parts, after surfaces have worn.
    fmu.set("load_torque", 1e9)
    before = fmu.save()
    with pytest.raises(RunFault, match="no equilibrium"):
        fmu.step(0.12, 0.08)
    assert fmu.save() == before
    fmu.close()


def test_few_connections_are_enough(rv20e):
    assert sum(v.size for v in rv20e.joint.of_role("input")) == 5
    assert sum(v.size for v in rv20e.joint.of_role("output")) < 80


def test_units_of_one_reducer_share_their_table_and_no_value(rv20e, bx40e):
    one, other = make_unit(rv20e, load_torque=50.0), make_unit(rv20e)
    assert one.table is other.table is not make_unit(bx40e).table
    assert one.get("load_torque") == 50.0 and other.get("load_torque") == rv20e.starts["load_torque"]
    changed = rv20e.specification("rv_reducer")
    changed["starts"] = changed["starts"] | {"load_torque": 60.0}
    assert InProcess("reducer", changed).get("load_torque") == 60.0


def test_a_step_that_the_wear_refuses_changes_nothing_that_is_not_put_back(rv20e):
    """Part of the way to the next wear is gone, then a flank is worn through: the plant had moved when the wear refused."""
    unit = make_unit(rv20e)
    step = crank_turn_time(rv20e, unit) / 72
    run(unit, 1, 0.4 * step)
    unit.records["wear"]["flank_depth"] = 1.0
    # What lies before these cells FMUs put back themselves.
    beyond = slice(unit.unit.guarded_cells, unit.table.state_cells)
    before = unit.table.cells(unit.records)[beyond].copy()
    with pytest.raises(RunFault, match="worn through"):
        unit.step(0.4 * step, 0.6 * step)
    assert np.array_equal(unit.table.cells(unit.records)[beyond], before)


def test_a_refused_step_that_is_asked_for_again_ends_the_unit(one_unit_fmus):
    """An importer of fixed steps asks for ever; one that tries a smaller step, or changes an input, goes on.  Why it ends is said without debug logging."""
    said = []
    found = fmpy.simulate_fmu(
        str(one_unit_fmus / "fmi2" / "RvReducer.fmu"), start_values={"acceleration": 1e12}, stop_time=0.01, step_size=1e-4, output=["flank.depth[1]"],
        logger=lambda *arguments: said.append(arguments[4].decode()),
    )  # fmt: skip
    assert 0.0 < found["time"][-1] < 0.009
    assert any("worn through" in text for text in said) and "was asked for again: the unit is terminated" in said[-1] and len(said) == 3


def test_an_importer_that_stops_at_a_refused_step_has_its_reason(one_unit_fmus, capfd):
    """fmpy steps an FMI 3.0 unit no further; without debug logging, too, it shows why."""
    with pytest.raises(fmpy.fmi1.FMICallException):
        fmpy.simulate_fmu(str(one_unit_fmus / "fmi3" / "RvReducer.fmu"), start_values={"acceleration": 1e12}, stop_time=0.01, step_size=1e-4)
    shown = capfd.readouterr()
    assert "worn through" in shown.out + shown.err
