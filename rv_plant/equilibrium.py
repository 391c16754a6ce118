"""Static equilibrium at one input angle: a globalised Newton iteration.

The potential of frictionless contacts is convex up to the small turning of the
contact normals, so along a Newton direction its slope grows.  A step is taken when the
slope has not become clearly positive; otherwise it is shortened by the secant rule.
Where a bearing floats in its clearance the tangent is singular; a shift of the
diagonal then leads to the next contact.
"""

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, scratch, state
from rv_plant.assembly import assemble, assemble_beside, assemble_on
from rv_plant.coordinates import coordinate_count, moving_count
from rv_plant.line_search import between, narrowed
from rv_plant.linear import cholesky_solve
from rv_plant.mesh import forget_phases
from rv_plant.near_mesh import missed
from rv_plant.output_pins import has_output_pins

# No component may move a contact further than this in one iteration [m].
LONGEST_STEP = 3e-5
# With output pins, whose clearance may be a tenth of a millimetre and more.
LONGEST_STEP_IN_PLAY = 2e-4
# The residual is weighed with at least this force [N]; rounding leaves 1e-8 N.
LEAST_FORCE = 30.0
# So many times the iterations where one of a load of a few such forces, or none, is looked for anew: its last contacts come slowly.
PATIENCE, WEAK = 16, 10.0
# Stiffness that stands for "a typical diagonal" [N/m].
TYPICAL_STIFFNESS = 1e8


def variables(sizes: Sizes) -> list[Variable]:
    z, n = coordinate_count(sizes), moving_count(sizes)
    return [
        Variable("tolerance", "parameter", "1", "out-of-balance force over load", 1e-9, minimum=1e-12,
                 maximum=1e-3, source="assumed: far below every other error", path="numerics.tolerance"),
        Variable("max_iterations", "parameter", "1", "Newton iterations before an angle counts as failed", 60,
                 integer=True, minimum=1, maximum=1000, source="assumed", path="numerics.max_iterations"),
        local("residual", "1", "out-of-balance force over load at the last equilibrium", path="numerics.residual"),
        local("iterations", "1", "equilibrium iterations of the last angle", integer=True, path="numerics.iterations"),
        state("is_free", "1", "whether the coordinate is an unknown", **sizes.over(coordinate=z), integer=True, minimum=0, maximum=1),
        state("free", "1", "the unknown coordinates", **sizes.over(unknown=z), integer=True, minimum=0, maximum=z - 1),
        state("free_count", "1", "number of unknowns", integer=True, minimum=0, maximum=z),
        # Newton's step, of the bodies in motion too.
        scratch("factor", (n, n)), scratch("factor_scale", (n,)), scratch("direction", (n,)),
    ]


@kernel
def list_free_coordinates(r):
    """Discs and carrier turning are free, supports if they are compliant."""
    discs = r.mesh_force.shape[0]
    n = 0
    for i in range(r.z.shape[0]):
        r.is_free[i] = 1 if i <= 3 * discs or r.compliance[i] > 0.0 else 0
        if r.is_free[i]:
            r.free[n] = i
            n += 1
    r.free_count = n


@kernel
def is_turning(r, i):
    """Whether coordinate i is an angle (it is weighed with the pin circle radius)."""
    discs = r.mesh_force.shape[0]
    if i < 3 * discs:
        return i % 3 == 2
    if i == 3 * discs or i == r.z.shape[0] - 1:
        return True
    return i >= 3 * discs + 3 and (i - 3 * discs - 3) % 3 == 2


@kernel
def relative_residual(r, load_torque):
    """Largest out-of-balance force or moment over the load (at least 1 N of force)."""
    lever = r.pin_circle_radius
    worst = 0.0
    for a in range(r.free_count):
        i = r.free[a]
        force = abs(r.residual_vector[i])
        if is_turning(r, i):
            force /= lever
        # A NaN must not look like a small residual.
        if not force < 1e300:
            return 1e300
        worst = max(worst, force)
    # What rounding of positions leaves goes with the largest contact force.
    scale = max(LEAST_FORCE, abs(load_torque) / lever)
    discs, cranks, rollers = r.roller_force_now.shape
    for d in range(discs):
        for j in range(r.mesh_force_now.shape[1]):
            scale = max(scale, r.mesh_force_now[d, j])
        for c in range(cranks):
            for k in range(rollers):
                scale = max(scale, r.roller_force_now[d, c, k])
    return worst / scale


