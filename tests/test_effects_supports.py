"""What carries the mesh and stands unevenly: ring stiffness, unequal discs, tilting moment, play over the angle, a seat with memory."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from stand import crank_period, in_equilibrium, in_motion, only, records_of
from twin import Twin

from discrepancy.catalogue.signature import ARCSEC, conditions, loop_width, new_bench, observed, rated
from reducers.reducer import load_reducer
from rv_plant import plant
from rv_plant.effects import support_hysteresis
from studies.coupled import COLUMNS

UM = 1e-6
PINS, LOBES, RATIO = 40, 39, 121
ETA = 2.0 * np.pi * np.arange(PINS) / PINS
LEVER, CRANK_PER_OUTPUT = 21e-3 * math.cos(math.radians(20.0)), LOBES + 1.0 + 1.0 / 3.0
SAMPLES = 1024


@pytest.fixture(scope="module")
def bench():
    return new_bench()


def orders(bench, values, at, base=None):
    """Complex amplitudes [arcsec] of the orders that values bring into the transmission error, over the output's angle."""
    angles = at.direction * np.linspace(0.0, 2.0 * np.pi, SAMPLES, endpoint=False)
    series = [bench.running(at, v, angles)[:, COLUMNS.index("transmission_error")] for v in ({**(base or {}), **values}, base or {})]
    change = (series[0] - series[1]) * ARCSEC
    # Backwards the samples after the first one come in the other order.
    return 2.0 * np.fft.rfft(change if at.direction > 0 else np.roll(change[::-1], 1)) / SAMPLES


def forces_by(record, ring=0.0, stiffness=1.0):
    """Forces of discs on pins by an independent twin, ring off centre by ``ring`` (complex, per disc)."""
    twin = Twin(record, float(record.ideal_output), float(record.cage))
    pins = twin.place(np.array(record.z)) or twin.pin_centre + np.reshape(ring, (-1, 1))
    place = twin.place

    def displaced(z):
        place(z)
        twin.pin_centre = pins

    twin.place = displaced
    depth = np.maximum(twin.penetrations(np.array(record.z))[0], 0.0)
    return record.mesh_constant * stiffness * depth**record.mesh_exponent


def test_soft_pins_carry_less(rv20e):
    """F = K (1 + c cos 2 eta + s sin 2 eta) d^n with the penetrations of the twin, in equilibrium."""
    r = in_equilibrium(rv20e.plant, 0.37, 0.2, ring_stiffness_cos=0.3, ring_stiffness_sin=-0.2)
    stiffness = 1.0 + 0.3 * np.cos(2.0 * ETA) - 0.2 * np.sin(2.0 * ETA)
    assert np.allclose(r.mesh_force_now, forces_by(r, stiffness=stiffness), rtol=1e-6, atol=1e-4)
    assert not np.allclose(r.mesh_force_now, forces_by(r), rtol=1e-2, atol=1.0)


def test_ring_stiffness_is_order_78_in_proportion_to_torque(bench):
    at = rated(bench)
    found = [orders(bench, {"ring_stiffness_cos": 0.1}, replace(at, load=share * at.load)) for share in (1.0, 0.5, 0.25)]
    sizes = [abs(f[2 * LOBES]) for f in found]
    assert sizes[0] > 3.0 * np.delete(abs(found[0][1:]), 2 * LOBES - 1).max()
    # Force goes with the depth to the power 10/9, so the depth with the force to the power 0.9.
    for k, share in ((1, 0.5), (2, 0.25)):
        assert share < sizes[k] / sizes[0] < share**0.8
    assert abs(orders(bench, {"ring_stiffness_cos": 0.1}, replace(at, load=0.0))).max() < 1e-3
    oval = [abs(orders(bench, {"pin_ring_ovality": 3 * UM}, replace(at, load=share * at.load))[2 * LOBES]) for share in (1.0, 0.25)]
    assert oval[1] > 0.7 * oval[0]


