"""The disc's profile against its definition: envelope, conjugacy, brute-force distances."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from stand import in_equilibrium
from twin import centre_curve, directions, outward_normal

from rv_plant.assembly import assemble
from rv_plant.geometry import (
    centre_curve_curvature,
    closest_distance,
    flank_curvature,
    least_distance,
    lobe_point,
    shortening,
    turn_of,
)

LOBES = 39
# (pin circle radius, pin radius, eccentricity) of the generated profile [m]
RV20E, BX40E = (52e-3, 2e-3, 0.9e-3), (69.5e-3, 3e-3, 1.3e-3)
MODIFIED = (52e-3 - 20e-6, 2e-3 - 13e-6, 0.9e-3)
PROFILES = pytest.mark.parametrize("profile", [RV20E, BX40E, MODIFIED], ids=["RV20E", "BX40E", "modified"])


def flank(phi, profile):
    """(point, outward normal) as complex numbers, from the kernel."""
    circle, radius, eccentricity = profile
    x, y, nx, ny = lobe_point(phi, LOBES, circle, radius, eccentricity, shortening(eccentricity, LOBES, circle))
    return complex(x, y), complex(nx, ny)


def from_root(pin, phi, circle, eccentricity, k1, ideal=0.7):
    """(phase, gap, n_x, n_y, curvature) of a pin seen from the root, the iteration begun at phi."""
    frame = np.exp(1j * ideal / LOBES)
    seen = pin / frame
    shift, gap, nx, ny, bend = closest_distance(
        seen.real, seen.imag, np.cos(ideal), np.sin(ideal), phi - ideal, LOBES, circle, eccentricity, k1
    )
    normal = complex(nx, ny) * frame
    return ideal + shift, gap, normal.real, normal.imag, bend


@PROFILES
def test_bound_of_the_distance_is_below_it_and_close(profile):
    """Pins displaced in any direction by up to 10 um, and as far as the bound is promised."""
    circle, _, eccentricity = profile
    k1 = shortening(eccentricity, LOBES, circle)
    hollow = -centre_curve_curvature(0.0, LOBES, circle, k1)
    random = np.random.default_rng(3)
    for size in (10e-6, 0.333 / hollow):
        slack = []
        for phi in np.concatenate([random.uniform(-np.pi, np.pi, 2000), random.uniform(-0.3, 0.3, 2000)]):
            c, s = np.cos(phi), np.sin(phi)
            away = size * random.uniform() * np.exp(2j * np.pi * random.uniform())
            place = circle - eccentricity * c + away.real, -eccentricity * s + away.imag, c, s
            _, gap, *_ = closest_distance(*place, 0.0, LOBES, circle, eccentricity, k1)
            slack.append(gap - least_distance(*place, circle, eccentricity, k1, hollow))
        assert min(slack) > -1e-15
        if size == 10e-6:
            assert max(slack) < 1e-6
    assert least_distance(circle - eccentricity + 1e-3, 0.0, 1.0, 0.0, circle, eccentricity, k1, hollow) == -np.inf


@pytest.mark.parametrize("angle", [0.0, 1e-9, -3e-3, 0.0499, -0.0499, 0.0501, 2.0])
def test_series_of_a_small_angle(angle):
    assert turn_of(angle) == pytest.approx((np.cos(angle), np.sin(angle)), rel=3e-16, abs=0)


@PROFILES
@pytest.mark.parametrize("phi", np.linspace(-3.1, 3.1, 7))
def test_flank_is_the_envelope_of_the_moving_pin(profile, phi):
    circle, radius, eccentricity = profile
    point, normal = flank(phi, profile)
    # Pin centre at angle 0 seen from a disc that turns by theta while its crank turns by -z_c theta.
    theta = -phi / LOBES
    seen = (circle - eccentricity * np.exp(-1j * LOBES * theta)) * np.exp(-1j * theta)
    assert abs(point + radius * normal - seen) < 1e-15
    # An envelope is touched where the pin's motion runs along it.
    assert abs(normal - outward_normal(phi, LOBES, circle, eccentricity)) < 1e-13
    step = 1e-4
    along = flank(phi + step, profile)[0] - flank(phi - step, profile)[0]
    assert abs((along * normal.conjugate()).real) < 1e-7 * abs(along)


@pytest.mark.parametrize("discs", [1, 2, 3])
@pytest.mark.parametrize("theta", [0.0, 0.0371, -2.9, 1.23456])
def test_every_pin_touches_the_ideal_disc_in_the_ideal_position(discs, theta):
    circle, radius, eccentricity = RV20E
    k1 = shortening(eccentricity, LOBES, circle)
    for disc in range(discs):
        offset = 2.0 * np.pi * disc / discs
        centre = eccentricity * np.exp(1j * (offset - LOBES * theta))
        seen = (circle * directions(LOBES + 1) - centre) * np.exp(-1j * (theta - offset / LOBES))
        for pin in seen:
            root = np.round(np.angle(pin) * LOBES / (2.0 * np.pi))
            local = pin * np.exp(-2j * np.pi * root / LOBES)
            phi, distance, *_ = from_root(local, np.angle(local) * LOBES, circle, eccentricity, k1)
            assert abs(distance) < 1e-15
            # The flank itself, one pin radius inside.
            assert abs(abs(local - flank(phi, RV20E)[0]) - radius) < 1e-12


@pytest.mark.parametrize("theta", [0.0, 0.0371, -2.9, 1.23456])
def test_the_plant_finds_every_pin_in_touch_in_the_ideal_position(rv20e, theta):
    # Contacts at distance 0 carry no force, so all pins are made 1 um too thick.
    proud = 1e-6
    record = in_equilibrium(rv20e.plant)
    record.z[:] = 0.0
    record.pin_radius_error[:] = proud
    assemble(record, theta, 0.0, 0.0)
    penetration = (record.mesh_force_now / record.mesh_constant) ** (1.0 / record.mesh_exponent)
    assert record.mesh_force_now.shape == (2, 40)
    assert np.abs(penetration - proud).max() < 1e-12


@PROFILES
def test_distance_is_the_least_over_the_whole_lobe(profile):
    """Pins displaced by up to 0.1 mm in any direction, against brute-force minimisation."""
    circle, radius, eccentricity = profile
    k1 = shortening(eccentricity, LOBES, circle)
    random = np.random.default_rng(7)
    grid = np.linspace(-np.pi, np.pi, 2001)
    for phi in random.uniform(-2.5, 2.5, 25):
        shift = random.uniform(0.0, 1e-4) * np.exp(2j * np.pi * random.uniform())
        pin = complex(centre_curve(phi, LOBES, circle, eccentricity)) + shift

        def distance(p):
            return abs(pin - flank(p, profile)[0])

        start = grid[np.argmin(abs(pin - centre_curve(grid, LOBES, circle, eccentricity)))]
        least = minimize_scalar(distance, bounds=(start - 0.01, start + 0.01), method="bounded",
                                options={"xatol": 1e-10}).fun
        found, gap, nx, ny, bend = from_root(pin, phi, circle, eccentricity, k1)
        assert gap + radius == pytest.approx(least, abs=1e-14)
        # The normal points from the curve to the pin, outwards if the gap is positive.
        foot = pin - gap * complex(nx, ny)
        assert abs(foot - centre_curve(found, LOBES, circle, eccentricity)) < 1e-8
        assert bend == pytest.approx(centre_curve_curvature(found, LOBES, circle, k1), rel=1e-4, abs=1e-3)


@pytest.mark.parametrize("phi", [0.0, 0.1, 0.3, 0.9, 3.0])
@pytest.mark.parametrize("away", [9.9e-6, -9.9e-6, 1.1e-5, -3e-3, 0.1], ids="{:g} rad".format)
def test_distance_and_normal_do_not_depend_on_the_start_of_the_iteration(phi, away):
    """A pin pressed 5 um into the flank; errors below those stated, 1e-15 m and 1e-10 rad."""
    circle, _, eccentricity = RV20E
    k1 = shortening(eccentricity, LOBES, circle)
    normal = outward_normal(phi, LOBES, circle, eccentricity)
    pin = centre_curve(phi, LOBES, circle, eccentricity) - 5e-6 * normal
    _, gap, nx, ny, _ = from_root(pin, phi + away, circle, eccentricity, k1)
    assert gap == pytest.approx(-5e-6, abs=1e-15)
    assert abs(complex(nx, ny) - normal) < 1e-9


@PROFILES
@pytest.mark.parametrize("phi", [0.0, 0.2, 0.7, 1.1, 2.0, 3.0])
def test_curvature_is_the_turning_of_the_normal_along_the_arc(profile, phi):
    circle, radius, eccentricity = profile
    k1 = shortening(eccentricity, LOBES, circle)
    step = 1e-4
    for offset, curvature in (
        (radius, flank_curvature(phi, LOBES, circle, radius, k1)),
        (0.0, centre_curve_curvature(phi, LOBES, circle, k1)),
    ):
        parallel = (circle, offset, eccentricity)
        (before, n_before), (after, n_after) = flank(phi - step, parallel), flank(phi + step, parallel)
        along = after - before
        # Convex where the normal turns the way the point moves.
        turning = np.angle(n_after / n_before) * np.sign((along * (1j * n_before).conjugate()).real)
        assert curvature == pytest.approx(turning / abs(along), rel=2e-6, abs=1e-4)


@pytest.mark.parametrize("profile, degrees", [(BX40E, 40.3), (RV20E, None)], ids=["BX40E", "RV20E"])
def test_inflection(profile, degrees):
    circle, radius, eccentricity = profile
    k1 = shortening(eccentricity, LOBES, circle)
    phi = brentq(lambda p: flank_curvature(p, LOBES, circle, radius, k1), 0.1, 1.5, xtol=1e-14)
    # Where the centre curve's numerator vanishes.
    assert np.cos(phi) == pytest.approx((1.0 + (LOBES + 1) * k1**2) / ((LOBES + 2) * k1), abs=1e-13)
    if degrees:
        assert np.degrees(phi) == pytest.approx(degrees, abs=0.05)
    concave, convex = (flank_curvature(p, LOBES, circle, radius, k1) for p in (phi - 0.1, phi + 0.1))
    assert concave < 0.0 < convex


@pytest.mark.parametrize("profile, k1, degrees", [(BX40E, 0.7482, 41.6), (RV20E, 0.6923, None)], ids=["BX40E", "RV20E"])
def test_lever_is_longest_at_the_arc_cosine_of_k1(profile, k1, degrees):
    """sin(alpha) = lever of the normal about the disc's centre over e z_c; its maximum is 1."""
    circle, _, eccentricity = profile
    assert shortening(eccentricity, LOBES, circle) == pytest.approx(k1, abs=5e-5)

    def sine(phi):
        point, normal = flank(phi, profile)
        return abs((point.conjugate() * normal).imag) / (eccentricity * LOBES)

    best = minimize_scalar(lambda p: -sine(p), bounds=(0.1, 2.0), method="bounded", options={"xatol": 1e-10})
    assert best.x == pytest.approx(np.arccos(eccentricity * (LOBES + 1) / circle), abs=1e-7)
    assert -best.fun == pytest.approx(1.0, abs=1e-12)
    if degrees:
        assert np.degrees(best.x) == pytest.approx(degrees, abs=0.05)
    for phi in (0.1, 0.5, 1.0, 2.5):
        root = np.sqrt(1 + k1**2 - 2 * k1 * np.cos(phi))
        assert sine(phi) == pytest.approx(np.sin(phi) / root, rel=1e-4, abs=0)


