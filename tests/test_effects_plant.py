"""Friction, drag, heat, springs, first stage, unbalance, skidding, spall and grease of the plant: laws and signatures."""

import math
from dataclasses import replace

import numpy as np
import pytest
from stand import crank_period, in_equilibrium, only, records_of, run_plant
from twin import Twin

from discrepancy.catalogue.signature import ARCSEC, amplitudes, cage_order, conditions, loop_width, new_bench, observed, rated, turn
from rv_plant import plant
from rv_plant.effects import stribeck_friction

UM = 1e-6
HOUR = 3600.0
LOBES, RATIO = 39, 121
# Planet's pitch radius times the cosine of the pressure angle, and cranks' turning per output turning, sun held.
LEVER, CRANK_PER_OUTPUT = 21e-3 * math.cos(math.radians(20.0)), LOBES + 1.0 + 1.0 / 3.0


@pytest.fixture(scope="module")
def bench():
    return new_bench()


def torque(bench, values, **setting):
    return observed(bench, "input_torque", replace(rated(bench), **setting), values)


def sliding_and_arms(record, angle):
    """Sliding speed and friction arm at every pin [disc, pin], from rigid bodies that move as ideal kinematics wants."""
    twin = Twin(record, angle, float(record.cage))
    twin.penetrations(np.array(record.z))
    contact = twin.pin_centre - record.pin_radius * twin.normal - twin.disc_centre[:, None]
    crank = float(record.crank_speed)
    velocity = 1j * crank * twin.disc_centre[:, None] - 1j * crank / LOBES * contact
    return abs((velocity * (1j * twin.normal).conj()).real), abs((contact * twin.normal.conj()).real)


def test_power_lost_is_friction_times_force_times_sliding(rv20e):
    mu, excess, viscous, limit, bearing = 0.04, 0.08, 0.1, 0.02, 0.003
    r = in_equilibrium(rv20e.plant, 0.2, friction_coefficient=mu, friction_excess=excess, friction_viscous=viscous,
                       stribeck_speed=limit, bearing_friction=bearing)
    v, _ = sliding_and_arms(r, 0.2)
    mesh = ((mu + excess * np.exp(-v / limit) + viscous * v) * r.mesh_force_now * v).sum()
    rolling = bearing * r.roller_force_now.sum() * r.inner_race_radius * abs(r.crank_speed) * (1.0 + 1.0 / LOBES)
    assert r.power_loss == pytest.approx(mesh + rolling, rel=2e-3)
    clean = in_equilibrium(rv20e.plant, 0.2)
    assert r.drive_torque - clean.drive_torque == pytest.approx(r.power_loss / r.input_speed, rel=1e-9)


def test_torque_has_a_minimum_over_speed(bench):
    values = {"friction_coefficient": 0.04, "friction_excess": 0.08, "friction_viscous": 0.2}
    slow, middle, fast = (torque(bench, values, speed=s * bench.rated_speed) for s in (0.02, 0.5, 3.0))
    assert middle < slow - 0.05 and middle < fast - 0.02


def test_friction_goes_with_load(bench):
    values = {"friction_coefficient": 0.06}
    loss = [torque(bench, values, load=x) - torque(bench, {}, load=x) for x in (40.0, 80.0, 160.0)]
    assert loss[0] / 40.0 == pytest.approx(loss[2] / 160.0, rel=0.2) and loss[0] < loss[1] < loss[2]


def held(table, torques, **values):
    """Records with the input held, the torque brought up through ``torques``."""
    records = records_of(table, input_speed=0.0, load_torque=torques[0], **values)
    assert plant.initialise(records) == 0
    found = []
    for value in torques:
        records["load_torque"] = value
        assert plant.step(records, 0.0, 1.0) == 0
        found.append(only(records).copy())
    return found


def test_slipping_elements_carry_the_friction_of_all_contacts(rv20e):
    """Fully slipping, the contacts see the torque less mu sum F |arm|."""
    mu, rising = 0.06, np.linspace(0.0, 167.0, 200)
    r = held(rv20e.plant, rising, friction_coefficient=mu, presliding_angle=1e-7)[-1]
    _, arms = sliding_and_arms(r, 0.0)
    assert r.friction_torque == pytest.approx(mu * (r.mesh_force_now * arms).sum(), rel=5e-3)
    free = held(rv20e.plant, [0.0, 167.0 - r.friction_torque])[-1]
    assert r.transmission_error == pytest.approx(free.transmission_error, rel=1e-4)


def loop_area(bench, values, steps=40):
    """Work lost in the second of two loops [mJ], and how far it stays open [arcsec]; no clearance."""
    up = np.linspace(0.0, 1.0, steps + 1)
    one = np.concatenate([up[1:], up[-2::-1], -up[1:], -up[-2::-1]]) * bench.rated_load
    way = np.concatenate([[0.0], one, one])
    turning = bench.held(rated(bench), {"needle_clearance_added": -2.5 * UM, **values}, way)
    last = slice(len(one), None)
    return 1e3 * np.trapezoid(way[last], turning[last]), (turning[-1] - turning[len(one)]) * ARCSEC


