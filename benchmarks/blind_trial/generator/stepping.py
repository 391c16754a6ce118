"""Stepping of the plain plant and wear kernels, with what a bench sees."""

from fmu_src.kernel import kernel
from rv_plant.plant import step as step_plant
from wear_fmu.accumulator import step as step_wear

COLUMNS = ("transmission_error", "drive_torque", "housing_force_x", "housing_force_y", "cage_speed", "roller_load")


@kernel
def wear_with(plants, wears, time, duration):
    """The wear unit follows the plant, the plant gets the worn surfaces."""
    p, w = plants[0], wears[0]
    w.crank_angle, w.crank_speed, w.output_angle, w.cage_angle = p.crank_angle, p.crank_speed, p.output_angle, p.cage_angle
    w.temperature = p.reducer_temperature
    discs, cranks, rollers = p.roller_force.shape
    pins = p.mesh_force.shape[1]
    for d in range(discs):
        for j in range(pins):
            w.mesh_force[d, j] = p.mesh_force[d, j]
        for c in range(cranks):
            for k in range(rollers):
                w.roller_force[d, c, k] = p.roller_force[d, c, k]
    status = step_wear(wears, time, duration)
    for d in range(discs):
        for j in range(pins):
            p.mesh_profile_error[d, j] = w.mesh_profile_error[d, j]
        for c in range(cranks):
            for k in range(rollers):
                p.roller_profile_error[d, c, k] = w.roller_profile_error[d, c, k]
    return status


@kernel
def run(plants, wears, steps, duration):
    """``steps`` equal steps of both units; False if one fails."""
    for i in range(steps):
        if step_plant(plants, i * duration, duration) != 0 or wear_with(plants, wears, i * duration, duration) != 0:
            return False
    return True


@kernel
def turn(plants, wears, durations, series, worn):
    """Steps of given durations; row i of ``series`` as COLUMNS."""
    p = plants[0]
    discs, cranks, rollers = p.roller_force.shape
    for i in range(durations.shape[0]):
        if step_plant(plants, 0.0, durations[i]) != 0:
            return False
        if worn and wear_with(plants, wears, 0.0, durations[i]) != 0:
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
def load(plants, torques, turning):
    """Output torques in order with the input held; turning [rad] in their sense."""
    p = plants[0]
    for i in range(torques.shape[0]):
        p.load_torque = torques[i]
        if step_plant(plants, 0.0, 1.0) != 0:
            return False
        turning[i] = -p.transmission_error
    return True
