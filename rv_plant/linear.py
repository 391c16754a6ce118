"""Small dense solver for the Newton step: no allocation, no library call."""

import math

from fmu_src.kernel import kernel


@kernel
def cholesky_solve(matrix, rhs, scale, n, shift):
    """Solve (matrix + shift diag(scale)) x = rhs in place; False if not positive definite.

    ``matrix`` (n, n): the upper triangle and diagonal are read, the lower triangle and
    diagonal receive the factor; ``rhs`` becomes x.  ``scale`` holds a typical diagonal.
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
        s = rhs[j]
        for k in range(j):
            s -= matrix[j, k] * rhs[k]
        rhs[j] = s * inverse
        matrix[j, j] = pivot
    for j in range(n - 1, -1, -1):
        s = rhs[j]
        for i in range(j + 1, n):
            s -= matrix[i, j] * rhs[i]
        rhs[j] = s / matrix[j, j]
    return True