def test_loops_close_and_lose_work_in_proportion_to_friction(bench):
    none = loop_area(bench, {})[0]
    areas = []
    for mu in (0.03, 0.06):
        area, opening = loop_area(bench, {"friction_coefficient": mu})
        assert abs(opening) < 1e-3
        areas.append(area)
    assert abs(none) < 1e-3 * areas[0]
    assert areas[1] / areas[0] == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize("presliding", [1e-6, 2e-5, 2e-4])
def test_loops_never_give_energy(bench, presliding):
    """Stiffness of stuck contacts grows and falls with load; none of it may be gained."""
    area, opening = loop_area(bench, {"friction_coefficient": 0.06, "presliding_angle": presliding})
    assert area > 0.0 and abs(opening) < 0.02


def test_elements_yield_one_after_the_other(rv20e):
    """The kernel's torque along a turning back from full slip is that of the Iwan sum, doubled (Masing)."""
    records = records_of(rv20e.plant, input_speed=0.0, load_torque=0.0, friction_coefficient=0.06)
    assert plant.initialise(records) == 0
    for value in np.linspace(0.0, 167.0, 60):
        records["load_torque"] = value
        assert plant.step(records, 0.0, 1.0) == 0
    r = only(records)
    carrier, limit, theta, elements = 6, float(r.friction_torque), float(r.presliding_angle), len(r.slider)
    yields = 2.0 * theta * np.arange(1, elements + 1) / elements
    start = float(r.z[carrier])

    def torque_after(back):
        r.z[carrier] = start + back
        r.residual_vector[:] = 0.0
        stribeck_friction.hold(records[0])
        return float(r.residual_vector[carrier])

    # The output has turned backwards under the load; every element slips.
    assert torque_after(0.0) == pytest.approx(-limit, rel=1e-6)
    for x in np.linspace(0.0, 5.0 * theta, 20):
        iwan = limit / elements * np.minimum(0.5 * x / yields, 1.0).sum()
        assert torque_after(x) + limit == pytest.approx(2.0 * iwan, rel=1e-6, abs=1e-9)


def test_loop_widens_with_load(bench):
    """Slipping contacts: twice the friction torque over the stiffness, at a quarter and at three quarters of the torque."""
    up = np.linspace(0.0, 1.0, 33)
    way = np.concatenate([up, up[-2::-1], -up[1:], -up[-2::-1], up[1:]]) * bench.rated_load
    widths = {}
    for mu in (0.0, 0.06):
        turning = bench.held(rated(bench), {"friction_coefficient": mu, "presliding_angle": 1e-6}, way) * ARCSEC
        down, again = turning[32:65][::-1], turning[-33:]
        widths[mu] = down[[8, 24]] - again[[8, 24]]
    assert np.abs(widths[0.0]).max() < 1e-3
    assert 2.0 < widths[0.06][1] / widths[0.06][0] < 3.5
    assert loop_width(bench, rated(bench), {"friction_coefficient": 0.06}) * ARCSEC > 1.0


def test_drag_follows_speed_and_temperature_but_not_load(bench):
    values = {"seal_torque": 0.1, "churning_torque": 0.2, "churning_speed": bench.rated_speed}

    def drag(**setting):
        return torque(bench, values, **setting) - torque(bench, {}, **setting)

    assert drag() == pytest.approx(0.3, rel=1e-9)
    assert drag(speed=0.1 * bench.rated_speed) == pytest.approx(0.1 + 0.2 * 0.1 ** (2 / 3), rel=1e-6)
    assert drag(temperature=333.15) == pytest.approx(0.1 + 0.2 * math.exp(-0.035 * 40.0) ** (2 / 3), rel=1e-6)
    assert drag(load=0.0) == pytest.approx(0.3, rel=1e-6) and drag(load=250.0) == pytest.approx(0.3, rel=1e-6)


def test_old_grease_churns_by_its_viscosity(bench):
    """Loss of grease 2,500 h old over that of new grease: exp(g t/t_a)^(2/3)."""
    values = {"churning_torque": 0.2, "grease_ageing": 0.7, "grease_life": 5000.0 * HOUR}
    old, new = (bench.average("power_loss", replace(rated(bench), hours=h * HOUR), values) for h in (2500.0, 0.0))
    assert old / new == pytest.approx(math.exp(0.35) ** (2 / 3), rel=1e-4)


