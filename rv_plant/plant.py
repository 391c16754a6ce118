"""The plant as a unit: initialise it, step it through time.

Quasi-static, the input turns and at each angle every part is in equilibrium; dynamic, the
bodies move (``motion``).  All entry points take a one-element record array of
``plant_table`` and return a status code, 0 or a key of ``FAULTS``.
"""

import math

from fmu_src.effect import compose
from fmu_src.kernel import entry_point, kernel
from fmu_src.variables import Sizes, Variable, local, output, state
from rv_plant.assembly import assemble_once
from rv_plant.contact_arrays import copy_contacts
from rv_plant.coordinates import coordinate_count
from rv_plant.dimension import FILE
from rv_plant.dynamics import assemble_motion
from rv_plant.effects import HOOKS
from rv_plant.equilibrium import equilibrium, refine
from rv_plant.faults import DYNAMIC, LONG_STEP, NO_EQUILIBRIUM, NO_MOTION, NO_START, QUASI_STATIC, TORQUE_AT_REST, geometry_fault
from rv_plant.force_paths import add_force_paths, start_force_paths
from rv_plant.gear_stage import crank_turn_per_carrier_turn, crank_turn_per_shift, planet_radius, total_ratio
from rv_plant.integrator import MOST_ITERATIONS, MOST_SUBSTEPS
from rv_plant.motion import advance, publish_motion, start_motion, start_ramp
from rv_plant.needle_bearing import cage_rate
from rv_plant.outputs import prepare_position, publish_contacts, publish_losses
from rv_plant.poses import crank_position
from rv_plant.prepared import prepare, retune
from rv_plant.profiles import end_profiles, start_profiles, take_profiles
from rv_plant.supports import twist_compliance
from rv_plant.turning import add_turning, angles_within_turn, speeds

effects = compose("rv_plant.effects", HOOKS)
start_effects, advance_states, heat_effects = effects.start, effects.advance, effects.heat


def variables(sizes: Sizes) -> list[Variable]:
    return [
        Variable("input.speed", "input", "rad/s", "speed of the sun (of the cranks without a first stage)",
                 1.0, source=FILE),
        Variable("input.torque", "input", "N.m", "torque on the sun if drive is torque", 0.0,
                 source="as the system model has it"),
        Variable("load_torque", "input", "N.m", "torque on the carrier, positive against positive rotation",
                 0.0, nominal=100.0, source=FILE, path="output.load_torque"),
        Variable("temperature", "input", "K", "temperature of the reducer's surroundings", 293.15,
                 minimum=200.0, maximum=500.0, nominal=300.0, source="assumed: room temperature", path="heat.ambient_temperature"),
        Variable("fidelity", "parameter", "1", "equilibrium at each angle, or bodies in motion", 0,
                 choices=("quasi-static", "dynamic"), source="as the system model needs it"),
        Variable("drive", "parameter", "1", "what moves the input in motion", 0, choices=("speed", "torque"),
                 source="as the system model needs it"),
        Variable("largest_crank_step", "parameter", "rad", "a communication step is divided so that no crank"
                 " turns further between two equilibria", math.radians(5.0), minimum=1e-6, maximum=1.0,
                 source="assumed: 72 positions a turn", path="numerics.largest_crank_step"),
        output("input.angle", "rad", "angle of the sun"),
        output("crank.angle", "rad", "angle of the cranks in the housing (mean of all cranks)"),
        output("crank.speed", "rad/s", "speed of the cranks in the housing"),
        output("output.angle", "rad", "angle of the output flange"),
        output("output.speed", "rad/s", "speed of the output flange"),
        output("drive_torque", "N.m", "torque that holds or drives the input", path="input.drive_torque"),
        output("reaction_torque", "N.m", "torque with which the housing holds the pin ring", path="housing.reaction_torque"),
        output("transmission_error", "rad", "output angle minus input angle over ratio", nominal=1e-4, path="output.transmission_error"),
        output("lag", "rad", "carrier behind its ideal angle for the present crank angle (second stage alone: what turns the cranks along"
               " is in output.transmission_error)", nominal=1e-4, path="output.lag"),
        local("substeps", "1", "equilibria in the last communication step", integer=True, path="numerics.substeps"),
        state("z_before", "1", "z one equilibrium earlier", **sizes.over(coordinate=coordinate_count(sizes))),
        state("advance_before", "rad", "turning of the ideal output between z_before and z"),
    ]


