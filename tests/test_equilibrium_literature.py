"""Literature family: published figures of the RV20E-121 and BX-40E, to the percent they are given with.

Figures: independent quasi-static solver behind the audit of the two source documents, sun
drive, needle clearances radial, 72 positions a turn of the cranks.
"""

import numpy as np
import pytest
from stand import ARCSEC, run_plant

LOBES, PINS = 39, 40


def over_turns(table, turns=1, **values):
    """Series of lag [arcsec], loaded teeth per disc, and peak forces [N] over turns of the cranks."""
    lag, teeth, pin, roller = [], [], [], []
    for record in run_plant(table, turns, **values):
        lag.append(ARCSEC * record.lag)
        teeth.append(record.loaded_teeth.mean())
        pin.append(record.mesh_force_now.max())
        roller.append(record.roller_force_now.max())
    return np.array(lag), np.mean(teeth), max(pin), max(roller)


def amplitude(lag, order):
    """Amplitude of an order of the output's turn in a record of one whole output turn."""
    return 2.0 * abs(np.fft.rfft(lag)[order]) / len(lag)


def with_one(table, name, index, value):
    array = np.zeros(table.by_name[name].shape)
    array[index] = value
    return {name: array}


@pytest.mark.parametrize("clearance, mean, peak_to_peak", [
    (0.0, 26.5, 0.55), (2.5e-6, 51.9, 6.8), (5e-6, 75.5, 12.7), (10e-6, 120.0, 24.0),
])
def test_lag_and_transmission_error_against_needle_clearance(rv20e, clearance, mean, peak_to_peak):
    lag, *_ = over_turns(rv20e.plant, bearing_clearance=clearance)
    assert lag.mean() == pytest.approx(mean, rel=0.005, abs=0)
    assert np.ptp(lag) == pytest.approx(peak_to_peak, rel=0.01, abs=0)


def test_lost_motion_grows_20_arcsec_per_micrometre_of_clearance(rv20e):
    narrow, wide = (over_turns(rv20e.plant, bearing_clearance=c)[0].mean() for c in (2.5e-6, 5e-6))
    assert 2 * (wide - narrow) / 2.5 == pytest.approx(20.0, rel=0.1, abs=0)


@pytest.mark.parametrize("share, peak_to_peak", [(0.05, 5.5), (2.5, 7.8)])
def test_transmission_error_hardly_depends_on_the_load(rv20e, share, peak_to_peak):
    # At 5 % of the load, 8.35 N.m, the contacts must be found across the clearance.
    lag, *_ = over_turns(rv20e.plant, load_torque=share * 167.0)
    assert np.ptp(lag) == pytest.approx(peak_to_peak, rel=0.01, abs=0)


@pytest.mark.parametrize("reducer, reading, stiffness", [
    ("rv20e", 1, 199.0), ("rv20e", 0, 382.0), ("bx40e", 1, 581.0), ("bx40e", 0, 1113.0),
], ids=["RV20E literal", "RV20E SI", "BX40E literal", "BX40E SI"])
def test_stiffness_of_the_second_stage(request, reducer, reading, stiffness):
    """N m/arcmin between half and full rated load."""
    reducer = request.getfixturevalue(reducer)
    load = reducer.starts["load_torque"]
    full, half = (
        over_turns(reducer.plant, stiffness_reading=reading, load_torque=t)[0].mean() for t in (load, load / 2)
    )
    assert 0.5 * load / ((full - half) / 60) == pytest.approx(stiffness, rel=0.005, abs=0)


@pytest.mark.parametrize("values, pin_force", [
    ({}, 311.2), ({"first_stage_ratio": 0.0, "input_speed": 67.5}, 319.9),
], ids=["sun drive", "cranks turned by couples"])
def test_peak_pin_force(rv20e, values, pin_force):
    assert over_turns(rv20e.plant, **values)[2] == pytest.approx(pin_force, rel=0.005, abs=0)


@pytest.mark.parametrize("values, teeth, pin_force", [
    ({}, 18.4, 312.0), ({"equidistant_modification": -13e-6, "shift_modification": -20e-6}, 7.9, 501.0),
], ids=["ideal profile", "modified profile"])
def test_loaded_teeth(rv20e, values, teeth, pin_force):
    _, found, peak, roller = over_turns(rv20e.plant, **values)
    assert found == pytest.approx(teeth, rel=0.01, abs=0)
    assert peak == pytest.approx(pin_force, rel=0.01, abs=0)


def test_a_reducer_without_errors_has_order_80_alone(rv20e):
    lag, _, _, roller = over_turns(rv20e.plant, LOBES)
    assert amplitude(lag, 80) == pytest.approx(3.46, rel=0.01, abs=0)
    assert max(amplitude(lag, order) for order in (1, 39, 40, 41, 78, 79)) < 0.02
    assert roller == pytest.approx(852.0, rel=0.005, abs=0)


@pytest.mark.parametrize("name, index, micrometres, order, arcsec", [
    ("crank_eccentricity_error", (0, 0), 3.0, 40, 4.98),
    ("disc_hole_error_tangential", (0, 0), -4.0, 40, 6.05),
    ("pin_position_error_radial", 0, -5.0, 78, 0.46),
], ids=["throw of one lobe", "one hole of one disc", "one pin proud"])
def test_order_that_a_part_error_excites(rv20e, name, index, micrometres, order, arcsec):
    lag, *_ = over_turns(rv20e.plant, LOBES, **with_one(rv20e.plant, name, index, micrometres * 1e-6))
    assert amplitude(lag, order) == pytest.approx(arcsec, rel=0.02, abs=0)


def test_eccentric_ring_excites_order_78(rv20e):
    """All pins displaced by 5 um in one direction."""
    eta = 2 * np.pi * np.arange(PINS) / PINS
    lag, *_ = over_turns(
        rv20e.plant, LOBES, pin_position_error_radial=5e-6 * np.cos(eta),
        pin_position_error_tangential=-5e-6 * np.sin(eta),
    )
    assert amplitude(lag, 78) == pytest.approx(1.8, rel=0.02, abs=0)


@pytest.mark.parametrize("name, index, roller_force, mean_change, order_40", [
    ("disc_hole_error_tangential", (0, 0), 1217.0, None, 6.05),
    ("carrier_hole_error_tangential", 0, 1214.0, -15.0, 0.0),
], ids=["hole of a disc", "seat in the carrier"])
def test_misplaced_hole_loads_rollers(rv20e, name, index, roller_force, mean_change, order_40):
    clean = over_turns(rv20e.plant)[0].mean()
    lag, _, _, roller = over_turns(rv20e.plant, LOBES, **with_one(rv20e.plant, name, index, -4e-6))
    assert roller == pytest.approx(roller_force, rel=0.005, abs=0)
    assert amplitude(lag, 40) == pytest.approx(order_40, rel=0.02, abs=0.02)
    if mean_change is not None:
        assert lag.mean() - clean == pytest.approx(mean_change, rel=0.03, abs=0)