def test_phase_of_the_soft_place_is_that_of_the_ring(bench):
    """Turning the pattern by 45 degrees exchanges cosine and sine: a quarter period of order 78."""
    cosine, sine = (orders(bench, {f"ring_stiffness_{part}": 0.1}, rated(bench))[2 * LOBES] for part in ("cos", "sin"))
    assert abs(sine) == pytest.approx(abs(cosine), rel=0.05)
    assert abs((sine / cosine).real) < 0.1 * abs(sine / cosine)


def test_discs_see_the_ring_where_it_stands_for_them(rv20e):
    r = in_equilibrium(rv20e.plant, 0.37, 0.2, disc_offset_x=6 * UM, disc_offset_y=-4 * UM)
    offset = (6 - 4j) * UM
    assert np.allclose(r.mesh_force_now, forces_by(r, [-0.5 * offset, 0.5 * offset]), rtol=1e-6, atol=1e-4)
    common = in_equilibrium(rv20e.plant, 0.37, 0.2, disc_offset_x=6 * UM, pin_ring_runout=3 * UM)
    moved = forces_by(common, [-3 * UM, 3 * UM])
    # The first disc sees the ring where it was, the other one twice as far off.
    runout = 3 * UM * np.ones(2)
    assert not np.allclose(moved, common.mesh_force_now, rtol=1e-3)
    assert np.allclose(forces_by(common, runout + np.array([-3 * UM, 3 * UM])), common.mesh_force_now, rtol=1e-6, atol=1e-4)


def test_unequal_discs_are_parts_of_opposite_errors(rv20e):
    effect = in_equilibrium(rv20e.plant, 0.37, 0.2, disc_gap_difference=4 * UM, disc_pitch_difference=2 * UM, disc_clearance_difference=1 * UM)
    sign = np.array([[-0.5], [0.5]])
    parts = in_equilibrium(rv20e.plant, 0.37, 0.2, lobe_profile_error=4 * UM * sign * np.ones(LOBES), lobe_pitch_error=2 * UM * sign * np.ones(LOBES),
                           roller_profile_error=1 * UM * sign[..., None] * np.ones((2, 16)))
    for name in ("mesh_force_now", "roller_force_now"):
        assert np.allclose(effect[name], parts[name], rtol=1e-6, atol=1e-5)


def test_only_unequal_discs_show_order_39(bench):
    """A ring off centre for both cancels; for one more than for the other it does not; unequal teeth let it through."""
    at, runout = rated(bench), {"pin_ring_runout": 5 * UM}
    together, apart = (abs(orders(bench, v, at)) for v in (runout, {"disc_offset_x": 4 * UM}))
    assert together[LOBES] < 0.1 and apart[LOBES] > 10.0 and apart[LOBES] > 10.0 * np.delete(apart[1:], LOBES - 1).max()
    low = abs(orders(bench, {"disc_offset_x": 4 * UM}, replace(at, load=0.25 * at.load)))[LOBES]
    assert low == pytest.approx(apart[LOBES], rel=0.05)
    teeth = {"disc_gap_difference": 2 * UM}
    assert abs(orders(bench, teeth, at))[LOBES] < 0.05
    assert abs(orders(bench, teeth, at, runout))[LOBES] > 1.0


def test_unequal_teeth_move_load_from_one_disc_to_the_other(rv20e):
    thick, thin = in_equilibrium(rv20e.plant, 0.1, disc_gap_difference=4 * UM).mesh_force_now.sum(axis=1)
    assert thick > 1.3 * thin


def test_one_disc_has_no_other():
    one = load_reducer("cycloidal-actuator").plant
    plain, found = (in_equilibrium(one, 0.1, load_torque=1.0, **v) for v in ({}, {"disc_offset_x": 5 * UM, "disc_gap_difference": 5 * UM}))
    assert np.array_equal(plain.mesh_force_now, found.mesh_force_now)