def test_heat_opens_the_gap_of_a_larger_pin_circle(rv20e):
    warm = in_equilibrium(rv20e.plant, 0.3, thermal_expansion=2e-6, temperature=313.15)
    wide = in_equilibrium(rv20e.plant, 0.3, pin_position_error_radial=2e-6 * 20.0 * 52e-3)
    assert np.allclose(warm.mesh_force_now, wide.mesh_force_now, rtol=1e-6, atol=1e-5)
    assert abs(warm.lag - in_equilibrium(rv20e.plant, 0.3).lag) * ARCSEC > 5.0


def test_warming_has_the_time_constant(rv20e):
    tau, resistance = 1800.0, 0.5
    records = records_of(rv20e.plant, thermal_resistance=resistance, thermal_time=tau, seal_torque=0.3, input_speed=1e-3)
    assert plant.initialise(records) == 0
    power = 0.3 * 1e-3
    for _ in range(20):
        assert plant.step(records, 0.0, 90.0) == 0
    risen = float(records["reducer_temperature"][0]) - 293.15
    assert risen == pytest.approx(resistance * power * (1.0 - math.exp(-1.0)), rel=1e-6)


def test_steady_warming_follows_the_loss(bench):
    values = {"thermal_resistance": 0.5, "friction_coefficient": 0.06}
    warm, loss = (bench.average(name, rated(bench), values) for name in ("reducer_temperature", "power_loss"))
    assert warm - 293.15 == pytest.approx(0.5 * loss, rel=5e-3)


def test_only_expansion_shows_at_standstill_hot_against_cold(bench):
    hot = conditions(bench)["40 K warmer"]
    for values, differs in (({"thermal_expansion": 2e-6}, True), ({"friction_coefficient": 0.06}, False), ({"churning_torque": 0.3}, False)):
        change = observed(bench, "lost_motion", hot, values) - observed(bench, "lost_motion", rated(bench), values)
        assert (abs(change) * ARCSEC > 5.0) == differs


def test_springs_act_in_series_and_linearly(bench):
    """Twist c T at the output; for the housing the ring's torque T (1 - 1/121), felt by the output with the same share."""
    loads = np.array([0.0, 20.0, 83.5, 167.0])
    plain = bench.held(rated(bench), {}, loads)
    for name, share in (("carrier_compliance", 1.0), ("housing_compliance", (1.0 - 1.0 / RATIO) ** 2)):
        soft = bench.held(rated(bench), {name: 1e-6}, loads)
        assert np.allclose((soft - plain)[1:], share * 1e-6 * loads[1:], rtol=5e-3)


def test_crank_supports_bring_the_printed_stiffness_to_the_catalogue(rv20e):
    """Stiffnesses taken literally, 199 N m/arcmin, with 1.4e8 N/m per crank: some 49."""
    lag = [in_equilibrium(rv20e.plant, 0.0, load_torque=t, stiffness_reading=1, crank_support_compliance=1.0 / 1.4e8).lag for t in (83.5, 167.0)]
    assert 83.5 / ((lag[1] - lag[0]) * ARCSEC / 60.0) == pytest.approx(49.0, rel=0.07)


@pytest.mark.parametrize("values, order, size", [
    ({"tooth_error": 10 * UM}, 1440, 10 * UM), ({"planet_runout": 20 * UM}, 40, 10 * UM),
], ids=["tooth error", "planet"])
def test_first_stage_shows_reduced_by_the_second(bench, values, order, size):
    """One of two planets counts half; the same at any load."""
    expected = size / LEVER / CRANK_PER_OUTPUT * ARCSEC
    for c in ("rated", "load 25 %"):
        assert amplitudes(turn(bench, conditions(bench)[c], values) * ARCSEC)[order] == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("values", [{"tooth_error": 10 * UM}, {"sun_runout": 50 * UM, "planet_runout": 50 * UM}], ids=["teeth", "run-out"])
def test_first_stage_errors_do_no_net_work_in_a_turn(bench, values):
    """Their torque at the input ripples, but over a turn of the output the input's work is the load's."""
    c = rated(bench)
    torque = turn(bench, c, values, "drive_torque")
    ripple = torque - turn(bench, c, {}, "drive_torque")
    assert torque.mean() * RATIO == pytest.approx(c.load, rel=1e-4)
    assert np.std(ripple) > 1e-4 * torque.mean()


def test_tooth_error_makes_the_input_torque_follow_the_speed_of_the_output(bench):
    """Nearly rigid: T_in = T_out d(theta_out)/d(theta_in); springs take up the rest of the ripple's power."""
    c = rated(bench)
    values = {"tooth_error": 10 * UM}
    ripple = amplitudes(turn(bench, c, values, "drive_torque"))[1440]
    assert ripple == pytest.approx(c.load / RATIO * 1440 * 10 * UM / LEVER / CRANK_PER_OUTPUT, rel=0.02)


