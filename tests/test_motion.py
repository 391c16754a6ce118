"""Bodies in motion: energy, momentum, the slow limit, symmetry, natural frequency, acceleration, rough handling."""

import numpy as np
import pytest
from stand import crank_period, in_motion, only, records_of, run_motion

from rv_plant import plant

NONE, STEP, HYSTERETIC, MODAL = range(4)
UNDAMPED = {"damping_law": NONE, "joint_damping_time": 0.0}
RPM = np.pi / 30.0
RATIO, LOBES = 121, 39
EVERY_LAW = pytest.mark.parametrize("law", [NONE, STEP, HYSTERETIC, MODAL], ids=["none", "step", "hysteretic", "modal"])


def kinetic_energy(series):
    return np.array([0.5 * r.mass @ r.v**2 for r in series])


def angular_momentum_rate(record):
    """d/dt of the angular momentum of all bodies about the housing's centre."""
    m, q, a = record.mass, record.q, record.acceleration
    discs, cranks = record.roller_force.shape[:2]
    carrier = 3 * discs
    shifts = [3 * d for d in range(discs)] + [carrier + 1] + [carrier + 3 + 3 * c for c in range(cranks)]
    orbits = sum(m[i] * (q[i] * a[i + 1] - q[i + 1] * a[i]) for i in shifts)
    turning = [i for i in range(len(q)) if i not in shifts and i - 1 not in shifts]
    return orbits + m[turning] @ a[turning]


def inertia_at_sun(record):
    """All that moves with ideal kinematics, reduced to the sun, in closed form."""
    discs, cranks = record.roller_force.shape[:2]
    slow = record.carrier_inertia + record.load_inertia + discs * record.disc_inertia
    slow += cranks * record.crank_mass * record.crank_circle_radius**2
    fast = cranks * record.crank_inertia + discs * record.disc_mass * record.eccentricity**2
    return record.sun_inertia + slow / RATIO**2 + fast * (LOBES / RATIO) ** 2


@EVERY_LAW
@pytest.mark.parametrize("reducer", ["rv20e", "bx40e"])
def test_energy_balances_over_a_crank_turn(request, reducer, law):
    """By the plant's own account, and by one from its outputs: what goes in comes out, is lost, or is stored."""
    damping = UNDAMPED if law == NONE else {"damping_law": law}
    records = in_motion(request.getfixturevalue(reducer).plant, **damping)
    first = only(records).copy()
    series = [first, *run_motion(records, crank_period(records), 2000)]
    last = series[-1]
    assert max(abs(r.energy_error) for r in series[200:]) < 1e-4
    torque = np.array([r.drive_torque for r in series])
    angle = np.array([r.input_angle for r in series])
    given = np.sum(0.5 * (torque[1:] + torque[:-1]) * np.diff(angle))
    taken = float(last.load_torque) * (last.output_angle - first.output_angle)
    assert last.input_energy == pytest.approx(given, rel=1e-4, abs=0)
    assert last.output_energy == pytest.approx(taken, rel=1e-4, abs=0)
    assert given == pytest.approx(taken, rel=2e-3, abs=0)
    if law == NONE:
        assert last.lost_energy == 0.0 and last.dissipation == 0.0 and last.power_loss == 0.0
    else:
        assert last.lost_energy > 0.0
        assert np.diff([r.lost_energy for r in series]).min() >= 0.0


@pytest.mark.parametrize("damping_time", [0.0, 4e-6], ids="{:g} s".format)
@pytest.mark.parametrize("values", [{}, {"first_stage_ratio": 0.0, "input_speed": 600.0 * RPM, "load_torque": -167.0}],
                         ids=["sun drive", "crank drive"])
def test_outer_torques_change_the_angular_momentum(rv20e, values, damping_time):
    """No inner force does: drive, load and housing alone, also while it shakes after a jump of the load."""
    records = in_motion(rv20e.plant, joint_damping_time=damping_time, load_inertia=0.05, **values)
    records["load_torque"] *= 1.5
    for record in run_motion(records, 5e-3, 25):
        outer = record.drive_torque + record.reaction_torque - record.load_torque
        rate = angular_momentum_rate(record)
        assert rate == pytest.approx(outer, abs=1e-6 * abs(record.load_torque))
    assert abs(rate) > 1.0