def test_tilt_displaces_the_discs_by_their_levers(rv20e):
    """c M l/2 either way: the twin's forces with the ring there."""
    share, load, compliance, spacing = 2.0, 167.0, 7.8e-7, 10e-3
    r = in_equilibrium(rv20e.plant, 0.37, 0.2, tilting_share_x=share, tilting_moment_y=300.0, load_torque=load)
    shift = compliance * spacing / 2.0 * (share * load + 300.0j)
    assert np.allclose(r.mesh_force_now, forces_by(r, [shift, -shift]), rtol=1e-6, atol=1e-4)


def test_moment_of_the_load_is_order_39_in_proportion_to_it(bench):
    at, values = rated(bench), {"tilting_share_x": 2.0}
    full, quarter = (orders(bench, values, replace(at, load=share * at.load))[LOBES] for share in (1.0, 0.25))
    assert abs(quarter) == pytest.approx(0.25 * abs(full), rel=0.03) and abs(full) > 3.0
    constant = [orders(bench, {"tilting_moment_x": 300.0}, replace(at, load=share * at.load))[LOBES] for share in (1.0, 0.25)]
    assert abs(constant[1]) == pytest.approx(abs(constant[0]), rel=0.03)
    # As discs that are misaligned with the ring by as much, the other way.
    offset = orders(bench, {"disc_offset_x": -7.8e-7 * 10e-3 * 300.0}, at)[LOBES]
    assert constant[0] == pytest.approx(offset, rel=1e-3)


def test_loaded_main_bearings_brake(bench):
    """f |M| at the output, over the ratio at the input, without load torque too."""
    at, values = replace(rated(bench), load=0.0), {"tilting_moment_x": 300.0, "tilting_moment_y": -400.0}
    assert observed(bench, "input_torque", at, values) == pytest.approx(4e-3 * 500.0 / RATIO, rel=1e-3)


def test_play_over_the_angle_has_the_sign_of_the_torque(bench):
    at, play = rated(bench), {"first_stage_play_cos": 20 * UM}
    both_ways = [orders(bench, play, replace(at, direction=d))[40] for d in (1, -1)]
    expected = 0.5 * 20 * UM / (2.0 * LEVER * CRANK_PER_OUTPUT) * ARCSEC
    for found, sign in zip(both_ways, (-1.0, 1.0)):
        assert found == pytest.approx(sign * expected, rel=0.08)
    runout = [orders(bench, {"planet_runout": 20 * UM}, replace(at, direction=d))[40] for d in (1, -1)]
    assert runout[1] == pytest.approx(runout[0], rel=0.1)
    light = orders(bench, play, replace(at, load=0.25 * at.load))[40]
    assert light == pytest.approx(both_ways[0], rel=0.02)


def test_play_in_motion_is_that_at_rest(rv20e):
    """Sun and planet in motion have the same play: the planet's crank stands back by half of it either way."""
    for load in (120.0, -120.0):
        still = [in_equilibrium(rv20e.plant, load_torque=load, first_stage_play_cos=b).transmission_error for b in (0.0, 40 * UM)]
        moving = []
        for b in (0.0, 40 * UM):
            records = in_motion(rv20e.plant, load_torque=load, first_stage_play_cos=b, input_speed=1e-3, joint_damping_time=1e-4)
            for _ in range(40):
                assert plant.step(records, 0.0, 5e-5) == 0
            moving.append(float(only(records).transmission_error))
        assert moving[1] - moving[0] == pytest.approx(still[1] - still[0], rel=0.15)


def seat(c, slip, ratio):
    return {"support_slip_compliance": c, "support_slip_torque": slip, "support_stick_ratio": ratio}


