"""Stepping of the plain plant and wear kernels, with what a bench sees."""

from fmu_src.kernel import kernel
from rv_plant.plant import step as step_plant
from wear_fmu.accumulator import step as step_wear

COLUMNS = ("transmission_error", "drive_torque", "housing_force_x", "housing_force_y", "cage_speed", "roller_load")


# Wear of the races goes with this power of the force (Janakiraman's law).
RACE_POWER = 2.219


@kernel
def that_wears(force, limit, share, power):
    """Force [N] that wears as much as ``force`` does where a ``share`` of the wear is missing below the ``limit`` [N]."""
    if share == 0.0 or force <= 0.0:
        return force
    return force * (1.0 - share / (1.0 + (force / limit) ** 3.6)) ** (1.0 / power)


@kernel
def wear_with(plants, wears, time, duration, mild):
    """The wear unit follows the plant, the plant gets the worn surfaces; ``mild`` as in ``run``."""
    p, w = plants[0], wears[0]
    w.crank_angle, w.crank_speed, w.output_angle, w.cage_angle = p.crank_angle, p.crank_speed, p.output_angle, p.cage_angle
    w.temperature = p.reducer_temperature
    discs, cranks, rollers = p.roller_force.shape
    pins = p.mesh_force.shape[1]
    for d in range(discs):
        for j in range(pins):
            w.mesh_force[d, j] = that_wears(p.mesh_force[d, j], mild[1], mild[0], 1.0 + w.load_exponent)
        for c in range(cranks):
            for k in range(rollers):
                w.roller_force[d, c, k] = that_wears(p.roller_force[d, c, k], mild[2], mild[0], RACE_POWER)
    status = step_wear(wears, time, duration)
    p.profile_angle = w.profile_angle
    for d in range(discs):
        for j in range(pins):
            p.mesh_profile_error[d, j] = w.mesh_profile_error[d, j]
            p.mesh_profile_slope[d, j] = w.mesh_profile_slope[d, j]
        for c in range(cranks):
            for k in range(rollers):
                p.roller_profile_error[d, c, k] = w.roller_profile_error[d, c, k]
                p.roller_profile_slope[d, c, k] = w.roller_profile_slope[d, c, k]
    return status


@kernel
def run(plants, wears, steps, duration, mild):
    """``steps`` equal steps of both units; False if one fails.

    ``mild`` is the share of wear that is missing below a force of disc on pin and one on a roller [N].
    """
    for i in range(steps):
        if step_plant(plants, i * duration, duration) != 0 or wear_with(plants, wears, i * duration, duration, mild) != 0:
            return False
    return True


@kernel
def turn(plants, wears, durations, series, worn, mild):
    """Steps of given durations; row i of ``series`` as COLUMNS; ``mild`` as in ``run``."""
    p = plants[0]
    discs, cranks, rollers = p.roller_force.shape
    for i in range(durations.shape[0]):
        if step_plant(plants, 0.0, durations[i]) != 0:
            return False
        if worn and wear_with(plants, wears, 0.0, durations[i], mild) != 0:
            return False
        series[i, 0], series[i, 1] = p.transmission_error, p.drive_torque
        series[i, 2], series[i, 3], series[i, 4] = p.housing_force_x, p.housing_force_y, p.cage_speed
        total = 0.0
        for d in range(discs):
            for c in range(cranks):
                for k in range(rollers):
                    total += p.roller_force_now[d, c, k]
        series[i, 5] = total / (discs * cranks)
    return True


@kernel
def turn_with_gaps(plants, durations, series, gaps, forces):
    """As ``turn``, of a new reducer whose pins are missed by further ``gaps`` (steps, discs, pins) [m]; fills ``forces`` [N] of that shape."""
    p = plants[0]
    for i in range(durations.shape[0]):
        for d in range(gaps.shape[1]):
            for j in range(gaps.shape[2]):
                p.mesh_profile_error[d, j] = gaps[i, d, j]
        if step_plant(plants, 0.0, durations[i]) != 0:
            return False
        series[i, 0], series[i, 1] = p.transmission_error, p.drive_torque
        series[i, 2], series[i, 3], series[i, 4] = p.housing_force_x, p.housing_force_y, p.cage_speed
        for d in range(gaps.shape[1]):
            for j in range(gaps.shape[2]):
                forces[i, d, j] = p.mesh_force_now[d, j]
    return True


@kernel
def load(plants, torques, turning):
    """Output torques in order with the input held; turning [rad] in their sense."""
    p = plants[0]
    for i in range(torques.shape[0]):
        p.load_torque = torques[i]
        if step_plant(plants, 0.0, 1.0) != 0:
            return False
        turning[i] = -p.transmission_error
    return True
