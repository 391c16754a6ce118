"""Equilibrium: balance of bodies cut free, a SciPy twin, energy, symmetry, limits and faults."""

import numpy as np
import pytest
from scipy.optimize import root
from stand import imperfect, in_equilibrium, only, records_of
from twin import Twin

from rv_plant import faults, plant
from rv_plant.equilibrium import equilibrium
from rv_plant.topology import Topology
from rv_plant.variables import plant_table

ANGLE, CAGE = 0.0871, 1.3
SUPPORTS = {
    "rigid supports": {},
    "compliant crank supports": {"crank_support_compliance": 1 / 1.4e8},
    "compliant main bearings": {"main_bearing_compliance": 1 / 3e8},
    "compliant first stage": {"first_stage_compliance": 1e-8},
    "compliant housing": {"housing_compliance": 1e-7},
}
ON_EVERY_SUPPORT = pytest.mark.parametrize("supports", SUPPORTS.values(), ids=SUPPORTS)
PITCH = "lobe_pitch_error"


def balanced(table, angle=ANGLE, cage=CAGE, **values):
    """The record in equilibrium, its twin, and what the twin finds left over from the record's contact forces."""
    record = in_equilibrium(table, angle, cage, **values)
    twin = Twin(record, angle, cage)
    return record, twin, twin.balance(record.z, record.mesh_force_now, record.roller_force_now)


def assert_in_balance(record, twin, left_over):
    """To 1e-8 of the load: of each disc and crank, of the carrier with its cranks, and of the whole."""
    load = abs(twin.load)
    force, moment = 1e-8 * load / record.pin_circle_radius, 1e-8 * load
    assert np.abs(left_over["disc force"]).max() < force
    assert np.abs(left_over["disc moment"]).max() < moment
    assert abs(left_over["carrier moment"]) < moment
    if record.crank_support_compliance > 0.0:
        assert np.abs(twin.support_force + twin.crank_shift / record.crank_support_compliance).max() < force
    if record.main_bearing_compliance > 0.0:
        assert abs(twin.support_force.sum() + twin.carrier_shift / record.main_bearing_compliance) < force
    assert record.drive_torque == pytest.approx(twin.input_torque, abs=moment)
    assert record.reaction_torque == pytest.approx(twin.pin_moment.sum(), abs=moment)
    assert record.reaction_torque + record.drive_torque == pytest.approx(twin.load, abs=moment)
    if twin.planet_radius:
        assert record.tooth_force * twin.planet_radius == pytest.approx(twin.crank_moment, abs=moment)


@ON_EVERY_SUPPORT
@pytest.mark.parametrize("reducer", ["rv20e", "bx40e"])
def test_every_body_is_in_balance(request, reducer, supports):
    assert_in_balance(*balanced(request.getfixturevalue(reducer).plant, **supports))


@ON_EVERY_SUPPORT
@pytest.mark.parametrize("without", [(PITCH,), ()], ids=["no pitch errors", "all errors"])
def test_every_body_is_in_balance_with_part_errors(rv20e, supports, without):
    errors = {k: v for k, v in imperfect(rv20e.plant, 2).items() if k not in without}
    assert_in_balance(*balanced(rv20e.plant, **supports, **errors))


@pytest.mark.parametrize("values", [
    {"first_stage_ratio": 0.0}, {"contact_law": 1}, {"contact_law": 2}, {"stiffness_reading": 1},
    {"load_torque": 5 * 167.0}, {"load_torque": -167.0}, {"load_torque": -167.0, "crank_support_compliance": 7e-9},
    {"equidistant_modification": 10e-6, "shift_modification": -15e-6},
], ids=lambda v: ", ".join(f"{k} {x:g}" for k, x in v.items()))
def test_every_body_is_in_balance_in_other_cases(rv20e, values):
    assert_in_balance(*balanced(rv20e.plant, **values))


# Every topology is compiled anew, which takes longer than the test.
@pytest.mark.parametrize(
    "discs, cranks", [(3, 3), *(pytest.param(*t, marks=pytest.mark.campaign) for t in ((1, 2), (2, 3)))]
)
def test_every_body_is_in_balance_in_other_topologies(discs, cranks):
    table = plant_table(Topology(discs, cranks, 40, 39, 16))
    assert_in_balance(*balanced(table, load_torque=167.0, bearing_clearance=2.5e-6))