def held(table, torques, values):
    """(turning of the pin ring, torque on it) under output torques in order, input held."""
    records = records_of(table, input_speed=0.0, load_torque=torques[0], **values)
    assert plant.initialise(records) == 0
    found = []
    for torque in torques:
        records["load_torque"] = torque
        assert plant.step(records, 0.0, 1.0) == 0
        r = only(records)
        found.append((float(r.z[-1]), float(r.z[-1]) / values["support_slip_compliance"] + float(r.support_force)))
    return np.array(found).T


def there_and_back(peak, steps=24):
    up = np.linspace(0.0, peak, steps + 1)
    return np.concatenate([up[1:], up[-2::-1], -up[1:], -up[-2::-1], up[1:]])


def test_friction_of_the_seat_follows_dahls_equation(rv20e):
    """Along the ring's way, with its reversals: F by small steps of dF/dpsi = rho/c (1 - F/F_s sign)."""
    c, slip, ratio = 2e-7, 30.0, 5.0
    psi, torque = held(rv20e.plant, there_and_back(167.0), seat(c, slip, ratio))
    force, at, found = 0.0, 0.0, []
    for target in psi:
        step = (target - at) / 4000
        for _ in range(4000):
            middle = force + 0.5 * step * ratio / c * (1.0 - force / slip * math.copysign(1.0, step))
            force += step * ratio / c * (1.0 - middle / slip * math.copysign(1.0, step))
        at = target
        found.append(force)
    assert torque - psi / c == pytest.approx(np.array(found), abs=1e-3 * slip)
    # The housing holds what the output's torque leaves to it.
    assert abs(torque).max() == pytest.approx(167.0 * (1.0 - 1.0 / RATIO), rel=0.01)


def test_loop_of_a_slipping_seat_is_as_wide_as_friction_makes_it(rv20e):
    """Between large torques F is +-F_s: the branches lie 2 c F_s apart; small torques turn it 1/(1 + rho) as far."""
    c, slip = 4e-7, 5.0
    way = there_and_back(167.0)
    psi, _ = held(rv20e.plant, way, seat(c, slip, 9.0))
    n = len(way) // 5
    down, up = psi[2 * n - 1], psi[4 * n - 1]
    assert way[2 * n - 1] == way[4 * n - 1] == 0.0
    assert down - up == pytest.approx(2.0 * c * slip, rel=0.02) or up - down == pytest.approx(2.0 * c * slip, rel=0.02)
    stuck, torque = held(rv20e.plant, np.array([0.05]), seat(c, 500.0, 9.0))
    assert stuck[0] == pytest.approx(c * torque[0] / 10.0, rel=1e-3)


def test_seat_does_not_see_the_steps(rv20e):
    """A way in one step or in fifty: the same place and friction."""
    values = seat(2e-7, 30.0, 5.0)
    fine = held(rv20e.plant, np.concatenate([np.linspace(0.0, 150.0, 50), np.linspace(150.0, -80.0, 50)]), values)
    coarse = held(rv20e.plant, np.array([0.0, 150.0, -80.0]), values)
    assert coarse[:, -1] == pytest.approx(fine[:, -1], rel=1e-6)


def test_seat_loses_work_at_every_reversal_and_closes_its_loop(rv20e):
    c, slip, ratio = 2e-7, 30.0, 5.0
    way = there_and_back(100.0, 60)
    psi, torque = held(rv20e.plant, np.concatenate([way, way]), seat(c, slip, ratio))
    period = 240
    area = abs(np.trapezoid(torque[-period - 1 :], psi[-period - 1 :]))
    assert psi[-1] == pytest.approx(psi[-period - 1], rel=2e-3)
    # Two branches of Dahl's law from -F_0 to F_0 over the ring's stroke.
    stroke = np.ptp(psi[-period:])
    start = -slip * math.tanh(0.5 * ratio * stroke / (c * slip))
    branch, _ = quad(lambda x: slip + (start - slip) * math.exp(-ratio * x / (c * slip)), 0.0, stroke)
    assert area == pytest.approx(2.0 * branch, rel=0.01)


