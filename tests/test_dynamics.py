"""Forces on the bodies in motion: derivatives of the energy, power of the damping, tangent, action and reaction."""

import numpy as np
import pytest
from stand import gradient, imperfect, in_motion, only

from rv_plant.dynamics import assemble_motion
from rv_plant.topology import Topology
from rv_plant.variables import plant_table

NONE, STEP, HYSTERETIC, MODAL = range(4)
EVERY_LAW = pytest.mark.parametrize("law", [STEP, HYSTERETIC, MODAL], ids=["step", "hysteretic", "modal"])
SOFT = {
    "crank_support_compliance": 1 / 1.4e8, "main_bearing_compliance": 1 / 3e8, "first_stage_compliance": 1e-8,
    "housing_compliance": 1e-7, "carrier_compliance": 1e-6,
}
TEETH = {"backlash": 3e-6, "tooth_stiffness_variation": 0.3, "tooth_error": 2e-6, "sun_teeth": 13.0}
CASES = {
    "sun drive": (Topology(2, 2, 40, 39, 16), {}),
    "crank drive": (Topology(2, 2, 40, 39, 16), {"first_stage_ratio": 0.0, "input_speed": 60.0}),
    # The topology that test_equilibrium compiles too; a further one takes half a minute.
    "3 discs, 3 cranks": (Topology(3, 3, 40, 39, 16), {}),
    "1 disc, 3 cranks": (Topology(1, 3, 40, 39, 16), {}),
}
EVERY_CASE = pytest.mark.parametrize("topology, values", [
    pytest.param(*case, id=name, marks=pytest.mark.campaign if name.startswith("1 disc") else ()) for name, case in CASES.items()
])  # fmt: skip


def is_turning(record):
    discs, cranks = record.roller_force.shape[:2]
    carrier = 3 * discs
    index = np.arange(len(record.q))
    of_disc, of_crank = index < carrier, index > carrier + 2
    turning = (index % 3 == 2) & (of_disc | of_crank)
    return turning | (index == carrier) | (index >= carrier + 3 + 3 * cranks)


def shifts(record):
    """Indices of the first of each pair of coordinates x, y."""
    discs, cranks = record.roller_force.shape[:2]
    carrier = 3 * discs
    return [*range(0, carrier, 3), carrier + 1, *range(carrier + 3, carrier + 3 + 3 * cranks, 3)]


def shaken(topology, values, seed=5, speed=1e-2, **more):
    """A record under load with part errors, every body displaced up to 0.3 um and shaken at up to ``speed`` [m/s]."""
    table = plant_table(topology)
    errors = imperfect(table, seed)
    usual = {"load_torque": 167.0, "bearing_clearance": 2.5e-6, "input_speed": 200.0}
    records = in_motion(table, **{**usual, **errors, **SOFT, **TEETH, **values, **more})
    record, random = only(records), np.random.default_rng(seed)
    lever = np.where(is_turning(record), record.pin_circle_radius, 1.0)
    record.q[:] += random.uniform(-3e-7, 3e-7, len(record.q)) / lever
    record.v[:] += random.uniform(-speed, speed, len(record.q)) / lever
    if record.first_stage_ratio == 0.0:
        # Cranks turn with the input, on a joint that nearly is rigid.
        cranks = [i + 2 for i in shifts(record)[-record.roller_force.shape[1] :]]
        record.q[cranks], record.v[cranks] = record.q[-2] + 1e-11, record.v[-2] + 1e-8
    record.mesh_impact_speed[:] = record.roller_impact_speed[:] = 0.03
    return record, lever


def residual_at(record, q, v, rate_weight=1.0):
    """Gradient of the equations of motion with the contacts' phases as they were."""
    place, speed, phases = record.q.copy(), record.v.copy(), record.phase_shift.copy()
    record.q[:], record.v[:] = q, v
    assemble_motion(record, rate_weight)
    found = record.residual_vector.copy(), float(record.potential), float(record.dissipation), float(record.cage_power)
    record.q[:], record.v[:], record.phase_shift[:] = place, speed, phases
    return found


def of_outer_torques(record):
    outer = np.zeros(len(record.q))
    outer[-1], outer[-2] = record.load_torque, -record.input_torque
    return outer


@EVERY_CASE
def test_forces_at_rest_are_the_gradient_of_the_energy(topology, values):
    """Contacts, joints, and teeth whose stiffness goes with the phase."""
    record, lever = shaken(topology, values)
    rest = np.zeros(len(record.q))

    def energy(q):
        return np.array([residual_at(record, q, rest)[1]])

    expected = gradient(energy, record.q.copy(), 2e-9 / lever)[:, 0]
    found = residual_at(record, record.q, rest)[0] - of_outer_torques(record)
    assert np.abs(found / lever).max() > 100.0
    assert found / lever == pytest.approx(expected / lever, abs=1e-6 * np.abs(found / lever).max())


@EVERY_CASE
@EVERY_LAW
def test_damping_forces_do_the_work_that_is_lost(topology, values, law):
    """v . (force in motion - force at rest) is the dissipation; the cages' drive takes part at the rollers."""
    record, _ = shaken(topology, values, damping_law=law, damping_depth=1e-6)
    moving, _, lost, cage = residual_at(record, record.q, record.v)
    still, _, nothing, _ = residual_at(record, record.q, np.zeros(len(record.q)))
    assert nothing == 0.0 and lost > 0.0
    # The rate at a roller has a part of its cage's turning, which is no velocity of a body.
    cage_share = cage_damping_power(record)
    assert record.v @ (moving - still) == pytest.approx(lost - cage_share, rel=1e-9, abs=1e-12)


