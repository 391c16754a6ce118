"""Wear over temperature, pressure and time, and the surfaces that an effect of wear acts on."""

import math

import numpy as np
import pytest
from stand import SHARED, crank_period, exchange, only, records_of

from discrepancy.catalogue.signature import conditions, new_bench, worn
from rv_plant import plant
from wear_fmu import accumulator
from wear_fmu.chosen_surfaces import CHOICES, FLANK, INNER, OUTER, PIN, is_chosen
from wear_fmu.effects import EFFECTS, arrhenius, pressure_threshold, starvation, wear_growth

HOUR = 3600.0
GAS = 8.314462618
# The cages stand still here, and with them the outer races.
VOLUMES = ("flank_volume", "pin_volume", "inner_race_volume")


@pytest.fixture(scope="module")
def bench():
    return new_bench()


@pytest.fixture(scope="module")
def steady(rv20e):
    """Step [s] and plant record of constant forces."""
    records = records_of(rv20e.plant)
    assert plant.initialise(records) == 0
    return crank_period(records) / 72.0, records


def volumes(table, steady, hours=100.0, steps=1, **values):
    """Worn volumes of flanks, pins and inner races after steps at constant forces; (steps + 1, 3)."""
    step, machine = steady
    records = records_of(table, acceleration=hours * HOUR / (steps * step), run_in_ratio=1.0, **values)
    exchange(machine, records, SHARED)
    assert accumulator.initialise(records) == 0
    travel = float(machine["crank_speed"][0]) * step
    found = [[0.0] * 3]
    for _ in range(steps):
        records["crank_angle"] += travel
        assert accumulator.step(records, 0.0, step) == 0
        records["crank_angle"] -= travel
        records["crank_angle_before"] = records["crank_angle"]
        found.append([float(records[v][0]) for v in VOLUMES])
    return np.array(found)


def factor(module, table, line_load=5e4, radius=1.3e-3, **values):
    return module.factor(records_of(table, **values)[0], INNER, line_load, radius, 0.02, 0.0)


def test_logarithm_of_the_coefficient_falls_with_one_over_temperature(rv20e, steady):
    """Slope of ln k over 1/T is -E/R; constant laws, because Janakiraman's has a temperature of its own."""
    energy, laws = 30e3, {"mesh_wear_law": 0, "raceway_wear_law": 0}
    hot, cold = (volumes(rv20e.wear, steady, temperature=t, activation_energy=energy, **laws)[-1] for t in (333.15, 283.15))
    assert np.log(hot / cold) == pytest.approx(np.full(3, energy / GAS * (1.0 / 283.15 - 1.0 / 333.15)), rel=1e-12)
    assert factor(arrhenius, rv20e.wear, activation_energy=energy, temperature=293.15) == 1.0


def test_temperature_counts_the_same_at_every_speed(bench):
    at, values = conditions(bench), {"activation_energy": 30e3, "mesh_wear_law": 0.0}
    expected = math.exp(30e3 / GAS * (1.0 / 293.15 - 1.0 / 333.15))
    ratio = worn(bench, at["40 K warmer"], values, 20.0)["flank"] / worn(bench, at["40 K warmer"], {"mesh_wear_law": 0.0}, 20.0)["flank"]
    # The worn profile takes back a little of the load.
    assert ratio == pytest.approx(expected, rel=0.05)


def test_pressure_below_the_threshold_does_not_wear(rv20e):
    """Half of the share is missing at the threshold, all of it far below; p by the textbook's half width."""
    radius, limit, share = 1.3e-3, 600e6, 0.8
    modulus = 0.5 * 207e9 / (1.0 - 0.3**2)

    def k(pressure, **more):
        # p = 2 q/(pi a) and a = sqrt(4 q R/(pi E*)).
        load = pressure**2 * math.pi * radius / modulus
        return factor(pressure_threshold, rv20e.wear, load, radius, threshold_share=share, threshold_pressure=limit, **more)

    assert k(limit) == pytest.approx(1.0 - 0.5 * share, rel=1e-9)
    assert k(0.3 * limit) == pytest.approx(1.0 - share, abs=1e-3) and k(3.0 * limit) == pytest.approx(1.0, abs=1e-3)
    assert k(0.9 * limit, threshold_sharpness=60.0) == pytest.approx(1.0 - share, abs=2e-3)
    slopes = np.diff([k(p) for p in np.linspace(100e6, 2000e6, 400)])
    assert slopes.min() >= 0.0 and slopes.max() < 0.03


def test_threshold_takes_wear_at_low_load(bench):
    at, values = conditions(bench), {"threshold_share": 1.0, "threshold_pressure": 500e6}
    share = {c: worn(bench, at[c], values, 50.0)["flank"] / worn(bench, at[c], {}, 50.0)["flank"] for c in ("load 10 %", "load 150 %")}
    assert share["load 10 %"] < 0.05 and share["load 150 %"] > 0.95


