"""Wear coefficients.

Everywhere here k is the dimensional coefficient in 1/Pa, depth = k p s; K (kappa) is
the dimensionless one, k = K/H with the hardness H.  q is the load per length [N/m].

constant             k = K/H
run-in and load      k = K/H [1 + (r - 1) exp(-s/s0)] (q/q0)^m (form fitted to pin-on-disc
                     tests, BX-40E document; s is distance run, not time)
Janakiraman          k = 3.981e29/E' (q/(E' R))^1.219 (alpha E')^-7.377 (Rq/R)^1.589
                     (Janakiraman, Li and Kahraman, J. Tribol. 136 (2014) 031602);
                     E' = E/(1-nu^2)
Janakiraman printed  k = 3.981e-29 C G S^-1.589 E'/H as the needle-bearing document prints
                     it: not a 1/Pa quantity by its units, three orders too small,
                     and falling with roughness; kept to show what it gives
"""

import math

from fmu_src.kernel import kernel

CONSTANT, RUN_IN_LOAD, JANAKIRAMAN, JANAKIRAMAN_PRINTED = 0, 1, 2, 3
LAWS = ("constant", "run-in and load", "janakiraman", "janakiraman printed")


@kernel
def run_in_factor(ratio, travel, run_in_travel):
    """1 + (r - 1) exp(-s/s0): how much faster new surfaces wear."""
    return 1.0 + (ratio - 1.0) * math.exp(-travel / run_in_travel)


@kernel
def load_factor(line_load, reference_line_load, exponent):
    """(q/q0)^m."""
    if exponent == 0.0:
        return 1.0
    return (line_load / reference_line_load) ** exponent


@kernel
def janakiraman(line_load, radius, roughness, pressure_viscosity, modulus):
    """k [1/Pa] for a line contact: load per length [N/m], radius and roughness [m],
    pressure-viscosity coefficient [1/Pa], modulus E' = E/(1-nu^2) [Pa]."""
    load = line_load / (modulus * radius)
    material = pressure_viscosity * modulus
    surface = roughness / radius
    return 3.981e29 / modulus * load**1.219 * material**-7.377 * surface**1.589


@kernel
def janakiraman_printed(line_load, radius, roughness, pressure_viscosity, modulus, hardness):
    """The printed form, taken at its word; same arguments, hardness [Pa]."""
    load = line_load / (modulus * radius)
    material = pressure_viscosity * modulus
    surface = roughness / radius
    return 3.981e-29 * load * material * surface**-1.589 * modulus / hardness


@kernel
def wear_coefficient(law, coefficient, hardness, run_in, load_exponent, reference_line_load,
                     roughness, pressure_viscosity, modulus, line_load, radius):
    """k [1/Pa] by the named law; ``run_in`` is the factor of ``run_in_factor``."""
    if law == JANAKIRAMAN:
        return janakiraman(line_load, radius, roughness, pressure_viscosity, modulus)
    if law == JANAKIRAMAN_PRINTED:
        return janakiraman_printed(line_load, radius, roughness, pressure_viscosity, modulus, hardness)
    k = coefficient / hardness
    if law == RUN_IN_LOAD:
        k *= run_in * load_factor(line_load, reference_line_load, load_exponent)
    return k
