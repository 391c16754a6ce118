"""One step of each method on the plant's record, and its control of the step."""


from benchmarks.integrators.first_order import cage_speed
from benchmarks.integrators.methods import BDF2, DIRK
from benchmarks.numba_peer import njit
from rv_plant.dynamics import assemble_motion
from rv_plant.linear import cholesky_apply, cholesky_factor, cholesky_solve

NEWTON_SHARE = 1e-2


@njit
def implicit_stage(r, base_q, base_v, hg, found, counts):
    """q = base_q + hg v, v = base_v + hg a, M a + G(q, v) = 0 by Newton from r.q; fills r.q, r.v, found = a."""
    n = r.q.shape[0]
    per = 1.0 / hg
    for _ in range(r.max_newton):
        for i in range(n):
            r.v[i] = (r.q[i] - base_q[i]) * per
            found[i] = (r.v[i] - base_v[i]) * per
        assemble_motion(r, per)
        counts[0] += 1
        counts[1] += 1
        for i in range(n):
            r.direction[i] = -(r.residual_vector[i] + r.mass[i] * found[i])
            for j in range(i, n):
                r.factor[i, j] = r.tangent[i, j]
            r.factor[i, i] += r.mass[i] * per * per
            r.factor_scale[i] = max(r.factor[i, i], 1e-30)
        if not cholesky_solve(r.factor, r.direction, r.factor_scale, n, 0.0):
            return False
        worst = 0.0
        for i in range(n):
            r.q[i] += r.direction[i]
            r.v[i] += r.direction[i] * per
            found[i] += r.direction[i] * per * per
            size = abs(r.direction[i]) / r.length_scale[i]
            if not size <= worst:
                worst = size
        if worst < NEWTON_SHARE * r.dynamic_tolerance:
            return True
        if not worst < 1e6:
            return False
    return False


@njit
def dirk_step(r, h, gamma, a, e, ks, counts):
    """One step; ks[0, i], ks[1, i] are velocity and acceleration of stage i, the last also the step's end."""
    stages, n = a.shape[0], r.q.shape[0]
    base_q, base_v = ks[2, 0], ks[2, 1]
    cage, turning = r.cage, cage_speed(r)
    for i in range(n):
        ks[0, 0, i], ks[1, 0, i] = r.v_start[i], r.acceleration_start[i]
    for s in range(1, stages):
        for i in range(n):
            sum_q = sum_v = 0.0
            for k in range(s):
                sum_q += a[s, k] * ks[0, k, i]
                sum_v += a[s, k] * ks[1, k, i]
            base_q[i], base_v[i] = r.q_start[i] + h * sum_q, r.v_start[i] + h * sum_v
            r.q[i] = base_q[i] + h * gamma * (base_v[i] + h * gamma * ks[1, s - 1, i])
        r.cage = cage + a[s].sum() * h * turning
        if not implicit_stage(r, base_q, base_v, h * gamma, ks[1, s], counts):
            return -1.0
        for i in range(n):
            ks[0, s, i] = r.v[i]
    error = 0.0
    for i in range(n):
        r.acceleration[i] = ks[1, stages - 1, i]
        jump = 0.0
        for s in range(stages):
            jump += h * e[s] * ks[0, s, i]
        if stages == 2:
            # Local error of the trapezoidal rule, h^3/12 of the third derivative.
            jump = h * h / 12.0 * (ks[1, 1, i] - ks[1, 0, i])
        error = max(error, abs(jump) / r.length_scale[i])
    return error / r.dynamic_tolerance


@njit
def bdf2_step(r, h, h_before, ks, counts):
    """Variable step; ks[0, 0], ks[1, 0] are q and v one step earlier (h_before = 0: Euler)."""
    n = r.q.shape[0]
    base_q, base_v = ks[2, 0], ks[2, 1]
    w = h / h_before if h_before > 0.0 else 0.0
    now, before = (1.0 + w) ** 2 / (1.0 + 2.0 * w), w * w / (1.0 + 2.0 * w)
    hg = h * (1.0 + w) / (1.0 + 2.0 * w)
    for i in range(n):
        base_q[i] = now * r.q_start[i] - before * ks[0, 0, i]
        base_v[i] = now * r.v_start[i] - before * ks[1, 0, i]
        r.q[i] = base_q[i] + hg * (base_v[i] + hg * r.acceleration_start[i])
    r.cage += h * cage_speed(r)
    if not implicit_stage(r, base_q, base_v, hg, ks[1, 1], counts):
        return -1.0
    error = 0.0
    share = (1.0 + w) ** 2 / (6.0 * w * (1.0 + 2.0 * w)) if w > 0.0 else 0.5
    for i in range(n):
        r.acceleration[i] = ks[1, 1, i]
        error = max(error, share * h * h * abs(r.acceleration[i] - r.acceleration_start[i]) / r.length_scale[i])
    return error / r.dynamic_tolerance


