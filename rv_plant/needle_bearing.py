"""Turning-arm needle bearing, roller by roller.

A roller at angle a (in the frame of the disc, from the hole's outward radial) is
squeezed by the shift u of the crank's eccentric against the hole:

    d = u.e_r(a) - clearance - profile error (what both raceways lack there)

K is the stiffness of the whole roller, both raceways in series.  Forces act on both
rings along one line through the eccentric's centre, so that force and moment balance.
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, output, scratch, state
from rv_plant.contact import contact_force, damped_force, force_beside, impact_speed
from rv_plant.dimension import FILE, length


def variables(sizes: Sizes) -> list[Variable]:
    roller = sizes.over("disc", "crank", "roller")
    return [
        Variable("roller.profile_error", "input", "m", "what both raceways lack at a roller", **roller, nominal=1e-6),
        length("inner_race.radius", "radius of the crank's eccentric", 1e-4, 10.25e-3),
        length("outer_race.radius", "radius of the hole in the disc", 1e-4, 13.25e-3),
        length("roller.radius", "radius of the needle rollers", 1e-5, 1.5e-3),
        length("roller.length", "length of the needle rollers", 1e-5, 8e-3),
        length("bearing.clearance", "radial clearance of the needle bearings (half the diametral one)", -1e-4,
               maximum=1e-3, display="um"),
        Variable("roller.stiffness", "parameter", "N",
                 "force of a roller between both races at 1 mm of approach, exponent 10/9", 5.1e5, minimum=1.0,
                 nominal=1e5, source=FILE),
        Variable("roller.stiffness_lankarani", "parameter", "N", "force of a roller between both races at 1 mm of approach, Lankarani-Nikravesh law", 5.1e6,
                 minimum=1.0, nominal=1e6, source=FILE),
        Variable("roller.damping", "parameter", "N.s/m", "coefficient C of a roller (law step)", 200.0, minimum=0.0,
                 nominal=100.0, source="assumed: as disc and pin"),
        output("cage.angle", "rad", "angle of the roller cages against the discs"),
        output("cage.speed", "rad/s", "speed of the roller cages against the discs"),
        output("roller.force", "N", "force on a roller", **roller, nominal=100.0),
        # What effects add to the ideal parts.
        state("roller_gap_added", "m", "added to a bearing's radial clearance, by roller: above 0 looser", **roller),
        state("roller_gap_now", "m", "radial clearance of a bearing at the present angle, by roller, with what depends on it: above 0 looser", **roller),
        state("cage_share", "1", "speed of the cages over that of pure rolling"),
        state("cage", "rad", "angle of the cages"),
        state("cage_power", "W", "power of the cages' prescribed motion"),
        state("roller_constant", "1", "K of a roller in N/m^n"),
        state("roller_exponent", "1", "n of a roller"),
        state("roller_damping_now", "1", "coefficient of the chosen law for a roller"),
        state("roller_force_now", "N", "force of the last equilibrium", **roller),
        state("roller_impact_speed", "m/s", "speed of approach at first touch", **roller),
        scratch("roller_rate", roller["shape"]),
        # Approach and force of the equilibrium's first assembly.
        scratch("roller_known", roller["shape"]), scratch("roller_known_force", roller["shape"]),
        # Sum and tangent of one bearing, see roller_contacts.
        scratch("bearing_total", (3,)), scratch("bearing_tangent", (3, 3)),
    ]


@kernel
def clear_clearances(r):
    """No effect adds to a bearing's clearance."""
    discs, cranks, rollers = r.roller_gap_added.shape
    for d in range(discs):
        for c in range(cranks):
            for k in range(rollers):
                r.roller_gap_added[d, c, k] = 0.0


@kernel
def take_clearances(r):
    """Clearances at the present angle start from those that hold at every angle."""
    discs, cranks, rollers = r.roller_gap_now.shape
    for d in range(discs):
        for c in range(cranks):
            for k in range(rollers):
                r.roller_gap_now[d, c, k] = r.roller_gap_added[d, c, k]


@kernel
def cage_rate(crank_speed, disc_speed, inner_radius, outer_radius):
    """Speed of the cage against the disc [rad/s], rollers rolling without slip."""
    return (crank_speed - disc_speed) * inner_radius / (inner_radius + outer_radius)


@kernel
def roller_contacts(r, d, c, ux, uy, first_angle, vx, vy, turn_rate, rate_weight, near):
    """Forces of all rollers of the bearing of disc d on crank c.

    (ux, uy) is the shift of lobe against hole [m], (vx, vy) its rate [m/s],
    ``first_angle`` the direction of roller 1 in the same frame and ``turn_rate`` the
    speed at which the rollers' directions turn [rad/s].  Fills r.roller_force_now[d, c] (N);
    r.bearing_total (3) with the pull on the disc and its moment about the hole's turning
    (N, N, N m); r.bearing_tangent (3, 3), the stiffness with respect to (ux, uy, turning
    of the disc) plus ``rate_weight`` [1/s] times the damping; with 0 nothing moves.
    ``near``: beside the last call without it, whose forces are known.
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
            if near:
                f, k = force_beside(approach, r.roller_known[d, c, i], r.roller_known_force[d, c, i], r.roller_constant, r.roller_exponent)
            elif rate_weight == 0.0:
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
        if rate_weight == 0.0 and not near:
            r.roller_known[d, c, i], r.roller_known_force[d, c, i] = max(0.0, approach), f
        ex, ey = ex * step_c - ey * step_s, ex * step_s + ey * step_c
    tangent[1, 0] = tangent[0, 1]
    tangent[2, 0] = tangent[0, 2]
    tangent[2, 1] = tangent[1, 2]