@kernel
def newton_direction(r):
    """Fill r.direction with -tangent^-1 residual, limited in length; False if impossible."""
    n = r.free_count
    lever = r.pin_circle_radius
    shift = 0.0
    for attempt in range(12):
        for a in range(n):
            i = r.free[a]
            r.direction[a] = -r.residual_vector[i]
            r.factor_scale[a] = TYPICAL_STIFFNESS * (lever * lever if is_turning(r, i) else 1.0)
            for b in range(a, n):
                r.factor[a, b] = r.tangent[i, r.free[b]]
        if cholesky_solve(r.factor, r.direction, r.factor_scale, n, shift):
            break
        shift = 1e-9 if attempt == 0 else shift * 10.0
    else:
        return False
    longest = 0.0
    for a in range(n):
        move = abs(r.direction[a]) * (lever if is_turning(r, r.free[a]) else 1.0)
        if not move < 1e300:
            return False
        longest = max(longest, move)
    most = LONGEST_STEP_IN_PLAY if has_output_pins(r) else LONGEST_STEP
    if longest > most:
        for a in range(n):
            r.direction[a] *= most / longest
    return longest < 1e30


@kernel
def slope_along(r):
    s = 0.0
    for a in range(r.free_count):
        s += r.direction[a] * r.residual_vector[r.free[a]]
    return s


@kernel
def newton(r, ideal_output, cage_angle, load_torque, most):
    """Iterate r.z to equilibrium from where it stands, ``most`` times; True if the residual is met."""
    assemble_on(r, ideal_output, cage_angle, load_torque)
    r.residual = relative_residual(r, load_torque)
    for _ in range(most):
        if r.residual <= r.tolerance:
            if r.residual + missed(r) <= r.tolerance:
                return True
            assemble(r, ideal_output, cage_angle, load_torque)
            r.residual = relative_residual(r, load_torque)
            if r.residual <= r.tolerance:
                return True
        if not newton_direction(r):
            return False
        slope = slope_along(r)
        taken = 0.0
        step = 1.0
        low, low_slope, high, high_slope = 0.0, slope, 0.0, 0.0
        for _ in range(40):
            for a in range(r.free_count):
                r.z[r.free[a]] += (step - taken) * r.direction[a]
            taken = step
            assemble_beside(r, ideal_output, cage_angle, load_torque)
            r.iterations += 1
            new_slope = slope_along(r)
            if abs(new_slope) <= 0.5 * abs(slope) or (high == 0.0 and new_slope < 0.0):
                break
            low, low_slope, high, high_slope = narrowed(low, low_slope, high, high_slope, step, new_slope)
            step = between(low, low_slope, high, high_slope)
        r.residual = relative_residual(r, load_torque)
    return r.residual + missed(r) <= r.tolerance


@kernel
def refine(r, ideal_output, cage_angle, load_torque):
    """One Newton step more from an equilibrium: what is left is rounding.  Where the tangent is singular nothing moves."""
    if newton_direction(r):
        for a in range(r.free_count):
            r.z[r.free[a]] += r.direction[a]
        assemble_beside(r, ideal_output, cage_angle, load_torque)
        r.residual = relative_residual(r, load_torque)


@kernel
def start_anew(r):
    """Ideal places, and contacts where they are ideally."""
    for i in range(r.z.shape[0]):
        r.z[i] = 0.0
    forget_phases(r)


@kernel
def equilibrium(r, ideal_output, cage_angle, load_torque):
    """Equilibrium at an input angle, given as the output angle [rad] of ideal kinematics.

    Starts at r.z (the last solution, or its extrapolation).  If that fails, starts anew
    from no load in growing steps.  Fills z, contact forces, ``residual`` and
    ``iterations``; False if no equilibrium was found.
    """
    r.iterations = 0
    if newton(r, ideal_output, cage_angle, load_torque, r.max_iterations):
        return True
    weak = abs(load_torque) < WEAK * LEAST_FORCE * r.pin_circle_radius
    most = PATIENCE * r.max_iterations if weak else r.max_iterations
    for steps in (4, 16, 64):
        start_anew(r)
        reached = True
        for s in range(steps):
            if not newton(r, ideal_output, cage_angle, load_torque * (s + 1) / steps, most):
                reached = False
                break
        if reached:
            return True
    return False
