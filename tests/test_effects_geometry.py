"""Errors of parts, clearance, modification and worn races: law, and orders of the transmission error.

The laws are held against the plant's arrays of errors per part, which other tests hold
against an independent twin.  Orders and sizes are those of the audit of the source
documents (lag of the second stage there, transmission error here: 2 % apart).
"""

import math

import numpy as np
import pytest
from stand import in_equilibrium

from discrepancy.catalogue.signature import ARCSEC, amplitudes, conditions, new_bench, observed, rated, turn, worn
from discrepancy.prediction.units import Condition

UM = 1e-6
PINS, LOBES = 40, 39
ETA = 2.0 * np.pi * np.arange(PINS) / PINS
FORCES = ("mesh_force_now", "roller_force_now")


@pytest.fixture(scope="module")
def bench():
    return new_bench()


def spectrum(bench, values, condition="rated"):
    """(amplitudes of all orders, mean lag) [arcsec]."""
    series = turn(bench, conditions(bench)[condition], values) * ARCSEC
    return amplitudes(series), -series.mean()


def alike(table, effect, parts, angle=0.37, **more):
    """Whether an effect does to the forces what errors of the parts do."""
    a, b = in_equilibrium(table, angle, 0.2, **effect, **more), in_equilibrium(table, angle, 0.2, **parts, **more)
    clean = in_equilibrium(table, angle, 0.2, **more)
    for name in FORCES:
        assert np.allclose(a[name], b[name], rtol=1e-6, atol=1e-5)
    assert any(not np.allclose(a[name], clean[name], rtol=1e-3, atol=1e-2) for name in FORCES)


def with_one(table, name, index, value):
    array = np.zeros(table.by_name[name].shape)
    array[index] = value
    return {name: array}


@pytest.mark.parametrize("effect, radial, tangential", [
    ({"pin_ring_runout": 5 * UM, "pin_ring_runout_angle": 0.7}, 5 * UM * np.cos(ETA - 0.7), -5 * UM * np.sin(ETA - 0.7)),
    ({"pin_ring_ovality": 5 * UM, "pin_ring_ovality_angle": 0.4}, 5 * UM * np.cos(2 * (ETA - 0.4)), 0.0 * ETA),
    ({"pin_ring_trilobe": 5 * UM, "pin_ring_trilobe_angle": 0.2}, 5 * UM * np.cos(3 * (ETA - 0.2)), 0.0 * ETA),
    ({"pin_ring_cos_4": 2 * UM, "pin_ring_sin_6": 1 * UM}, 2 * UM * np.cos(4 * ETA) + 1 * UM * np.sin(6 * ETA), 0.0 * ETA),
], ids=["off centre", "oval", "three lobes", "harmonics"])
def test_pins_are_moved(rv20e, effect, radial, tangential):
    alike(rv20e.plant, effect, {"pin_position_error_radial": radial, "pin_position_error_tangential": tangential})


def test_single_parts_are_displaced(rv20e):
    t = rv20e.plant
    alike(t, {"proud_pin": 5 * UM, "proud_pin_number": 31}, with_one(t, "pin_radius_error", 30, 5 * UM), angle=0.0)
    # Between two pins both, behind the last one the first.
    shared = with_one(t, "pin_radius_error", 30, 3 * UM)["pin_radius_error"] + with_one(t, "pin_radius_error", 31, 2 * UM)["pin_radius_error"]
    alike(t, {"proud_pin": 5 * UM, "proud_pin_number": 31.4}, {"pin_radius_error": shared}, angle=0.0)
    ends = with_one(t, "pin_radius_error", PINS - 1, 4 * UM)["pin_radius_error"] + with_one(t, "pin_radius_error", 0, 1 * UM)["pin_radius_error"]
    for number in (0.2, PINS + 0.2):
        alike(t, {"proud_pin": 5 * UM, "proud_pin_number": number}, {"pin_radius_error": ends}, angle=0.0)
    alike(t, {"lobe_throw_error_1": 3 * UM, "lobe_error_disc": 2}, with_one(t, "crank_eccentricity_error", (1, 0), 3 * UM))
    alike(t, {"lobe_phase_error_2": 3e-3}, with_one(t, "crank_phase_error", (0, 1), 3e-3))
    alike(t, {"disc_hole_shift_2": 4 * UM, "disc_hole_disc": 2},
          with_one(t, "disc_hole_error_tangential", (1, 1), 4 * UM))
    alike(t, {"disc_hole_radial_2": 4 * UM}, with_one(t, "disc_hole_error_radial", (0, 1), 4 * UM))
    alike(t, {"carrier_seat_shift": 4 * UM, "carrier_seat_crank": 2}, with_one(t, "carrier_hole_error_tangential", 1, 4 * UM))
    alike(t, {"carrier_seat_radial": 4 * UM}, with_one(t, "carrier_hole_error_radial", 0, 4 * UM))


