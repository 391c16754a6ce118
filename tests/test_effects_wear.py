"""Effects of the wear unit: laws against plain computation, and how wear goes with load, speed, temperature and time."""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq
from stand import SHARED, crank_period, exchange, only, records_of

from discrepancy.catalogue.signature import conditions, new_bench, worn
from rv_plant import plant
from wear_fmu import accumulator
from wear_fmu.effects import (
    edge_loading,
    grease_ageing,
    hardness_gradient,
    load_exponent,
    lubrication_regime,
    roller_skidding,
    running_in,
)

HOUR = 3600.0
FLANK, INNER, OUTER = 0, 1, 2
VOLUMES = ("flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume")


@pytest.fixture(scope="module")
def bench():
    return new_bench()


@pytest.fixture(scope="module")
def steady(rv20e):
    """Step [s] and plant record of constant forces."""
    records = records_of(rv20e.plant)
    assert plant.initialise(records) == 0
    return crank_period(records) / 72.0, records


def wear_on(table, steady, hours, steps, **values):
    """(operating time, worn volume, record) through steps at constant forces; run-in of the base law off."""
    step, machine = steady
    records = records_of(table, acceleration=hours * HOUR / (steps * step), run_in_ratio=1.0, **values)
    exchange(machine, records, SHARED)
    assert accumulator.initialise(records) == 0
    travel = float(machine["crank_speed"][0]) * step
    time, volume = [0.0], [0.0]
    for _ in range(steps):
        records["crank_angle"] += travel
        assert accumulator.step(records, 0.0, step) == 0
        # Forces and phases stay: only the law may change the rate.
        records["crank_angle"] -= travel
        records["crank_angle_before"] = records["crank_angle"]
        time.append(float(records["operating_time"][0]))
        volume.append(sum(float(records[v][0]) for v in VOLUMES))
    return np.array(time), np.array(volume), only(records)


def factor(module, table, surface=INNER, line_load=5e4, radius=1.3e-3, speed=0.02, depth=0.0, **values):
    records = records_of(table, **values)
    return module.factor(records[0], surface, line_load, radius, speed, depth)


def test_running_in_decays_with_turns(rv20e, steady):
    """Volume of k_ss [1 + (r - 1) exp(-s/s0)] integrated; s0 counts turns at the rated crank speed."""
    time, volume, r = wear_on(rv20e.wear, steady, 1000.0, 2000, running_in_excess=4.0, running_in_time=200.0 * HOUR)
    _, base, _ = wear_on(rv20e.wear, steady, 1000.0, 2000)
    fall = 200.0 * HOUR * r.run_in_crank_speed / abs(steady[1]["crank_speed"][0])
    expected = base + 4.0 * base[-1] / time[-1] * fall * (1.0 - np.exp(-time / fall))
    assert np.allclose(volume, expected, rtol=5e-3)
    rate = np.diff(volume)
    assert np.all(np.diff(rate) < 1e-12 * rate[0])
    assert factor(running_in, rv20e.wear, running_in_excess=4.0) == 5.0


def test_running_in_scales_with_turns_and_comes_once(bench):
    at, values = conditions(bench), {"running_in_excess": 4.0, "running_in_time": 200.0 * HOUR}
    excess = [worn(bench, at[c], values)["inner_race"] / worn(bench, at[c], {})["inner_race"] for c in ("rated", "speed 20 %")]
    assert excess[0] > 1.5 and excess[0] == pytest.approx(excess[1], rel=0.03)
    late = [worn(bench, at["rated"], v, 2000.0)["inner_race"] - worn(bench, at["rated"], v, 1500.0)["inner_race"] for v in (values, {})]
    assert late[0] == pytest.approx(late[1], rel=0.1)


def test_debris_feeds_on_wear(rv20e, steady):
    """Against scipy: dV/dt = v (1 + g c/c0), dc/dt = rho dV/dt/m - c/tau."""
    gain, mass, tau = 2.0, 0.1, 2000.0 * HOUR
    time, volume, r = wear_on(rv20e.wear, steady, 1000.0, 2000, debris_gain=gain, grease_mass=mass, debris_settling=tau)
    _, base, _ = wear_on(rv20e.wear, steady, 1000.0, 2000)
    rate = base[-1] / time[-1]

    def change(_, y):
        worn_off = rate * (1.0 + gain * y[1] / 1e-3)
        return [worn_off, 7850.0 * worn_off / mass - y[1] / tau]

    answer = solve_ivp(change, (0.0, time[-1]), [0.0, 0.0], t_eval=time[::200], rtol=1e-8, atol=1e-20)
    assert np.allclose(volume[::200][1:], answer.y[0][1:], rtol=5e-3)
    assert r.debris == pytest.approx(answer.y[1][-1], rel=1e-2)
    assert np.all(np.diff(volume, 2) > -1e-9 * np.diff(volume)[0]) and volume[-1] > 1.02 * base[-1]