def test_starving_begins_after_its_time_and_ends_with_new_grease(rv20e, steady):
    """Worn volume against the integral of 1 + a S(t) in closed form."""
    growth, onset, width = 4.0, 400.0, 30.0
    values = {"starvation_growth": growth, "starvation_onset": onset * HOUR, "starvation_width": width * HOUR}
    found, base = (volumes(rv20e.wear, steady, 1000.0, 1000, **v).sum(axis=1) for v in (values, {}))
    time = np.linspace(0.0, 1000.0, 1001)

    def integral(t):
        return width * np.log1p(np.exp((t - onset) / width))

    expected = base[-1] / 1000.0 * (time + growth * (integral(time) - integral(0.0)))
    assert found[1:] == pytest.approx(expected[1:], rel=6e-3)

    def k(hours, change=0.0):
        return factor(starvation, rv20e.wear, operating_time=hours * HOUR, grease_change=change * HOUR, **values)

    assert k(onset) == pytest.approx(1.0 + 0.5 * growth) and k(0.0) == pytest.approx(1.0, abs=1e-5)
    assert k(900.0, 500.0) == pytest.approx(k(400.0)) and k(900.0) == pytest.approx(1.0 + growth, rel=1e-6)
    assert factor(starvation, rv20e.wear, starvation_growth=1.0, starvation_onset=1e6 * HOUR, starvation_width=HOUR) == 1.0


@pytest.mark.parametrize("power", [1.0, 2.0])
def test_wear_grows_with_time(rv20e, steady, power):
    """The volume is the integral of 1 + g (t/t0)^p."""
    values = {"wear_growth": 0.8, "wear_growth_time": 500.0 * HOUR, "wear_growth_power": power}
    found, base = (volumes(rv20e.wear, steady, 1000.0, 500, **v).sum(axis=1) for v in (values, {}))
    time = np.linspace(0.0, 1000.0, 501)
    expected = base[-1] / 1000.0 * (time + 0.8 * 500.0 / (power + 1.0) * (time / 500.0) ** (power + 1.0))
    # Steps see the coefficient at their start.
    assert found[50:] == pytest.approx(expected[50:], rel=8e-3)
    assert factor(wear_growth, rv20e.wear, wear_growth=-0.5, operating_time=4000.0 * HOUR) == 0.0


def test_time_and_iron_part_at_another_load(bench):
    """Alike at rated load; at a tenth of it little iron comes, and the time is the same."""
    at = conditions(bench)

    def growth(c, values):
        late, early = (worn(bench, at[c], v, 3000.0)["flank"] / worn(bench, at[c], v, 1000.0)["flank"] for v in (values, {}))
        return late / early

    by_time, by_iron = {"wear_growth": 0.3}, {"debris_gain": 1.0}
    assert growth("rated", by_time) > 1.1 and growth("rated", by_iron) > 1.1
    assert growth("load 10 %", by_time) > 1.15 and growth("load 10 %", by_iron) < 1.05


CHOSEN = {FLANK: "flanks", PIN: "pins", INNER: "races", OUTER: "races"}


@pytest.mark.parametrize("choice", range(len(CHOICES)))
def test_choices_name_their_surfaces(choice):
    for surface, name in CHOSEN.items():
        assert is_chosen(choice, surface) == (CHOICES[choice] == "all" or name in CHOICES[choice])


def test_every_effect_with_a_factor_can_choose():
    for name, effect in EFFECTS.items():
        choices = [p.variable.choices for p in effect.parameters if p.variable.name == f"{name}_surfaces"]
        assert choices == ([] if name == "pin_rotation" else [CHOICES])


@pytest.mark.parametrize("choice", range(len(CHOICES)))
def test_effect_acts_on_the_chosen_surfaces_alone(rv20e, steady, choice):
    """Of two effects each acts on its own choice: factors of the volumes of flanks, pins and races."""
    plain, laws = {"mesh_wear_law": 0, "raceway_wear_law": 0}, {"activation_energy": -20e3, "temperature": 333.15}
    base = volumes(rv20e.wear, steady, temperature=333.15, **plain)[-1]
    found = volumes(rv20e.wear, steady, arrhenius_surfaces=choice, load_exponent_added=0.3, load_exponent_surfaces=CHOICES.index("pins"),
                    **laws, **plain)[-1]
    only_power = volumes(rv20e.wear, steady, load_exponent_added=0.3, load_exponent_surfaces=CHOICES.index("pins"), temperature=333.15, **plain)[-1]
    expected = math.exp(20e3 / GAS * (1.0 / 333.15 - 1.0 / 293.15))
    for i, name in enumerate(("flanks", "pins", "races")):
        acts = CHOICES[choice] == "all" or name in CHOICES[choice]
        assert found[i] / only_power[i] == pytest.approx(expected if acts else 1.0, rel=1e-12)
        assert (only_power[i] == base[i]) == (name != "pins")


@pytest.mark.parametrize("pins", [0, 1])
def test_pins_may_be_kept_from_wearing(rv20e, steady, pins):
    all_wear, half, kept = (volumes(rv20e.wear, steady, pins=pins, pin_wear_share=share)[-1] for share in (1.0, 0.5, 0.0))
    assert kept[1] == 0.0 and half[1] == 0.5 * all_wear[1]
    assert np.array_equal(kept[[0, 2]], all_wear[[0, 2]])


def test_kept_pins_stay_whole(rv20e, steady):
    step, machine = steady
    records = records_of(rv20e.wear, acceleration=1e8, pin_wear_share=0.0, pin_standing_share=0.5)
    exchange(machine, records, SHARED)
    assert accumulator.initialise(records) == 0
    records["crank_angle"] += 0.1
    assert accumulator.step(records, 0.0, step) == 0
    r = only(records)
    assert r.flank_depth.max() > 0.0 and r.pin_depth.max() == r.pin_even_wear.max() == r.pin_wear.max() == 0.0
