"""All contacts of the reducer at given positions: residual and tangent of the equilibrium.

Coordinates z, the small departures from ideal kinematics, in this order:

    disc d          3d, 3d+1, 3d+2      x, y [m] (in the frame that turns with the
                                        disc's eccentric direction), turning [rad]
    carrier         3D                  turning [rad] (minus the lag)
    carrier         3D+1, 3D+2          shift x, y on the main bearings [m]
    crank k         3D+3+3k ...         shift x, y on its support bearings [m],
                                        turning on the first stage's teeth [rad]
    pin ring        last                turning of the housing [rad]

The residual is the gradient of the potential: contact energies, springs z^2/(2 c) of
the supports, and the load's work.  A support of compliance c = 0 is rigid: its
coordinate is not among the unknowns.
"""

import math

from fmu_src.effect import compose
from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, output, scratch, state
from rv_plant.coordinates import coordinate_count, moving_count
from rv_plant.effects import HOOKS
from rv_plant.gear_stage import crank_turn_per_carrier_turn, crank_turn_per_shift
from rv_plant.mesh import mesh_contacts
from rv_plant.near_mesh import is_held, is_near, keep_place, near_contacts
from rv_plant.needle_bearing import roller_contacts
from rv_plant.output_pins import has_output_pins, output_contacts
from rv_plant.poses import crank_position, disc_offset, hole, lobe, seat

hold_effects = compose("rv_plant.effects", HOOKS).hold


def variables(sizes: Sizes) -> list[Variable]:
    z, n, crank = coordinate_count(sizes), moving_count(sizes), sizes["crank"]
    return [
        output("housing.force_x", "N", "force of the pins on their ring, with unbalance", nominal=100.0),
        output("housing.force_y", "N", "force of the pins on their ring, with unbalance", nominal=100.0),
        state("z", "1", "departures from ideal kinematics, see assembly", **sizes.over(coordinate=z)),
        state("compliance", "1", "compliance of each coordinate of z [m/N, rad/(N m)]: turning of carrier and ring, seats, teeth", **sizes.over(coordinate=z)),
        state("potential", "J", "energy of deformation"),
        state("dissipation", "W", "power lost in damping"),
        # Large enough for the bodies in motion too.
        scratch("residual_vector", (n,)), scratch("tangent", (n, n)),
        scratch("crank_force", (crank, 2)), scratch("crank_moment", (crank,)),
        # Gradient of a bearing's shift and what follows from it, see bearing_contacts.
        scratch("bearing_columns", (7, 4)), scratch("bearing_stiffness", (7, 7)), scratch("bearing_pull", (7,)),
    ]


@kernel
def clear(r):
    """Empty residual, tangent and what is summed over the contacts."""
    n = r.residual_vector.shape[0]
    r.potential = r.dissipation = r.cage_power = 0.0
    r.housing_force_x = r.housing_force_y = 0.0
    for i in range(n):
        r.residual_vector[i] = 0.0
        for j in range(n):
            r.tangent[i, j] = 0.0


