"""The plant in motion as a system of first order, y = (q, v, cage), for SciPy and other packages."""


from benchmarks.numba_peer import njit
from rv_plant.dynamics import assemble_motion


@njit
def cage_speed(r):
    carrier = 3 * r.roller_force.shape[0]
    return (r.v[carrier + 5] - r.v[carrier]) * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)


@njit
def rate_of_change(records, y, dy):
    """For SciPy: y = (q, v, cage)."""
    r = records[0]
    n = r.q.shape[0]
    for i in range(n):
        r.q[i], r.v[i] = y[i], y[n + i]
    r.cage = y[2 * n]
    assemble_motion(r, 1.0)
    for i in range(n):
        dy[i], dy[n + i] = r.v[i], -r.residual_vector[i] / r.mass[i]
    dy[2 * n] = cage_speed(r)


@njit
def jacobian(records, y, matrix):
    r = records[0]
    n = r.q.shape[0]
    r.q[:], r.v[:], r.cage = y[:n], y[n : 2 * n], y[2 * n]
    rate = 1e5
    matrix[:] = 0.0
    for twice in range(2):
        assemble_motion(r, rate * (1 + twice))
        for i in range(n):
            matrix[i, n + i] = 1.0
            for j in range(n):
                t = r.tangent[min(i, j), max(i, j)] / r.mass[i]
                # First -(K + rate D), then -(K + 2 rate D): the difference is D.
                if twice == 0:
                    matrix[n + i, j] = -t
                else:
                    d = (-t - matrix[n + i, j]) / rate
                    matrix[n + i, n + j] = d
                    matrix[n + i, j] -= rate * d
    carrier = 3 * r.roller_force.shape[0]
    share = r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)
    matrix[2 * n, n + carrier + 5], matrix[2 * n, n + carrier] = share, -share
