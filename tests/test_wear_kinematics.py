"""Kinematics of wear against the rigid motion of ideal parts and against the plant."""

import numpy as np
import pytest
from stand import in_equilibrium, only, records_of
from twin import Twin, centre_curve, outward_normal

from rv_plant.assembly import assemble
from rv_plant.geometry import flank_curvature
from wear_fmu import places
from wear_fmu.kinematics import (
    equivalent_curvature,
    flank_arc_per_phase,
    pin_contact_angle,
    pitch_distance,
    printed_sliding_per_crank_angle,
    sliding_per_crank_angle,
)

LOBES = 39
# (pin circle radius, pin radius, eccentricity) [m]
RV20E, BX40E = (52e-3, 2e-3, 0.9e-3), (69.5e-3, 3e-3, 1.3e-3)
PROFILES = pytest.mark.parametrize("profile", [RV20E, BX40E], ids=["RV20E", "BX40E"])
PHASES = pytest.mark.parametrize("phi", [0.0, 0.035, 0.7, 1.57, 2.6, np.pi, 4.0, 6.2])


def shortening(profile):
    return profile[2] * (LOBES + 1) / profile[0]


def flank(phi, profile):
    circle, radius, eccentricity = profile
    curve = (LOBES, circle, eccentricity)
    return centre_curve(phi, *curve) - radius * outward_normal(phi, *curve)


def per_phase(function, phi, profile):
    return function(phi, LOBES, *profile[:2], shortening(profile))


@PROFILES
@PHASES
def test_sliding_is_the_speed_of_the_disc_where_it_touches_a_fixed_pin(profile, phi):
    """Material point of the disc at the contact, followed through the ideal motion."""
    material = flank(phi, profile)

    def place(crank):
        return profile[2] * np.exp(1j * crank) + material * np.exp(-1j * crank / LOBES)

    # It lies on the pin.
    assert abs(place(phi) - profile[0]) == pytest.approx(profile[1], abs=1e-15)
    step = 1e-3
    near, far = (place(phi + n * step) - place(phi - n * step) for n in (1, 2))
    speed = (8 * near - far) / (12 * step)
    assert per_phase(sliding_per_crank_angle, phi, profile) == pytest.approx(abs(speed), rel=1e-9, abs=0)


@PROFILES
@PHASES
def test_arc_is_the_length_of_the_flank_passed_per_phase(profile, phi):
    step = 1e-4
    length = abs(flank(phi + step, profile) - flank(phi - step, profile))
    assert per_phase(flank_arc_per_phase, phi, profile) == pytest.approx(length / (2 * step), rel=1e-5, abs=0)


@PROFILES
@PHASES
def test_equivalent_curvature_is_that_of_flank_and_pin(profile, phi):
    circle, radius, _ = profile
    expected = 1 / radius + flank_curvature(phi, LOBES, circle, radius, shortening(profile))
    assert per_phase(equivalent_curvature, phi, profile) == pytest.approx(expected, rel=1e-12, abs=0)


@PROFILES
def test_equivalent_radius_is_the_pins_at_the_inflection(profile):
    k1 = shortening(profile)
    phi = np.arccos((1 + (LOBES + 1) * k1**2) / ((LOBES + 2) * k1))
    assert per_phase(equivalent_curvature, phi, profile) == pytest.approx(1 / profile[1], rel=1e-12, abs=0)


@PROFILES
@PHASES
def test_place_on_the_pin_is_where_the_disc_touches_it(profile, phi):
    """Angle from the pin's inward radial to the contact, pin on the real axis."""
    material = flank(phi, profile)
    contact = profile[2] * np.exp(1j * phi) + material * np.exp(-1j * phi / LOBES)
    expected = np.angle((contact - profile[0]) / -profile[0])
    assert pin_contact_angle(phi, shortening(profile)) == pytest.approx(expected, abs=1e-12)


def test_contact_turns_back_on_the_pin_at_the_arc_sine_of_k1():
    k1 = shortening(BX40E)
    angle = [abs(pin_contact_angle(phi, k1)) for phi in np.linspace(0, np.pi, 20001)]
    assert max(angle) == pytest.approx(np.arcsin(k1), abs=1e-8)
    assert np.degrees(max(angle)) == pytest.approx(48.4, abs=0.05)


@PROFILES
@PHASES
def test_pitch_point_is_where_the_disc_rolls(profile, phi):
    """It lies at e z_p along the eccentric direction; the pin on the real axis."""
    circle, _, eccentricity = profile
    pitch_point = eccentricity * (LOBES + 1) * np.exp(1j * phi)
    expected = abs(circle - pitch_point)
    assert circle * pitch_distance(phi, shortening(profile)) == pytest.approx(expected, rel=1e-13, abs=0)