@EVERY_LAW
@pytest.mark.parametrize("load", [20.0, 167.0])
def test_slow_motion_is_the_equilibrium(rv20e, load, law):
    """At 20 rpm nothing but the equilibrium's forces is left, to 0.5 % of the largest."""
    values = {"input_speed": 20.0 * RPM, "load_torque": load}
    moving, still = in_motion(rv20e.plant, damping_law=law, **values), records_of(rv20e.plant, **values)
    assert plant.initialise(still) == 0
    step = crank_period(still) / 72
    for i in range(9):
        assert plant.step(moving, i * step, step) == 0 and plant.step(still, i * step, step) == 0
        a, b = only(moving), only(still)
        for name in ("lag", "transmission_error", "drive_torque", "reaction_torque", "tooth_force"):
            assert a[name] == pytest.approx(b[name], rel=5e-3, abs=0), name
        for name in ("mesh_force_now", "roller_force_now"):
            assert a[name] == pytest.approx(b[name], abs=5e-3 * b[name].max()), name
        for name in ("crank_angle", "cage_angle", "output_angle", "input_angle"):
            assert a[name] == pytest.approx(b[name], rel=5e-3, abs=1e-5), name


def test_mirrored_speed_and_load_mirror_the_motion(rv20e):
    ahead = in_motion(rv20e.plant)
    back = in_motion(rv20e.plant, input_speed=-2000.0 * RPM, load_torque=-167.0)
    duration = crank_period(ahead) / 2
    pins, rollers, cranks = (-np.arange(n) % n for n in (40, 16, 2))
    for a, b in zip(run_motion(ahead, duration, 36), run_motion(back, duration, 36)):
        assert b.mesh_force == pytest.approx(a.mesh_force[:, pins], abs=1e-4)
        assert b.roller_force == pytest.approx(a.roller_force[:, cranks][:, :, rollers], abs=1e-4)
        assert (b.lag, b.drive_torque, b.output_speed) == pytest.approx((-a.lag, -a.drive_torque, -a.output_speed),
                                                                        rel=1e-6, abs=0)
        assert b.substeps == a.substeps


@pytest.mark.parametrize("carrier_compliance", [0.0, 1e-6, 1e-5], ids="{:g} rad/(N m)".format)
def test_load_swings_at_its_natural_frequency(rv20e, carrier_compliance):
    """f = sqrt(K/J)/(2 pi), K the tangent stiffness of the equilibria with the flange's twist in series."""
    turned = []
    for torque in (166.0, 168.0):
        rigid = records_of(rv20e.plant, input_speed=0.0, load_torque=torque, tolerance=1e-11)
        assert plant.initialise(rigid) == 0
        turned.append(only(rigid).output_angle)
    stiffness = 1.0 / ((turned[0] - turned[1]) / 2.0 + carrier_compliance)
    records = in_motion(rv20e.plant, input_speed=0.0, carrier_compliance=carrier_compliance, **UNDAMPED)
    period = 2.0 * np.pi * np.sqrt(records["load_inertia"][0] / stiffness)
    records["load_torque"] += 1.0
    count = 400
    speed = np.array([r.output_speed for r in run_motion(records, 5 * period, count)])
    time = np.arange(1, count + 1) * 5 * period / count
    before = np.flatnonzero((speed[:-1] <= 0.0) & (speed[1:] > 0.0))
    crossing = time[before] - speed[before] * np.diff(time)[before] / np.diff(speed)[before]
    assert len(crossing) >= 4
    assert np.diff(crossing) == pytest.approx(period, rel=5e-3, abs=0)


