"""Joints as constraints with Lagrange multipliers, as the needle-bearing document has them.

    M dv/dt + gradient + C^T lambda = 0
    C dv/dt + b + 2 s dPhi/dt + s^2 Phi = 0

Phi holds, in this order, the seats of the cranks (x and y each), the main bearing (x and
y), the pin ring's turning and the output shaft's twist; C is its Jacobian, b what the
accelerations of turning seats add, s the rate of Baumgarte's stabilisation (alpha =
beta: critically damped).  (Baumgarte 1972; Garcia de Jalon and Bayo 1994)
"""

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, scratch, state
from rv_plant.coordinates import moving_count
from rv_plant.linear import cholesky_apply, cholesky_factor
from rv_plant.mesh import ring_coordinate
from rv_plant.poses import seat

COMPLIANT, CONSTRAINED, SETTLING = range(3)


def variables(sizes: Sizes) -> list[Variable]:
    # Two per crank's seat, two of the main bearing, ring, shaft.
    m, n = 2 * sizes["crank"] + 4, moving_count(sizes)
    each = ("constraint", "constraint_rate", "constraint_bias", "multiplier_step", "multiplier_start", "schur_scale")
    return [
        Variable("joints", "parameter", "1", "joints in motion: springs, or constraints with multipliers (then rigid)", 0,
                 choices=("compliant", "constrained"), source="needle-bearing document has constraints", path="numerics.joints"),
        Variable("baumgarte_rate", "parameter", "1/s", "rate at which drift of a constraint is pulled back", 1e4,
                 minimum=0.0, maximum=1e8, nominal=1e4, source="assumed: faster than the cranks, slower than a step", path="numerics.baumgarte_rate"),
        local("constraint_drift", "m", "largest violation of a joint's constraint (turnings in rad)", path="numerics.constraint_drift",
              display="um"),
        state("multiplier", "N", "forces of the joints' constraints (moments in N m)", **sizes.over(constraint=m)),
        *(scratch(name, (m,)) for name in each),
        scratch("constraint_jacobian", (m, n)), scratch("schur", (m, m)), scratch("schur_columns", (m, n)),
    ]


@kernel
def evaluate_constraints(r):
    """Fill Phi, its rate, b and C at the present places and velocities."""
    discs, cranks = r.roller_force.shape[:2]
    carrier, ring = 3 * discs, ring_coordinate(r)
    q, v, c = r.q, r.v, r.constraint_jacobian
    m, n = c.shape
    for i in range(m):
        r.constraint_bias[i] = 0.0
        for j in range(n):
            c[i, j] = 0.0
    spin = v[carrier] * v[carrier]
    for k in range(cranks):
        crank, row = carrier + 3 + 3 * k, 2 * k
        ax, ay = seat(r, k, q[carrier])
        r.constraint[row] = q[crank] - q[carrier + 1] - ax
        r.constraint[row + 1] = q[crank + 1] - q[carrier + 2] - ay
        c[row, crank] = c[row + 1, crank + 1] = 1.0
        c[row, carrier + 1] = c[row + 1, carrier + 2] = -1.0
        c[row, carrier], c[row + 1, carrier] = ay, -ax
        r.constraint_bias[row], r.constraint_bias[row + 1] = ax * spin, ay * spin
    row = 2 * cranks
    for i in range(2):
        r.constraint[row + i] = q[carrier + 1 + i]
        c[row + i, carrier + 1 + i] = 1.0
    r.constraint[row + 2] = q[ring]
    c[row + 2, ring] = 1.0
    r.constraint[row + 3] = q[carrier] - q[ring + 2]
    c[row + 3, carrier], c[row + 3, ring + 2] = 1.0, -1.0
    for i in range(m):
        rate = 0.0
        for j in range(n):
            rate += c[i, j] * v[j]
        r.constraint_rate[i] = rate


@kernel
def start_multipliers(r, compliance):
    """Multipliers that carry what joints of a small ``compliance`` carried."""
    evaluate_constraints(r)
    for i in range(r.multiplier.shape[0]):
        r.multiplier[i] = r.constraint[i] / compliance


@kernel
def constrained_direction(r, free, q_weight, v_weight):
    """Newton step of places and multipliers; r.direction holds -(residual) and gets the step.

    r.factor holds the iteration matrix of the bodies; the multipliers' equations are
    solved on its factor (Schur complement).  False if the matrix is not positive definite.
    """
    m = r.multiplier.shape[0]
    s = r.baumgarte_rate
    weight = q_weight + 2.0 * s * v_weight + s * s
    evaluate_constraints(r)
    for i in range(m):
        unbalanced = r.constraint_bias[i] + 2.0 * s * r.constraint_rate[i] + s * s * r.constraint[i]
        for a in range(free):
            unbalanced += r.constraint_jacobian[i, r.unknown[a]] * r.acceleration[r.unknown[a]]
        r.multiplier_step[i] = unbalanced / weight
    for a in range(free):
        for i in range(m):
            r.direction[a] -= r.constraint_jacobian[i, r.unknown[a]] * r.multiplier[i]
    if not cholesky_factor(r.factor, r.factor_scale, free, 0.0):
        return False
    cholesky_apply(r.factor, r.direction, free)
    # Columns of A^-1 C^T, the Schur complement C A^-1 C^T, and its right-hand side.
    for i in range(m):
        for a in range(free):
            r.schur_columns[i, a] = r.constraint_jacobian[i, r.unknown[a]]
        cholesky_apply(r.factor, r.schur_columns[i], free)
    for i in range(m):
        for k in range(i, m):
            total = 0.0
            for a in range(free):
                total += r.constraint_jacobian[k, r.unknown[a]] * r.schur_columns[i, a]
            r.schur[i, k] = total
        for a in range(free):
            r.multiplier_step[i] += r.constraint_jacobian[i, r.unknown[a]] * r.direction[a]
        r.schur_scale[i] = r.schur[i, i]
    if not cholesky_factor(r.schur, r.schur_scale, m, 0.0):
        return False
    cholesky_apply(r.schur, r.multiplier_step, m)
    for i in range(m):
        r.multiplier[i] += r.multiplier_step[i]
        for a in range(free):
            r.direction[a] -= r.schur_columns[i, a] * r.multiplier_step[i]
    return True


@kernel
def largest_drift(r):
    """Largest violation of a constraint [m or rad]."""
    evaluate_constraints(r)
    worst = 0.0
    for i in range(r.constraint.shape[0]):
        worst = max(worst, abs(r.constraint[i]))
    return worst