@pytest.mark.parametrize("angle", [0.0, 0.061, 1.7])
def test_same_equilibrium_as_scipy_finds_for_the_twin(rv20e, angle):
    record, twin, _ = balanced(rv20e.plant, angle, tolerance=1e-11)
    count = 7
    scale = np.where(twin.is_turning(), 1e-6 / record.pin_circle_radius, 1e-6)[:count]
    levers = np.where(twin.is_turning(), record.pin_circle_radius, 1.0)[:count]

    def left_over(x):
        z = np.zeros(len(record.z))
        z[:count] = x * scale
        return twin.left_over(z) / levers

    start = np.round(record.z[:count] / scale, 1)
    found = root(left_over, start, method="hybr", options={"xtol": 1e-13})
    assert np.abs(found.fun).max() < 1e-5
    assert np.abs(start - found.x).max() > 1e-3
    z = np.zeros(len(record.z))
    z[:count] = found.x * scale
    assert record.z[:count] == pytest.approx(z[:count], abs=1e-9 * np.abs(found.x).max() * scale.max(), rel=1e-9)
    mesh, roller = twin.forces(z)
    assert record.mesh_force_now == pytest.approx(mesh, abs=1e-8 * mesh.max())
    assert record.roller_force_now == pytest.approx(roller, abs=1e-8 * roller.max())


def over_a_crank_turn(table, count=600, **values):
    """Records at equal angles over the turn of the cranks against the carrier after which all repeats.

    The cage stands still on the disc: its rollers would store energy as they pass.
    """
    record = in_equilibrium(table, **values)
    for i in range(count):
        angle = 2.0 * np.pi / len(record.pin_angle) * i / count
        assert equilibrium(record, angle, 0.0, record.load_torque)
        yield angle, record


@ON_EVERY_SUPPORT
@pytest.mark.parametrize("first_stage_ratio, ratio", [(3.0, 121.0), (0.0, -39.0)], ids=["sun drive", "crank drive"])
def test_power_balances_over_a_crank_turn(rv20e, supports, first_stage_ratio, ratio):
    torques = []
    for _, record in over_a_crank_turn(rv20e.plant, first_stage_ratio=first_stage_ratio, **supports):
        moment = record.crank_moment.sum()
        torques.append(moment / first_stage_ratio if first_stage_ratio else -moment)
    load = float(record.load_torque)
    # It is not balanced at each angle: energy is stored and given back.
    assert np.ptp(torques) > 1e-3 * load / abs(ratio)
    assert np.mean(torques) == pytest.approx(load / ratio, rel=1e-6, abs=0)


def test_pins_carry_half_the_output_torque_less_the_input_torque_per_disc(rv20e):
    moments = []
    for angle, record in over_a_crank_turn(rv20e.plant):
        twin = Twin(record, angle, 0.0)
        twin.balance(record.z, record.mesh_force_now, record.roller_force_now)
        moments.append(twin.pin_moment)
    assert np.mean(moments, axis=0) == pytest.approx(2 * [0.5 * 167.0 * (1 - 1 / 121)], rel=1e-6, abs=0)


def test_force_follows_the_lever_if_bearings_are_rigid(rv20e):
    """Rigid bearings let the disc only turn: F ~ (lever)^(10/9), lever ~ sin(alpha)."""
    record = in_equilibrium(rv20e.plant, ANGLE, roller_stiffness=5.1e8, bearing_clearance=0.0, tolerance=1e-7)
    k1 = 36.0 / 52.0
    for d in range(2):
        force, phi = record.mesh_force_now[d], record.mesh_phase[d]
        sine = np.sin(phi) / np.sqrt(1 + k1**2 - 2 * k1 * np.cos(phi))
        side = np.maximum(np.sign(sine[np.argmax(force)]) * sine, 0.0) ** (10 / 9)
        fit = side * (force @ side) / (side @ side)
        assert 1 - np.sum((force - fit) ** 2) / np.sum((force - force.mean()) ** 2) > 1 - 1e-4
        assert (force > 0).sum() in (19, 20)


@pytest.mark.parametrize("angle", [0.0, 0.9])
def test_without_load_the_ideal_position_inside_the_clearance_is_an_equilibrium(rv20e, angle):
    record = in_equilibrium(rv20e.plant, angle, load_torque=0.0)
    assert not record.z.any() and record.lag == 0.0 and record.iterations == 0
    assert record.mesh_force_now.max() < 1e-6 and not record.roller_force_now.any()


def assert_discs_in_balance(record, left_over):
    """To 1e-8 of the largest force, at least of 30 N."""
    largest = max(30.0, record.roller_force_now.max(), record.mesh_force_now.max())
    assert np.abs(left_over["disc force"]).max() < 1e-8 * largest
    assert np.abs(left_over["disc moment"]).max() < 1e-8 * largest * record.pin_circle_radius


@pytest.mark.parametrize("clearance", [0.0, 2.5e-6, 10e-6], ids=lambda c: f"clearance {c * 1e6:g} um")
@pytest.mark.parametrize("load", [0.01, 1.0, 5.0, 20.0, 167.0, 5 * 167.0, -5.0, -167.0], ids=lambda t: f"{t:g} N.m")
def test_converges_from_rest_at_every_load(rv20e, load, clearance):
    """Cold start: no load is too small to find the contacts across the clearance."""
    record, _, left_over = balanced(rv20e.plant, load_torque=load, bearing_clearance=clearance)
    assert np.sign(record.lag) == np.sign(load)
    assert_discs_in_balance(record, left_over)