def test_change_of_grease_takes_debris_but_not_hardness(rv20e, steady):
    # Rates before and after the change at 500 h; the case is so thin that hardness has reached the core.
    changed = {"grease_change": 500.0 * HOUR}
    rates = {}
    for name, values in (("debris", {"debris_gain": 10.0}), ("hardness", {"core_softness": 0.5, "case_depth": 1e-8})):
        _, volume, _ = wear_on(rv20e.wear, steady, 700.0, 700, **values, **changed)
        rates[name] = np.diff(volume)
    assert rates["debris"][505] < 0.99 * rates["debris"][495]
    assert rates["hardness"][505] == pytest.approx(rates["hardness"][495], rel=1e-3)


def test_film_is_that_of_dowson_and_higginson():
    """By hand, in the form of the textbooks: h = 2.65 alpha^0.54 (eta u)^0.7 R^0.43/(E'^0.03 q^0.13)."""
    eta, u, radius, alpha, modulus, q = 0.05, 0.5, 1.3e-3, 1.8e-8, 227.5e9, 8e4
    expected = 2.65 * alpha**0.54 * (eta * u) ** 0.7 * radius**0.43 / (modulus**0.03 * q**0.13)
    assert lubrication_regime.film_thickness(q, radius, u, eta, alpha, modulus) == pytest.approx(expected, rel=1e-9)
    assert 0.02e-6 < expected < 1e-6


def test_thick_film_spares_its_share(rv20e):
    thick = factor(lubrication_regime, rv20e.wear, film_share=0.7, oil_viscosity=100.0, crank_speed=600.0)
    thin = factor(lubrication_regime, rv20e.wear, film_share=0.7, oil_viscosity=1e-4, crank_speed=1.0)
    assert thick == pytest.approx(0.3, abs=0.01) and thin == pytest.approx(1.0, abs=1e-3)
    # Half of it at lambda = lambda_0.
    film = lubrication_regime.film_thickness(5e4, 1.3e-3, 67.5 * 10.25e-3 / 2, 0.1 * math.exp(0.035 * 20.0), 1.8e-8, 207e9 / 0.91)
    half = factor(lubrication_regime, rv20e.wear, film_share=0.7, film_lambda=film / 0.4e-6, crank_speed=67.5)
    assert half == pytest.approx(1.0 - 0.35, rel=1e-9)


def test_film_wears_less_per_turn_when_fast_and_more_when_warm(bench):
    at, values = conditions(bench), {"film_share": 0.9, "film_lambda": 0.2}
    ratio = {c: worn(bench, at[c], values, 200.0)["inner_race"] / worn(bench, at[c], {}, 200.0)["inner_race"]
             for c in ("speed 20 %", "rated", "speed 200 %", "40 K warmer")}
    assert ratio["speed 200 %"] < ratio["rated"] < ratio["speed 20 %"] and ratio["40 K warmer"] > 1.5 * ratio["rated"]


def test_load_exponent(rv20e):
    m = 0.7
    low, high = (factor(load_exponent, rv20e.wear, line_load=q, load_exponent_added=m) for q in (2e4, 8e4))
    assert high / low == pytest.approx(4.0**m, rel=1e-12)
    assert factor(load_exponent, rv20e.wear, line_load=5e4, load_exponent_added=m, reference_line_load=5e4) == 1.0


def test_wear_at_two_loads_gives_the_exponent(bench):
    at = conditions(bench)
    growth = [np.log(worn(bench, at["load 150 %"], v, 50.0)["inner_race"] / worn(bench, at["rated"], v, 50.0)["inner_race"]) / np.log(1.5)
              for v in ({}, {"load_exponent_added": 0.5})]
    # Loads of single rollers grow a little slower than the torque.
    assert 0.35 < growth[1] - growth[0] < 0.55


def test_hardness_falls_with_depth(rv20e):
    def k(depth):
        return factor(hardness_gradient, rv20e.wear, depth=depth, core_softness=0.46, case_depth=20e-6)

    assert k(0.0) == 1.0 and k(1e-3) == pytest.approx(7.4 / 4.0, rel=0.01)
    assert k(20e-6) == pytest.approx(1.0 / (1.0 - 0.46 * (1.0 - math.exp(-1.0))), rel=1e-12)


