"""The cycloid disc: profile, normal, curvature, and the distance of a pin to it.

A pin centre seen from the disc runs on a shortened epitrochoid; the flank is the
curve at the pin's radius from it.  Per lobe, with the local phase phi (0 at the root,
pi at the tip) and complex numbers for points of the disc plane (lobe's root on the
real axis):

    B(phi) = exp(i phi/z_c) (R - e exp(i phi))       centre curve
    n(phi) = exp(i phi/z_c) (1 - K1 exp(i phi))/sqrt(S)   outward normal
    X(phi) = B - r n                                  flank
    S = 1 + K1^2 - 2 K1 cos(phi),  K1 = e z_p / R

R, r are the generating radii: pin circle and pin radius plus shift and equidistant
modification.  (Litvin and Fuentes, Gear Geometry, 2004, ch. 13; Malhotra and
Parameswaran 1983.  The printed profile of the BX-40E document has a sign error in y.)
"""

import math

from fmu_src.kernel import kernel


@kernel
def shortening(eccentricity, lobes, generating_circle):
    """K1 = e z_p / R, with one pin more than lobes."""
    return eccentricity * (lobes + 1) / generating_circle


@kernel
def sliding_per_crank_angle(phi, lobes, pin_circle_radius, pin_radius, k1):
    """Sliding of flank on pin per turning of the cranks [m/rad]: (R sqrt(S) - r)/z_c."""
    return (pin_circle_radius * math.sqrt(1.0 + k1 * k1 - 2.0 * k1 * math.cos(phi)) - pin_radius) / lobes


@kernel
def centre_curve_curvature(phi, lobes, generating_circle, k1):
    """Curvature of the centre curve [1/m], positive where the lobe is convex."""
    s = 1.0 + k1 * k1 - 2.0 * k1 * math.cos(phi)
    bend = 1.0 + (lobes + 1) * k1 * k1 - (lobes + 2) * k1 * math.cos(phi)
    return bend / (generating_circle * s * math.sqrt(s))


@kernel
def flank_curvature(phi, lobes, generating_circle, generating_radius, k1):
    """Curvature of the flank [1/m]: positive convex, negative concave.

    A parallel curve at distance r inside has the radius of curvature less r.
    """
    centre = centre_curve_curvature(phi, lobes, generating_circle, k1)
    return centre / (1.0 - generating_radius * centre)


@kernel
def lobe_point(phi, lobes, generating_circle, generating_radius, eccentricity, k1):
    """Point of the flank and its outward normal (x, y, n_x, n_y) in the lobe's frame [m]."""
    c1, s1 = math.cos(phi / lobes), math.sin(phi / lobes)
    c, s = math.cos(phi), math.sin(phi)
    root = math.sqrt(1.0 + k1 * k1 - 2.0 * k1 * c)
    wx, wy = (1.0 - k1 * c) / root, -k1 * s / root
    nx, ny = c1 * wx - s1 * wy, s1 * wx + c1 * wy
    px, py = generating_circle - eccentricity * c, -eccentricity * s
    x, y = c1 * px - s1 * py, s1 * px + c1 * py
    return x - generating_radius * nx, y - generating_radius * ny, nx, ny


@kernel
def turn_of(angle):
    """(cos, sin) of an angle; by series where it is small, as the shift of a contact nearly always is."""
    if abs(angle) > 0.05:
        return math.cos(angle), math.sin(angle)
    s = angle * angle
    # The first terms left out are below 1e-19.
    c = 1.0 - s / 2.0 * (1.0 - s * (1.0 / 12.0) * (1.0 - s * (1.0 / 30.0) * (1.0 - s * (1.0 / 56.0))))
    by = 1.0 - s * (1.0 / 6.0) * (1.0 - s * (1.0 / 20.0) * (1.0 - s * (1.0 / 42.0) * (1.0 - s * (1.0 / 72.0))))
    return c, angle * by