@pytest.mark.parametrize("case", ["preloaded bearings", "part errors"])
@pytest.mark.parametrize("angle", np.linspace(0.0, 2 * np.pi / 40, 6, endpoint=False), ids="{:.3f} rad".format)
def test_converges_without_load_where_parts_press_on_each_other(rv20e, angle, case):
    values = {"bearing_clearance": -5e-6}
    if case == "part errors":
        values = {k: v for k, v in imperfect(rv20e.plant, 4, 4e-6).items() if k != PITCH}
    record, _, left_over = balanced(rv20e.plant, angle, load_torque=0.0, **values)
    assert record.roller_force_now.max() > 1.0
    assert_discs_in_balance(record, left_over)


@pytest.mark.parametrize("seed", range(8))
def test_runs_through_a_crank_turn_with_part_errors_of_4_um(rv20e, seed):
    errors = imperfect(rv20e.plant, seed, 4e-6)
    records = records_of(rv20e.plant, load_torque=50.0, bearing_clearance=10e-6, **errors)
    assert plant.initialise(records) == 0
    step = 2 * np.pi / 72 / abs(records["crank_speed"][0])
    statuses = [plant.step(records, i * step, step) for i in range(72)]
    assert statuses == 72 * [0]


def test_negative_load_mirrors_everything(rv20e):
    """Mirrored at the axis through pin 1: angles, torques and the order of pins and rollers turn round."""
    ahead = in_equilibrium(rv20e.plant, ANGLE, CAGE)
    back = in_equilibrium(rv20e.plant, -ANGLE, -CAGE, load_torque=-167.0)
    pins, rollers, cranks = (-np.arange(n) % n for n in (40, 16, 2))
    assert back.mesh_force == pytest.approx(ahead.mesh_force[:, pins], abs=1e-6)
    assert back.roller_force == pytest.approx(ahead.roller_force[:, cranks][:, :, rollers], abs=1e-6)
    assert ahead.mesh_force[:, pins] != pytest.approx(ahead.mesh_force, abs=1.0)
    assert (back.lag, back.drive_torque) == pytest.approx((-ahead.lag, -ahead.drive_torque), rel=1e-8, abs=0)


@pytest.mark.parametrize("fault, values", [
    (faults.PRIMED, {"eccentricity": 1.31e-3}),
    (faults.PRIMED, {"shift_modification": -1e-3, "pin_circle_radius": 36.9e-3}),
    (faults.UNDERCUT, {"pin_radius": 3.9e-3, "equidistant_modification": 0.8e-3}),
    (faults.UNDERCUT, {"eccentricity": 1.27e-3}),
    (faults.PINS_OVERLAP, {"pin_radius": 4.09e-3}),
    (faults.BEARINGS_OVERLAP, {"crank_circle_radius": 13.2e-3}),
    (faults.BEARINGS_OVERLAP, {"crank_circle_radius": 35.9e-3}),
    (faults.ROLLERS_OVERLAP, {"roller_radius": 2.5e-3, "outer_race_radius": 15.25e-3}),
    (faults.RACES_DO_NOT_FIT, {"outer_race_radius": 13.36e-3}),
    (faults.NO_EQUILIBRIUM, {"max_iterations": 1}),
    (faults.NO_EQUILIBRIUM, {"load_torque": np.nan}),
    (faults.NO_EQUILIBRIUM, {"load_torque": np.nan, "housing_compliance": 1e-7}),
    (faults.NO_EQUILIBRIUM, {"mesh_profile_error": np.nan}),
    (faults.NO_EQUILIBRIUM, {"load_torque": 0.0, "mesh_profile_error": [[np.nan], [0.0]]}),
], ids=str)
def test_impossible_values_give_their_fault(rv20e, fault, values):
    status = plant.initialise(records_of(rv20e.plant, **values))
    assert status == fault


@pytest.mark.parametrize("values", [
    {"eccentricity": 1.26e-3, "pin_radius": 0.2e-3}, {"pin_radius": 3.9e-3, "equidistant_modification": 0.7e-3},
    {"roller_radius": 2.4e-3, "outer_race_radius": 15.05e-3}, {"outer_race_radius": 13.34e-3},
    {"crank_circle_radius": 13.3e-3}, {"crank_circle_radius": 35.8e-3},
], ids=str)
def test_possible_values_near_those_limits_pass(rv20e, values):
    assert faults.geometry_fault(only(records_of(rv20e.plant, **values))) == 0


def test_ring_that_is_not_closed_gives_its_fault():
    records = records_of(plant_table(Topology(2, 2, 40, 38, 16)))
    assert faults.geometry_fault.function(only(records)) == faults.RING_OPEN
