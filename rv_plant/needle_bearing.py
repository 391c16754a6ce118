"""Turning-arm needle bearing, roller by roller.

A roller at angle a (in the frame of the disc, from the hole's outward radial) is
squeezed by the shift u of the crank lobe against the hole:

    d = u.e_r(a) - clearance - profile error (what both raceways lack there)

K is the stiffness of the whole roller, both raceways in series.  Forces act on both
rings along one line through the lobe's centre, so that force and moment balance.
"""

import math

from fmu_src.kernel import kernel

from rv_plant.contact import contact_force


@kernel
def cage_rate(crank_speed, disc_speed, inner_radius, outer_radius):
    """Speed of the cage against the disc [rad/s], rollers rolling without slip."""
    return (crank_speed - disc_speed) * inner_radius / (inner_radius + outer_radius)


@kernel
def roller_contacts(ux, uy, first_angle, clearance, profile_error, stiffness, exponent, force, total, tangent):
    """Forces of all rollers of one bearing for the shift (ux, uy) of lobe against hole [m].

    ``first_angle`` is the direction of roller 1 in the frame of u.  Fills ``force``
    [roller] (N); ``total`` (3) with the pull on the disc and its moment about the
    hole's turning (N, N, N m); ``tangent`` (3, 3), the stiffness with respect to
    (ux, uy, turning of the disc).
    """
    for i in range(3):
        total[i] = 0.0
        for j in range(3):
            tangent[i, j] = 0.0
    n = force.shape[0]
    # Directions by rotation: one sine and cosine a bearing instead of one a roller.
    ex, ey = math.cos(first_angle), math.sin(first_angle)
    step_c, step_s = math.cos(2.0 * math.pi / n), math.sin(2.0 * math.pi / n)
    for r in range(n):
        f, k = contact_force(ux * ex + uy * ey - clearance - profile_error[r], stiffness, exponent)
        force[r] = f
        if f > 0.0:
            twist = uy * ex - ux * ey
            total[0] += f * ex
            total[1] += f * ey
            total[2] += f * twist
            tangent[0, 0] += k * ex * ex
            tangent[0, 1] += k * ex * ey
            tangent[0, 2] += k * ex * twist
            tangent[1, 1] += k * ey * ey
            tangent[1, 2] += k * ey * twist
            tangent[2, 2] += k * twist * twist
            # The roller's direction turns with the disc.
            tangent[0, 2] -= f * ey
            tangent[1, 2] += f * ex
            tangent[2, 2] -= f * (ux * ex + uy * ey)
        ex, ey = ex * step_c - ey * step_s, ex * step_s + ey * step_c
    tangent[1, 0] = tangent[0, 1]
    tangent[2, 0] = tangent[0, 2]
    tangent[2, 1] = tangent[1, 2]