@kernel
def advance_effects(r, duration):
    """States of the effects move on through ``duration`` [s], then the temperature."""
    advance_states(r, duration)
    heat_effects(r, duration)


@kernel
def crank_departure(r):
    """How far the cranks (their mean) are from where ideal kinematics has them [rad]."""
    discs, cranks = r.roller_force.shape[:2]
    carrier = 3 * discs
    turning = r.z[carrier]
    departure = crank_turn_per_carrier_turn(r.first_stage_ratio) * turning
    side = 1.0 if r.load_torque >= 0.0 else -1.0
    for c in range(cranks):
        crank = carrier + 3 + 3 * c
        per_x, per_y = crank_turn_per_shift(
            r.ideal_output + turning + crank_position(r, c), r.crank_circle_radius, r.first_stage_ratio,
            r.pressure_angle, side,
        )
        shift_x, shift_y = r.z[carrier + 1] + r.z[crank], r.z[carrier + 2] + r.z[crank + 1]
        departure += (r.z[crank + 2] + r.crank_turn_added[c] + per_x * shift_x + per_y * shift_y) / cranks
    return departure


@kernel
def error_of(r):
    """Transmission error [rad] of the present equilibrium."""
    return r.z[3 * r.roller_force.shape[0]] - twist_compliance(r) * r.load_torque


@kernel
def publish(r, output_speed):
    """Outputs that follow from the present equilibrium; ``output_speed`` is the ideal one."""
    cranks = r.roller_force.shape[1]
    pins, lobes = r.pin_x.shape[0], r.lobe_pitch_error.shape[1]
    ratio = total_ratio(r.first_stage_ratio, pins, lobes)
    turning, crank_turning = r.z[3 * r.roller_force.shape[0]], crank_departure(r)
    moment = of_errors = 0.0
    for c in range(cranks):
        moment += r.crank_moment[c]
        of_errors += r.crank_moment[c] * r.crank_turn_rate[c]
        lever = planet_radius(r.crank_circle_radius, r.first_stage_ratio)
        r.tooth_force[c] = r.crank_moment[c] / lever if lever > 0.0 else 0.0
    r.input_angle = ratio * r.ideal_output
    r.crank_angle = -lobes * r.ideal_output + crank_turning
    r.crank_speed = -lobes * output_speed
    r.cage_angle = r.cage
    r.cage_speed = r.cage_share * cage_rate(r.crank_speed, output_speed, r.inner_race_radius, r.outer_race_radius)
    twist = twist_compliance(r) * r.load_torque
    r.output_angle = r.ideal_output + turning - twist
    r.output_speed = output_speed
    r.transmission_error = error_of(r)
    r.lag = -crank_turning / lobes - turning + twist
    # Virtual work of the cranks' turning, as the teeth's errors have it.
    r.drive_torque = (moment / r.first_stage_ratio if r.first_stage_ratio > 0.0 else -moment) - of_errors
    r.drive_torque += publish_losses(r, r.input_speed)
    r.power_loss = r.friction_power
    r.reaction_torque = r.load_torque - r.drive_torque
    publish_contacts(r)


@kernel
def extrapolate(r, advance):
    """Start of the next equilibrium: z continued along a straight line through the last two."""
    share = 0.0
    # Only across similar steps; a straight line through far points leads astray.
    if r.advance_before != 0.0 and 0.2 < advance / r.advance_before < 5.0:
        share = advance / r.advance_before
    for i in range(r.z.shape[0]):
        now = r.z[i]
        r.z[i] = now + share * (now - r.z_before[i])
        r.z_before[i] = now
    r.advance_before = advance


@kernel
def solve(r):
    """Equilibrium at the present input angle."""
    prepare_position(r)
    output, cage = angles_within_turn(r)
    return equilibrium(r, output, cage, r.load_torque)


@kernel
def assemble_at_input(r):
    """Out-of-balance forces and tangent at the present input angle, where the bodies stand."""
    prepare_position(r)
    output, cage = angles_within_turn(r)
    assemble_once(r, output, cage, r.load_torque)


