"""Where surfaces touch and how far they slide, from ideal kinematics alone.

The disc rolls on the pin ring with its pitch point as instantaneous centre, so a
fixed pin slides on the flank with the disc's speed times the distance from contact to
pitch point.  A material point of the disc slides 2 a v_s/v_c while a contact of half
width a passes at v_c; with the mean pressure q/(2 a) its wear depth is k q v_s/v_c,
whatever the width.  So the area worn off a flank in a crank turn d(theta) is
k q ds, ds = m(phi) d(theta), spread over the arc that the contact has swept.
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable
from wear_fmu.dimension import parameter

EXACT, PRINTED = 0, 1
SLIDING_FORMS = ("exact", "printed")


def variables(sizes: Sizes) -> list[Variable]:
    return [
        parameter("pin.radius", "m", "radius of the pins", 2e-3, 1e-5, nominal=1e-3),
        parameter("pin.circle_radius", "m", "radius of the circle of the pins' centres", 52e-3, 1e-4, nominal=1e-2),
        parameter("eccentricity", "m", "throw of the cranks", 0.9e-3, 1e-6, nominal=1e-3, path="crank.eccentricity"),
        parameter("mesh.width", "m", "width of one disc", 8.82e-3, 1e-5, nominal=1e-2),
        parameter("inner_race.radius", "m", "radius of the crank's eccentric", 10.25e-3, 1e-4, nominal=1e-2),
        parameter("outer_race.radius", "m", "radius of the hole in the disc", 13.25e-3, 1e-4, nominal=1e-2),
        parameter("roller.radius", "m", "radius of the needle rollers", 1.5e-3, 1e-5, nominal=1e-3),
        parameter("roller.length", "m", "length of the needle rollers", 8e-3, 1e-5, nominal=1e-2),
        parameter("sliding_form", "1", "sliding of flank on pin", 0, choices=SLIDING_FORMS,
                  source="exact kinematics; the printed form is garbled", path="wear.sliding_form"),
        parameter("slip_ratio_inner", "1", "slip of the rollers on the inner raceway", 0.05, 0.0, 1.0, path="wear.inner_slip_ratio"),
        parameter("slip_ratio_outer", "1", "slip of the rollers on the outer raceway", 0.05, 0.0, 1.0, path="wear.outer_slip_ratio"),
    ]


@kernel
def pitch_distance(phi, k1):
    """sqrt(S): distance of pin centre to pitch point over the pin circle radius."""
    return math.sqrt(1.0 + k1 * k1 - 2.0 * k1 * math.cos(phi))


@kernel
def sliding_per_crank_angle(phi, lobes, pin_circle_radius, pin_radius, k1):
    """m(phi) = (R sqrt(S) - r)/z_c: sliding per crank turning [m/rad]; never zero."""
    return (pin_circle_radius * pitch_distance(phi, k1) - pin_radius) / lobes


@kernel
def printed_sliding_per_crank_angle(phi, lobes, eccentricity, k1):
    """|e [z_p/(z_p-1) - sin(alpha)/sin(alpha+beta)]| as the BX-40E document prints it [m/rad].

    alpha is the pressure angle, sin(alpha) = sin(phi)/sqrt(S), beta the normal's angle
    against the pin's radius.
    """
    # In the triangle of ring centre, pitch point and pin the fraction is 1/sqrt(S).
    return abs(eccentricity * ((lobes + 1.0) / lobes - 1.0 / pitch_distance(phi, k1)))


@kernel
def flank_arc_per_phase(phi, lobes, pin_circle_radius, pin_radius, k1):
    """Arc of the flank per phase |dX/dphi| [m/rad]."""
    s2 = 1.0 + k1 * k1 - 2.0 * k1 * math.cos(phi)
    centre = pin_circle_radius * math.sqrt(s2) / lobes
    normal_turning = 1.0 / lobes - (k1 * math.cos(phi) - k1 * k1) / s2
    return abs(centre - pin_radius * normal_turning)


@kernel
def equivalent_curvature(phi, lobes, pin_circle_radius, pin_radius, k1):
    """1/rho_eq [1/m] of flank and pin: equals 1/r at the inflection, least at the root."""
    s2 = 1.0 + k1 * k1 - 2.0 * k1 * math.cos(phi)
    centre = (1.0 + (lobes + 1) * k1 * k1 - (lobes + 2) * k1 * math.cos(phi)) / (
        pin_circle_radius * s2 * math.sqrt(s2)
    )
    return 1.0 / pin_radius + centre / (1.0 - pin_radius * centre)


@kernel
def pin_contact_angle(phi, k1):
    """Place of the contact on the pin [rad] from its inward radial; turns back at asin(K1)."""
    return -math.atan2(k1 * math.sin(phi), 1.0 - k1 * math.cos(phi))