def cage_damping_power(record):
    """Power of the cages against the rollers' damping, from the rollers one by one."""
    discs, cranks, rollers = record.roller_force_now.shape
    total = 0.0
    carrier = 3 * discs
    ratio = record.inner_race_radius / (record.inner_race_radius + record.outer_race_radius)
    cage_speed = (record.v[carrier + 5] - record.v[carrier]) * ratio
    residual_at(record, record.q, record.v)
    moving = record.roller_force_now.copy()
    residual_at(record, record.q, np.zeros(len(record.q)))
    still = record.roller_force_now.copy()
    for d in range(discs):
        for c in range(cranks):
            turned, crank = record.q[3 * d + 2], carrier + 3 + 3 * c
            arm = 2j * np.pi * c / cranks
            hole = record.crank_circle_radius + record.disc_hole_error_radial[d, c]
            hole = (hole + 1j * record.disc_hole_error_tangential[d, c]) * np.exp(arm + 1j * turned)
            throw = record.eccentricity + record.crank_eccentricity_error[d, c]
            lobe = throw * np.exp(1j * (record.q[crank + 2] + 2 * np.pi * d / discs + record.crank_phase_error[d, c]))
            shift = complex(*record.q[crank : crank + 2]) + lobe - complex(*record.q[3 * d : 3 * d + 2]) - hole
            direction = np.exp(arm + 1j * (turned + record.cage + 2 * np.pi * np.arange(rollers) / rollers))
            twist = (shift * direction.conj()).imag
            total += ((moving - still)[d, c] * twist).sum() * cage_speed
    return total


@EVERY_CASE
@pytest.mark.parametrize("law", [NONE, STEP, HYSTERETIC, MODAL], ids=["none", "step", "hysteretic", "modal"])
@pytest.mark.parametrize("rate_weight", [1e-6, 3e5])
def test_tangent_is_the_derivative_of_the_forces(topology, values, law, rate_weight):
    """d/dq + rate_weight d/dv at rest, where damping has no part in the levers.

    The cages' turning with crank and carrier is left out of it: some 1e-4 of the damping."""
    record, lever = shaken(topology, values, damping_law=law, speed=0.0)
    rest = np.zeros(len(record.q))

    def by_place(q):
        return residual_at(record, q, rest, rate_weight)[0]

    def by_speed(v):
        return residual_at(record, record.q, v, rate_weight)[0]

    expected = gradient(by_place, record.q.copy(), 5e-10 / lever)
    expected += rate_weight * gradient(by_speed, rest, 1e-7 / lever)
    by_place(record.q)
    tangent = np.triu(record.tangent) + np.triu(record.tangent, 1).T
    scale = np.sqrt(np.diag(tangent))
    assert np.max(np.abs(tangent - expected) / np.outer(scale, scale)) < (5e-5 if rate_weight < 1.0 else 1e-3)


def support_couple(record):
    """Of the crank supports' damping: it acts at both ends of the deflection, which is not along the damping force."""
    q, v = record.q, record.v
    cranks, carrier = record.roller_force.shape[1], 3 * len(record.roller_force)
    couple = 0.0
    for c in range(cranks):
        crank = carrier + 3 + 3 * c
        seat = record.crank_circle_radius + record.carrier_hole_error_radial[c]
        arm = np.exp(1j * (q[carrier] + 2 * np.pi * c / cranks))
        seat = (seat + 1j * record.carrier_hole_error_tangential[c]) * arm
        apart = complex(*q[crank : crank + 2]) - complex(*q[carrier + 1 : carrier + 3]) - seat
        rate = complex(*v[crank : crank + 2]) - complex(*v[carrier + 1 : carrier + 3]) - 1j * seat * v[carrier]
        couple += record.joint_damping_time / record.crank_support_compliance * (apart.conjugate() * rate).imag
    return couple


@EVERY_CASE
@pytest.mark.parametrize("law", [NONE, STEP, HYSTERETIC, MODAL], ids=["none", "step", "hysteretic", "modal"])
def test_moments_of_inner_forces_cancel(topology, values, law):
    """About the housing's centre: what is left are load, drive, housing and main bearing."""
    record, _ = shaken(topology, values, damping_law=law)
    # A displaced lobe is turned against the pins by its pitch error, not moved.
    record.lobe_pitch_error[:] = 0.0
    left = residual_at(record, record.q, record.v)[0]
    q, v, tau = record.q, record.v, record.joint_damping_time
    pairs = shifts(record)
    moment = left[is_turning(record)].sum() + sum(q[i] * left[i + 1] - q[i + 1] * left[i] for i in pairs)
    ring, main = len(q) - 3, pairs[len(record.roller_force)]
    housing = (q[ring] + tau * v[ring]) / record.housing_compliance
    bearing = tau / record.main_bearing_compliance * (q[main] * v[main + 1] - q[main + 1] * v[main])
    outer = record.load_torque - record.input_torque + housing + bearing + support_couple(record)
    assert moment == pytest.approx(outer, abs=1e-8)
    assert abs(housing) > 10.0


@EVERY_CASE
def test_inner_forces_cancel(topology, values):
    """Of discs, cranks and carrier: without pins and sun, what is left is the main bearing."""
    record, _ = shaken(topology, values, damping_law=STEP)
    record.mesh_constant, record.backlash = 0.0, 1.0
    left = residual_at(record, record.q, record.v)[0]
    pairs = shifts(record)
    main, tau = pairs[len(record.roller_force)], record.joint_damping_time
    for i in range(2):
        bearing = (record.q[main + i] + tau * record.v[main + i]) / record.main_bearing_compliance
        largest = max(abs(left[k + i]) for k in pairs)
        assert sum(left[k + i] for k in pairs) == pytest.approx(bearing, abs=1e-3)
        assert largest > 10.0