@kernel
def bearing_contacts(r, d, c, ideal_output, cage_angle, side, near):
    """Needle bearing of disc d on crank c: adds to residual and tangent, fills the roller forces; ``near`` as in ``add_all``."""
    discs = r.roller_force.shape[0]
    lobes = r.lobe_pitch_error.shape[1]
    eccentric = -lobes * ideal_output + disc_offset(r, d)
    ce, se = math.cos(eccentric), math.sin(eccentric)
    carrier = 3 * discs
    crank = carrier + 3 + 3 * c
    z = r.z
    disc_turn = ideal_output + z[3 * d + 2]
    hx, hy = hole(r, d, c, disc_turn)

    # Crank's centre on the carrier, and its turning.
    carrier_turn = ideal_output + z[carrier]
    ax, ay = seat(r, c, carrier_turn)
    shift_x, shift_y = z[carrier + 1] + z[crank], z[carrier + 2] + z[crank + 1]
    per_turn = crank_turn_per_carrier_turn(r.first_stage_ratio)
    per_x, per_y = crank_turn_per_shift(
        carrier_turn + crank_position(r, c), r.crank_circle_radius, r.first_stage_ratio, r.pressure_angle, side
    )
    crank_turn = (
        -lobes * ideal_output + per_turn * z[carrier] + per_x * shift_x + per_y * shift_y + z[crank + 2]
        + r.crank_turn_added[c]
    )
    # The teeth's direction turns with the carrier.
    per_turn += per_x * shift_y - per_y * shift_x
    ex, ey = lobe(r, d, c, crank_turn)

    zx, zy = z[3 * d], z[3 * d + 1]
    ux = ax + shift_x + ex - (r.eccentricity * ce + zx * ce - zy * se) - hx
    uy = ay + shift_y + ey - (r.eccentricity * se + zx * se + zy * ce) - hy
    roller_contacts(r, d, c, ux, uy, disc_turn + crank_position(r, c) + cage_angle, 0.0, 0.0, 0.0, 0.0, near)
    fx, fy, moment = r.bearing_total[0], r.bearing_total[1], r.bearing_total[2]
    r.crank_force[c, 0] -= fx
    r.crank_force[c, 1] -= fy
    r.crank_moment[c] -= ex * fy - ey * fx

    # Columns of d(ux, uy, turning of disc)/d(x, y, turning of the disc; turning of the carrier; shift x, y of carrier or crank; turning of the crank).
    g = r.bearing_columns
    g[0, 0], g[0, 1], g[0, 2] = -ce, -se, 0.0
    g[1, 0], g[1, 1], g[1, 2] = se, -ce, 0.0
    g[2, 0], g[2, 1], g[2, 2] = hy, -hx, 1.0
    g[3, 0], g[3, 1], g[3, 2] = -ay - per_turn * ey, ax + per_turn * ex, 0.0
    g[4, 0], g[4, 1], g[4, 2] = 1.0 - per_x * ey, per_x * ex, 0.0
    g[5, 0], g[5, 1], g[5, 2] = -per_y * ey, 1.0 + per_y * ex, 0.0
    # The fourth column is d(crank's turning)/dz.
    g[0, 3] = g[1, 3] = g[2, 3] = 0.0
    g[3, 3], g[4, 3], g[5, 3], g[6, 3] = per_turn, per_x, per_y, 1.0
    g[6, 0], g[6, 1], g[6, 2] = -ey, ex, 0.0
    # Levers turn with disc and carrier.
    r.tangent[3 * d + 2, 3 * d + 2] += fx * hx + fy * hy
    r.tangent[carrier, carrier] -= fx * ax + fy * ay
    outward, forward = fx * ex + fy * ey, fy * ex - fx * ey
    k, stiffness, pull = r.bearing_tangent, r.bearing_stiffness, r.bearing_pull
    columns = 7 if has_soft_crank(r, carrier, crank) else 4
    for a in range(columns):
        g0, g1, g2 = g[a, 0], g[a, 1], g[a, 2]
        pull[a] = g0 * fx + g1 * fy + g2 * moment
        k0 = g0 * k[0, 0] + g1 * k[1, 0] + g2 * k[2, 0]
        k1 = g0 * k[0, 1] + g1 * k[1, 1] + g2 * k[2, 1]
        k2 = g0 * k[0, 2] + g1 * k[1, 2] + g2 * k[2, 2]
        for b in range(a, columns):
            stiffness[a, b] = k0 * g[b, 0] + k1 * g[b, 1] + k2 * g[b, 2] - outward * g[a, 3] * g[b, 3]
    for a in range(3):
        r.residual_vector[3 * d + a] += pull[a]
        r.tangent[3 * d + a, carrier] += stiffness[a, 3]
        for b in range(a, 3):
            r.tangent[3 * d + a, 3 * d + b] += stiffness[a, b]
    r.residual_vector[carrier] += pull[3]
    r.tangent[carrier, carrier] += stiffness[3, 3]
    if columns == 7:
        # The teeth's direction turns with the carrier.
        stiffness[3, 4] -= forward * per_y
        stiffness[3, 5] += forward * per_x
        add_soft_crank(r, 3 * d, carrier, crank)


