"""The plant in motion: from the first equilibrium through communication steps.

Keeps account of energy: work of the input, work done on the load, losses, and what is
stored in motion and deformation.
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, state
from rv_plant.constraints import CONSTRAINED, largest_drift
from rv_plant.dynamics import RIGID, RIGID_TOOTH, assemble_motion
from rv_plant.faults import DYNAMIC
from rv_plant.force_paths import add_force_paths, start_force_paths
from rv_plant.gear_stage import crank_turn_per_carrier_turn, crank_turn_per_shift, planet_radius, total_ratio
from rv_plant.integrator import (
    MOST_SUBSTEPS,
    SHORTEST_STEP,
    alpha_step,
    back_to_start,
    finish_step,
    keep_start,
    kinetic_energy,
    next_step_size,
    settle,
)
from rv_plant.mesh import ring_coordinate
from rv_plant.needle_bearing import cage_rate
from rv_plant.outputs import prepare_position, publish_contacts, publish_losses
from rv_plant.poses import disc_offset, seat
from rv_plant.profiles import end_profiles, start_profiles, take_profiles
from rv_plant.supports import teeth_yield, twist_compliance
from rv_plant.turning import add_turning, angles_within_turn, leave_out_turns, left_out, whole_turns

# Deflection that tolerances are relative to [m].
TYPICAL_DEFLECTION = 1e-6
# Gentle changes of the input speed are spread over the communication step, up to a few periods of the discs on their contacts [s].
GENTLE_RAMP = 2e-3


def variables(sizes: Sizes) -> list[Variable]:
    return [
        local("energy_error", "1", "energy that the account in motion lacks, over what was turned over", path="numerics.energy_error"),
        Variable("input.acceleration", "parameter", "rad/s^2", "in motion a new input speed is reached along a ramp of this slope"
                 " at most", 1e5, minimum=1e-3, nominal=1e5, source="assumed: rated speed in 2 ms"),
        state("drive_speed", "rad/s", "speed at which the input is driven"),
        state("ramp_left", "s", "time until that is input_speed"),
        state("ramp_end", "rad/s", "input speed that the ramp leads to"),
        state("internal_step", "s", "next step of the integrator"),
        state("rejected", "1", "internal steps repeated shorter", integer=True, minimum=0),
        state("input_energy", "J", "work of the input"), state("output_energy", "J", "work done on the load"),
        state("lost_energy", "J", "energy lost in damping"), state("cage_energy", "J", "work of the cages"),
        state("stored_energy", "J", "energy of motion and deformation at the start"),
    ]


@kernel
def set_masses(r):
    """Mass or inertia, and the size of a small change, of every coordinate."""
    discs, cranks = r.roller_force.shape[:2]
    carrier, ring = 3 * discs, ring_coordinate(r)
    for i in range(r.q.shape[0]):
        r.length_scale[i] = TYPICAL_DEFLECTION
    for d in range(discs):
        r.mass[3 * d] = r.mass[3 * d + 1] = r.disc_mass
        r.mass[3 * d + 2] = r.disc_inertia
        r.length_scale[3 * d + 2] /= r.pin_circle_radius
    r.mass[carrier] = r.carrier_inertia
    r.mass[carrier + 1] = r.mass[carrier + 2] = r.carrier_mass
    r.length_scale[carrier] /= r.crank_circle_radius
    for c in range(cranks):
        crank = carrier + 3 + 3 * c
        r.mass[crank] = r.mass[crank + 1] = r.crank_mass
        r.mass[crank + 2] = r.crank_inertia
        r.length_scale[crank + 2] /= r.crank_circle_radius
    r.mass[ring], r.mass[ring + 1], r.mass[ring + 2] = r.ring_inertia, r.sun_inertia, r.load_inertia
    for i in range(3):
        r.length_scale[ring + i] /= r.pin_circle_radius


@kernel
def start_motion(r):
    """Bodies where the equilibrium r.z has put them, moving as ideal kinematics wants at input_speed."""
    discs, cranks = r.roller_force.shape[:2]
    pins, lobes = r.pin_x.shape[0], r.lobe_pitch_error.shape[1]
    carrier, ring = 3 * discs, ring_coordinate(r)
    ratio = total_ratio(r.first_stage_ratio, pins, lobes)
    speed = r.input_speed / ratio
    crank_speed = -lobes * speed
    ideal, _cage = angles_within_turn(r)
    r.turns_left_out = whole_turns(r.ideal_output)
    z, q, v = r.z, r.q, r.v
    set_masses(r)
    for d in range(discs):
        eccentric = -lobes * ideal + disc_offset(r, d)
        ce, se = math.cos(eccentric), math.sin(eccentric)
        q[3 * d] = r.eccentricity * ce + z[3 * d] * ce - z[3 * d + 1] * se
        q[3 * d + 1] = r.eccentricity * se + z[3 * d] * se + z[3 * d + 1] * ce
        q[3 * d + 2] = ideal + z[3 * d + 2]
        v[3 * d], v[3 * d + 1] = -q[3 * d + 1] * crank_speed, q[3 * d] * crank_speed
        v[3 * d + 2] = speed
        r.acceleration[3 * d] = -q[3 * d] * crank_speed * crank_speed
        r.acceleration[3 * d + 1] = -q[3 * d + 1] * crank_speed * crank_speed
    q[carrier] = ideal + z[carrier]
    q[carrier + 1], q[carrier + 2] = z[carrier + 1], z[carrier + 2]
    v[carrier] = speed
    side = 1.0 if r.load_torque >= 0.0 else -1.0
    for c in range(cranks):
        crank = carrier + 3 + 3 * c
        ax, ay = seat(r, c, q[carrier])
        shift_x, shift_y = z[carrier + 1] + z[crank], z[carrier + 2] + z[crank + 1]
        per_x, per_y = crank_turn_per_shift(
            math.atan2(ay, ax), r.crank_circle_radius, r.first_stage_ratio, r.pressure_angle, side
        )
        q[crank], q[crank + 1] = ax + shift_x, ay + shift_y
        q[crank + 2] = (
            -lobes * ideal + crank_turn_per_carrier_turn(r.first_stage_ratio) * z[carrier]
            + per_x * shift_x + per_y * shift_y + z[crank + 2] + r.crank_turn_added[c]
        )
        v[crank], v[crank + 1], v[crank + 2] = -q[crank + 1] * speed, q[crank] * speed, crank_speed
        r.acceleration[crank], r.acceleration[crank + 1] = -q[crank] * speed * speed, -q[crank + 1] * speed * speed
    q[ring] = z[ring]
    q[ring + 1] = ratio * ideal
    v[ring + 1] = r.input_speed
    # The driving flanks touch, pressed on by the tooth force.
    if r.first_stage_ratio > 0.0:
        small = planet_radius(r.crank_circle_radius, r.first_stage_ratio) / r.first_stage_ratio
        pressed = 0.0
        for c in range(cranks):
            pressed += abs(r.tooth_force[c]) / cranks * max(teeth_yield(r), RIGID_TOOTH)
        q[ring + 1] += side * pressed / (small * r.pressure_cosine * r.pressure_cosine)
    q[ring + 2] = q[carrier] - twist_compliance(r) * r.load_torque
    v[ring + 2] = speed
    settled = settle(r)
    for i in range(q.shape[0]):
        r.smooth[i] = r.acceleration[i]
    r.drive_speed = r.ramp_end = r.input_speed
    r.internal_step = 1e-6
    assemble_motion(r, 1.0)
    r.stored_energy = r.potential + kinetic_energy(r)
    r.drive_torque = r.residual_vector[ring + 1] + r.input_torque
    start_force_paths(r)
    return settled


@kernel
def start_ramp(r, duration):
    """At the beginning of a communication step of ``duration`` [s]: a jump of the input speed would strike the bodies."""
    if r.fidelity == DYNAMIC and r.input_speed != r.ramp_end:
        r.ramp_end = r.input_speed
        r.ramp_left = max(min(duration, GENTLE_RAMP), abs(r.input_speed - r.drive_speed) / r.input_acceleration)


@kernel
def advance(r, duration):
    """Integrate over ``duration`` [s]; True if every step met the tolerance.

    A driven sun goes to a new input speed along a ramp, and the profile errors go from those at the start
    to those at the end: jumps of them would strike the bodies once a communication step.
    """
    discs = r.roller_force.shape[0]
    carrier, ring = 3 * discs, ring_coordinate(r)
    sun, load = ring + 1, ring + 2
    time = 0.0
    r.assemblies = r.substeps = r.rejected = 0
    start_profiles(r, r.crank_speed * duration)
    lost = 0.0
    cage_share = r.cage_share * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)
    leave_out_turns(r)
    crank_angle = mean_crank_angle(r)
    while time < duration * (1.0 - 1e-12):
        if r.substeps + r.rejected >= MOST_SUBSTEPS:
            end_profiles(r)
            return False
        left, slope = duration - time, 0.0
        if r.ramp_left > 0.0:
            slope = (r.ramp_end - r.drive_speed) / r.ramp_left
            left = min(left, r.ramp_left)
        h = r.internal_step
        # No crumb at the end: two equal steps where one would leave little.
        if h >= left:
            h = left
        elif 2.0 * h > left:
            h = 0.5 * left
        r.ideal_output = r.q[carrier] + left_out(r)
        prepare_position(r)
        keep_start(r)
        cage, cage_rest, loss, torque, speed = r.cage, r.cage_rest, r.dissipation, r.drive_torque, r.v[sun]
        cage_power, load_speed = r.cage_power, r.v[load]
        r.cage, r.cage_rest = add_turning(cage, cage_rest, h * (r.v[carrier + 5] - r.v[carrier]) * cage_share)
        take_profiles(r, (time + h) / duration)
        error = alpha_step(r, h, r.drive_speed + slope * h, slope)
        if not 0.0 <= error <= 1.0:
            back_to_start(r)
            r.cage, r.cage_rest, r.dissipation, r.cage_power = cage, cage_rest, loss, cage_power
            r.rejected += 1
            r.internal_step = 0.25 * h if error < 0.0 else next_step_size(r, h, error)
            if r.internal_step < SHORTEST_STEP:
                end_profiles(r)
                return False
            continue
        time += h
        r.substeps += 1
        r.drive_speed += slope * h
        r.ramp_left -= min(h, r.ramp_left)
        if r.ramp_left <= 1e-12 * duration:
            r.drive_speed, r.ramp_left = r.ramp_end, 0.0
        finish_step(r)
        if r.drive == 0:
            r.drive_torque = r.residual_vector[sun] + r.input_torque + r.mass[sun] * r.acceleration[sun]
        else:
            r.drive_torque = r.input_torque
        turned_to = mean_crank_angle(r)
        add_force_paths(r, turned_to - crank_angle)
        crank_angle = turned_to
        r.input_energy += 0.5 * h * (torque * speed + r.drive_torque * r.v[sun])
        r.output_energy += 0.5 * h * r.load_torque * (load_speed + r.v[load])
        lost += 0.5 * h * (loss + r.dissipation)
        r.cage_energy += 0.5 * h * (cage_power + r.cage_power)
        if h < left:
            r.internal_step = next_step_size(r, h, error)
    end_profiles(r)
    r.lost_energy += lost
    r.power_loss = lost / duration if duration > 0.0 else 0.0
    return True


@kernel
def mean_crank_angle(r):
    """Angle of the cranks in the housing [rad]."""
    discs, cranks = r.roller_force.shape[:2]
    angle = 0.0
    for c in range(cranks):
        angle += r.q[3 * discs + 5 + 3 * c] / cranks
    return angle


@kernel
def publish_motion(r):
    """Outputs from the present places and velocities."""
    discs, cranks = r.roller_force.shape[:2]
    pins, lobes = r.pin_x.shape[0], r.lobe_pitch_error.shape[1]
    carrier, ring = 3 * discs, ring_coordinate(r)
    sun, load = ring + 1, ring + 2
    crank_angle = crank_speed = 0.0
    for c in range(cranks):
        crank_angle += r.q[carrier + 5 + 3 * c] / cranks
        crank_speed += r.v[carrier + 5 + 3 * c] / cranks
    ratio, turned = total_ratio(r.first_stage_ratio, pins, lobes), left_out(r)
    r.input_angle, r.crank_angle = r.q[sun] + ratio * turned, crank_angle - lobes * turned
    r.crank_speed, r.cage_angle = crank_speed, r.cage
    r.output_angle, r.output_speed = r.q[load] + turned, r.v[load]
    r.transmission_error = r.q[load] - r.q[sun] / ratio
    r.lag = -crank_angle / lobes - r.q[load]
    if r.joints == CONSTRAINED:
        r.reaction_torque = -r.multiplier[2 * cranks + 2]
        r.constraint_drift = largest_drift(r)
    else:
        r.reaction_torque = -(r.q[ring] + r.joint_damping_time * r.v[ring]) / max(r.compliance[ring], RIGID)
    r.cage_speed = r.cage_share * cage_rate(crank_speed, r.v[carrier], r.inner_race_radius, r.outer_race_radius)
    r.friction_load = abs(publish_losses(r, r.v[sun]))
    stored = r.potential + kinetic_energy(r) - r.stored_energy
    balance = r.input_energy + r.cage_energy - r.output_energy - r.lost_energy - stored
    turnover = abs(r.input_energy) + abs(r.output_energy) + abs(stored)
    r.energy_error = 2.0 * balance / turnover if turnover > 0.0 else 0.0
    publish_contacts(r)


@kernel
def linearise(records, rate_weight):
    """Fill the tangent at the present places and velocities: stiffness + rate_weight damping."""
    assemble_motion(records[0], rate_weight)