def test_teeth_of_the_discs_lack_what_the_law_says(rv20e):
    tip = 2.0 * np.pi * (np.arange(LOBES) + 0.5) / LOBES
    place = np.stack([tip, tip - np.pi / LOBES])
    for pairing in (0.0, 1.0):
        turned = place + np.array([[0.0], [np.pi * pairing]])
        alike(rv20e.plant, {"disc_runout": 4 * UM, "disc_runout_angle": 0.3, "disc_ovality": 2 * UM, "disc_pairing": pairing},
              {"lobe_profile_error": 4 * UM * np.cos(turned - 0.3) + 2 * UM * np.cos(2.0 * turned)})


def test_clearance_and_modification_are_those_of_the_file(rv20e):
    clearance = float(rv20e.starts["bearing_clearance"])
    alike(rv20e.plant, {"needle_clearance_added": 3 * UM}, {"bearing_clearance": clearance + 3 * UM})
    alike(rv20e.plant, {"equidistant_added": -13 * UM, "shift_added": -20 * UM},
          {"equidistant_modification": -13 * UM, "shift_modification": -20 * UM})


def test_worn_race_takes_from_the_rollers_that_the_law_names(rv20e):
    """A hollow D sin^2 behind the hole's radial equals profile errors of the rollers there."""
    cage, rollers = 0.2, 16
    angle = cage + 2.0 * np.pi * np.arange(rollers) / rollers
    hollow = 10 * UM * np.where(np.sin(angle) < 0.0, np.sin(angle) ** 2, 0.0)
    alike(rv20e.plant, {"outer_race_worn": 10 * UM}, {"roller_profile_error": np.broadcast_to(hollow, (2, 2, rollers))})


def test_worn_races_lie_where_the_wear_unit_wears_them(bench):
    """Depth of the wear unit's own print is largest within 12 degrees of the hollow's middle."""
    for direction, middle in ((1, 1.5 * math.pi), (-1, 0.5 * math.pi)):
        at = Condition(bench.rated_speed, bench.rated_load, direction=direction)
        w = bench.worn(at, {}, 1000.0 * 3600.0)[0]
        for name in ("inner_race_angle", "outer_race_angle"):
            assert np.all(np.abs(w[name] - middle) < math.radians(12.0))


# Effect, order, amplitude [arcsec] and its tolerance.
AUDITED = [
    ({"pin_ring_runout": 5 * UM}, "rated", 78, 1.8, 0.06), ({"pin_ring_runout": 5 * UM}, "load 25 %", 78, 3.9, 0.04),
    ({"pin_ring_runout": 5 * UM}, "load 25 %", 2, 2.7, 0.06), ({"pin_ring_ovality": 5 * UM}, "rated", 78, 10.0, 0.04),
    ({"lobe_throw_error_1": 3 * UM}, "rated", 40, 4.98, 0.05), ({"disc_hole_shift_1": -4 * UM}, "rated", 40, 6.05, 0.05),
    ({"outer_race_worn": 10 * UM}, "rated", 80, 0.87, 0.7), ({"inner_race_worn": 10 * UM}, "rated", 80, 4.69, 0.3),
]  # fmt: skip


@pytest.mark.parametrize("values, condition, order, arcsec, tolerance", AUDITED)
def test_order_of_the_audit(bench, values, condition, order, arcsec, tolerance):
    assert spectrum(bench, values, condition)[0][order] == pytest.approx(arcsec, rel=tolerance, abs=0)


def test_orders_that_stay_away(bench):
    """Ring: not 39 and 117; opposed discs 40, a pair only 80; a seat of the carrier no 40."""
    ring = spectrum(bench, {"pin_ring_ovality": 5 * UM})[0]
    assert max(ring[[39, 117]]) < 0.05 and ring[156] > 1.0
    assert spectrum(bench, {"pin_ring_trilobe": 5 * UM})[0][234] > 0.5
    opposed, pair = (spectrum(bench, {"disc_runout": 4 * UM, "disc_pairing": p})[0] for p in (1.0, 0.0))
    clean = spectrum(bench, {})[0]
    assert opposed[40] > 10.0 and pair[40] < 0.05 and abs(pair[80] - clean[80]) > 0.3
    seat, lag = spectrum(bench, {"carrier_seat_shift": -4 * UM})
    assert seat[40] < 0.05 and lag - spectrum(bench, {})[1] == pytest.approx(-15.0, rel=0.05)


