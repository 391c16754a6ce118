"""Formulas as the two documents print them, where the kernels do not have that form.

They are kept to show what they give.  All lengths in m, angles in rad, NumPy arrays allowed.
"""

import numpy as np

from fmu_src.arrays import Floats, Points


def root_s(phase: Floats, k1: float) -> Floats:
    """sqrt(S), S = 1 + K1^2 - 2 K1 cos(phi)."""
    return np.asarray(np.sqrt(1.0 + k1 * k1 - 2.0 * k1 * np.cos(phase)))


def sine_of_pressure_angle(phase: Floats, k1: float) -> Floats:
    """sin(alpha) = sin(phi)/sqrt(S): the normal's lever about the disc's centre is a z_c sin(alpha)."""
    return np.sin(phase) / root_s(phase, k1)


def printed_profile(
    phase: Floats, circle: float, radius: float, eccentricity: float, pins: int, y_sign: float = -1.0, disc_change: float = 0.0,
    pin_change: float = 0.0,
) -> Points:  # fmt: skip
    """Worn profile, tooth-profile document (the first two equations), as complex numbers [m].

        x = (R_p + dR_p cos alpha) cos(phi - phi_H) - a cos phi_H
            + (r_rp + dR_rp) S^(-1/2) [K1 cos phi_H - cos(phi - phi_H)]
        y = (R_p + dR_p cos alpha) sin(phi - phi_H) + a sin phi_H
            - (r_rp + dR_rp) S^(-1/2) [K1 sin phi_H - sin(phi - phi_H)]

    with phi_H = (z_p/z_c) phi, the only reading that gives a closed curve.  ``y_sign`` is the
    sign in the last bracket: -1 as printed, +1 mended.
    """
    lobes = pins - 1
    k1 = eccentricity * pins / (circle + disc_change)
    turned = pins / lobes * phase
    sine = sine_of_pressure_angle(phase, k1)
    reach = circle + disc_change * np.sqrt(np.maximum(0.0, 1.0 - sine * sine))
    offset = (radius + pin_change) / root_s(phase, k1)
    x = reach * np.cos(phase - turned) - eccentricity * np.cos(turned)
    x = x + offset * (k1 * np.cos(turned) - np.cos(phase - turned))
    y = reach * np.sin(phase - turned) + eccentricity * np.sin(turned)
    y = y - offset * (k1 * np.sin(turned) + y_sign * np.sin(phase - turned))
    return x + 1j * y


def printed_radius_of_curvature(phase: Floats, circle: float, radius: float, pins: int, k1: float) -> Floats:
    """rho_i = R_p S^(3/2) / |K1 (z_p + 1) cos phi - (1 + z_p K1^2)| + r_rp, tooth-profile document [m]."""
    bend = k1 * (pins + 1) * np.cos(phase) - (1.0 + pins * k1 * k1)
    return circle * root_s(phase, k1) ** 3 / np.abs(bend) + radius


def printed_profile_error(disc_wear: float, pin_wear: float) -> float:
    """e_cp = dR_p - dR_rp, tooth-profile document [m]."""
    return disc_wear - pin_wear


def linear_forces(
    phase: Floats, moment: float, eccentricity: float, lobes: int, k1: float, exponent: float = 10.0 / 9.0
) -> Floats:
    """Forces [N] by delta_i = theta_c r_i - e with e = 0 and F = K delta^n, tooth-profile document.

    r_i = a z_c sin(alpha_i); theta_c follows from sum F_i r_i = moment [N m], K drops out.
    """
    lever = eccentricity * lobes * np.maximum(0.0, sine_of_pressure_angle(phase, k1))
    weight = lever**exponent
    return np.asarray(moment * weight / np.sum(weight * lever, axis=-1, keepdims=True))


def printed_sliding_speed_signed(phase: Floats, eccentricity: float, pins: int, k1: float) -> Floats:
    """v_s/omega = a [z_p/(z_p - 1) - sin alpha / sin(alpha + beta)], tooth-profile document [m/rad].

    The fraction is 1/sqrt(S): alpha and beta are angles of the triangle of ring centre, pitch
    point and pin.
    """
    return eccentricity * (pins / (pins - 1.0) - 1.0 / root_s(phase, k1))
