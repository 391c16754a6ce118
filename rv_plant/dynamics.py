"""Forces on the bodies in motion.

Coordinates q (absolute, in the housing) and velocities v:

    disc d       3d, 3d+1, 3d+2      x, y [m], turning [rad]
    carrier      3D                  turning, then x, y
    crank k      3D+3+3k ...         x, y, turning
    pin ring     3D+3+3K             turning
    sun          the next            turning
    load         last                turning

Equations of motion M dv/dt + gradient(q, v) = 0: ``assemble_motion`` fills the gradient
(contact, tooth and joint forces, damping, drive and load) and the tangent of it.
Joints are springs with damping; one that is rigid in statics (compliance 0) has the
compliance RIGID here.
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, scratch, state
from rv_plant.assembly import clear
from rv_plant.constraints import CONSTRAINED, SETTLING
from rv_plant.coordinates import moving_count
from rv_plant.gear_stage import planet_radius, total_ratio
from rv_plant.mesh import mesh_contacts, ring_coordinate
from rv_plant.needle_bearing import cage_rate, roller_contacts
from rv_plant.poses import crank_position, disc_offset, hole, lobe, seat
from rv_plant.supports import teeth_yield, twist_compliance
from rv_plant.turning import left_out

# Stand for rigid: joints [m/N, rad/(N m)], below a thousandth of the stiffest
# contact's compliance; teeth [m/N], whose small force would make a stiffer contact chatter.
RIGID = 1e-12
RIGID_TOOTH = 1e-10
# Input speed below which friction fades [rad/s].
STANDSTILL = 0.1


def mass(name: str, unit: str, text: str, start: float, display: str = "") -> Variable:
    return Variable(name, "parameter", unit, f"mass or inertia of {text}", start, minimum=1e-9,
                    source="assumed: plausible from geometry", display=display)


def variables(sizes: Sizes) -> list[Variable]:
    bodies = sizes.over(coordinate=moving_count(sizes))
    return [
        mass("disc.mass", "kg", "one disc", 0.387), mass("disc.inertia", "kg.m^2", "one disc", 5.7e-4),
        mass("crank.mass", "kg", "one crank with its planet", 0.131),
        mass("crank.inertia", "kg.m^2", "one crank with its planet", 1.26e-5),
        mass("carrier.mass", "kg", "the carrier", 0.715), mass("carrier.inertia", "kg.m^2", "the carrier", 7.8e-4),
        mass("sun.inertia", "kg.m^2", "sun with what is fixed to it", 3.6e-6),
        mass("ring.inertia", "kg.m^2", "pin ring on its housing", 1e-3),
        mass("load.inertia", "kg.m^2", "what the output flange carries", 5.0, display="kg.m^2"),
        Variable("tooth_stiffness_variation", "parameter", "1", "first-stage tooth stiffness over its mean, amplitude"
                 " at mesh order", 0.0, minimum=0.0, maximum=0.9, source="assumed: constant", path="first_stage.stiffness_variation"),
        Variable("joint_damping_time", "parameter", "s", "damping over stiffness of joints and teeth", 4e-6, minimum=0.0,
                 maximum=1.0, nominal=1e-6, source="assumed: ratio 0.045 at 3.5 kHz", path="contact.joint_damping_time"),
        Variable("swing_damping", "parameter", "N.m.s/rad", "damper in motion between the load and the input's turning over the ratio;"
                 " 0: none", 0.0, minimum=0.0, maximum=1e9, nominal=100.0, tunable=True, source="chosen by the master",
                 path="load.swing_damping"),
        state("q", "1", "places of the bodies, see dynamics", **bodies),
        state("v", "1", "velocities of the coordinates, sun and load", **bodies),
        state("acceleration", "1", "accelerations of the bodies", **bodies),
        state("mass", "1", "mass or inertia of each coordinate", **bodies),
        state("friction_load", "N.m", "torque of friction and drag at the input, in motion"),
        # One joint, see add_gradient.
        scratch("joint_index", (5,), integer=True), scratch("joint_gradient", (5,)),
    ]


@kernel
def add_gradient(r, index, gradient, count, force, stiffness):
    """Add a scalar joint: gradient of its elongation, its force and its tangent."""
    for a in range(count):
        ia = index[a]
        r.residual_vector[ia] += force * gradient[a]
        for b in range(count):
            # The tangent keeps its upper triangle.
            if ia <= index[b]:
                r.tangent[ia, index[b]] += stiffness * gradient[a] * gradient[b]


@kernel
def spring(r, index, gradient, count, elongation, compliance, rate_weight):
    """A linear spring with damping proportional to its stiffness."""
    stiffness = 1.0 / max(compliance, RIGID)
    rate = 0.0
    for a in range(count):
        rate += gradient[a] * r.v[index[a]]
    damping = stiffness * r.joint_damping_time
    force = stiffness * elongation + damping * rate
    r.potential += 0.5 * stiffness * elongation * elongation
    r.dissipation += damping * rate * rate
    add_gradient(r, index, gradient, count, force, stiffness + rate_weight * damping)
    return force


@kernel
def bearing_in_motion(r, d, c, cage_speed, rate_weight):
    """Needle bearing of disc d on crank c."""
    discs = r.roller_force.shape[0]
    crank, disc = 3 * discs + 3 + 3 * c, 3 * d
    q, v = r.q, r.v
    hx, hy = hole(r, d, c, q[disc + 2])
    ex, ey = lobe(r, d, c, q[crank + 2])
    ux = q[crank] + ex - q[disc] - hx
    uy = q[crank + 1] + ey - q[disc + 1] - hy
    vx = v[crank] - v[crank + 2] * ey - v[disc] + v[disc + 2] * hy
    vy = v[crank + 1] + v[crank + 2] * ex - v[disc + 1] - v[disc + 2] * hx
    direction = q[disc + 2] + crank_position(r, c) + r.cage
    roller_contacts(r, d, c, ux, uy, direction, vx, vy, v[disc + 2] + cage_speed, rate_weight, False)
    fx, fy, moment = r.bearing_total[0], r.bearing_total[1], r.bearing_total[2]
    r.cage_power -= moment * v[disc + 2]
    # Columns of d(ux, uy, turning of disc)/dq, disc before crank as in q.
    g = r.bearing_columns
    g[0, 0], g[0, 1], g[0, 2] = -1.0, 0.0, 0.0
    g[1, 0], g[1, 1], g[1, 2] = 0.0, -1.0, 0.0
    g[2, 0], g[2, 1], g[2, 2] = hy, -hx, 1.0
    g[3, 0], g[3, 1], g[3, 2] = 1.0, 0.0, 0.0
    g[4, 0], g[4, 1], g[4, 2] = 0.0, 1.0, 0.0
    g[5, 0], g[5, 1], g[5, 2] = -ey, ex, 0.0
    k = r.bearing_tangent
    for a in range(6):
        ia = disc + a if a < 3 else crank + a - 3
        g0, g1, g2 = g[a, 0], g[a, 1], g[a, 2]
        r.residual_vector[ia] += g0 * fx + g1 * fy + g2 * moment
        k0 = g0 * k[0, 0] + g1 * k[1, 0] + g2 * k[2, 0]
        k1 = g0 * k[0, 1] + g1 * k[1, 1] + g2 * k[2, 1]
        k2 = g0 * k[0, 2] + g1 * k[1, 2] + g2 * k[2, 2]
        for b in range(a, 6):
            ib = disc + b if b < 3 else crank + b - 3
            r.tangent[ia, ib] += k0 * g[b, 0] + k1 * g[b, 1] + k2 * g[b, 2]
    # Levers turn with disc and crank.
    r.tangent[disc + 2, disc + 2] += fx * hx + fy * hy
    r.tangent[crank + 2, crank + 2] -= fx * ex + fy * ey


@kernel
def crank_support(r, c, soft, rate_weight):
    """Bearings of crank c in the carrier: springs along x and y; ``soft`` 0 makes them as good as rigid."""
    carrier = 3 * r.roller_force.shape[0]
    crank = carrier + 3 + 3 * c
    q = r.q
    ax, ay = seat(r, c, q[carrier])
    index, gradient = r.joint_index, r.joint_gradient
    # Carrier turning, x or y, crank x or y.
    index[0], index[1], index[2] = carrier, carrier + 1, crank
    gradient[0], gradient[1], gradient[2] = ay, -1.0, 1.0
    pull_x = spring(r, index, gradient, 3, q[crank] - q[carrier + 1] - ax, soft * r.compliance[crank], rate_weight)
    index[1], index[2] = carrier + 2, crank + 1
    gradient[0] = -ax
    pull_y = spring(r, index, gradient, 3, q[crank + 1] - q[carrier + 2] - ay, soft * r.compliance[crank + 1], rate_weight)
    r.tangent[carrier, carrier] += pull_x * ax + pull_y * ay


@kernel
def tooth_contact(r, c, rate_weight):
    """Sun and planet of crank c: both flanks, with backlash, tooth stiffness and profile error by phase.

    Along the line of action of flank s = +1 (the driving one) or -1 the approach is
    s (r1 (sun - turned) + r2 (crank - turned)) cos(alpha) - (distance - a0) sin(alpha) - backlash/2,
    with turned the way of the crank's centre round the sun.
    """
    discs, _cranks = r.roller_force.shape[:2]
    carrier = 3 * discs
    crank = carrier + 3 + 3 * c
    sun = ring_coordinate(r) + 1
    q = r.q
    planet = planet_radius(r.crank_circle_radius, r.first_stage_ratio)
    small = planet / r.first_stage_ratio
    x, y = q[crank], q[crank + 1]
    distance = math.sqrt(x * x + y * y)
    # The crank's way round the sun, whole turns of the carrier included.
    nominal = q[carrier] + crank_position(r, c)
    cs, sn = math.cos(nominal), math.sin(nominal)
    turned = q[carrier] + math.atan2(y * cs - x * sn, x * cs + y * sn)
    rolled = small * (q[sun] - turned) + planet * (q[crank + 2] - turned)
    ca, sa = math.cos(r.pressure_angle), math.sin(r.pressure_angle)
    mesh_phase = r.sun_teeth * (q[sun] - q[carrier] + r.first_stage_ratio * r.pin_x.shape[0] * left_out(r) + r.first_stage_phase)
    compliance = max(teeth_yield(r), RIGID_TOOTH)
    swing = r.tooth_stiffness_variation
    stiffness = (1.0 + swing * math.cos(mesh_phase)) / compliance
    slope = -swing * r.sun_teeth * math.sin(mesh_phase) / compliance
    error = r.tooth_error * math.cos(mesh_phase)
    error_slope = -r.tooth_error * r.sun_teeth * math.sin(mesh_phase)
    index, gradient = r.joint_index, r.joint_gradient
    for flank in range(2):
        s = 1.0 if flank == 0 else -1.0
        apart = 0.5 * (r.tooth_backlash + r.backlash + r.tooth_play[c])
        approach = s * (rolled * ca - r.tooth_gap[c]) - (distance - r.crank_circle_radius) * sa - apart - error
        if approach <= 0.0:
            continue
        # By x and y the angle turned changes by -y and x over distance^2.
        along = -s * ca * (small + planet) / (distance * distance)
        index[0], index[1], index[2], index[3], index[4] = carrier, crank, crank + 1, crank + 2, sun
        gap_slope = error_slope + s * r.tooth_gap_rate[c] + 0.5 * r.tooth_play_rate[c]
        gradient[0] = gap_slope
        gradient[1] = -along * y - sa * x / distance
        gradient[2] = along * x - sa * y / distance
        gradient[3] = s * planet * ca
        gradient[4] = s * small * ca - gap_slope
        rate = 0.0
        for a in range(5):
            rate += gradient[a] * r.v[index[a]]
        damping = stiffness * r.joint_damping_time
        force = stiffness * approach + damping * rate
        if force <= 0.0:
            continue
        r.potential += 0.5 * stiffness * approach * approach
        r.dissipation += damping * rate * rate
        add_gradient(r, index, gradient, 5, force, stiffness + rate_weight * damping)
        # The potential also changes with the stiffness that goes with the phase.
        r.residual_vector[sun] += 0.5 * slope * approach * approach
        r.residual_vector[carrier] -= 0.5 * slope * approach * approach
        r.tooth_force[c] += s * force * ca


@kernel
def joint_springs(r, rate_weight):
    """Crank supports, main bearing, housing and output shaft."""
    discs, cranks = r.roller_force.shape[:2]
    carrier, ring = 3 * discs, ring_coordinate(r)
    load = ring + 2
    q, index, gradient = r.q, r.joint_index, r.joint_gradient
    # Constraints start from where joints stand that are as good as rigid.
    soft = 0.0 if r.joints == SETTLING else 1.0
    for c in range(cranks):
        crank_support(r, c, soft, rate_weight)
    gradient[0] = 1.0
    for i in range(2):
        index[0] = carrier + 1 + i
        spring(r, index, gradient, 1, q[carrier + 1 + i], soft * r.compliance[carrier + 1 + i], rate_weight)
    index[0] = ring
    spring(r, index, gradient, 1, q[ring], soft * r.compliance[ring], rate_weight)
    index[0], index[1], gradient[1] = carrier, load, -1.0
    spring(r, index, gradient, 2, q[carrier] - q[load], soft * twist_compliance(r), rate_weight)


@kernel
def swing_damper(r, rate_weight):
    """Between load and sun: takes the energy of the load's swing about ideal motion, turns nothing by itself."""
    sun, load = ring_coordinate(r) + 1, ring_coordinate(r) + 2
    index, gradient = r.joint_index, r.joint_gradient
    ratio = total_ratio(r.first_stage_ratio, r.pin_x.shape[0], r.lobe_pitch_error.shape[1])
    index[0], index[1] = load, sun
    gradient[0], gradient[1] = 1.0, -1.0 / ratio
    rate = r.v[load] - r.v[sun] / ratio
    r.dissipation += r.swing_damping * rate * rate
    add_gradient(r, index, gradient, 2, r.swing_damping * rate, rate_weight * r.swing_damping)


