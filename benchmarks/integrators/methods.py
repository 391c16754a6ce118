"""Coefficients of the methods compared."""

import math
from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats

BDF2, DIRK, ROSENBROCK = range(3)
NOT_USED = np.zeros((1, 1))


@dataclass(frozen=True)
class Method:
    """``a`` are Butcher's coefficients, ``e`` the weights of the error estimate.

    Rosenbrock methods in the form without products with the Jacobian (Hairer and Wanner 1996, IV.7):
    (1/(h gamma) - J) k_i = f(y + sum a_ij k_j) + sum c_ij k_j/h, y1 = y + sum b_i k_i.
    """

    kind: int
    order: int
    gamma: float
    a: Floats
    c: Floats
    b: Floats
    e: Floats


def tr_bdf2() -> Method:
    """Trapezoidal rule, then BDF2 (Bank et al. 1985; estimate of Hosea and Shampine 1996): L-stable, order 2."""
    g, w = 1.0 - math.sqrt(0.5), math.sqrt(2.0) / 4.0
    a = np.array([[0.0, 0.0, 0.0], [g, g, 0.0], [w, w, g]])
    e = a[2] - np.array([(1.0 - w) / 3.0, (3.0 * w + 1.0) / 3.0, g / 3.0])
    return Method(DIRK, 2, g, a, NOT_USED, a[2], e)


def trapezoidal() -> Method:
    """A-stable, undamped; the estimate compares with Euler's rule on the acceleration (see ``dirk_step``)."""
    a = np.array([[0.0, 0.0], [0.5, 0.5]])
    return Method(DIRK, 2, 0.5, a, NOT_USED, a[1], np.zeros(2))


def kvaerno3() -> Method:
    """ESDIRK 3(2) of four stages, stiffly accurate, L-stable (Kvaerno 2004)."""
    g = 0.4358665215084590
    a32 = (1.0 - 2.0 * g) / (4.0 * g)
    b2, b3 = 1.0 / (12.0 * g * (1.0 - 2.0 * g)), (1.0 - 6.0 * g + 6.0 * g * g) / (3.0 * (1.0 - 2.0 * g))
    a = np.zeros((4, 4))
    a[1, :2] = g, g
    a[2, :3] = 1.0 - a32 - g, a32, g
    a[3] = 1.0 - b2 - b3 - g, b2, b3, g
    return Method(DIRK, 3, g, a, NOT_USED, a[3], a[3] - a[2])


def ros2() -> Method:
    """Two stages, L-stable, order 2 with any Jacobian (Verwer et al. 1999)."""
    g = 1.0 - math.sqrt(0.5)
    a, c = np.zeros((2, 2)), np.zeros((2, 2))
    a[1, 0], c[1, 0] = 1.0 / g, -2.0 / g
    return Method(ROSENBROCK, 2, g, a, c, np.array([1.5, 0.5]) / g, np.array([0.5, 0.5]) / g)


def rodas3() -> Method:
    """Four stages, stiffly accurate, L-stable, order 3(2) (Sandu et al. 1997)."""
    a, c = np.zeros((4, 4)), np.zeros((4, 4))
    a[2, 0], a[3, 0], a[3, 2] = 2.0, 2.0, 1.0
    c[1, 0], c[2, :2], c[3, :3] = 4.0, (1.0, -1.0), (1.0, -1.0, -8.0 / 3.0)
    return Method(ROSENBROCK, 3, 0.5, a, c, np.array([2.0, 0.0, 1.0, 1.0]), np.array([0.0, 0.0, 0.0, 1.0]))


BDF2_METHOD = Method(BDF2, 2, 0.0, NOT_USED, NOT_USED, np.zeros(1), np.zeros(1))
OURS = {
    "BDF2": BDF2_METHOD, "trapezoidal": trapezoidal(), "TR-BDF2": tr_bdf2(), "ESDIRK3 (Kvaerno)": kvaerno3(),
    "ROS2": ros2(), "RODAS3": rodas3(),
}  # fmt: skip
