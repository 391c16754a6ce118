"""Worn surfaces as rows of bins: add the wear of a swept arc, read the depth at a place.

A surface is a closed or open row of bins; positions are counted in bins, bin i covers
[i, i+1).  What is added to the bins always sums to what was given.
"""

import math
from typing import Any

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, output, state


def variables(sizes: Sizes) -> list[Variable]:
    disc, contact, bearing = sizes.over("disc"), sizes.over("disc", "pin"), sizes.over("disc", "crank")
    flank_bins, lobes = sizes["flank bin"], sizes["lobe"]
    race, lobe_bin = sizes.over("disc", "crank", bin=sizes["raceway bin"]), sizes.over(bin=flank_bins)

    def surface(name: str, text: str, over: dict[str, Any], last_axes: tuple[tuple[str, int], ...] = ()) -> Variable:
        return state(name, "m", text, **over, nominal=1e-6, profile=True, path=f"surface.{name}", last_axes=last_axes)

    return [
        output("flank.depth", "m", "deepest wear on a disc's flanks", **disc, nominal=1e-6),
        local("flank.phase", "rad", "place of the deepest wear on a tooth: 0 root, pi tip, 2 pi next root", **disc),
        local("flank.lobe", "1", "lobe with the deepest wear, from 1", **disc, integer=True),
        local("pin.depth", "m", "deepest wear on a pin", **contact, nominal=1e-6),
        output("inner_race.depth", "m", "deepest wear of the crank's raceway", **bearing, nominal=1e-6),
        local("inner_race.angle", "rad", "place of the deepest wear, from the eccentric's direction", **bearing),
        output("outer_race.depth", "m", "deepest wear of the disc's raceway", **bearing, nominal=1e-6),
        local("outer_race.angle", "rad", "place of the deepest wear, from the hole's outward radial", **bearing),
        output("flank.volume", "m^3", "material lost by the flanks: integral of K F ds/H", nominal=1e-9),
        output("pin.volume", "m^3", "material lost by the pins", nominal=1e-9),
        output("inner_race.volume", "m^3", "material lost by the cranks' raceways", nominal=1e-9),
        output("outer_race.volume", "m^3", "material lost by the discs' raceways", nominal=1e-9),
        surface("disc_wear", "depth on a disc's circumference, lobe after lobe, each from root over tip to root",
                sizes.over("disc", bin=lobes * flank_bins), last_axes=(("lobe", lobes), ("bin", flank_bins))),
        surface("pin_wear", "depth on a standing pin, from -90 to +90 degrees of its inward radial, per disc",
                sizes.over("disc", "pin", bin=sizes["pin bin"])),
        surface("pin_even_wear", "depth all round a turning pin, per disc", contact),
        surface("inner_race_wear", "depth on a crank's eccentric", race),
        surface("outer_race_wear", "depth in a disc's hole", race),
        state("slide", "m", "sliding length of a contact within a bin of a lobe", **lobe_bin),
        state("slide_before", "m", "its sum up to the bin", **lobe_bin),
        state("arc", "m", "flank length of a bin", **lobe_bin),
    ]


@kernel
def interpolate_closed(depth, position):
    """Depth at a position of a closed row, linear between the bins' middles."""
    n = depth.shape[0]
    x = position - 0.5
    i = math.floor(x)
    part = x - i
    cell = i % n
    return (1.0 - part) * depth[cell] + part * depth[cell + 1 if cell + 1 < n else 0]


@kernel
def interpolate_open(depth, position):
    """The same for an open row; beyond its ends the last bin's depth."""
    n = depth.shape[0]
    x = min(max(position - 0.5, 0.0), n - 1.0)
    i = min(int(x), n - 2)
    part = x - i
    return (1.0 - part) * depth[i] + part * depth[i + 1]