@kernel
def assemble_motion(r, rate_weight):
    """Gradient and tangent at r.q, r.v; fills contact forces, potential energy and dissipation.

    The tangent is d(gradient)/dq + rate_weight d(gradient)/dv, upper triangle.
    Joints add their springs unless constraints stand for them.
    """
    discs, cranks = r.roller_force.shape[:2]
    lobes = r.lobe_pitch_error.shape[1]
    carrier, ring = 3 * discs, ring_coordinate(r)
    sun, load = ring + 1, ring + 2
    q, v, z = r.q, r.v, r.z
    clear(r)
    turn = 2.0 * math.pi
    ideal = q[carrier] - turn * math.floor(q[carrier] / turn + 0.5)
    z[ring] = q[ring]
    cage_speed = r.cage_share * cage_rate(v[carrier + 5], v[carrier], r.inner_race_radius, r.outer_race_radius)
    for c in range(cranks):
        r.tooth_force[c] = 0.0
    for d in range(discs):
        eccentric = -lobes * ideal + disc_offset(r, d)
        z[3 * d] = q[3 * d] - r.eccentricity * math.cos(eccentric)
        z[3 * d + 1] = q[3 * d + 1] - r.eccentricity * math.sin(eccentric)
        z[3 * d + 2] = q[3 * d + 2] - q[carrier]
        mesh_contacts(r, d, ideal, 0.0, rate_weight, False)
        for c in range(cranks):
            bearing_in_motion(r, d, c, cage_speed, rate_weight)
    for c in range(cranks):
        if r.first_stage_ratio > 0.0:
            tooth_contact(r, c, rate_weight)
    index, gradient = r.joint_index, r.joint_gradient
    gradient[0] = 1.0
    if r.first_stage_ratio == 0.0:
        # Without a first stage the input turns the cranks themselves.
        gradient[1] = -1.0
        for c in range(cranks):
            index[0], index[1] = carrier + 5 + 3 * c, sun
            spring(r, index, gradient, 2, q[index[0]] - q[sun], 0.0, rate_weight)
    if r.joints != CONSTRAINED:
        joint_springs(r, rate_weight)
    if r.swing_damping > 0.0:
        swing_damper(r, rate_weight)
    r.residual_vector[load] += r.load_torque
    r.residual_vector[sun] -= r.input_torque
    # Friction and drag resist the sun; smooth through standstill.
    if r.friction_load > 0.0:
        slow = math.sqrt(v[sun] * v[sun] + STANDSTILL * STANDSTILL)
        r.residual_vector[sun] += r.friction_load * v[sun] / slow
        r.tangent[sun, sun] += rate_weight * r.friction_load * STANDSTILL * STANDSTILL / (slow * slow * slow)
        r.dissipation += r.friction_load * v[sun] * v[sun] / slow
