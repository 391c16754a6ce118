"""Contact laws: from penetration to force, stiffness and Hertz pressure.

All laws are F = K d^n for d > 0:

line contact          n = 10/9, K from the reducer file (both sources)
Lankarani-Nikravesh   n free (1.5 in the BX-40E document; that exponent belongs to
                      spheres, a line contact has 1.0 to 1.11), K free; its hysteresis
                      factor is 1 at rest (Lankarani and Nikravesh 1990)
Palmgren              n = 10/9, K = 8.06e4 L^(8/9) N/mm^(10/9), L in mm (Palmgren 1959,
                      steel on steel)

A stiffness is given by the force at 1 mm, so its unit is N whatever the exponent.
The needle-bearing document prints "3.2e8 N/m": read "literally" that is the force at
1 m, 2.15 times softer at n = 10/9 than the same digits per millimetre ("SI").
"""

import math

from fmu_src.kernel import kernel

LINE, LANKARANI, PALMGREN = 0, 1, 2
LAWS = ("line", "lankarani-nikravesh", "palmgren")
SI, LITERAL = 0, 1
READINGS = ("SI", "literal")


@kernel
def law_constants(law, reading, force_at_1mm, hertz_force_at_1mm, hertz_exponent, length):
    """(K [N/m^n], n) of a law; forces in N at 1 mm of penetration, length in m."""
    if law == LANKARANI:
        return hertz_force_at_1mm * 1000.0**hertz_exponent, hertz_exponent
    exponent = 10.0 / 9.0
    if law == PALMGREN:
        return 8.06e4 * (length * 1000.0) ** (8.0 / 9.0) * 1000.0**exponent, exponent
    if reading == LITERAL:
        return force_at_1mm * 1000.0, exponent
    return force_at_1mm * 1000.0**exponent, exponent


@kernel
def contact_force(penetration, stiffness, exponent):
    """(force [N], tangent stiffness [N/m]) of a contact that never pulls."""
    if penetration <= 0.0:
        return 0.0, 0.0
    slope = stiffness * penetration ** (exponent - 1.0)
    return slope * penetration, exponent * slope


@kernel
def hertz_half_width(line_load, curvature, modulus):
    """Half width of a line contact [m]: a = sqrt(4 q/(pi kappa E*)).

    line_load q [N/m], curvature kappa = 1/rho_eq [1/m], modulus E* [Pa] with
    1/E* = sum (1-nu^2)/E.  (Johnson, Contact Mechanics, 1985, eq. 4.43)
    """
    return math.sqrt(4.0 * line_load / (math.pi * curvature * modulus))


@kernel
def hertz_peak_pressure(line_load, curvature, modulus):
    """Largest pressure p0 = 2 q/(pi a) [Pa]; the mean over the width is pi/4 of it."""
    if line_load <= 0.0:
        return 0.0
    return 2.0 * line_load / (math.pi * hertz_half_width(line_load, curvature, modulus))