@kernel
def swept_semi_ellipse(x, start, end, half_width):
    """Share of wear left of x, when a Hertz pressure moves evenly from start to end."""
    if end - start < 1e-9 * half_width:
        u = (x - 0.5 * (start + end)) / half_width
        if u <= -1.0:
            return 0.0
        if u >= 1.0:
            return 1.0
        return 0.5 + (u * math.sqrt(1.0 - u * u) + math.asin(u)) / math.pi
    before = semi_ellipse_integral((x - start) / half_width)
    after = semi_ellipse_integral((x - end) / half_width)
    return half_width / (end - start) * (before - after)


@kernel
def semi_ellipse_integral(u):
    """Integral up to u of the distribution function of a semi-ellipse on [-1, 1]."""
    if u <= -1.0:
        return 0.0
    if u >= 1.0:
        return u
    w = math.sqrt(1.0 - u * u)
    return 0.5 * u + (w - w * w * w / 3.0 + u * math.asin(u)) / math.pi


@kernel
def add_footprint(depth, start, end, half_width, amount):
    """Add ``amount`` (depth times bins) along the sweep of a Hertz pressure over an open row.

    What would fall beyond the ends goes into the last bins.  Returns (deepest depth
    touched, its bin).
    """
    n = depth.shape[0]
    low, high = min(start, end), max(start, end)
    first = min(max(math.floor(low - half_width), 0), n - 1)
    last = min(max(math.floor(high + half_width), 0), n - 1)
    deepest, place = 0.0, first
    left = 0.0
    for i in range(first, last + 1):
        right = 1.0 if i == last else swept_semi_ellipse(i + 1.0, low, high, half_width)
        depth[i] += amount * (right - left)
        left = right
        if depth[i] > deepest:
            deepest, place = depth[i], i
    return deepest, place


@kernel
def add_pass(depth, start, end, amount):
    """Add ``amount`` per bin fully swept from start to end over a closed row.

    Returns (deepest depth touched, its bin).
    """
    n = depth.shape[0]
    low, high = min(start, end), max(start, end)
    deepest, place = 0.0, 0
    first = math.floor(low)
    following = first % n
    for i in range(first, math.floor(high) + 1):
        cell, following = following, following + 1 if following + 1 < n else 0
        swept = min(high, i + 1.0) - max(low, float(i))
        if swept <= 0.0:
            continue
        depth[cell] += amount * swept
        if depth[cell] > deepest:
            deepest, place = depth[cell], cell
    return deepest, place


@kernel
def add_flank_pass(depth, start, end, amount, slide, slide_before, arc):
    """Wear of one contact that sweeps a disc's circumference (closed row of lobes).

    ``amount`` is the area worn per slid length (k q, [m]); ``slide`` [bin of a lobe] is
    the sliding length within each bin, ``slide_before`` its sum up to the bin's start,
    ``arc`` the flank length of a bin.  Returns (deepest depth touched, its bin, sliding
    length of the whole sweep [m], an account apart from the bins).
    """
    n, bins = depth.shape[0], arc.shape[0]
    low, high = min(start, end), max(start, end)
    deepest, place = 0.0, 0
    first = math.floor(low)
    following = first % n
    for i in range(first, math.floor(high) + 1):
        cell, following = following, following + 1 if following + 1 < n else 0
        swept = min(high, i + 1.0) - max(low, float(i))
        if swept <= 0.0:
            continue
        phase = cell % bins
        depth[cell] += amount * swept * slide[phase] / arc[phase]
        if depth[cell] > deepest:
            deepest, place = depth[cell], cell
    return deepest, place, slide_to(high, slide, slide_before) - slide_to(low, slide, slide_before)


@kernel
def slide_to(position, slide, slide_before):
    """Sliding length from position 0 [m]; the lobes repeat."""
    bins = slide.shape[0]
    whole = math.floor(position / bins)
    x = position - whole * bins
    i = min(int(x), bins - 1)
    return whole * (slide_before[bins - 1] + slide[bins - 1]) + slide_before[i] + (x - i) * slide[i]
