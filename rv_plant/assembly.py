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

from fmu_src.kernel import kernel

from rv_plant.contact import contact_force
from rv_plant.gear_stage import crank_turn_per_carrier_turn, crank_turn_per_shift
from rv_plant.geometry import closest_distance
from rv_plant.needle_bearing import roller_contacts


def coordinate_count(discs: int, cranks: int) -> int:
    """Length of z."""
    return 3 * discs + 3 + 3 * cranks + 1


@kernel
def clear(r):
    n = r.z.shape[0]
    for i in range(n):
        r.residual_vector[i] = 0.0
        for j in range(n):
            r.tangent[i, j] = 0.0


@kernel
def mesh_contacts(r, d, ideal_output):
    """Contacts of disc d with the pins: adds to residual and tangent, fills the pin forces."""
    discs, pins = r.mesh_force.shape
    lobes = r.lobe_pitch_error.shape[1]
    circle = r.pin_circle_radius + r.shift_modification
    radius = r.pin_radius + r.equidistant_modification
    k1 = r.eccentricity * (lobes + 1) / circle
    offset = 2.0 * math.pi * d / discs
    # The profile of disc d is cut turned by -offset/lobes against its holes.
    profile_turn = -offset / lobes
    eccentric = -lobes * ideal_output + offset
    ce, se = math.cos(eccentric), math.sin(eccentric)
    zx, zy = r.z[3 * d], r.z[3 * d + 1]
    disc_x = r.eccentricity * ce + zx * ce - zy * se
    disc_y = r.eccentricity * se + zx * se + zy * ce
    disc_angle = ideal_output + r.z[3 * d + 2] + profile_turn
    cd, sd = math.cos(disc_angle), math.sin(disc_angle)
    ring = r.z.shape[0] - 1
    ring_cos, ring_sin = math.cos(r.z[ring]), math.sin(r.z[ring])
    rx = ry = rt = rr = 0.0
    kxx = kxy = kxt = kxr = kyy = kyt = kyr = ktt = ktr = krr = 0.0
    loaded = 0
    for j in range(pins):
        # Pin centre from the disc's centre, in the housing and in the profile's frame.
        pin_x = ring_cos * r.pin_x[j] - ring_sin * r.pin_y[j]
        pin_y = ring_cos * r.pin_y[j] + ring_sin * r.pin_x[j]
        px, py = pin_x - disc_x, pin_y - disc_y
        along_disc = lobes * (r.pin_angle[j] - ideal_output - profile_turn)
        # The frame stands on the nearest root; the tooth lies between two roots.
        root_number = math.floor(along_disc / (2.0 * math.pi) + 0.5)
        root = int(root_number) % lobes
        lobe = int(math.floor(along_disc / (2.0 * math.pi))) % lobes
        cl, sl = r.root_cos[root], r.root_sin[root]
        cr, sr = cd * cl - sd * sl, sd * cl + cd * sl
        cx, cy = cr * px + sr * py, cr * py - sr * px
        # A flank is displaced along the pitch with its tooth, and turned into it by angle modification.
        ideal_phase = along_disc - 2.0 * math.pi * root_number
        flank = 1.0 if ideal_phase >= 0.0 else -1.0
        pitch = r.lobe_pitch_error[d, lobe] / r.pin_circle_radius + flank * r.angle_modification
        cx, cy = cx + pitch * cy, cy - pitch * cx
        phase, distance, nx, ny, bend = closest_distance(
            cx, cy, ideal_phase + r.phase_shift[d, j], lobes, circle, r.eccentricity, k1
        )
        r.phase_shift[d, j] = phase - ideal_phase
        r.mesh_phase[d, j] = phase
        r.centre_curvature[d, j] = bend
        gap = distance + radius - r.pin_radius - r.pin_radius_error[j]
        gap += r.lobe_profile_error[d, lobe] + r.mesh_profile_error[d, j]
        force, stiffness = contact_force(-gap, r.mesh_constant, r.mesh_exponent)
        r.mesh_force_now[d, j] = force
        if force == 0.0:
            continue
        loaded += 1
        # Gradient of the penetration: (N, arm about the disc, minus arm about the ring),
        # with the normal turned back from the displaced flank.
        nx, ny = nx - pitch * ny, ny + pitch * nx
        nhx, nhy = cr * nx - sr * ny, sr * nx + cr * ny
        gx, gy = ce * nhx + se * nhy, ce * nhy - se * nhx
        gt = px * nhy - py * nhx
        gr = pin_y * nhx - pin_x * nhy
        rx += force * gx
        ry += force * gy
        rt += force * gt
        rr += force * gr
        kxx += stiffness * gx * gx
        kxy += stiffness * gx * gy
        kxt += stiffness * gx * gt
        kxr += stiffness * gx * gr
        kyy += stiffness * gy * gy
        kyt += stiffness * gy * gt
        kyr += stiffness * gy * gr
        ktt += stiffness * gt * gt
        ktr += stiffness * gt * gr
        krr += stiffness * gr * gr
        # The normal turns with the disc, and along the flank by its curvature.
        reach = px * nhx + py * nhy
        bend /= 1.0 + bend * distance
        turn = 1.0 - bend * reach
        kxx -= force * bend * gy * gy
        kxy += force * bend * gx * gy
        kyy -= force * bend * gx * gx
        kxt -= force * turn * gy
        kyt += force * turn * gx
        ktt += force * turn * reach
        swing = pin_x * nhx + pin_y * nhy
        kxr -= force * bend * swing * gy
        kyr += force * bend * swing * gx
        ktr -= force * turn * swing
        krr += force * swing * (1.0 - bend * swing)
    r.loaded_teeth[d] = loaded
    x, y, t = 3 * d, 3 * d + 1, 3 * d + 2
    r.residual_vector[x] += rx
    r.residual_vector[y] += ry
    r.residual_vector[t] += rt
    r.residual_vector[ring] += rr
    k = r.tangent
    k[x, x] += kxx
    k[x, y] += kxy
    k[x, t] += kxt
    k[x, ring] += kxr
    k[y, y] += kyy
    k[y, t] += kyt
    k[y, ring] += kyr
    k[t, t] += ktt
    k[t, ring] += ktr
    k[ring, ring] += krr


