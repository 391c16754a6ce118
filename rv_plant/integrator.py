"""Time integration of the motion: generalised-alpha with error control, nothing allocated.

The generalised-alpha method of Chung and Hulbert (1993) in the form of Arnold and Bruls
(2007), which meets the equations of motion at the end of each step: second order,
unconditionally stable for linear systems, with a chosen damping ``spectral_radius`` of
frequencies far above the step.  Each step is a Newton iteration on the positions with
the assembled tangent; its local error is taken from the change of acceleration
(Zienkiewicz and Xie 1991).  A step across the beginning or end of a contact shows as
error and is repeated shorter.
"""

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, scratch, state
from rv_plant.constraints import CONSTRAINED, SETTLING, constrained_direction, start_multipliers
from rv_plant.contact import NO_DAMPING
from rv_plant.coordinates import moving_count
from rv_plant.dynamics import RIGID, assemble_motion
from rv_plant.line_search import between, narrowed
from rv_plant.linear import cholesky_solve
from rv_plant.mesh import forget_phases, ring_coordinate

SHORTEST_STEP = 1e-10
# Internal steps of one communication step, and equilibrium iterations in it: some seconds each.
MOST_SUBSTEPS = 100_000
MOST_ITERATIONS = 1_000_000
# Square of the frequency that stands in where nothing holds a body [1/s^2].
FLOATING = 1e8
# The last way to rest, and the longest at once where ways are shortened, over what is small.
SETTLED, LONGEST_WAY = 1e-6, 30.0
# Energy [J] that is no more than rest: it moves a disc at 0.2 mm/s, a hundredth of what the cranks do.
AT_REST = 1e-8


def variables(sizes: Sizes) -> list[Variable]:
    n = moving_count(sizes)
    bodies = sizes.over(coordinate=n)
    return [
        Variable("spectral_radius", "parameter", "1", "what the integrator leaves of frequencies far above its step",
                 0.5, minimum=0.0, maximum=1.0, source="assumed: between none and all", path="numerics.spectral_radius"),
        Variable("dynamic_tolerance", "parameter", "1", "local error of a step over a deflection of 1 um", 3e-3,
                 minimum=1e-9, maximum=1.0, source="measured: forces within 1 %", path="numerics.dynamic_tolerance"),
        Variable("max_newton", "parameter", "1", "Newton iterations before a step is repeated shorter", 8,
                 integer=True, minimum=2, maximum=100, source="assumed", path="numerics.max_newton"),
        state("smooth", "1", "the integrator's acceleration", **bodies),
        state("length_scale", "1", "small change of each coordinate", **bodies),
        state("assemblies", "1", "evaluations of all forces in the last communication step", integer=True, minimum=0),
        scratch("unknown", (n,), integer=True),
        *(scratch(name, (n,)) for name in ("q_start", "v_start", "acceleration_start", "smooth_start")),
    ]


@kernel
def keep_start(r):
    """Remember where the step begins."""
    for i in range(r.q.shape[0]):
        r.q_start[i] = r.q[i]
        r.v_start[i] = r.v[i]
        r.acceleration_start[i] = r.acceleration[i]
        r.smooth_start[i] = r.smooth[i]
    for i in range(r.multiplier.shape[0]):
        r.multiplier_start[i] = r.multiplier[i]


@kernel
def back_to_start(r):
    for i in range(r.q.shape[0]):
        r.q[i] = r.q_start[i]
        r.v[i] = r.v_start[i]
        r.acceleration[i] = r.acceleration_start[i]
        r.smooth[i] = r.smooth_start[i]
    for i in range(r.multiplier.shape[0]):
        r.multiplier[i] = r.multiplier_start[i]


@kernel
def driven_coordinate(r):
    """Index of the sun if its motion is prescribed, else -1."""
    return ring_coordinate(r) + 1 if r.drive == 0 else -1


@kernel
def settle(r):
    """Find the start of the motion; constraints start where very stiff joints would be."""
    joints = r.joints
    if joints == CONSTRAINED:
        r.joints = SETTLING
    settled = settle_on_springs(r)
    r.joints = joints
    if settled and joints == CONSTRAINED:
        start_multipliers(r, RIGID)
    return settled


