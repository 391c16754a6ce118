"""Turning-arm needle bearing, roller by roller.

A roller at angle a (in the frame of the disc, from the hole's outward radial) is
squeezed by the shift u of the crank lobe against the hole:

    d = u.e_r(a) - clearance - profile error (what both raceways lack there)

K is the stiffness of the whole roller, both raceways in series.  Forces act on both
rings along one line through the lobe's centre, so that force and moment balance.
"""

import math

from fmu_src.kernel import kernel

from rv_plant.contact import contact_force, damped_force, impact_speed


@kernel
def cage_rate(crank_speed, disc_speed, inner_radius, outer_radius):
    """Speed of the cage against the disc [rad/s], rollers rolling without slip."""
    return (crank_speed - disc_speed) * inner_radius / (inner_radius + outer_radius)


@kernel
def roller_contacts(r, d, c, ux, uy, first_angle, vx, vy, turn_rate, rate_weight):
    """Forces of all rollers of the bearing of disc d on crank c.

    (ux, uy) is the shift of lobe against hole [m], (vx, vy) its rate [m/s],
    ``first_angle`` the direction of roller 1 in the same frame and ``turn_rate`` the
    speed at which the rollers' directions turn [rad/s].  Fills r.roller_force_now[d, c] (N);
    r.bearing_total (3) with the pull on the disc and its moment about the hole's turning
    (N, N, N m); r.bearing_tangent (3, 3), the stiffness with respect to (ux, uy, turning
    of the disc) plus ``rate_weight`` [1/s] times the damping; with 0 nothing moves.
    """
    total, tangent, force = r.bearing_total, r.bearing_tangent, r.roller_force_now[d, c]
    for i in range(3):
        total[i] = 0.0
        for j in range(3):
            tangent[i, j] = 0.0
    n = force.shape[0]
    gap = r.roller_gap_now[d, c]
    # Directions by rotation: one sine and cosine a bearing instead of one a roller.
    ex, ey = math.cos(first_angle), math.sin(first_angle)
    step_c, step_s = math.cos(2.0 * math.pi / n), math.sin(2.0 * math.pi / n)
    for i in range(n):
        approach = ux * ex + uy * ey - r.bearing_clearance - gap[i] - r.roller_profile_error[d, c, i]
        f = 0.0
        if approach > 0.0:
            twist = uy * ex - ux * ey
            if rate_weight == 0.0:
                f, k = contact_force(approach, r.roller_constant, r.roller_exponent)
            else:
                rate = vx * ex + vy * ey + twist * turn_rate
                r.roller_rate[d, c, i] = rate
                f, k, by_rate, elastic = damped_force(
                    approach, rate, r.roller_constant, r.roller_exponent, r.damping_law, r.roller_damping_now,
                    r.damping_depth, impact_speed(r.roller_impact_speed[d, c, i], rate),
                )
                k += rate_weight * by_rate
                r.potential += elastic * approach / (r.roller_exponent + 1.0)
                r.dissipation += (f - elastic) * rate
                # The rollers go with the cage, whose drive is not modelled: its work is accounted for.
                r.cage_power += f * twist * turn_rate
            total[0] += f * ex
            total[1] += f * ey
            total[2] += f * twist
            # The roller's direction turns with the disc: the terms in f.
            tangent[0, 0] += k * ex * ex
            tangent[0, 1] += k * ex * ey
            tangent[0, 2] += k * ex * twist - f * ey
            tangent[1, 1] += k * ey * ey
            tangent[1, 2] += k * ey * twist + f * ex
            tangent[2, 2] += k * twist * twist - f * (ux * ex + uy * ey)
        force[i] = f
        ex, ey = ex * step_c - ey * step_s, ex * step_s + ey * step_c
    tangent[1, 0] = tangent[0, 1]
    tangent[2, 0] = tangent[0, 2]
    tangent[2, 1] = tangent[1, 2]
