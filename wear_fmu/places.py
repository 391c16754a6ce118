"""Where contacts are on the surfaces: pins on flanks and flanks on pins, rollers on races."""

import math

from fmu_src.kernel import kernel
from wear_fmu.kinematics import pin_contact_angle


@kernel
def shortening(r):
    return r.eccentricity * r.mesh_force.shape[1] / r.pin_circle_radius


@kernel
def flank_position(r, d, j, crank_angle):
    """Place of pin j on the circumference of disc d, in bins; whole lobes apart it is the phase.

    The phase is that of the disc's eccentric direction against the pin: 0 at the root.
    """
    pins = r.mesh_force.shape[1]
    lobes = pins - 1
    eccentric = crank_angle + 2.0 * math.pi * d / r.mesh_force.shape[0]
    return (lobes * j / pins + eccentric / (2.0 * math.pi)) * r.arc.shape[0]


@kernel
def pin_position(r, phase_position):
    """Place of a contact on a standing pin, in bins, from its place on the flank."""
    bins, k1 = r.pin_wear.shape[2], shortening(r)
    angle = pin_contact_angle(2.0 * math.pi * phase_position / r.arc.shape[0], k1)
    return (angle / math.pi + 0.5) * bins


@kernel
def first_roller(r, d, c, crank_angle, output_angle, cage_angle):
    """Angles of roller 1 on the inner and on the outer raceway [rad]."""
    discs, cranks = r.inner_race_depth.shape
    position = 2.0 * math.pi * c / cranks
    eccentric = crank_angle + 2.0 * math.pi * d / discs
    return output_angle + position + cage_angle - eccentric, cage_angle