def test_one_lobe_or_all(bench):
    """Order 40 of one lobe's error cancels in the sum of what either lobe of a crank does."""
    first, second = (turn(bench, rated(bench), {"lobe_throw_error_1": UM, "lobe_error_disc": d}) for d in (1, 2))
    base = turn(bench, rated(bench), {})
    both = amplitudes(((first - base) + (second - base)) * ARCSEC)
    assert amplitudes((first - base) * ARCSEC)[40] > 1.0 and both[40] < 0.05


@pytest.mark.parametrize("added, peak_to_peak", [(-2.5, 0.55), (0.0, 6.8), (2.5, 12.7), (7.5, 24.0)])
def test_clearance_opens_order_80(bench, added, peak_to_peak):
    series = turn(bench, rated(bench), {"needle_clearance_added": added * UM}) * ARCSEC
    assert np.ptp(series) == pytest.approx(peak_to_peak, rel=0.03, abs=0)


@pytest.mark.parametrize("share, peak_to_peak", [(0.05, 5.5), (2.5, 7.8)])
def test_clearance_shows_at_hardly_any_load(bench, share, peak_to_peak):
    """The file's 2.5 um; at 5 % and at 250 % of the rated load."""
    series = turn(bench, Condition(bench.rated_speed, share * bench.rated_load), {}) * ARCSEC
    assert np.ptp(series) == pytest.approx(peak_to_peak, rel=0.03, abs=0)


def test_worn_races_open_lost_motion_but_not_order_80(bench):
    """Clearance opens both; the side of negative torque does not know of the wear."""
    for name, lag in (("inner_race_worn", 41.0), ("outer_race_worn", 51.0)):
        orders, mean = spectrum(bench, {name: 10 * UM})
        assert mean - spectrum(bench, {})[1] == pytest.approx(lag, rel=0.2)
        assert orders[80] < 1.2 * spectrum(bench, {})[0][80]
    torque = np.array([0.0, 83.5, 167.0])
    back = [bench.held(rated(bench), v, -torque)[1:] for v in ({}, {"outer_race_worn": 10 * UM})]
    assert np.allclose(*back, rtol=2e-3)


def test_modification_softens_low_torque_both_ways(bench):
    modified = {"equidistant_added": -13 * UM, "shift_added": -20 * UM}
    torque = np.array([0.0, 10.0, 30.0, 83.5, 167.0])
    plain, soft, back = (bench.held(rated(bench), v, s * torque) for v, s in (({}, 1.0), (modified, 1.0), (modified, -1.0)))
    stiffness = [np.diff(torque)[[1, 3]] / np.diff(np.abs(x))[[1, 3]] for x in (plain, soft, back)]
    assert stiffness[1][0] < 0.85 * stiffness[0][0] and stiffness[1][1] / stiffness[1][0] > stiffness[0][1] / stiffness[0][0]
    assert np.allclose(stiffness[1], stiffness[2], rtol=0.02)
    assert observed(bench, "lost_motion", rated(bench), modified) > 1.3 * observed(bench, "lost_motion", rated(bench), {})


def test_part_errors_do_not_know_speed_and_temperature(bench):
    values = {"pin_ring_ovality": 5 * UM}
    cold, hot, fast = (spectrum(bench, values, c)[0][78] for c in ("rated", "40 K warmer", "speed 200 %"))
    assert cold == pytest.approx(hot, rel=1e-6) and cold == pytest.approx(fast, rel=1e-3)


def test_proud_pin_carries_more(rv20e):
    """A proud pin in the loaded zone carries three times as much; the others hardly notice."""
    angles = np.linspace(0.0, 2.0 * np.pi / LOBES, 24, endpoint=False)
    peak = [max(in_equilibrium(rv20e.plant, a, proud_pin=p, proud_pin_number=31).mesh_force_now[:, 30].max() for a in angles)
            for p in (0.0, 5 * UM)]
    assert 2.5 < peak[1] / peak[0] < 5.0


def test_misplaced_holes_load_rollers_unevenly(rv20e):
    angles = np.linspace(0.0, 2.0 * np.pi / LOBES, 24, endpoint=False)
    for values, force in (({}, 852.0), ({"disc_hole_shift_1": -4 * UM}, 1217.0), ({"carrier_seat_shift": -4 * UM}, 1214.0)):
        peak = max(in_equilibrium(rv20e.plant, a, **values).roller_force_now.max() for a in angles)
        assert peak == pytest.approx(force, rel=0.03, abs=0)


def test_wear_goes_on_upon_part_errors(bench):
    """An error of a part changes wear of the same life: the unit sees its forces."""
    assert worn(bench, rated(bench), {"disc_hole_shift_1": -4 * UM}, 100.0)["inner_race"] > 1.2 * worn(bench, rated(bench), {}, 100.0)["inner_race"]