@njit
def rosenbrock_step(r, h, gamma, a, c, b, e, ks, damping, counts):
    """One step; ks[0, i], ks[1, i] are the increments k_i of q and v.

    With W = M/(hg)^2 + D/(hg) + K: W kq = M (Rv + Rq/(hg)) + D Rq, kv = kq/(hg) - Rq.  D/(hg) is
    the difference of two tangents; the cages' turning enters as the derivative by time.
    """
    stages, n = a.shape[0], r.q.shape[0]
    per = 1.0 / (h * gamma)
    by_time, rq, start = ks[2, 0], ks[2, 1], ks[2, 2]
    cage, turning = r.cage, cage_speed(r)
    assemble_motion(r, 2.0 * per)
    for i in range(n):
        for j in range(i, n):
            damping[i, j] = r.tangent[i, j]
    nudge = 1e-3 * h
    third = stages > 2
    if third:
        r.cage = cage + nudge * turning
        assemble_motion(r, per)
        counts[0] += 1
        for i in range(n):
            by_time[i] = r.residual_vector[i]
        r.cage = cage
    assemble_motion(r, per)
    counts[0] += 2
    counts[1] += 1
    for i in range(n):
        by_time[i] = (by_time[i] - r.residual_vector[i]) / nudge if third else 0.0
        for j in range(i, n):
            damping[i, j] = damping[j, i] = damping[i, j] - r.tangent[i, j]
            r.factor[i, j] = r.tangent[i, j]
        r.factor[i, i] += r.mass[i] * per * per
        r.factor_scale[i] = max(r.factor[i, i], 1e-30)
        start[i] = r.residual_vector[i]
    if not cholesky_factor(r.factor, r.factor_scale, n, 0.0):
        return -1.0
    for s in range(stages):
        moved = 0.0
        for k in range(s):
            moved += abs(a[s, k])
        if moved > 0.0:
            for i in range(n):
                r.q[i], r.v[i] = r.q_start[i], r.v_start[i]
                for k in range(s):
                    r.q[i] += a[s, k] * ks[0, k, i]
                    r.v[i] += a[s, k] * ks[1, k, i]
            r.cage = cage + h * turning
            assemble_motion(r, per)
            counts[0] += 1
            for i in range(n):
                start[i] = r.residual_vector[i]
        # gamma_i of RODAS3: 1/2, 3/2, 0, 0.
        time_share = (0.5, 1.5, 0.0, 0.0)[s] if third else 0.0
        for i in range(n):
            rq[i] = r.v[i]
            r.direction[i] = -start[i] - time_share * h * by_time[i]
            for k in range(s):
                rq[i] += c[s, k] / h * ks[0, k, i]
                r.direction[i] += r.mass[i] * c[s, k] / h * ks[1, k, i]
            r.direction[i] += r.mass[i] * rq[i] * per
        for i in range(n):
            for j in range(n):
                r.direction[i] += damping[i, j] * rq[j] / per
        cholesky_apply(r.factor, r.direction, n)
        for i in range(n):
            ks[0, s, i] = r.direction[i]
            ks[1, s, i] = r.direction[i] * per - rq[i]
    error = 0.0
    for i in range(n):
        r.q[i], r.v[i] = r.q_start[i], r.v_start[i]
        jump = 0.0
        for s in range(stages):
            r.q[i] += b[s] * ks[0, s, i]
            r.v[i] += b[s] * ks[1, s, i]
            jump += e[s] * ks[0, s, i]
        if not abs(jump) < 1e300:
            return -1.0
        error = max(error, abs(jump) / r.length_scale[i])
    r.cage = cage + h * turning
    return error / r.dynamic_tolerance


@njit
def advance_by(records, duration, kind, order, gamma, a, c, b, e, ks, damping, counts):
    """Integrate over a communication step; counts: assemblies, factorisations, steps, rejected."""
    r = records[0]
    n = r.q.shape[0]
    time = 0.0
    while time < duration * (1.0 - 1e-12):
        left = duration - time
        h = r.internal_step
        if h >= left:
            h = left
        elif 2.0 * h > left:
            h = 0.5 * left
        cage, turning = r.cage, cage_speed(r)
        for i in range(n):
            r.q_start[i], r.v_start[i], r.acceleration_start[i] = r.q[i], r.v[i], r.acceleration[i]
        if kind == BDF2:
            error = bdf2_step(r, h, ks[3, 0, 0], ks, counts)
        elif kind == DIRK:
            error = dirk_step(r, h, gamma, a, e, ks, counts)
        else:
            error = rosenbrock_step(r, h, gamma, a, c, b, e, ks, damping, counts)
        if not 0.0 <= error <= 1.0:
            for i in range(n):
                r.q[i], r.v[i], r.acceleration[i] = r.q_start[i], r.v_start[i], r.acceleration_start[i]
            r.cage = cage
            counts[3] += 1
            r.internal_step = 0.25 * h if error < 0.0 else h * max(0.2, 0.9 * error ** (-1.0 / (order + 1)))
            if r.internal_step < 1e-9:
                return False
            continue
        time += h
        counts[2] += 1
        r.cage = cage + 0.5 * h * (turning + cage_speed(r))
        if kind == BDF2:
            ks[3, 0, 0] = h
            for i in range(n):
                ks[0, 0, i], ks[1, 0, i] = r.q_start[i], r.v_start[i]
        if h < left:
            r.internal_step = h * min(2.0, max(0.2, 0.9 * max(error, 1e-6) ** (-1.0 / (order + 1))))
    return True
