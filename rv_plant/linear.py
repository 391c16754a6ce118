"""Small dense solver for the Newton step: no allocation, no library call."""

import math

from fmu_src.kernel import kernel


@kernel
def cholesky_factor(matrix, scale, n, shift):
    """Factor matrix + shift diag(scale) in place; False if it is not positive definite.

    ``matrix`` (n, n): the upper triangle and diagonal are read, the lower triangle and
    diagonal receive the factor.  ``scale`` holds a typical diagonal.
    """
    for j in range(n):
        pivot = matrix[j, j] + shift * scale[j]
        for k in range(j):
            pivot -= matrix[j, k] * matrix[j, k]
        if not pivot > 1e-12 * scale[j]:
            return False
        pivot = math.sqrt(pivot)
        inverse = 1.0 / pivot
        for i in range(j + 1, n):
            s = matrix[j, i]
            for k in range(j):
                s -= matrix[i, k] * matrix[j, k]
            matrix[i, j] = s * inverse
        matrix[j, j] = pivot
    return True


@kernel
def cholesky_apply(factor, x, n):
    """Solve with a factor of ``cholesky_factor``; x is the right-hand side and becomes the solution."""
    for j in range(n):
        s = x[j]
        for k in range(j):
            s -= factor[j, k] * x[k]
        x[j] = s / factor[j, j]
    for j in range(n - 1, -1, -1):
        s = x[j]
        for i in range(j + 1, n):
            s -= factor[i, j] * x[i]
        x[j] = s / factor[j, j]


@kernel
def cholesky_solve(matrix, rhs, scale, n, shift):
    """Solve (matrix + shift diag(scale)) x = rhs in place; False if not positive definite."""
    if not cholesky_factor(matrix, scale, n, shift):
        return False
    cholesky_apply(matrix, rhs, n)
    return True