@pytest.mark.parametrize("profile, crank_rpm, slowest, fastest", [
    (BX40E, 585.0, 22.8, 186.0), (RV20E, 2000 / 121 * 39, 24.2, 149.0),
], ids=["BX40E at 15 rpm out", "RV20E at 2000 rpm in"])
def test_literature_sliding_speeds(profile, crank_rpm, slowest, fastest):
    """mm/s, rising from root to tip, never zero."""
    phases = np.linspace(0, np.pi, 181)
    speed = np.array([per_phase(sliding_per_crank_angle, p, profile) for p in phases]) * crank_rpm * np.pi / 30 * 1e3
    assert speed[0] == pytest.approx(slowest, rel=0.003, abs=0)
    assert speed[-1] == pytest.approx(fastest, rel=0.003, abs=0)
    assert (np.diff(speed) > 0).all()


@pytest.mark.parametrize("degrees, ratio", [(2.0, 0.04), (40.3, 0.93), (90.0, 2.00), (180.0, 1.73)])
def test_literature_sliding_over_contact_speed_of_the_bx40e(degrees, ratio):
    phi = np.radians(degrees)
    found = per_phase(sliding_per_crank_angle, phi, BX40E) / per_phase(flank_arc_per_phase, phi, BX40E)
    assert found == pytest.approx(ratio, abs=0.005)


def test_literature_equivalent_radius_of_the_bx40e_is_largest_at_the_root():
    radius = np.array([1 / per_phase(equivalent_curvature, p, BX40E) for p in np.linspace(0, np.pi, 181)])
    assert radius.argmax() == 0
    assert 1e3 * radius[0] == pytest.approx(60.0, rel=0.05, abs=0)


def test_literature_printed_sliding_of_the_bx40e():
    """As printed it runs from -3.83 mm at the root to +0.59 mm at the tip; the unit takes its size."""
    root, tip = (1e3 * printed_sliding_per_crank_angle(p, LOBES, BX40E[2], shortening(BX40E)) for p in (1e-9, np.pi))
    assert root == pytest.approx(3.83, abs=0.005)
    assert tip == pytest.approx(0.59, abs=0.005)


@pytest.mark.parametrize("crank", [0.0, 0.4, -7.3, 100.0])
def test_place_on_the_disc_is_the_plants_phase_and_lobe(rv20e, crank):
    """Pins seen from the profile's frame in the ideal position: nearest point over the whole disc."""
    record = only(records_of(rv20e.wear))
    circle, _, eccentricity = RV20E
    bins = len(record.arc)
    along = np.linspace(0, 2 * np.pi * LOBES, 400 * LOBES, endpoint=False)
    whole_disc = centre_curve(along, LOBES, circle, eccentricity)
    machine = in_equilibrium(rv20e.plant)
    machine.z[:] = 0.0
    assemble(machine, -crank / LOBES, 0.0, 0.0)
    for d in range(2):
        centre = eccentricity * np.exp(1j * (crank + np.pi * d))
        for j in range(0, 40, 3):
            pin = circle * np.exp(2j * np.pi * j / 40)
            seen = (pin - centre) * np.exp(1j * (crank / LOBES + np.pi * d / LOBES))
            nearest = along[np.argmin(abs(whole_disc - seen))] / (2 * np.pi)
            found = places.flank_position(record, d, j, crank) / bins
            assert (found - nearest + LOBES / 2) % LOBES - LOBES / 2 == pytest.approx(0.0, abs=0.6 / 400)
            assert np.exp(2j * np.pi * found) == pytest.approx(np.exp(1j * machine.mesh_phase[d, j]), abs=1e-10)


@pytest.mark.parametrize("crank, cage", [(0.0, 0.0), (2.3, 0.7), (-40.0, -13.0)])
def test_rollers_lie_on_the_raceways_where_the_plant_has_them(rv20e, crank, cage):
    """Inner raceway from the lobe's eccentric direction, outer from the hole's outward radial."""
    record = only(records_of(rv20e.wear))
    twin = Twin(in_equilibrium(rv20e.plant), -crank / LOBES, cage)
    twin.place(np.zeros(len(twin.r.z)))
    for d in range(2):
        for c in range(2):
            inner, outer = places.first_roller(record, d, c, crank, -crank / LOBES, cage)
            roller = twin.roller_direction[d, c, 0]
            assert np.exp(1j * inner) == pytest.approx(roller / (twin.throw[d, c] / abs(twin.throw[d, c])), abs=1e-10)
            assert np.exp(1j * outer) == pytest.approx(roller / twin.hole_direction[d, c], abs=1e-10)
