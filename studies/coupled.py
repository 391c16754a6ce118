"""Plant and wear unit of one reducer stepped together in compiled code.

The same kernels and the same exchange as the master's Gauss-Seidel scheme, without its
freedom (units in this process, one step size): for fits and ensembles that need
thousands of runs.
"""

from fmu_src.kernel import kernel
from rv_plant.contact_arrays import copy_contacts
from rv_plant.equilibrium import newton_direction
from rv_plant.faults import NO_EQUILIBRIUM
from rv_plant.plant import advance_effects, assemble_at_input, error_of, publish
from rv_plant.plant import step as step_plant
from rv_plant.turning import turn_input
from wear_fmu.accumulator import step as step_wear

# Of an equilibrium that is looked for from the one at the torque before.
USUAL_ITERATIONS = 6.0
# Share of the last one in what is known of them.
REMEMBERED = 0.3


@kernel
def give_forces(p, w):
    """What the plant gives the wear unit."""
    w.crank_angle, w.crank_speed, w.output_angle, w.cage_angle = p.crank_angle, p.crank_speed, p.output_angle, p.cage_angle
    w.temperature = p.reducer_temperature
    w.crank_path = p.crank_path
    copy_contacts(p.mesh_force_path, p.roller_force_path, w.mesh_force_path, w.roller_force_path)


@kernel
def give_profiles(w, p):
    """What the wear unit gives the plant."""
    p.profile_angle = w.profile_angle
    copy_contacts(w.mesh_profile_error, w.roller_profile_error, p.mesh_profile_error, p.roller_profile_error)
    copy_contacts(w.mesh_profile_slope, w.roller_profile_slope, p.mesh_profile_slope, p.roller_profile_slope)


@kernel
def step_pair(plants, wears, time, duration):
    """One communication step of both; status codes (plant, wear), of which one stays 0."""
    status = step_plant(plants, time, duration)
    if status != 0:
        return status, 0
    give_forces(plants[0], wears[0])
    status = step_wear(wears, time, duration)
    if status != 0:
        return 0, status
    give_profiles(wears[0], plants[0])
    return 0, 0


@kernel
def run_pair(plants, wears, steps, duration, errors):
    """``steps`` equal communication steps of ``duration`` [s] each; the transmission error [rad] after each, if ``errors`` has room for it."""
    for i in range(steps):
        plant_status, wear_status = step_pair(plants, wears, i * duration, duration)
        if plant_status != 0 or wear_status != 0:
            return plant_status, wear_status
        if errors.shape[0] > 0:
            errors[i] = plants[0].transmission_error
    return 0, 0


@kernel
def start_beside(p, similar, i, alike):
    """Start equilibrium i where the similar run found it, as far beside as one step earlier if the two steps are ``alike``."""
    for k in range(similar.shape[1]):
        beside = p.z[k] - similar[i - 1, k] if alike and i > 0 else 0.0
        p.z[k] = similar[i, k] + beside
    p.advance_before = 0.0


@kernel
def run_pair_beside(plants, wears, duration, accelerations, places, similar, guessed):
    """As many steps of ``duration`` [s] as there are ``accelerations``; ``places``, ``similar`` and ``guessed`` as in ``sweep``."""
    p = plants[0]
    for i in range(accelerations.shape[0]):
        wears[0].acceleration = accelerations[i]
        if guessed:
            start_beside(p, similar, i, True)
        plant_status, wear_status = step_pair(plants, wears, i * duration, duration)
        if plant_status != 0 or wear_status != 0:
            return plant_status, wear_status
        for k in range(places.shape[1]):
            places[i, k] = p.z[k]
    return 0, 0


@kernel
def sweep(plants, wears, durations, series, worn, places, similar, guessed):
    """Steps of the given ``durations`` [s]; row i of ``series`` gets what a bench sees after step i.

    Columns: see COLUMNS.  Surfaces that are not ``worn`` need no wear unit.  ``places`` (steps, coordinates)
    keeps every equilibrium; if ``guessed``, ``similar`` holds those of a similar run, to start from.
    """
    p = plants[0]
    for i in range(durations.shape[0]):
        if guessed:
            start_beside(p, similar, i, True)
        plant_status, wear_status = 0, 0
        if worn:
            plant_status, wear_status = step_pair(plants, wears, 0.0, durations[i])
        else:
            plant_status = step_plant(plants, 0.0, durations[i])
        if plant_status != 0 or wear_status != 0:
            return plant_status, wear_status
        series[i, 0], series[i, 1], series[i, 2] = p.output_angle, p.transmission_error, p.drive_torque
        series[i, 3], series[i, 4], series[i, 5] = p.housing_force_x, p.housing_force_y, p.power_loss
        series[i, 6], series[i, 7] = p.reducer_temperature, p.cage_speed
        for k in range(places.shape[1]):
            places[i, k] = p.z[k]
    return 0, 0


COLUMNS = (
    "output_angle", "transmission_error", "drive_torque", "housing_force_x", "housing_force_y", "power_loss",
    "reducer_temperature", "cage_speed",
)  # fmt: skip


@kernel
def step_beside(p, similar, i):
    """One Newton step from equilibrium i of a similar run; False if there is none."""
    for k in range(similar.shape[1]):
        p.z[k] = similar[i, k]
    assemble_at_input(p)
    if not newton_direction(p):
        return False
    for a in range(p.free_count):
        p.z[p.free[a]] += p.direction[a]
    return True


@kernel
def sweep_beside(plants, durations, torques, errors, similar, forgets):
    """Transmission error [rad] after each of the ``durations`` [s], to first order beside a similar run; with the input held, under each of the output
    ``torques`` [N m] instead, if there are any (not beside friction, whose springs remember).  ``forgets``: there is no state that the way to a
    place brings there.

    One Newton step from each equilibrium of that run (rows of ``similar``): a third of the cost of a new
    equilibrium.  Contact forces stay those of the similar run.  One kernel for both: most of it is the plant's, which takes its time to compile.
    """
    p = plants[0]
    is_held = torques.shape[0] > 0
    for i in range(similar.shape[0]):
        if is_held:
            p.load_torque = torques[i]
        output_speed = turn_input(p, 0.0 if is_held else durations[i])
        if not step_beside(p, similar, i):
            return NO_EQUILIBRIUM
        if not forgets:
            publish(p, output_speed)
            advance_effects(p, durations[i])
        errors[i] = error_of(p)
    return 0


@kernel
def torque_sweep(plants, torques, turning, places, similar, guessed):
    """Output torque through ``torques`` [N m] with the input held; ``turning`` [rad] of the output in its sense.

    ``places``, ``similar`` and ``guessed`` as in ``sweep``.
    """
    p = plants[0]
    # Iterations from beside the similar run and from where the way led, when each was last gone: far from a similar run it is no help.
    from_similar, from_way = 0.0, USUAL_ITERATIONS
    p.near_held[0] = 0
    for i in range(torques.shape[0]):
        beside = guessed and from_similar <= from_way
        if beside:
            # Play and yielding turn with the torque.
            start_beside(p, similar, i, i == 0 or torques[i] * torques[i - 1] > 0.0)
        p.load_torque = torques[i]
        status = step_plant(plants, 0.0, 1.0)
        if status != 0:
            return status
        # The input stands and no surface wears: only the torque changes from here on.
        p.near_held[0] = 1
        if beside:
            from_similar += REMEMBERED * (p.iterations - from_similar)
        else:
            from_way += REMEMBERED * (p.iterations - from_way)
        turning[i] = -p.transmission_error
        for k in range(places.shape[1]):
            places[i, k] = p.z[k]
    p.near_held[0] = 0
    return 0