@kernel
def bearing_contacts(r, d, c, ideal_output, cage_angle, side):
    """Needle bearing of disc d on crank c: adds to residual and tangent, fills the roller forces."""
    discs, cranks = r.roller_force.shape[:2]
    lobes = r.lobe_pitch_error.shape[1]
    offset = 2.0 * math.pi * d / discs
    eccentric = -lobes * ideal_output + offset
    ce, se = math.cos(eccentric), math.sin(eccentric)
    carrier = 3 * discs
    crank = carrier + 3 + 3 * c
    z = r.z

    # Hole in the disc, from the disc's centre.
    disc_turn = ideal_output + z[3 * d + 2]
    position = 2.0 * math.pi * c / cranks
    cd, sd = math.cos(disc_turn + position), math.sin(disc_turn + position)
    radial = r.crank_circle_radius + r.disc_hole_error_radial[d, c]
    tangential = r.disc_hole_error_tangential[d, c]
    hx, hy = radial * cd - tangential * sd, radial * sd + tangential * cd

    # Crank's centre on the carrier, and its turning.
    carrier_turn = ideal_output + z[carrier]
    ca, sa = math.cos(carrier_turn + position), math.sin(carrier_turn + position)
    radial = r.crank_circle_radius + r.carrier_hole_error_radial[c]
    tangential = r.carrier_hole_error_tangential[c]
    ax, ay = radial * ca - tangential * sa, radial * sa + tangential * ca
    shift_x, shift_y = z[carrier + 1] + z[crank], z[carrier + 2] + z[crank + 1]
    per_turn = crank_turn_per_carrier_turn(r.first_stage_ratio)
    per_x, per_y = crank_turn_per_shift(
        carrier_turn + position, r.crank_circle_radius, r.first_stage_ratio, r.pressure_angle, side
    )
    crank_turn = (
        -lobes * ideal_output + per_turn * z[carrier] + per_x * shift_x + per_y * shift_y + z[crank + 2]
    )
    # The teeth's direction turns with the carrier.
    per_turn += per_x * shift_y - per_y * shift_x
    lobe_angle = crank_turn + offset + r.crank_phase_error[d, c]
    throw = r.eccentricity + r.crank_eccentricity_error[d, c]
    ex, ey = throw * math.cos(lobe_angle), throw * math.sin(lobe_angle)

    zx, zy = z[3 * d], z[3 * d + 1]
    ux = ax + shift_x + ex - (r.eccentricity * ce + zx * ce - zy * se) - hx
    uy = ay + shift_y + ey - (r.eccentricity * se + zx * se + zy * ce) - hy
    roller_contacts(
        ux, uy, disc_turn + position + cage_angle, r.bearing_clearance, r.roller_profile_error[d, c],
        r.roller_constant, r.roller_exponent, r.roller_force_now[d, c], r.bearing_total, r.bearing_tangent,
    )
    fx, fy, moment = r.bearing_total[0], r.bearing_total[1], r.bearing_total[2]
    r.crank_force[c, 0] -= fx
    r.crank_force[c, 1] -= fy
    r.crank_moment[c] -= ex * fy - ey * fx

    # Columns of d(ux, uy, turning of disc)/dz; the last three are shared by carrier and crank.
    g = r.bearing_columns
    g[0, 0], g[0, 1], g[0, 2] = -ce, -se, 0.0
    g[1, 0], g[1, 1], g[1, 2] = se, -ce, 0.0
    g[2, 0], g[2, 1], g[2, 2] = hy, -hx, 1.0
    g[3, 0], g[3, 1], g[3, 2] = -ay - per_turn * ey, ax + per_turn * ex, 0.0
    g[4, 0], g[4, 1], g[4, 2] = 1.0 - per_x * ey, per_x * ex, 0.0
    g[5, 0], g[5, 1], g[5, 2] = -per_y * ey, 1.0 + per_y * ex, 0.0
    # The fourth column is d(crank's turning)/dz.
    g[0, 3] = g[1, 3] = g[2, 3] = 0.0
    g[3, 3], g[4, 3], g[5, 3], g[8, 3] = per_turn, per_x, per_y, 1.0
    for i in range(4):
        g[6, i], g[7, i] = g[4, i], g[5, i]
    g[8, 0], g[8, 1], g[8, 2] = -ey, ex, 0.0
    # Levers turn with disc and carrier.
    r.tangent[3 * d + 2, 3 * d + 2] += fx * hx + fy * hy
    r.tangent[carrier, carrier] -= fx * ax + fy * ay
    outward, forward = fx * ex + fy * ey, fy * ex - fx * ey
    k = r.bearing_tangent
    for a in range(9):
        ia = bearing_coordinate(a, d, carrier, crank)
        if not r.is_free[ia]:
            continue
        g0, g1, g2 = g[a, 0], g[a, 1], g[a, 2]
        r.residual_vector[ia] += g0 * fx + g1 * fy + g2 * moment
        k0 = g0 * k[0, 0] + g1 * k[1, 0] + g2 * k[2, 0]
        k1 = g0 * k[0, 1] + g1 * k[1, 1] + g2 * k[2, 1]
        k2 = g0 * k[0, 2] + g1 * k[1, 2] + g2 * k[2, 2]
        for b in range(a, 9):
            ib = bearing_coordinate(b, d, carrier, crank)
            if r.is_free[ib]:
                r.tangent[ia, ib] += k0 * g[b, 0] + k1 * g[b, 1] + k2 * g[b, 2] - outward * g[a, 3] * g[b, 3]
                # The teeth's direction turns with the carrier.
                if a == 3 and (b == 4 or b == 6):
                    r.tangent[ia, ib] -= forward * per_y
                elif a == 3 and (b == 5 or b == 7):
                    r.tangent[ia, ib] += forward * per_x


@kernel
def bearing_coordinate(column, d, carrier, crank):
    """Index in z of one of a bearing's nine columns; increasing with the column."""
    if column < 3:
        return 3 * d + column
    if column < 6:
        return carrier + column - 3
    return crank + column - 6


@kernel
def assemble(r, ideal_output, cage_angle, load_torque):
    """Residual (gradient of the potential) and tangent at r.z; fills all contact forces."""
    discs, cranks = r.roller_force.shape[:2]
    clear(r)
    for c in range(cranks):
        r.crank_force[c, 0] = r.crank_force[c, 1] = r.crank_moment[c] = 0.0
    side = 1.0 if load_torque >= 0.0 else -1.0
    for d in range(discs):
        mesh_contacts(r, d, ideal_output)
        for c in range(cranks):
            bearing_contacts(r, d, c, ideal_output, cage_angle, side)
    r.residual_vector[3 * discs] += load_torque
    for i in range(3 * discs + 1, r.z.shape[0]):
        if r.compliance[i] > 0.0:
            r.residual_vector[i] += r.z[i] / r.compliance[i]
            r.tangent[i, i] += 1.0 / r.compliance[i]