@kernel
def settle_on_springs(r):
    """Move the bodies, sun held, to where all forces balance the given accelerations; True if found.

    Joints that statics takes as rigid get their small deflection here.  Where Newton's steps lead to and fro
    across clearance or backlash they are shortened.
    """
    keep_start(r)
    for _ in range(40):
        if not direction_to_rest(r):
            break
        worst = take_share(r, 1.0)
        # A picometre is far below every tolerance and above rounding.
        if worst < SETTLED:
            return True
    back_to_start(r)
    forget_phases(r)
    # Damping makes forces jump where contacts begin; at rest to each other the bodies feel none.
    law, joints = r.damping_law, r.joint_damping_time
    r.damping_law, r.joint_damping_time = NO_DAMPING, 0.0
    settled = settle_gently(r)
    r.damping_law, r.joint_damping_time = law, joints
    return settled


@kernel
def settle_gently(r):
    """The same by shortened ways."""
    for _ in range(400):
        if not direction_to_rest(r):
            return False
        if way_along(r) < SETTLED:
            return True
        shorten_to_rest(r)
    # What floats in clearance and backlash may creep on; when nothing is to be gained by it, it rests.
    return direction_to_rest(r) and -force_along(r) < AT_REST


@kernel
def direction_to_rest(r):
    """Newton's step of all coordinates but the sun's into r.direction; False if there is none."""
    n, sun = r.q.shape[0], ring_coordinate(r) + 1
    assemble_motion(r, 1.0)
    free = 0
    for i in range(n):
        if i != sun:
            r.unknown[free] = i
            free += 1
    # Bodies that float in clearance or backlash are held by a little of their inertia.
    shift = 0.0
    for _ in range(10):
        for a in range(free):
            i = r.unknown[a]
            r.direction[a] = -(r.residual_vector[i] + r.mass[i] * r.acceleration[i])
            r.factor_scale[a] = max(r.tangent[i, i], r.mass[i] * FLOATING)
            for b in range(a, free):
                r.factor[a, b] = r.tangent[i, r.unknown[b]]
        if cholesky_solve(r.factor, r.direction, r.factor_scale, free, shift):
            return True
        shift = max(1e-9, 10.0 * shift)
    return False


@kernel
def take_share(r, share):
    """Move by a share of r.direction; how far that is at most, over what is small."""
    worst = 0.0
    for a in range(r.q.shape[0] - 1):
        i = r.unknown[a]
        r.q[i] += share * r.direction[a]
        worst = max(worst, abs(share * r.direction[a]) / r.length_scale[i])
    return worst


@kernel
def way_along(r):
    """How far r.direction leads at most, over what is small."""
    worst = 0.0
    for a in range(r.q.shape[0] - 1):
        worst = max(worst, abs(r.direction[a]) / r.length_scale[r.unknown[a]])
    return worst


@kernel
def force_along(r):
    """What is out of balance, along r.direction: below 0 as long as it leads towards balance."""
    slope = 0.0
    for a in range(r.q.shape[0] - 1):
        i = r.unknown[a]
        slope += r.direction[a] * (r.residual_vector[i] + r.mass[i] * r.acceleration[i])
    return slope


@kernel
def shorten_to_rest(r):
    """Go along r.direction until what is out of balance has halved or just begins to push back."""
    slope, step = force_along(r), min(1.0, LONGEST_WAY / way_along(r))
    low, low_slope, high, high_slope = 0.0, slope, 0.0, 0.0
    taken = 0.0
    for _ in range(40):
        take_share(r, step - taken)
        taken = step
        assemble_motion(r, 1.0)
        new = force_along(r)
        if abs(new) <= 0.5 * abs(slope) or (high == 0.0 and new < 0.0):
            break
        low, low_slope, high, high_slope = narrowed(low, low_slope, high, high_slope, step, new)
        step = between(low, low_slope, high, high_slope)


