"""Lubrication regime: a film carries part of the load and spares the surfaces.

    lambda = h_min/Rq,  h_min = 2.65 R U^0.7 G^0.54 W^-0.13 (Dowson and Higginson 1966)
    U = eta_0 u/(E' R),  G = alpha E',  W = q/(E' R),  eta_0(T) = eta_40 exp(-beta (T - 313 K))
    k = k_0 [1 - a + a/(1 + (lambda/lambda_0)^2)]

Source: Dowson and Higginson 1966; mixed-regime share after the usual logistic fits; lambda 0.1 to 2.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

EFFECT = Effect(
    3, "lubrication regime",
    "k = k_0 [1 - a + a/(1 + (lambda/lambda_0)^2)], lambda = h_min/Rq after Dowson and Higginson",
    "Dowson and Higginson 1966; lambda 0.1 to 2",
    "wear per revolution falls with speed and rises with temperature; not once only, as running-in does",
    (
        amplitude("film_share", "1", "a: share of wear that a thick film spares", 0.3, 0.0, 1.0, sign=1),
        shape("film_lambda", "1", "lambda_0: film over roughness at which half of that wear is spared", 0.5, 0.01, 10.0, "assumed",
              grid=(0.1, 0.5, 2.0)),
        shape("oil_viscosity", "Pa.s", "viscosity of the grease's oil at 40 C", 0.1, 1e-4, 100.0, "assumed: VG 100", held=True),
        shape("oil_viscosity_slope", "1/K", "beta: relative fall of the oil's viscosity with temperature", 0.035, 0.0, 0.2,
              "assumed: halves in 20 K", held=True),
    ),
    signals=WEAR,
)


@kernel
def prepare(r):
    if r.film_share != 0.0:
        r.effects_on += 1


@kernel
def film_thickness(line_load, radius, speed, viscosity, pressure_viscosity, modulus):
    """Smallest film of a line contact [m]; speed is the mean rolling speed [m/s], modulus E' [Pa]."""
    u = viscosity * speed / (modulus * radius)
    return 2.65 * radius * u**0.7 * (pressure_viscosity * modulus) ** 0.54 * (line_load / (modulus * radius)) ** -0.13


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.film_share == 0.0:
        return 1.0
    viscosity = r.oil_viscosity * math.exp(-r.oil_viscosity_slope * (r.temperature - 313.15))
    modulus = r.elastic_modulus / (1.0 - r.poisson_ratio * r.poisson_ratio)
    # Rolling entrains: half the surface speed of the flank that slides, the race's speed of a roller.
    rolling = 0.5 * speed if surface == 0 else abs(r.crank_speed) * r.inner_race_radius * 0.5
    thick = film_thickness(line_load, radius, rolling, viscosity, r.pressure_viscosity, modulus) / r.roughness
    ratio = thick / r.film_lambda
    return 1.0 - r.film_share + r.film_share / (1.0 + ratio * ratio)
