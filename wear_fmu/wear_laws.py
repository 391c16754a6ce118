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
from fmu_src.variables import Sizes, Variable
from wear_fmu.dimension import parameter

CONSTANT, RUN_IN_LOAD, JANAKIRAMAN, JANAKIRAMAN_PRINTED = 0, 1, 2, 3
LAWS = ("constant", "run-in and load", "janakiraman", "janakiraman printed")


def variables(sizes: Sizes) -> list[Variable]:
    return [
        parameter("elastic_modulus", "Pa", "Young's modulus of all parts", 207e9, 1e6, nominal=1e11, path="material.elastic_modulus"),
        parameter("poisson_ratio", "1", "Poisson's ratio of all parts", 0.3, 0.0, 0.5, path="material.poisson_ratio"),
        parameter("hardness", "Pa", "hardness of the worn surfaces", 7e9, 1e6, nominal=1e9, path="material.hardness"),
        parameter("mesh_wear_law", "1", "wear law of flanks and pins", 1, choices=LAWS, source="BX-40E document", path="wear.mesh_law"),
        parameter("raceway_wear_law", "1", "wear law of the raceways", 2, choices=LAWS,
                  source="needle-bearing document, law restored after Janakiraman et al. 2014", path="wear.race_law"),
        parameter("mesh_wear_coefficient", "1", "dimensionless wear coefficient of flanks and pins, run in",
                  5e-9, 0.0, 1.0, nominal=1e-8, path="wear.mesh_coefficient"),
        parameter("raceway_wear_coefficient", "1", "dimensionless wear coefficient of the raceways, run in (laws other than Janakiraman)",
                  3e-9, 0.0, 1.0, nominal=1e-8, path="wear.race_coefficient"),
        parameter("run_in_ratio", "1", "wear coefficient when new over run in", 5.0, 0.0, 1e3, path="wear.run_in_ratio"),
        parameter("run_in_time", "s", "decay time of running-in at wear.run_in_crank_speed (running-in goes by distance slid)",
                  300 * 3600.0, 1.0, nominal=1e6, path="wear.run_in_time"),
        parameter("run_in_crank_speed", "rad/s", "speed of the cranks that wear.run_in_time holds for", 67.5, 1e-6, path="wear.run_in_crank_speed"),
        parameter("load_exponent", "1", "exponent of the load dependence", 0.3, -1.0, 5.0, path="wear.load_exponent"),
        parameter("reference_line_load", "N/m", "load per width at which the coefficient holds", 5e4, 1e-3,
                  nominal=1e4, path="wear.reference_line_load"),
        parameter("roughness", "m", "composite roughness Rq of roller and raceway, and of disc and pin", 0.4e-6,
                  1e-9, 1e-4, nominal=1e-6, path="wear.roughness"),
        parameter("pressure_viscosity", "1/Pa", "pressure-viscosity coefficient of the grease at its reference"
                  " temperature", 1.8e-8, 1e-10, 1e-6, nominal=1e-8, path="grease.pressure_viscosity"),
        parameter("pressure_viscosity_slope", "1/K", "relative fall of the pressure-viscosity coefficient with temperature", 0.005, 0.0, 0.1,
                  source="assumed: about 0.5 % per kelvin", path="grease.pressure_viscosity_slope"),
        parameter("reference_temperature", "K", "temperature that grease.pressure_viscosity holds for", 293.15, 200.0,
                  500.0, source="assumed: room temperature", path="grease.reference_temperature"),
    ]


@kernel
def run_in_factor(ratio, travel, run_in_travel):
    """1 + (r - 1) exp(-s/s0): how much faster new surfaces wear."""
    return 1.0 + (ratio - 1.0) * math.exp(-travel / run_in_travel)


@kernel
def mean_run_in_factor(ratio, travel, turned, run_in_travel):
    """Mean of it over the next ``turned`` [rad], exact: parts of a way add up."""
    decay = turned / run_in_travel
    share = -math.expm1(-decay) / decay if decay > 1e-12 else 1.0
    return 1.0 + (ratio - 1.0) * math.exp(-travel / run_in_travel) * share


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


@kernel
def exponents(law, load_exponent):
    """Powers with which ``wear_coefficient`` goes with the line load and with the radius."""
    if law == JANAKIRAMAN:
        return 1.219, -2.808
    if law == JANAKIRAMAN_PRINTED:
        return 1.0, 0.589
    return load_exponent if law == RUN_IN_LOAD else 0.0, 0.0