def test_torque_on_the_sun_accelerates_all_inertias(rv20e):
    """d(speed)/dt = T/J from rest, averaged over the swinging of the load on the first stage."""
    values = {"input_speed": 0.0, "load_torque": 0.0, "bearing_clearance": 0.0}
    records = in_motion(rv20e.plant, drive=1, input_torque=0.5, load_inertia=0.05, **values)
    series, time = run_motion(records, 0.02, 100), np.arange(1, 101) * 2e-4
    speed = np.array([r.v[-2] for r in series])
    expected = 0.5 / inertia_at_sun(only(records))
    assert np.polyfit(time, speed, 1)[0] == pytest.approx(expected, rel=1e-2, abs=0)
    assert series[-1].output_speed * RATIO == pytest.approx(speed[-1], rel=1e-2, abs=0)
    # All work is in the motion; the first sign of a wrong inertia.
    work = 0.5 * series[-1].input_angle
    assert kinetic_energy(series)[-1] == pytest.approx(work, rel=1e-2, abs=0)


def test_state_restores_to_the_bit(rv20e):
    """All but scratch is the state: after it is put back, with rubbish in the scratch, all repeats."""
    table = rv20e.plant
    records = in_motion(table, damping_law=HYSTERETIC, backlash=10e-6, first_stage_compliance=1e-8)
    step = crank_period(records) / 72
    run_motion(records, 10 * step, 10)
    saved = table.cells(records)[: table.state_cells].copy()
    first = run_motion(records, 10 * step, 10)
    again = table.new_records()
    for variable in table.of_role("scratch"):
        again[variable.name] = -7 if variable.is_integer else np.nan
    table.cells(again)[: table.state_cells] = saved
    for a, b in zip(first, run_motion(again, 10 * step, 10)):
        for variable in table.variables:
            if variable.role != "scratch":
                assert np.array_equal(a[variable.name], b[variable.name]), variable.name


