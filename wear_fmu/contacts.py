"""Where the contacts lie on the surfaces, and what the surfaces lack there."""

import math

from fmu_src.kernel import kernel
from wear_fmu.kinematics import pin_contact_angle
from wear_fmu.surfaces import interpolate_closed, interpolate_open


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


@kernel
def publish_profile_errors(r, lead_time):
    """What the surfaces lack where the contacts will be after ``lead_time`` [s] at the present speed."""
    discs, cranks, rollers = r.roller_force.shape
    pins = r.mesh_force.shape[1]
    bins = r.inner_race_wear.shape[2]
    # Ideal kinematics: the carrier turns by -1/z_c of the crank, the cage rolls along.
    crank_ahead = r.crank_speed * lead_time
    output_ahead = -crank_ahead / (pins - 1.0)
    cage_ahead = (crank_ahead - output_ahead) * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)
    crank_angle = r.crank_angle + crank_ahead
    for d in range(discs):
        for j in range(pins):
            place = flank_position(r, d, j, crank_angle)
            error = interpolate_closed(r.disc_wear[d], place) + r.pin_even_wear[d, j]
            if r.standing > 0.0:
                error += interpolate_open(r.pin_wear[d, j], pin_position(r, place))
            r.mesh_profile_error[d, j] = error
        for c in range(cranks):
            inner, outer = first_roller(
                r, d, c, crank_angle, r.output_angle + output_ahead, r.cage_angle + cage_ahead
            )
            for i in range(rollers):
                ahead = 2.0 * math.pi * i / rollers
                r.roller_profile_error[d, c, i] = interpolate_closed(
                    r.inner_race_wear[d, c], (inner + ahead) * bins / (2.0 * math.pi)
                ) + interpolate_closed(r.outer_race_wear[d, c], (outer + ahead) * bins / (2.0 * math.pi))