def test_play_adds_to_lost_motion(bench):
    added = observed(bench, "lost_motion", rated(bench), {"backlash": 50 * UM}) - observed(bench, "lost_motion", rated(bench), {})
    assert added == pytest.approx(50 * UM / LEVER / CRANK_PER_OUTPUT, rel=0.02)


def test_sun_off_centre_moves_load_between_the_cranks(rv20e, bench):
    """Opposite planets: order 120 of their shares, which cancels at the output."""
    shares = [np.diff(r.tooth_force)[0] for r in run_plant(rv20e.plant, LOBES, 12, sun_runout=20 * UM, largest_crank_step=1.0)]
    clean = [np.diff(r.tooth_force)[0] for r in run_plant(rv20e.plant, LOBES, 12, largest_crank_step=1.0)]
    assert amplitudes(np.array(shares))[120] > 5.0 > 20.0 * amplitudes(np.array(clean))[120]
    assert amplitudes(turn(bench, rated(bench), {"sun_runout": 20 * UM}) * ARCSEC)[120] < 0.05


def test_unbalance_shakes_the_housing_with_the_square_of_speed(bench):
    force = 0.387 * 0.9e-3 * (bench.rated_speed * LOBES / RATIO) ** 2
    at = conditions(bench)
    for c, times in (("rated", 1.0), ("speed 200 %", 4.0), ("load 25 %", 1.0)):
        found = amplitudes(turn(bench, at[c], {"unbalance": 0.387 * 0.9e-3}, "housing_force_x"))
        assert found[39] == pytest.approx(times * force, rel=1e-3)
    assert force == pytest.approx(1.6, rel=0.02)


def test_skidding_slows_the_cage_at_low_load(bench):
    at, values = conditions(bench), {"skid_share": 0.2, "skid_load": 500.0}
    pure = cage_order(bench, at["rated"], {})
    assert pure == pytest.approx(40.0 * 10.25 / 23.5, rel=1e-3)
    slips = [1.0 - cage_order(bench, at[c], values) / pure for c in ("rated", "load 10 %", "no load")]
    assert slips[0] < 0.01 < slips[1] < slips[2] <= 0.2 + 1e-9


def test_skidding_follows_the_mean_load_of_a_bearing(rv20e):
    r = in_equilibrium(rv20e.plant, 0.1, load_torque=30.0, skid_share=0.2, skid_load=500.0)
    mean = r.roller_force_now.sum() / 4.0
    assert r.cage_share == pytest.approx(1.0 - 0.2 * math.exp(-mean / 500.0), rel=1e-9)


@pytest.mark.parametrize("depth, passings", [("spall_depth", 361), ("spall_depth_outer", 279)])
def test_spall_shows_when_rollers_pass(bench, depth, passings):
    values = {depth: 10 * UM}
    with_pit, without = (turn(bench, rated(bench), v) * ARCSEC for v in (values, {}))
    orders = amplitudes(with_pit - without)
    assert orders[passings] > 0.9 * max(np.delete(orders[100:600], passings - 100)) and orders[2 * passings] > 0.3 * orders[passings]
    assert abs(np.mean(with_pit - without)) < 0.5
    # Bursts: peaked far above a sine.
    burst = with_pit - without
    assert np.mean((burst - burst.mean()) ** 4) / np.var(burst) ** 2 > 5.0


def test_spall_takes_only_from_rollers_over_the_pit(rv20e):
    width, place = 0.3, 4.7124
    for cage in np.linspace(0.0, 2.0 * math.pi / 16, 12):
        r = in_equilibrium(rv20e.plant, 0.0, cage, spall_depth_outer=10 * UM, spall_width=width)
        x = (cage + 2.0 * math.pi * np.arange(16) / 16 - place + math.pi) % (2.0 * math.pi) - math.pi
        pit = np.where(abs(x) < 0.5 * width, 10 * UM * np.cos(math.pi * x / width) ** 2, 0.0)
        assert np.allclose(r.roller_gap_now[0, 0], pit, atol=1e-12)
        assert not r.roller_gap_now[1].any() and not r.roller_gap_now[0, 1].any()


def test_effects_act_in_motion_too(rv20e):
    """Sun torque in motion carries friction and drag: within a few percent of the quasi-static loss."""
    values = {"friction_coefficient": 0.06, "seal_torque": 0.1}
    added = []
    for v in ({}, values):
        records = records_of(rv20e.plant, fidelity=1, **v)
        assert plant.initialise(records) == 0
        found = []
        for _i in range(60):
            assert plant.step(records, 0.0, crank_period(records) / 500.0) == 0
            found.append(float(records["drive_torque"][0]))
        added.append(np.mean(found[20:]))
    still = in_equilibrium(rv20e.plant, **values).drive_torque - in_equilibrium(rv20e.plant).drive_torque
    assert added[1] - added[0] == pytest.approx(still, rel=0.1)