@pytest.mark.parametrize("rest", [0.0, 1e-7, 1e-6])
def test_tangent_of_the_seat_is_its_derivative(rv20e, rest):
    r = in_equilibrium(rv20e.plant, ring_seat_compliance=rest, **seat(2e-7, 400.0, 5.0))

    def torque_at(turn):
        return (turn + 2e-7 * support_hysteresis.seat_at(r, turn)[0]) / (2e-7 + rest)

    for turn in (2.0 * r.z[-1], -r.z[-1], 0.1 * r.z[-1]):
        step = 1e-4 * abs(r.z[-1])
        force, stiffness, psi = support_hysteresis.seat_at(r, turn)
        slope = (torque_at(turn + step) - torque_at(turn - step)) / (2.0 * step)
        assert (1.0 / 2e-7 + stiffness) / (1.0 + rest * (1.0 / 2e-7 + stiffness)) == pytest.approx(slope, rel=1e-6)
        # The seat's torque is what the rest yields to.
        assert psi + rest * (psi / 2e-7 + force) == pytest.approx(turn, rel=1e-12)
        assert torque_at(turn) == pytest.approx(psi / 2e-7 + force, rel=1e-9)


def test_what_else_yields_under_the_ring_lies_in_series_with_the_seat(rv20e):
    """With c_0 under it the ring stands c_0 M further on every branch: the loop is no wider, and c_0 sticks nowhere."""
    way, rest = there_and_back(167.0), 3e-7
    alone, torque = held(rv20e.plant, way, seat(4e-7, 20.0, 6.0))
    records = records_of(rv20e.plant, input_speed=0.0, load_torque=way[0], ring_seat_compliance=rest, **seat(4e-7, 20.0, 6.0))
    assert plant.initialise(records) == 0
    for place, moment, load in zip(alone, torque, way):
        records["load_torque"] = load
        assert plant.step(records, 0.0, 1.0) == 0
        assert float(only(records).z[-1]) == pytest.approx(place + rest * moment, abs=2e-3 * np.ptp(alone))


def test_ring_bears_what_friction_of_its_pins_holds(rv20e):
    """Moments on the whole: with the input held, friction changes the ring's torque by no more than the input's, load over ratio."""
    soft = load_reducer("RV20E-121")
    way = there_and_back(167.0)
    records = records_of(soft.plant, input_speed=0.0, load_torque=way[0], friction_coefficient=0.05)
    assert plant.initialise(records) == 0
    for load in way:
        records["load_torque"] = load
        assert plant.step(records, 0.0, 1.0) == 0
        r = only(records)
        assert float(r.z[-1] / r.compliance[-1]) == pytest.approx(-load * (1.0 - 1.0 / RATIO), abs=0.3 * 167.0 / RATIO)
    assert float(r.friction_torque) > 10.0


def test_turning_that_reverses_its_torque_remembers(rv20e):
    """The same input angle and torque after a larger torque either way: the ring stands on two sides."""
    found = []
    for before in (160.0, -160.0):
        records = records_of(rv20e.plant, load_torque=before, **seat(4e-7, 20.0, 5.0))
        assert plant.initialise(records) == 0
        step = crank_period(records) / 72.0
        for torque in (before, 0.5 * before, 40.0, 40.0):
            records["load_torque"] = torque
            assert plant.step(records, 0.0, step) == 0
        found.append(float(only(records).z[-1]))
    assert abs(found[0] - found[1]) > 4e-7 * 20.0


def test_loop_of_the_bench_shows_the_seat(bench):
    at = conditions(bench)["rated"]
    # Where half the torque is reached the seat slips both ways: 2 c F_s less what is not yet there.
    assert 0.5 < loop_width(bench, at, seat(2e-7, 20.0, 8.0)) / (2.0 * 2e-7 * 20.0) < 1.05
