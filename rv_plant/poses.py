"""Where the parts of the cranks' joints are, part errors included."""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, state
from rv_plant.dimension import deviation, length


def variables(sizes: Sizes) -> list[Variable]:
    bearing, crank = sizes.over("disc", "crank"), sizes.over("crank")
    return [
        length("eccentricity", "throw of the cranks", 1e-6, 0.9e-3, path="crank.eccentricity"),
        length("crank.circle_radius", "radius of the circle of the cranks' centres (0: one central eccentric)", 0.0, 28e-3),
        deviation("crank_eccentricity_error", "throw of a crank's eccentric above nominal", **bearing, path="errors.crank.eccentricity"),
        Variable("crank_phase_error", "parameter", "rad", "turning of a crank's eccentric against nominal", 0.0, **bearing,
                 minimum=-0.1, maximum=0.1, source="ideal part", path="errors.crank.phase", display="arcmin"),
        deviation("disc_hole_error_radial", "hole in the disc outwards", **bearing, path="errors.disc_hole.radial"),
        deviation("disc_hole_error_tangential", "hole in the disc along its circle", **bearing, path="errors.disc_hole.tangential"),
        deviation("carrier_hole_error_radial", "crank's seat in the carrier outwards", **crank, path="errors.carrier_hole.radial"),
        deviation("carrier_hole_error_tangential", "crank's seat in the carrier along its circle", **crank, path="errors.carrier_hole.tangential"),
        # What effects add to the ideal parts.
        state("throw_added", "m", "added to an eccentric's throw: above 0 further off centre", **bearing),
        state("lobe_turn_added", "rad", "added to an eccentric's direction, above 0 counter-clockwise", **bearing),
        state("hole_tangential_added", "m", "hole in the disc displaced along its circle, above 0 counter-clockwise", **bearing),
        state("hole_radial_added", "m", "hole in the disc displaced outwards", **bearing),
        state("seat_radial_added", "m", "crank's seat displaced outwards", **crank),
        state("seat_tangential_added", "m", "crank's seat displaced along its circle, above 0 counter-clockwise", **crank),
    ]


@kernel
def clear_places(r):
    """No effect displaces a part."""
    discs, cranks = r.throw_added.shape
    for c in range(cranks):
        r.seat_tangential_added[c] = r.seat_radial_added[c] = 0.0
        for d in range(discs):
            r.throw_added[d, c] = r.lobe_turn_added[d, c] = r.hole_tangential_added[d, c] = r.hole_radial_added[d, c] = 0.0


@kernel
def crank_position(r, c):
    """Direction of crank c on the carrier [rad]."""
    return 2.0 * math.pi * c / r.carrier_hole_error_radial.shape[0]


@kernel
def disc_offset(r, d):
    """Angle by which the lobes of disc d stand ahead of those of disc 0 [rad]."""
    return 2.0 * math.pi * d / r.disc_hole_error_radial.shape[0]


@kernel
def hole(r, d, c, disc_turn):
    """Hole for crank c, from the centre of disc d (x, y) [m]."""
    angle = disc_turn + crank_position(r, c)
    radial = r.crank_circle_radius + r.disc_hole_error_radial[d, c] + r.hole_radial_added[d, c]
    tangential = r.disc_hole_error_tangential[d, c] + r.hole_tangential_added[d, c]
    cs, sn = math.cos(angle), math.sin(angle)
    return radial * cs - tangential * sn, radial * sn + tangential * cs


@kernel
def seat(r, c, carrier_turn):
    """Seat of crank c, from the centre of the carrier (x, y) [m]."""
    angle = carrier_turn + crank_position(r, c)
    radial = r.crank_circle_radius + r.carrier_hole_error_radial[c] + r.seat_radial_added[c]
    tangential = r.carrier_hole_error_tangential[c] + r.seat_tangential_added[c]
    cs, sn = math.cos(angle), math.sin(angle)
    return radial * cs - tangential * sn, radial * sn + tangential * cs


@kernel
def lobe(r, d, c, crank_turn):
    """Centre of the lobe for disc d, from the centre of crank c (x, y) [m]."""
    angle = crank_turn + disc_offset(r, d) + r.crank_phase_error[d, c] + r.lobe_turn_added[d, c]
    throw = r.eccentricity + r.crank_eccentricity_error[d, c] + r.throw_added[d, c]
    return throw * math.cos(angle), throw * math.sin(angle)
