"""Contours of the parts in the plane, as complex numbers in mm, and their worn copies."""

import math

import numpy as np

from fmu_src.arrays import Floats, Points
from pages import look
from rv_plant.geometry import flank_curvature, lobe_point
from studies.report.result import Result

MM = 1e3


def flank(result: Result, phases: Floats) -> tuple[Points, Points]:
    """(points [mm], outward normals) of one lobe at local phases [deg], in the lobe's frame."""
    circle, radius, k1 = result.generating
    eccentricity, lobes = result.plant["eccentricity"], result.topology.lobes
    rows = np.array([lobe_point(math.radians(p), lobes, circle, radius, eccentricity, k1) for p in phases])
    return MM * (rows[:, 0] + 1j * rows[:, 1]), rows[:, 2] + 1j * rows[:, 3]


def sharpest_radius(result: Result) -> float:
    """Smallest convex radius of the flank [mm]; infinite if there is none."""
    circle, radius, k1 = result.generating
    bends = [flank_curvature(phi, result.topology.lobes, circle, radius, k1) for phi in np.linspace(0.0, math.pi, 181)]
    return MM / max(bends) if max(bends) > 0.0 else math.inf


def directions(angles: Floats) -> Points:
    """Unit vectors at angles [deg]."""
    return np.asarray(np.exp(1j * np.radians(angles)))


def ring(radius: float, centre: complex = 0.0, count: int = 120) -> Points:
    """A closed circle."""
    return centre + radius * directions(np.linspace(0.0, 360.0, count + 1))


def magnification(depth: float, room: float) -> float:
    """How many times wear of ``depth`` is enlarged to be at most ``room`` long; 0 if nothing is worn."""
    return look.round_down(room / depth, (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0)) if depth > 0.0 else 0.0


def levels(depth: float, most: int = 8) -> Floats:
    """Edges of round colour steps from 0 to at least ``depth``."""
    if depth <= 0.0:
        return np.array([0.0, 1.0])
    power = 10.0 ** math.floor(math.log10(depth / most))
    step = next(s * power for s in (1.0, 2.0, 2.5, 5.0, 10.0) if depth <= s * power * most)
    return step * np.arange(math.ceil(depth / step - 1e-9) + 1, dtype=float)


def bands(nominal: Points, worn: Points, depth: Floats, edges: Floats) -> list[list[Points]]:
    """Strips between nominal and worn contour (closed rows), sorted by their depth's colour step.

    Entry i holds the polygons of step i; what is less than a hundredth of a step deep is left out.
    """
    following = np.roll(np.arange(nominal.size), -1)
    middle = 0.5 * (depth + depth[following])
    step = np.clip(np.searchsorted(edges, middle, side="right") - 1, 0, edges.size - 2)
    step[middle < 0.01 * (edges[1] - edges[0])] = -1
    strips: list[list[Points]] = [[] for _ in range(edges.size - 1)]
    borders = np.flatnonzero(np.diff(step)) + 1
    for run in np.split(np.arange(nominal.size), borders):
        if step[run[0]] >= 0:
            places = np.append(run, following[run[-1]])
            strips[step[run[0]]].append(np.concatenate((nominal[places], worn[places[::-1]])))
    return strips


def joined(polygons: list[Points]) -> Points:
    """Polygons in one row, NaN between them."""
    gap = np.array([complex(math.nan, math.nan)])
    return np.concatenate([part for polygon in polygons for part in (polygon, gap)]) if polygons else gap


def thin(values: np.ndarray, count: int) -> np.ndarray:
    """Every so many-th of the last axis, so that about ``count`` are left."""
    return values[..., :: max(1, round(values.shape[-1] / count))]


def enlargement(result: Result, share: float) -> float:
    """How many times wear is enlarged: at most to a share of the tooth's height and of its sharpest radius."""
    deepest = max(result[name][-1] for name in look.SURFACES)
    room = share * min(2.0 * MM * result.plant["eccentricity"], sharpest_radius(result))
    return magnification(1e-3 * deepest, room)


def enlarged_text(times: float) -> str:
    return f"Wear is drawn {times:,.0f} times too large." if times else "Nothing is worn."
