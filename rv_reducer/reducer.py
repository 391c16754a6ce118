"""Plant and wear stepped as one unit, by the kernels of both on one record.

The views ``plant`` and ``wear`` share the cells of what the two exchange.  A communication
step is divided where the cranks have turned by ``largest_crank_step`` since the surfaces last
wore, so wear falls on the same places, or nearly, whatever the communication step.
"""

from fmu_src.kernel import entry_point, kernel
from rv_plant.faults import DYNAMIC, LONG_STEP
from rv_plant.faults import FAULTS as PLANT_FAULTS
from rv_plant.gear_stage import total_ratio
from rv_plant.integrator import MOST_SUBSTEPS
from rv_plant.motion import start_ramp
from rv_plant.plant import go_on as plant_goes_on
from rv_plant.plant import initialise as initialise_plant
from rv_plant.plant import look
from rv_reducer.judgement import judge, pauses, start_judgement
from wear_fmu.accumulator import FAULTS as WEAR_FAULTS
from wear_fmu.accumulator import ON_TIME, take_off
from wear_fmu.accumulator import initialise as initialise_wear
from wear_fmu.contacts import extend_profiles, publish_profiles

# Status codes of the wear stand above those of the plant.
OF_WEAR = 100
FAULTS = PLANT_FAULTS | {OF_WEAR + code: text for code, text in WEAR_FAULTS.items()}
# A communication step so near to ``largest_crank_step``, as a share of it, is meant to be one: the surfaces wear at its end.
NEAR = 2e-4
# Where a torque sets the speed nobody knows how far the cranks will turn: the longest part of a step [s].
LONGEST_PART = 1e-3
# While the input speed changes, and perhaps its sign [s].
RAMP_PART = 2.5e-4


@entry_point
def initialise(records):
    """Check the parameters, find the first equilibrium; new surfaces."""
    fault = initialise_plant(records.plant)
    if fault != 0:
        return fault
    fault = initialise_wear(records.wear)
    if fault != 0:
        return OF_WEAR + fault
    records.wear[0].lateness = ON_TIME
    start_judgement(records)
    r, p = records[0], records.plant[0]
    r.sweep_acceleration = r.acceleration
    turn_on(records, driven_speed(p))
    return 0


@kernel
def driven_speed(p):
    """Speed of the cranks [rad/s] as the input wants it; where a torque drives, as it is."""
    if p.fidelity == DYNAMIC and p.drive == 1:
        return p.crank_speed
    lobes = p.lobe_pitch_error.shape[1]
    speed = p.input_speed
    if p.fidelity == DYNAMIC and abs(p.drive_speed) > abs(speed):
        speed = p.drive_speed
    return -lobes * speed / total_ratio(p.first_stage_ratio, p.pin_x.shape[0], lobes)


@kernel
def sense_of(speed):
    if speed == 0.0:
        return 0.0
    return 1.0 if speed > 0.0 else -1.0


@kernel
def turn_on(records, speed):
    """From here the surfaces next wear when the cranks have turned by ``largest_crank_step``."""
    r, sense = records[0], sense_of(speed)
    if sense == r.sweep_sense and sense != 0.0:
        if r.sweep_left <= NEAR * r.largest_crank_step:
            r.sweep_left = r.largest_crank_step
        extend_profiles(records.wear[0], sense * r.sweep_left)
    else:
        r.sweep_left = r.largest_crank_step
        publish_profiles(records.wear[0], 0.0, sense, sense * r.sweep_left)
    r.sweep_path, r.sweep_time, r.sweep_sense = 0.0, 0.0, sense
    r.swept_until = r.operating_time


@kernel
def wear(records, speed):
    """The surfaces wear under the way since they last did."""
    r = records[0]
    acceleration, r.acceleration, r.operating_time = r.acceleration, r.sweep_acceleration, r.swept_until
    fault = take_off(records.wear, r.sweep_time)
    r.acceleration = r.sweep_acceleration = acceleration
    if fault != 0:
        return OF_WEAR + fault
    judge(records, r.sweep_path)
    turn_on(records, speed)
    return 0


