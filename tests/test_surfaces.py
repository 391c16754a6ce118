"""Bins of worn surfaces: what goes in comes out, and where."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from wear_fmu.kinematics import flank_arc_per_phase, sliding_per_crank_angle
from wear_fmu.surfaces import (
    add_flank_pass,
    add_footprint,
    add_pass,
    interpolate_closed,
    interpolate_open,
    slide_to,
    swept_semi_ellipse,
)

SWEEPS = [(3.2, 3.9), (3.2, 7.75), (7.75, 3.2), (-5.5, 2.5), (38.5, 41.25), (-0.25, 100.5), (4.0, 5.0), (6.0, 6.0)]
EVERY_SWEEP = pytest.mark.parametrize("start, end", SWEEPS)
LOBES, PROFILE = 39, (39, 69.5e-3, 3e-3, 52 / 69.5)


def covered(bins, start, end):
    """How much of each bin of a closed row a sweep covers: overlap with all images of the bin."""
    low, high = min(start, end), max(start, end)
    edges = np.arange(np.floor(low) - 1, np.ceil(high) + 2).astype(int)
    overlap = np.clip(np.minimum(high, edges + 1) - np.maximum(low, edges), 0.0, None)
    return np.bincount(edges % bins, weights=overlap, minlength=bins)


@EVERY_SWEEP
def test_a_pass_adds_the_swept_share_of_each_bin(start, end):
    depth = np.zeros(40)
    deepest, place = add_pass(depth, start, end, 2e-9)
    assert depth == pytest.approx(2e-9 * covered(40, start, end), rel=1e-12, abs=1e-24)
    assert depth.sum() == pytest.approx(2e-9 * abs(end - start), rel=1e-12, abs=0)
    assert depth.min() >= 0.0
    assert deepest == depth.max() and (deepest == 0.0 or depth[place] == deepest)


@EVERY_SWEEP
def test_passes_add_up(start, end):
    middle = 0.5 * (start + end)
    whole, parts = np.zeros(40), np.zeros(40)
    add_pass(whole, start, end, 1.0)
    add_pass(parts, start, middle, 1.0)
    add_pass(parts, middle, end, 1.0)
    assert parts == pytest.approx(whole, abs=1e-12)


@pytest.mark.parametrize("start, end", [(0.0, 3.0), (-0.4, 0.3), (2.0, 2.5), (1.0, 1.0)])
@pytest.mark.parametrize("x", [-1.5, -0.3, 0.1, 1.4, 2.9, 4.5])
def test_swept_semi_ellipse_against_numerical_integration(x, start, end):
    half_width = 0.8

    def left_of_x(middle):
        """Share of one semi-ellipse about ``middle`` left of x."""
        u = np.clip((x - middle) / half_width, -1, 1)
        return 0.5 + (u * np.sqrt(1 - u * u) + np.arcsin(u)) / np.pi

    corners = [p for p in (x - half_width, x + half_width) if start < p < end]
    expected = left_of_x(start)
    if end > start:
        expected = quad(left_of_x, start, end, points=corners or None, epsabs=1e-12)[0] / (end - start)
    assert swept_semi_ellipse(x, start, end, half_width) == pytest.approx(expected, abs=1e-10)


def test_share_left_of_x_within_one_semi_ellipse_is_its_integral():
    for x in (-0.7, 0.0, 0.31):
        area = quad(lambda u: np.sqrt(1 - u * u), -1, x)[0] / (np.pi / 2)
        assert swept_semi_ellipse(x, 0.0, 0.0, 1.0) == pytest.approx(area, abs=1e-9)


def test_a_short_sweep_goes_over_into_a_standing_contact():
    standing = swept_semi_ellipse(0.3, 0.0, 0.0, 1.0)
    for length in (1e-12, 1e-9, 1.1e-9, 1e-7, 1e-5):
        assert swept_semi_ellipse(0.3, -length / 2, length / 2, 1.0) == pytest.approx(standing, abs=1e-6)


@pytest.mark.parametrize("start, end", [(5.2, 9.7), (9.7, 5.2), (5.5, 5.5), (0.3, 0.4), (18.9, 19.6), (-2.0, 22.0)])
@pytest.mark.parametrize("half_width", [0.05, 0.7, 3.0])
def test_a_footprint_keeps_its_amount_and_its_shape(start, end, half_width):
    depth = np.zeros(20)
    deepest, place = add_footprint(depth, start, end, half_width, 1e-8)
    assert depth.sum() == pytest.approx(1e-8, rel=1e-12, abs=0)
    assert depth.min() >= 0.0
    assert deepest == depth.max() == depth[place]
    # Many short contacts; what lies beyond the row goes into its last bins.
    middles = start + (np.arange(4000) + 0.5) / 4000 * (end - start)
    u = np.clip((np.arange(1, 20)[:, None] - middles) / half_width, -1, 1)
    left = np.mean(0.5 + (u * np.sqrt(1 - u * u) + np.arcsin(u)) / np.pi, axis=1)
    assert depth == pytest.approx(1e-8 * np.diff(np.concatenate([[0.0], left, [1.0]])), abs=2e-13)


def test_long_sweep_has_the_same_depth_whatever_the_hertz_width():
    depths = []
    for half_width in (0.2, 0.4, 1.6):
        depth = np.zeros(40)
        add_footprint(depth, 5.0, 35.0, half_width, 30.0)
        depths.append(depth[10:30])
        assert depth[10:30] == pytest.approx(1.0, rel=1e-12, abs=0)
    assert depths[0] == pytest.approx(depths[2], rel=1e-12, abs=0)


def lobe_tables(bins):
    """(slide, slide_before, arc) of one lobe of the BX-40E by adaptive integration."""
    edges = np.linspace(0, 2 * np.pi, bins + 1)
    slide, arc = (
        np.array([quad(f, a, b, args=PROFILE, epsabs=1e-16)[0] for a, b in itertools.pairwise(edges)])
        for f in (sliding_per_crank_angle, flank_arc_per_phase)
    )
    return slide, np.concatenate([[0.0], np.cumsum(slide)[:-1]]), arc


@EVERY_SWEEP
def test_worn_area_of_a_flank_pass_is_the_sum_over_its_bins(start, end):
    bins, lobes = 12, 5
    tables = lobe_tables(bins)
    depth = np.zeros(bins * lobes)
    deepest, place, slid = add_flank_pass(depth, start, end, 3e-12, *tables)
    worn = 3e-12 * slid
    assert np.sum(depth.reshape(lobes, bins) * tables[2]) == pytest.approx(worn, rel=1e-13, abs=1e-30)
    share = covered(bins * lobes, start, end).reshape(lobes, bins)
    assert worn == pytest.approx(3e-12 * np.sum(share * tables[0]), rel=1e-12, abs=0)
    assert depth.min() >= 0.0 and deepest == depth.max()
    assert deepest == 0.0 or depth[place] == deepest


@pytest.mark.parametrize("half_width", [20e-6, 80e-6])
@pytest.mark.parametrize("phi", [0.3, 0.703, 1.5, 2.8])
def test_depth_of_a_flank_pass_is_that_of_a_hertz_pressure_that_slides_by(phi, half_width):
    """A material point under the passing pressure: depth = integral of k p v_s dt, whatever the width."""
    k, line_load, contact_speed = 7e-19, 6e4, 0.1
    # Slow change of both speeds along the flank is left out: they are those at the point.
    sliding = sliding_per_crank_angle(phi, *PROFILE) / flank_arc_per_phase(phi, *PROFILE) * contact_speed
    peak = 2 * line_load / (np.pi * half_width)
    duration = half_width / contact_speed

    def rate(time):
        return k * peak * np.sqrt(max(0.0, 1 - (contact_speed * time / half_width) ** 2)) * sliding

    expected = quad(rate, -duration, duration)[0]
    bins = 720
    depth = np.zeros(bins)
    edges = np.linspace(0, 2 * np.pi, bins + 1)
    cell = int(phi / (2 * np.pi) * bins)
    slide, arc = np.zeros(bins), np.ones(bins)
    slide[cell], arc[cell] = (
        quad(f, edges[cell], edges[cell + 1], args=PROFILE)[0] for f in (sliding_per_crank_angle, flank_arc_per_phase)
    )
    add_flank_pass(depth, cell - 2.5, cell + 4.5, k * line_load, slide, np.zeros(bins), arc)
    assert depth[cell] == pytest.approx(expected, rel=0.01, abs=0)


def test_depth_of_a_flank_pass_converges_with_the_square_of_the_bin():
    """Deposited with a load that varies along the flank, read back between the bins."""
    phases = np.linspace(0.5, 6.0, 400)

    def area_rate(phi):
        return 1e-13 * (1 + np.sin(phi) ** 2)

    exact = np.array([area_rate(p) * sliding_per_crank_angle(p, *PROFILE) / flank_arc_per_phase(p, *PROFILE)
                      for p in phases])
    errors = []
    for bins in (45, 90, 180):
        tables = lobe_tables(bins)
        depth = np.zeros(bins)
        for i in range(8 * bins):
            add_flank_pass(depth, i / 8, (i + 1) / 8, area_rate(2 * np.pi * (i + 0.5) / 8 / bins), *tables)
        read = np.array([interpolate_closed(depth, p / (2 * np.pi) * bins) for p in phases])
        errors.append(np.abs(read - exact).max() / exact.max())
    assert errors[-1] < 2e-3
    assert np.log2(errors[0] / errors[1]) > 1.8 and np.log2(errors[1] / errors[2]) > 1.8


def test_sliding_length_goes_on_over_the_lobes():
    tables = lobe_tables(12)
    for position in (-13.7, -0.2, 0.0, 5.5, 12.0, 30.25):
        expected = quad(sliding_per_crank_angle, 0, 2 * np.pi * np.floor(position) / 12, args=PROFILE, limit=200)[0]
        expected += (position - np.floor(position)) * tables[0][int(np.floor(position)) % 12]
        assert slide_to(position, tables[0], tables[1]) == pytest.approx(expected, rel=1e-9, abs=1e-15)


def test_interpolation_meets_the_bins_in_their_middles_and_lines_between_them():
    depth = np.array([1.0, 4.0, 2.0, 8.0])
    for i in range(4):
        assert interpolate_closed(depth, i + 0.5) == interpolate_open(depth, i + 0.5) == depth[i]
    assert interpolate_closed(depth, 2.0) == interpolate_open(depth, 2.0) == pytest.approx(3.0)
    # A closed row repeats, an open one ends.
    assert interpolate_closed(depth, 0.0) == interpolate_closed(depth, 4.0) == pytest.approx(4.5)
    assert interpolate_closed(depth, -7.25) == pytest.approx(interpolate_closed(depth, 0.75))
    assert (interpolate_open(depth, -3.0), interpolate_open(depth, 9.0)) == (1.0, 8.0)
