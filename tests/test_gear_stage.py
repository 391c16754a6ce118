"""First stage and angles at the shafts against rolling circles and the definitions of the outputs."""

import numpy as np
import pytest
from stand import in_equilibrium, only, records_of

from rv_plant import plant
from rv_plant.gear_stage import crank_turn_per_carrier_turn, crank_turn_per_shift, planet_radius, total_ratio

CIRCLE, RATIO = 28e-3, 3.0
SUN = CIRCLE / (1 + RATIO)


@pytest.mark.parametrize("first_stage_ratio, ratio", [(3.0, 121.0), (2.0, 81.0), (0.0, -39.0)])
def test_total_ratio(first_stage_ratio, ratio):
    """Input turns per output turn: 1 + i1 z_p with a first stage, -z_c if the cranks are the input."""
    assert total_ratio(first_stage_ratio, 40, 39) == ratio


def test_planet_rolls_on_the_sun():
    """A planet carried round a sun that stands still turns by the way of its centre over its own radius."""
    assert planet_radius(CIRCLE, RATIO) == pytest.approx(CIRCLE - SUN, rel=1e-14, abs=0)
    assert crank_turn_per_carrier_turn(RATIO) == pytest.approx(CIRCLE / (CIRCLE - SUN), rel=1e-14, abs=0)
    assert crank_turn_per_carrier_turn(0.0) == 0.0


@pytest.mark.parametrize("direction", [0.0, 0.8, -2.5])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_shift_of_the_planet_turns_it_so_that_the_flanks_stay_in_touch(direction, side):
    """Material points of both flanks at the pitch point move equally along the tooth's normal."""
    angle = np.radians(20.0)
    outward = np.exp(1j * direction)
    # The sun pushes the planet forwards (backwards on the other flank) and always outwards.
    normal = side * 1j * outward * np.cos(angle) + outward * np.sin(angle)
    for shift in (1e-6, 1e-6j, (3 - 2j) * 1e-6):
        per_x, per_y = crank_turn_per_shift(direction, CIRCLE, RATIO, angle, side)
        turn = per_x * shift.real + per_y * shift.imag
        at_pitch_point = shift + 1j * turn * (SUN - CIRCLE) * outward
        assert abs((at_pitch_point * normal.conjugate()).real) < 1e-20
        assert turn != 0.0


def test_a_planet_shifted_along_its_circle_turns_as_if_the_carrier_had_turned():
    per_x, per_y = crank_turn_per_shift(0.7, CIRCLE, RATIO, 0.35, 1.0)
    turn = CIRCLE * (-np.sin(0.7) * per_x + np.cos(0.7) * per_y)
    assert turn == pytest.approx(crank_turn_per_carrier_turn(RATIO), rel=1e-13, abs=0)


@pytest.mark.parametrize("first_stage_ratio, ratio", [(3.0, 121.0), (0.0, -39.0)], ids=["sun drive", "crank drive"])
def test_shafts_turn_by_their_ratios(rv20e, first_stage_ratio, ratio):
    """Over a whole period, so that the departures from ideal kinematics are the same at both ends."""
    records = records_of(rv20e.plant, first_stage_ratio=first_stage_ratio, input_speed=200.0, load_torque=0.0)
    record = only(records)
    assert plant.initialise(records) == 0
    assert record.input_angle == record.crank_angle == record.output_angle == 0.0
    duration = 2 * np.pi / 40 * abs(ratio) / 200.0
    for i in range(40):
        assert plant.step(records, i * duration / 40, duration / 40) == 0
    assert record.input_angle == pytest.approx(200.0 * duration, rel=1e-12, abs=0)
    assert record.output_angle == pytest.approx(200.0 * duration / ratio, rel=1e-12, abs=0)
    assert record.crank_angle == pytest.approx(-39 * record.output_angle, rel=1e-12, abs=0)
    assert record.output_speed == pytest.approx(200.0 / ratio, rel=1e-14, abs=0)
    assert record.crank_speed == pytest.approx(-39 * record.output_speed, rel=1e-14, abs=0)


@pytest.mark.parametrize("compliance", [0.0, 2e-6])
@pytest.mark.parametrize("first_stage_ratio", [3.0, 0.0])
def test_transmission_error_and_lag_follow_from_the_angles(rv20e, first_stage_ratio, compliance):
    record = in_equilibrium(
        rv20e.plant, 0.05, first_stage_ratio=first_stage_ratio, carrier_compliance=compliance
    )
    ratio = 121.0 if first_stage_ratio else -39.0
    error = record.output_angle - record.input_angle / ratio
    assert record.transmission_error == pytest.approx(error, rel=1e-9, abs=0) and error < -1e-5
    assert record.lag == pytest.approx(-record.crank_angle / 39 - record.output_angle, rel=1e-9, abs=0)


def test_carrier_compliance_adds_its_twist(rv20e):
    stiff, soft = (in_equilibrium(rv20e.plant, 0.05, carrier_compliance=c) for c in (0.0, 2e-6))
    assert soft.lag - stiff.lag == pytest.approx(2e-6 * 167.0, rel=1e-9, abs=0)
    assert (soft.mesh_force == stiff.mesh_force).all()