@EVERY_LAW
def test_forces_do_not_depend_on_the_communication_step(rv20e, law):
    """Within the integrator's 1 %."""
    series = []
    for count in (36, 72):
        records = in_motion(rv20e.plant, damping_law=law)
        series.append(run_motion(records, crank_period(records) / 2, count)[count // 36 - 1 :: count // 36])
    for a, b in zip(*series):
        assert a.mesh_force_now == pytest.approx(b.mesh_force_now, abs=1e-2 * b.mesh_force_now.max())
        assert a.roller_force_now == pytest.approx(b.roller_force_now, abs=1e-2 * b.roller_force_now.max())


@EVERY_LAW
@pytest.mark.parametrize("reducer", ["rv20e", "bx40e"])
def test_forces_are_within_one_percent(request, reducer, law):
    """Against ten times tighter error control: means over 5 degrees, of the largest force."""
    table, series = request.getfixturevalue(reducer).plant, []
    for share in (1.0, 0.1):
        records = in_motion(table, damping_law=law)
        records["dynamic_tolerance"] *= share
        series.append(run_motion(records, crank_period(records), 72))
    for a, b in zip(*series):
        assert a.mesh_force == pytest.approx(b.mesh_force, abs=1e-2 * b.mesh_force.max())
        assert a.roller_force == pytest.approx(b.roller_force, abs=1e-2 * b.roller_force.max())


def rough(table, duration, count, change, **values):
    """Records of a run in which ``change(records, step number)`` handles the inputs."""
    records = in_motion(table, **values)
    series = []
    for i in range(count):
        change(records, i)
        series += run_motion(records, duration / count, 1)
    for record in series:
        assert all(np.isfinite(record[name]).all() for name in table.dtype.names if name != "tangent")
    return series


def largest_force(series):
    return max(max(r.mesh_force_now.max(), r.roller_force_now.max()) for r in series)


def assert_energy_balances(series, share):
    """To a share of what was turned over; the integrator damps impacts a little."""
    assert abs(series[-1].energy_error) < share


@EVERY_LAW
def test_speed_ramp_from_rest(rv20e, law):
    """The load goes along: mean drive torque is load plus inertia, reduced."""
    speed, count = 2000.0 * RPM, 400

    def ramp(records, i):
        records["input_speed"] = speed * (i + 1) / count

    series = rough(rv20e.plant, 0.4, count, ramp, damping_law=law, input_speed=0.0)
    assert_energy_balances(series, 1e-4)
    record = series[-1]
    expected = record.load_torque / RATIO + inertia_at_sun(record) * speed / 0.4
    assert np.mean([r.drive_torque for r in series]) == pytest.approx(expected, rel=1e-2, abs=0)
    assert record.output_speed == pytest.approx(speed / RATIO, rel=2e-2, abs=0)
    assert largest_force(series) < 2.0 * 860.0


@EVERY_LAW
def test_load_reverses_through_clearance_and_backlash(rv20e, law):
    def reverse(records, i):
        records["load_torque"] = 167.0 * np.cos(np.pi * min(1.0, max(0.0, (i - 20) / 100)))

    series = rough(rv20e.plant, 0.4, 400, reverse, damping_law=law, backlash=10e-6, first_stage_compliance=1e-8)
    assert_energy_balances(series, 2e-3)
    last = series[-1]
    assert np.mean([r.tooth_force for r in series[:20]]) > 50.0
    assert np.mean([r.tooth_force for r in series[300:]]) < -50.0
    assert np.mean([r.lag for r in series[:20]]) > 1e-4 and np.mean([r.lag for r in series[300:]]) < -1e-4
    assert last.output_angle > series[0].output_angle
    assert largest_force(series) < 4.0 * 860.0


@EVERY_LAW
def test_emergency_stop_within_one_communication_step(rv20e, law):
    """The load's energy goes into the spring of the reducer: T_max = T + omega sqrt(K J)."""
    def stop(records, i):
        if i == 10:
            records["input_speed"] = 0.0

    series = rough(rv20e.plant, 0.04, 80, stop, damping_law=law, load_inertia=0.5)
    assert_energy_balances(series, 1e-2)
    assert series[-1].v[-2] == 0.0
    speed, stiffness = 2000.0 * RPM / RATIO, 1.5e6
    bound = (167.0 + speed * np.sqrt(stiffness * 0.55)) / 167.0
    assert 1.5 * 860.0 < largest_force(series) < bound * 860.0


def test_profile_errors_ramp_through_a_step_and_cost_no_internal_steps(rv20e):
    """Errors that grow and fall from step to step, by 0.1 um, as worn surfaces do; jumps of them cost ten times as much."""
    counts = []
    for swing in (0.0, 1e-7):
        records = in_motion(rv20e.plant)
        record, step = only(records), crank_period(records) / 72
        assemblies = 0
        for i in range(72):
            given = swing * (1.0 + np.sin(i + np.arange(40)))[None, :] * np.ones((2, 1))
            record.mesh_profile_error[:] = given
            assert plant.step(records, i * step, step) == 0
            assert np.array_equal(record.mesh_profile_error, given)
            assemblies += int(record.assemblies)
        counts.append(assemblies)
    assert counts[1] < 3.0 * counts[0]


def test_the_swing_damper_takes_the_swing_alone(rv20e):
    """Amplitudes go with exp(-zeta omega t), zeta = D/(2 omega J); where it has died out the carrier stands as without it."""
    pulled = {"input_speed": 0.0, **UNDAMPED}
    omega = 2.0 * np.pi * 86.3
    records = in_motion(rv20e.plant, **pulled)
    inertia = float(records["load_inertia"][0])
    records["swing_damping"] = 2.0 * 0.05 * omega * inertia
    records["load_torque"] += 1.0
    angle = np.array([r.output_angle for r in run_motion(records, 0.35, 1750)])
    settled = in_motion(rv20e.plant, **{**pulled, "load_torque": float(records["load_torque"][0])})
    rest = only(settled).output_angle
    assert angle[-20:] == pytest.approx(rest, rel=1e-4)
    size = [np.abs(angle[first : first + 100] - rest).max() for first in (50, 350)]
    assert np.log(size[0] / size[1]) == pytest.approx(0.05 * omega * 0.06, rel=0.1)
    assert abs(only(records).energy_error) < 1e-3