@kernel
def least_distance(cx, cy, ideal_cos, ideal_sin, generating_circle, eccentricity, k1, hollow):
    """Less than ``closest_distance`` [m] in the same frame, without iteration.

    From the tangent at the ideal contact: along it the curve comes nearer by no more than
    its sharpest hollow makes it, the curvature ``hollow`` [1/m] at the root (0: none); twice that
    suffices up to a third of the hollow's radius (50 um).  Further off nothing is promised.
    """
    wx, wy = 1.0 - k1 * ideal_cos, -k1 * ideal_sin
    dx, dy = cx - generating_circle + eccentricity * ideal_cos, cy + eccentricity * ideal_sin
    if 9.0 * hollow * hollow * (dx * dx + dy * dy) > 1.0:
        return -math.inf
    per_square = 1.0 / (wx * wx + wy * wy)
    along = dy * wx - dx * wy
    return (dx * wx + dy * wy) * math.sqrt(per_square) - hollow * along * along * per_square


@kernel
def curvature_and_slopes(c, s, lobes, generating_circle, k1):
    """Curvature of the centre curve and its first two derivatives along the arc [1/m, 1/m^2, 1/m^3] at the phase of cosine ``c`` and sine ``s``,

    and that of the phase [rad/m].
    """
    s2 = 1.0 + k1 * k1 - 2.0 * k1 * c
    per_s2 = 1.0 / s2
    top = 1.0 + (lobes + 1) * k1 * k1 - (lobes + 2) * k1 * c
    steep = (lobes + 2) - 3.0 * top * per_s2
    steeper = -3.0 * k1 * s * ((lobes + 2) * s2 - 2.0 * top) * per_s2 * per_s2
    per_arc = lobes / generating_circle
    root = math.sqrt(per_s2)
    slope = per_arc / generating_circle * k1 * s * steep * per_s2 * per_s2
    curl = c * steep + s * steeper - 4.0 * k1 * s * s * steep * per_s2
    curl *= per_arc * per_arc / generating_circle * k1 * per_s2 * per_s2 * root
    return top * per_s2 * root / generating_circle, slope, curl, per_arc * root


@kernel
def closest_distance(cx, cy, ideal_cos, ideal_sin, shift, lobes, generating_circle, eccentricity, k1):
    """True closest distance of a pin centre (cx, cy) to the centre curve of a lobe.

    The phase is the ideal one, given by cosine and sine, plus ``shift`` [rad], the start of
    the Newton iteration, which stands on (c - B).t = 0.  The frame is the lobe's, turned
    by the ideal phase over z_c.  The closest point of a parallel curve lies on the same
    normal, so the distance to the flank is this one plus the generating radius.  Returns
    (shift, g, n_x, n_y, curvature of the centre curve): g [m] is positive outside.
    """
    g = nx = ny = bend = 0.0
    per_lobe, per_circle = 1.0 / lobes, 1.0 / generating_circle
    # Converges quadratically: from a phase one radian off the root it takes five.
    for _ in range(20):
        c1, s1 = turn_of(shift * per_lobe)
        shift_cos, shift_sin = turn_of(shift)
        c = ideal_cos * shift_cos - ideal_sin * shift_sin
        s = ideal_sin * shift_cos + ideal_cos * shift_sin
        s2 = 1.0 + k1 * k1 - 2.0 * k1 * c
        per_root = 1.0 / math.sqrt(s2)
        wx, wy = (1.0 - k1 * c) * per_root, -k1 * s * per_root
        nx, ny = c1 * wx - s1 * wy, s1 * wx + c1 * wy
        px, py = generating_circle - eccentricity * c, -eccentricity * s
        dx, dy = cx - (c1 * px - s1 * py), cy - (s1 * px + c1 * py)
        g = dx * nx + dy * ny
        along = dy * nx - dx * ny
        bend = (1.0 + (lobes + 1) * k1 * k1 - (lobes + 2) * k1 * c) * per_root * per_root * per_root * per_circle
        per_reach = 1.0 / (1.0 + bend * g)
        turn = along * lobes * per_circle * per_root * per_reach
        shift += turn
        # Below 1e-5 rad the last correction is carried to distance and normal to first
        # order, which leaves errors of 1e-15 m and 1e-10 rad.
        if abs(turn) < 1e-5:
            swing = along * bend * per_reach
            g += 0.5 * along * swing
            nx, ny = nx - swing * ny, ny + swing * nx
            break
    return shift, g, nx, ny, bend