def test_literature_radii_of_the_bx40e_flank():
    """Radius of the convex flank 2.7 mm at its sharpest; the flank is concave at the root."""
    circle, radius, eccentricity = BX40E
    k1 = shortening(eccentricity, LOBES, circle)
    curvature = [flank_curvature(p, LOBES, circle, radius, k1) for p in np.linspace(0.0, np.pi, 721)]
    assert 1e3 / max(curvature) == pytest.approx(2.7, abs=0.05)
    assert curvature[0] < 0.0


def test_modification_opens_the_gap_that_first_order_theory_gives(rv20e):
    """Gap = dr - dR (1 - K1 cos phi)/sqrt(S) for equidistant dr and shift dR, to second order in them."""
    equidistant, shift, proud = 13e-6, -20e-6, 60e-6
    modification = {"equidistant_modification": equidistant, "shift_modification": shift}
    record = in_equilibrium(rv20e.plant, load_torque=0.0, **modification)
    record.z[:] = 0.0
    record.pin_radius_error[:] = proud
    assemble(record, 0.3, 0.0, 0.0)
    gap = proud - (record.mesh_force_now / record.mesh_constant) ** (1.0 / record.mesh_exponent)
    k1, phi = 36.0 / 52.0, record.mesh_phase
    expected = equidistant - shift * (1.0 - k1 * np.cos(phi)) / np.sqrt(1.0 + k1**2 - 2.0 * k1 * np.cos(phi))
    # Neglected: the displacement along the flank squared times half its curvature.
    assert np.abs(gap - expected).max() < 0.5 * 400.0 * (1.5 * shift) ** 2