@kernel
def alpha_step(r, h, drive_speed, drive_acceleration):
    """One step of h [s]; fills r.smooth (the method's acceleration) and r.acceleration.

    A driven sun ends at ``drive_speed`` with ``drive_acceleration``.  Returns the local
    error over the tolerance, or a negative number if Newton's iteration failed.
    """
    n = r.q.shape[0]
    rho = r.spectral_radius
    alpha_m, alpha_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
    gamma = 0.5 + alpha_f - alpha_m
    beta = 0.25 * (1.0 + alpha_f - alpha_m) ** 2
    by_acceleration = (1.0 - alpha_f) / (1.0 - alpha_m)
    q_weight = 1.0 / (h * h * beta * by_acceleration)
    v_weight = gamma / (h * beta)
    driven = driven_coordinate(r)
    for i in range(n):
        # Predicted with the acceleration unchanged: a smooth motion needs few iterations.
        r.acceleration[i] = r.acceleration_start[i]
        r.smooth[i] = (
            alpha_f * r.acceleration_start[i] - alpha_m * r.smooth_start[i] + (1.0 - alpha_f) * r.acceleration[i]
        ) / (1.0 - alpha_m)
        r.q[i] = r.q_start[i] + h * r.v_start[i] + h * h * (
            (0.5 - beta) * r.smooth_start[i] + beta * r.smooth[i])
        r.v[i] = r.v_start[i] + h * ((1.0 - gamma) * r.smooth_start[i] + gamma * r.smooth[i])
    if driven >= 0:
        r.q[driven] = r.q_start[driven] + 0.5 * h * (r.v_start[driven] + drive_speed)
        r.v[driven] = drive_speed
        r.acceleration[driven] = r.smooth[driven] = drive_acceleration
    for _ in range(r.max_newton):
        assemble_motion(r, v_weight)
        r.assemblies += 1
        free = 0
        worst = 0.0
        for i in range(n):
            if i == driven:
                continue
            r.unknown[free] = i
            free += 1
        for a in range(free):
            i = r.unknown[a]
            r.direction[a] = -(r.residual_vector[i] + r.mass[i] * r.acceleration[i])
            for b in range(a, free):
                r.factor[a, b] = r.tangent[i, r.unknown[b]]
            r.factor[a, a] += r.mass[i] * q_weight
            r.factor_scale[a] = max(r.factor[a, a], 1e-30)
        if r.joints == CONSTRAINED:
            solved = constrained_direction(r, free, q_weight, v_weight)
        else:
            solved = cholesky_solve(r.factor, r.direction, r.factor_scale, free, 0.0)
        if not solved:
            return -1.0
        for a in range(free):
            i = r.unknown[a]
            change = r.direction[a]
            r.q[i] += change
            r.v[i] += v_weight * change
            r.acceleration[i] += q_weight * change
            r.smooth[i] += q_weight * by_acceleration * change
            size = abs(change) / r.length_scale[i]
            if not size <= worst:
                worst = size
        if worst < NEWTON_SHARE * r.dynamic_tolerance:
            error = 0.0
            for a in range(free):
                i = r.unknown[a]
                jump = h * h * abs(beta - 1.0 / 6.0) * abs(r.smooth[i] - r.smooth_start[i])
                error = max(error, jump / r.length_scale[i])
            return error / r.dynamic_tolerance
        if not worst < 1e6:
            return -1.0
    return -1.0


# Newton's last correction against the tolerance of a step.
NEWTON_SHARE = 1e-2


@kernel
def finish_step(r):
    """First touches keep their speed; lost contacts forget it."""
    discs, cranks, rollers = r.roller_force.shape
    for d in range(discs):
        for j in range(r.mesh_force.shape[1]):
            if r.mesh_force_now[d, j] == 0.0:
                r.mesh_impact_speed[d, j] = 0.0
            elif r.mesh_impact_speed[d, j] == 0.0:
                r.mesh_impact_speed[d, j] = abs(r.mesh_rate[d, j])
        for c in range(cranks):
            for k in range(rollers):
                if r.roller_force_now[d, c, k] == 0.0:
                    r.roller_impact_speed[d, c, k] = 0.0
                elif r.roller_impact_speed[d, c, k] == 0.0:
                    r.roller_impact_speed[d, c, k] = abs(r.roller_rate[d, c, k])


@kernel
def next_step_size(r, h, error):
    """Second-order method: the error goes with the third power of the step."""
    factor = 0.9 * max(error, 1e-6) ** (-1.0 / 3.0)
    return h * min(2.0, max(0.2, factor))


@kernel
def kinetic_energy(r):
    e = 0.0
    for i in range(r.q.shape[0]):
        e += 0.5 * r.mass[i] * r.v[i] * r.v[i]
    return e


