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
def read_profiles(r, crank_ahead, mesh_error, roller_error):
    """What the surfaces lack at the contacts when the cranks have turned by ``crank_ahead`` [rad] beyond the input angle."""
    discs, cranks, rollers = r.roller_force.shape
    pins = r.mesh_force.shape[1]
    bins = r.inner_race_wear.shape[2]
    # Ideal kinematics: the carrier turns by -1/z_c of the crank, the cage rolls along.
    output_ahead = -crank_ahead / (pins - 1.0)
    cage_ahead = (crank_ahead - output_ahead) * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)
    crank_angle = r.crank_angle + crank_ahead
    for d in range(discs):
        for j in range(pins):
            place = flank_position(r, d, j, crank_angle)
            error = interpolate_closed(r.disc_wear[d], place) + r.pin_even_wear[d, j]
            if r.standing > 0.0:
                error += interpolate_open(r.pin_wear[d, j], pin_position(r, place))
            mesh_error[d, j] = error
        for c in range(cranks):
            inner, outer = first_roller(
                r, d, c, crank_angle, r.output_angle + output_ahead, r.cage_angle + cage_ahead
            )
            for i in range(rollers):
                ahead = 2.0 * math.pi * i / rollers
                roller_error[d, c, i] = interpolate_closed(
                    r.inner_race_wear[d, c], (inner + ahead) * bins / (2.0 * math.pi)
                ) + interpolate_closed(r.outer_race_wear[d, c], (outer + ahead) * bins / (2.0 * math.pi))


@kernel
def clear_of_front(r):
    """Turning of the cranks [rad] that takes every contact off the bins that it is just wearing: one and a half of the widest.

    Between worn and unworn bins an accelerated pass would feel half of its own depth, more or less by how far the step went.
    """
    flank = 2.0 * math.pi / r.arc.shape[0]
    rolling = 1.0 + 1.0 / (r.mesh_force.shape[1] - 1.0)
    race = 2.0 * math.pi / r.inner_race_wear.shape[2] * (r.inner_race_radius + r.outer_race_radius) / (r.inner_race_radius * rolling)
    return 1.5 * max(flank, race)


@kernel
def publish_profiles(r, late, speed, turning):
    """Profile errors a little ahead of where the cranks are, ``late`` [rad] beyond the input angle, and their slopes there.

    Ahead is where the cranks turn to at ``speed``, if they turn.
    A slope is that of the line to where they will be after ``turning`` [rad] more, so
    that a step like the last one meets the surface where it is; it spans half a flank's bin at least.
    """
    ahead, reach = clear_of_front(r), math.pi / r.arc.shape[0]
    reach = max(reach, abs(turning) - ahead)
    if speed < 0.0:
        ahead, reach = -ahead, -reach
    if speed == 0.0:
        ahead = reach = 0.0
    look_ahead(r, late + ahead, reach)


@kernel
def look_ahead(r, lead, reach):
    """Profile errors where the cranks have turned by ``lead`` [rad] beyond the input angle, and their slopes through ``reach`` more."""
    r.profile_lead, r.profile_reach = lead, reach
    read_profiles(r, lead, r.mesh_profile_error, r.roller_profile_error)
    r.profile_angle = r.crank_angle + lead
    if reach != 0.0:
        read_profiles(r, lead + reach, r.mesh_profile_slope, r.roller_profile_slope)
    to_slopes(r, reach)


@kernel
def to_slopes(r, reach):
    """From the errors ``reach`` [rad] further on, which stand where the slopes shall be; 0: nothing turns."""
    discs, cranks, rollers = r.roller_force.shape
    for d in range(discs):
        for j in range(r.mesh_force.shape[1]):
            change = r.mesh_profile_slope[d, j] - r.mesh_profile_error[d, j]
            r.mesh_profile_slope[d, j] = change / reach if reach != 0.0 else 0.0
        for c in range(cranks):
            for k in range(rollers):
                change = r.roller_profile_slope[d, c, k] - r.roller_profile_error[d, c, k]
                r.roller_profile_slope[d, c, k] = change / reach if reach != 0.0 else 0.0


@kernel
def extend_profiles(r, turning):
    """Profile errors from where those published last lead to now, along a line to those after ``turning`` [rad] more.

    For who knows how far the cranks turn until the next call: the errors have no jumps.
    """
    discs, cranks, rollers = r.roller_force.shape
    passed = r.crank_angle - r.profile_angle
    for d in range(discs):
        for j in range(r.mesh_force.shape[1]):
            r.mesh_profile_error[d, j] += passed * r.mesh_profile_slope[d, j]
        for c in range(cranks):
            for k in range(rollers):
                r.roller_profile_error[d, c, k] += passed * r.roller_profile_slope[d, c, k]
    r.profile_angle = r.crank_angle
    read_profiles(r, turning, r.mesh_profile_slope, r.roller_profile_slope)
    to_slopes(r, turning)