@kernel
def has_soft_crank(r, carrier, crank):
    """Whether carrier or crank can be shifted, or the crank turned on its teeth."""
    soft = 0
    for i in range(3):
        soft += r.is_free[crank + i] + (r.is_free[carrier + i] if i > 0 else 0)
    return soft > 0


@kernel
def add_soft_crank(r, disc, carrier, crank):
    """A bearing's share of residual and tangent by the shifts of carrier and crank, which are one to it, and the crank's turning."""
    stiffness, pull, t = r.bearing_stiffness, r.bearing_pull, r.tangent
    stiffness[5, 4] = stiffness[4, 5]
    for a in range(3):
        r.residual_vector[crank + a] += pull[4 + a]
        for b in range(3):
            t[disc + a, crank + b] += stiffness[a, 4 + b]
            t[carrier + a, crank + b] += stiffness[3 + a, 4 + b]
            if b >= a:
                t[crank + a, crank + b] += stiffness[4 + a, 4 + b]
    for b in range(2):
        r.residual_vector[carrier + 1 + b] += pull[4 + b]
        for a in range(3):
            t[disc + a, carrier + 1 + b] += stiffness[a, 4 + b]
        t[carrier, carrier + 1 + b] += stiffness[3, 4 + b]
        t[carrier + 1, carrier + 1 + b] += stiffness[4, 4 + b]
    t[carrier + 2, carrier + 2] += stiffness[5, 5]


@kernel
def assemble(r, ideal_output, cage_angle, load_torque):
    """Residual (gradient of the potential) and tangent at r.z; fills all contact forces."""
    keep_place(r, ideal_output)
    add_all(r, ideal_output, cage_angle, load_torque, False, True)


@kernel
def assemble_once(r, ideal_output, cage_angle, load_torque):
    """The same where nothing goes on from here."""
    add_all(r, ideal_output, cage_angle, load_torque, False, False)


@kernel
def assemble_beside(r, ideal_output, cage_angle, load_torque):
    """The same beside the last ``assemble`` of this position; disc and pins are carried on where that is near enough."""
    if is_near(r):
        add_all(r, ideal_output, cage_angle, load_torque, True, False)
    else:
        assemble(r, ideal_output, cage_angle, load_torque)


@kernel
def assemble_on(r, ideal_output, cage_angle, load_torque):
    """The same for the first time, carried on from the equilibrium before where that holds."""
    if is_held(r, ideal_output):
        assemble_beside(r, ideal_output, cage_angle, load_torque)
    else:
        assemble(r, ideal_output, cage_angle, load_torque)


@kernel
def add_all(r, ideal_output, cage_angle, load_torque, near, kept):
    """All contacts, load and supports; ``near``: disc and pins by what is kept of them, rollers by their forces then; ``kept``: as ``mesh_contacts``."""
    discs, cranks = r.roller_force.shape[:2]
    clear(r)
    for c in range(cranks):
        r.crank_force[c, 0] = r.crank_force[c, 1] = r.crank_moment[c] = 0.0
    lobes = r.lobe_pitch_error.shape[1]
    side = 1.0 if load_torque >= 0.0 else -1.0
    for d in range(discs):
        axes = -lobes * ideal_output + disc_offset(r, d)
        if near:
            near_contacts(r, d, axes)
        else:
            mesh_contacts(r, d, ideal_output, axes, 0.0, kept)
        for c in range(cranks):
            bearing_contacts(r, d, c, ideal_output, cage_angle, side, near)
        if has_output_pins(r):
            output_contacts(r, d, ideal_output, axes)
    r.residual_vector[3 * discs] += load_torque
    for i in range(3 * discs + 1, r.z.shape[0]):
        if r.compliance[i] > 0.0:
            r.residual_vector[i] += r.z[i] / r.compliance[i]
            r.tangent[i, i] += 1.0 / r.compliance[i]
    hold_effects(r)
