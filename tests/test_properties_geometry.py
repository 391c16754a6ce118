"""The distance of a pin to any cycloid disc, against a search along the whole lobe."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from properties import examples
from scipy.optimize import minimize_scalar
from twin import centre_curve, outward_normal

from rv_plant.geometry import centre_curve_curvature, closest_distance, flank_curvature, least_distance, lobe_point, shortening

# (lobes, pin circle radius [m], shortening)
discs = st.tuples(st.integers(3, 80), st.floats(5e-3, 0.5), st.floats(0.1, 0.9))
phases, starts = st.floats(-np.pi, np.pi), st.floats(-0.2, 0.2)
# How far the pin stands from its ideal place: share of the curve's least radius of curvature, and direction.
displacements = st.tuples(st.floats(0.0, 0.2), st.floats(-np.pi, np.pi))


def at_disc(disc):
    lobes, circle, k1 = disc
    return lobes, circle, k1 * circle / (lobes + 1), k1


def least_radius(lobes, circle, k1):
    bend = max(abs(centre_curve_curvature(phi, lobes, circle, k1)) for phi in np.linspace(0.0, np.pi, 91))
    return 1.0 / bend


def searched(centre, phi, lobes, circle, eccentricity):
    """Signed distance to the nearest point of the centre curve within half a lobe."""
    def away(angle):
        return abs(centre - centre_curve(angle, lobes, circle, eccentricity))

    grid = phi + np.linspace(-np.pi, np.pi, 721)
    near = grid[np.argmin(away(grid))]
    found = minimize_scalar(away, bounds=(near - 0.01, near + 0.01), method="bounded", options={"xatol": 1e-12})
    normal = outward_normal(found.x, lobes, circle, eccentricity)
    return ((centre - centre_curve(found.x, lobes, circle, eccentricity)) * normal.conjugate()).real


@examples(4)
@given(discs, phases, starts, displacements)
def test_closest_distance_is_what_a_search_finds(disc, phi, start, displacement):
    lobes, circle, eccentricity, k1 = at_disc(disc)
    size, direction = displacement
    away = size * least_radius(lobes, circle, k1) * np.exp(1j * direction)
    ideal = complex(circle - eccentricity * np.cos(phi), -eccentricity * np.sin(phi))
    seen = ideal + away
    _, gap, nx, ny, bend = closest_distance(
        seen.real, seen.imag, np.cos(phi), np.sin(phi), start * np.cos(phi / 2), lobes, circle, eccentricity, k1
    )
    expected = searched(seen * np.exp(1j * phi / lobes), phi, lobes, circle, eccentricity)
    # Another part of a small lobe may be as near.
    assume(abs(expected) > 0.9 * abs(gap))
    assert abs(gap - expected) < 1e-9 * circle
    # To first order in the last correction of the phase, which is below 1e-5 rad.
    assert abs(nx * nx + ny * ny - 1.0) < 1e-7
    assert abs(gap) <= abs(away) * (1.0 + 1e-9) + 1e-15
    hollow = max(0.0, -centre_curve_curvature(0.0, lobes, circle, k1))
    bound = least_distance(seen.real, seen.imag, np.cos(phi), np.sin(phi), circle, eccentricity, k1, hollow)
    assert bound <= gap + 1e-12 * circle


@examples(4)
@given(discs, phases, st.floats(0.01, 0.8))
def test_the_flank_lies_at_the_pins_radius_from_the_centre_curve(disc, phi, share):
    lobes, circle, eccentricity, k1 = at_disc(disc)
    radius = share * least_radius(lobes, circle, k1)
    x, y, nx, ny = lobe_point(phi, lobes, circle, radius, eccentricity, shortening(eccentricity, lobes, circle))
    centre = centre_curve(phi, lobes, circle, eccentricity)
    assert abs(abs(complex(x, y) - centre) - radius) < 1e-12 * circle
    assert abs(complex(nx, ny) - outward_normal(phi, lobes, circle, eccentricity)) < 1e-9
    # A lobe is the mirror image of itself.
    mx, my, _, _ = lobe_point(-phi, lobes, circle, radius, eccentricity, shortening(eccentricity, lobes, circle))
    assert abs(complex(mx, -my) - complex(x, y)) < 1e-12 * circle
    # The radii of curvature of parallel curves differ by their distance.
    inner, outer = flank_curvature(phi, lobes, circle, radius, k1), centre_curve_curvature(phi, lobes, circle, k1)
    assert abs(inner - outer - radius * inner * outer) < 1e-9 * max(abs(inner), abs(outer))