@entry_point
def initialise(records):
    """Check the parameters, find the first equilibrium, publish the outputs."""
    r = records[0]
    fault = geometry_fault(r)
    if fault != 0:
        return fault
    if r.drive == 1 and r.fidelity == QUASI_STATIC:
        return TORQUE_AT_REST
    r.friction_power, r.cage_share, r.reducer_temperature = 0.0, 1.0, r.temperature
    start_effects(r)
    prepare(r)
    if not solve(r):
        return NO_EQUILIBRIUM
    start_force_paths(r)
    copy_contacts(r.mesh_profile_error, r.roller_profile_error, r.mesh_error_start, r.roller_error_start)
    ratio = total_ratio(r.first_stage_ratio, r.pin_x.shape[0], r.lobe_pitch_error.shape[1])
    publish(r, r.input_speed / ratio)
    if r.fidelity == DYNAMIC:
        if not start_motion(r):
            return NO_START
        publish_motion(r)
    return 0


@kernel
def look(records):
    """A step of no length: the outputs for inputs and amplitudes as they are now, the parts where they stand.

    At rest one more Newton step leaves nothing but rounding, so that differences of two such looks are those
    of the equilibrium's own tangent.  Nothing is added up.
    """
    r = records[0]
    fault = retune(r)
    if fault != 0:
        return fault
    start_profiles(r, 0.0)
    take_profiles(r, 1.0)
    found = True
    if r.fidelity == DYNAMIC:
        prepare_position(r)
        assemble_motion(r, 1.0)
    else:
        found = solve(r)
        if found:
            output, cage = angles_within_turn(r)
            refine(r, output, cage, r.load_torque)
    end_profiles(r)
    if not found:
        return NO_EQUILIBRIUM
    if r.fidelity == DYNAMIC:
        publish_motion(r)
    else:
        publish(r, speeds(r)[0])
    return 0


@entry_point
def step(records, time, duration):
    """One communication step: through equilibria or, if fidelity is dynamic, in motion."""
    if duration == 0.0:
        return look(records)
    start_ramp(records[0], duration)
    return go_on(records, time, duration)


@entry_point
def go_on(records, time, duration):
    """A communication step, or one of the parts that it is divided into."""
    r = records[0]
    fault = retune(r)
    if fault != 0:
        return fault
    if r.fidelity == DYNAMIC:
        moved = advance(r, duration)
        publish_motion(r)
        advance_effects(r, duration)
        if moved:
            return 0
        return LONG_STEP if r.substeps + r.rejected >= MOST_SUBSTEPS else NO_MOTION
    return step_through_equilibria(r, duration)


@kernel
def step_through_equilibria(r, duration):
    """Turn the input by input_speed times duration [s] through one or more equilibria."""
    pins, lobes = r.pin_x.shape[0], r.lobe_pitch_error.shape[1]
    output_speed, cage_speed = speeds(r)
    crank_advance = abs(lobes * output_speed * duration)
    if not crank_advance < MOST_SUBSTEPS * r.largest_crank_step:
        return LONG_STEP
    n = max(1, math.ceil(crank_advance / r.largest_crank_step - 1e-9))
    output_before, output_rest, cage_before, cage_rest = r.ideal_output, r.ideal_output_rest, r.cage, r.cage_rest
    start_profiles(r, -lobes * output_speed * duration)
    spent, crank_angle, fault = 0, r.crank_angle, 0
    for i in range(n):
        share = (i + 1.0) / n
        r.ideal_output, r.ideal_output_rest = add_turning(output_before, output_rest, share * output_speed * duration)
        r.cage, r.cage_rest = add_turning(cage_before, cage_rest, share * cage_speed * duration)
        extrapolate(r, output_speed * duration / n)
        take_profiles(r, share)
        if not solve(r):
            r.input_angle = total_ratio(r.first_stage_ratio, pins, lobes) * r.ideal_output
            fault = NO_EQUILIBRIUM
            break
        spent += r.iterations
        if spent > MOST_ITERATIONS:
            fault = LONG_STEP
            break
        turned_to = -lobes * r.ideal_output + crank_departure(r)
        add_force_paths(r, turned_to - crank_angle)
        crank_angle = turned_to
    end_profiles(r)
    if fault != 0:
        return fault
    r.substeps = n
    publish(r, output_speed)
    advance_effects(r, duration)
    return 0