def test_hardness_counts_depth_and_not_time(rv20e, steady):
    """Ten times the wear reaches the soft core in a tenth of the time."""
    values = {"core_softness": 0.5, "case_depth": 1e-7, "raceway_wear_law": 0, "mesh_wear_law": 0}
    fast, slow = (wear_on(rv20e.wear, steady, hours, 500, mesh_wear_coefficient=k, raceway_wear_coefficient=k, **values)[1]
                  for hours, k in ((100.0, 5e-8), (1000.0, 5e-9)))
    assert np.allclose(fast, slow, rtol=1e-6)


@pytest.mark.parametrize("tilt", [6e-5, 2e-4, 5e-4])
def test_edge_carries_what_a_tilted_contact_gives(rv20e, tilt):
    """Against the strips of a tilted line contact, q ~ depth^(10/9), at the same total load."""
    length, load = 8e-3, 650.0
    mean = 1e-3 * 3.84e-5 * load**0.9 / 8.0**0.8

    def strip(y, middle):
        return max(middle + tilt * y, 0.0) ** (10.0 / 9.0)

    def total(middle):
        return quad(strip, -0.5 * length, 0.5 * length, args=(middle,), limit=200)[0] - length * mean ** (10.0 / 9.0)

    middle = brentq(total, -2.0 * mean, 2.0 * mean)
    expected = strip(0.5 * length, middle) / mean ** (10.0 / 9.0)
    assert factor(edge_loading, rv20e.wear, line_load=load / length, roller_misalignment=tilt) == pytest.approx(expected, rel=0.05)


def test_edges_count_more_at_light_load(rv20e):
    light, heavy = (factor(edge_loading, rv20e.wear, line_load=q / 8e-3, roller_misalignment=6e-5) for q in (100.0, 650.0))
    assert light == pytest.approx(1.6, abs=0.1) and heavy == pytest.approx(1.1, abs=0.05)


def test_discs_and_rollers_tilt_on_their_own(rv20e):
    flank, race = ({"surface": surface, "line_load": 1e4} for surface in (FLANK, INNER))
    assert factor(edge_loading, rv20e.wear, **flank, misalignment=6e-5) > 1.0 == factor(edge_loading, rv20e.wear, **race, misalignment=6e-5)
    assert factor(edge_loading, rv20e.wear, **race, roller_misalignment=6e-5) > 1.0


def test_old_grease_starves_until_it_is_changed(rv20e):
    def k(hours, change=0.0):
        return factor(grease_ageing, rv20e.wear, grease_starvation=2.0, grease_life=5000.0 * HOUR,
                      operating_time=hours * HOUR, grease_change=change * HOUR)

    assert k(0.0) == 1.0 and k(5000.0) == pytest.approx(1.0 + 2.0 * (1.0 - math.exp(-1.0)), rel=1e-12)
    assert k(5000.0, 2500.0) == pytest.approx(1.0) and k(4000.0, 2500.0) == pytest.approx(k(1500.0))


def test_skidding_adds_to_the_slip_of_races(rv20e):
    slip = float(records_of(rv20e.wear)["slip_ratio_inner"][0])
    values = {"skid_share": 0.1, "skid": 0.03}
    assert factor(roller_skidding, rv20e.wear, INNER, **values) == pytest.approx(1.0 + 0.03 / slip)
    assert factor(roller_skidding, rv20e.wear, FLANK, **values) == 1.0


def test_skidding_wears_at_low_load(bench):
    at, values = conditions(bench), {"skid_share": 0.1, "skid_load": 500.0}
    ratio = [worn(bench, at[c], values, 100.0)["inner_race"] / worn(bench, at[c], {}, 100.0)["inner_race"] for c in ("load 10 %", "rated")]
    assert ratio[0] > 2.0 and ratio[1] < 1.15


def test_pin_print_is_round_or_two_bands(bench):
    """Standing pins wear where the contact turns back, at asin K1 = 43.8 degrees; the volume is the same."""
    wear = {share: bench.worn(conditions(bench)["rated"], {"pin_standing_share": share}, 50.0 * HOUR)[0] for share in (0.0, 0.5, 1.0)}
    assert not wear[0.0]["pin_wear"].any() and not wear[1.0]["pin_even_wear"].any()
    profile = wear[1.0]["pin_wear"].sum(axis=(0, 1))
    angle = (np.arange(len(profile)) + 0.5) / len(profile) * 180.0 - 90.0
    # Load from one side wears one band; the other is that of reverse torque.
    assert abs(angle[profile.argmax()]) == pytest.approx(43.8, abs=3.0)
    assert wear[0.5]["pin_volume"] == pytest.approx(wear[0.0]["pin_volume"], rel=0.02)
    assert wear[1.0]["pin_depth"].max() > 4.0 * wear[0.0]["pin_depth"].max()