@kernel
def same_sweep(r, speed):
    """Whether the way since the surfaces last wore goes on as it began."""
    return sense_of(speed) == r.sweep_sense and r.acceleration == r.sweep_acceleration


@kernel
def part_of(records, left, speed):
    """How long [s] the next part of a step is of which ``left`` is to be done."""
    r, p = records[0], records.plant[0]
    part = left
    near = NEAR * r.largest_crank_step
    if r.sweep_path == 0.0 and abs(abs(speed) * left - r.largest_crank_step) <= near:
        r.sweep_left = abs(speed) * left
    if abs(speed) * left > r.sweep_left * (1.0 + 1e-9):
        part = r.sweep_left / abs(speed)
    if p.fidelity == DYNAMIC:
        if p.drive == 1:
            part = min(part, LONGEST_PART)
        if p.ramp_left > 0.0:
            part = min(part, RAMP_PART)
    return part if part < left * (1.0 - 1e-9) else left


@kernel
def go_on(records, time, duration):
    """The parts of a communication step; it may end after one of them (``pausing``)."""
    r, p = records[0], records.plant[0]
    substeps, lost, left = 0, 0.0, duration
    limited_by, was_over = r.limited_by, r.remaining_life == 0.0
    r.paused_after = 0.0
    while left > 0.0:
        speed = driven_speed(p)
        if not abs(speed) * left < MOST_SUBSTEPS * r.largest_crank_step:
            return LONG_STEP
        if not same_sweep(r, speed):
            fault = wear(records, speed)
            if fault != 0:
                return fault
        part = part_of(records, left, speed)
        path, angle = p.crank_path, p.crank_angle
        before = p.drive_speed if p.fidelity == DYNAMIC else p.input_speed
        fault = plant_goes_on(records.plant, time + duration - left, part)
        if fault != 0:
            return fault
        substeps += p.substeps
        lost += p.power_loss * part
        left = left - part if part < left else 0.0
        turned = abs(speed) * part
        if p.fidelity == DYNAMIC and (p.drive == 1 or p.drive_speed != before):
            turned = p.crank_path - path
        r.sweep_left -= turned
        r.sweep_path += turned
        r.sweep_time += part
        r.operating_time = r.swept_until + r.acceleration * r.sweep_time
        # There and back is worn as soon as the cranks have turned round.
        if r.sweep_left <= 1e-9 * r.largest_crank_step or (p.crank_angle - angle) * r.sweep_sense < 0.0:
            fault = wear(records, speed)
            if fault != 0:
                return fault
            if pauses(r, limited_by, was_over, left):
                r.paused_after = duration - left
                break
    p.substeps = substeps
    if p.fidelity == DYNAMIC:
        p.power_loss = lost / (duration - left)
    return 0


@entry_point
def step(records, time, duration):
    """One communication step of both."""
    if duration == 0.0:
        return look(records.plant)
    r, p = records[0], records.plant[0]
    start_ramp(p, duration)
    speed = driven_speed(p)
    if same_sweep(r, speed) and part_of(records, duration, speed) == duration:
        # Plant and wear may refuse; surfaces wear once, at the end, if they do.
        left, path, passed, paused = r.sweep_left, r.sweep_path, r.sweep_time, r.paused_after
        fault = go_on(records, time, duration)
        if fault != 0:
            r.sweep_left, r.sweep_path, r.sweep_time, r.paused_after = left, path, passed, paused
        return fault
    # A part may fail after surfaces wore in an earlier one: what lies beyond the cells that are put back anyway is kept here.
    first = r.kept.shape[0]
    for i in range(r.worn_kept.shape[0]):
        r.worn_kept[i] = r.cells[first + i]
    fault = go_on(records, time, duration)
    if fault != 0:
        for i in range(r.worn_kept.shape[0]):
            r.cells[first + i] = r.worn_kept[i]
    return fault
