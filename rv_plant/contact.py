"""Contact laws: from penetration to force, stiffness and Hertz pressure.

All laws are F = K d^n for d > 0:

line contact          n = 10/9, K from the reducer file (both sources)
Lankarani-Nikravesh   n free (1.5 in the BX-40E document; that exponent belongs to
                      spheres, a line contact has 1.0 to 1.11), K free; its hysteresis
                      factor is 1 at rest (Lankarani and Nikravesh 1990)
Palmgren              n = 10/9, K = 8.06e4 L^(8/9) N/mm^(10/9), L in mm (Palmgren 1959,
                      steel on steel)

Damping, in the dynamic plant (rate is the speed of penetration):

step                  F + C s(d/d0) rate; the step s rises from 0 to 1 over the depth d0, so
                      that force begins at zero (needle-bearing document: C c_c v)
Lankarani-Nikravesh   F [1 + 3 (1 - ce^2)/4 rate/rate0], rate0 the speed at first touch
modal                 F + tau dF/dd rate: in a mode of frequency omega the ratio omega tau/2

None of them pulls: a total below zero is zero.

A stiffness is given by the force at 1 mm, so its unit is N whatever the exponent.
The needle-bearing document prints "3.2e8 N/m": read "literally" that is the force at
1 m, 2.15 times softer at n = 10/9 than the same digits per millimetre ("SI").
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable
from rv_plant.dimension import FILE

LINE, LANKARANI, PALMGREN = 0, 1, 2
LAWS = ("line", "lankarani-nikravesh", "palmgren")
NO_DAMPING, STEP, HYSTERETIC, MODAL = 0, 1, 2, 3
DAMPINGS = ("none", "step", "lankarani-nikravesh", "modal")
# Below this a touch is no impact; it keeps the hysteretic factor finite [m/s].
SLOWEST_IMPACT = 1e-3
SI, LITERAL = 0, 1
# Relative change of a penetration up to which a series stands for the power.
BESIDE = 0.02
READINGS = ("SI", "literal")


def variables(sizes: Sizes) -> list[Variable]:
    """What all contacts share; each has its own stiffness and damping."""
    return [
        Variable("elastic_modulus", "parameter", "Pa", "Young's modulus of all parts", 207e9, minimum=1e6,
                 nominal=1e11, source=FILE, path="material.elastic_modulus"),
        Variable("poisson_ratio", "parameter", "1", "Poisson's ratio of all parts", 0.3, minimum=0.0, maximum=0.5,
                 source=FILE, path="material.poisson_ratio"),
        Variable("contact.law", "parameter", "1", "law of force against penetration", 0, choices=LAWS,
                 source="both sources"),
        Variable("stiffness_reading", "parameter", "1",
                 "force at 1 mm, or the same digits in N/m as force at 1 m per thousand", 0, choices=READINGS,
                 source="assumed: Palmgren's constant for the printed length gives the SI reading", path="contact.stiffness_reading"),
        Variable("exponent_lankarani", "parameter", "1", "exponent of the Lankarani-Nikravesh law", 1.5, minimum=1.0,
                 maximum=2.0, source="BX-40E document", path="contact.exponent_lankarani"),
        Variable("damping_law", "parameter", "1", "damping of the contacts in motion", STEP, choices=DAMPINGS,
                 source="needle-bearing document: C c_c v", path="contact.damping_law"),
        Variable("damping_depth", "parameter", "m", "penetration at which damping is full (law step)", 1e-6,
                 minimum=1e-9, maximum=1e-3, nominal=1e-6, source="assumed: a third of the usual penetration", path="contact.damping_depth"),
        Variable("restitution", "parameter", "1", "coefficient of restitution (law lankarani-nikravesh)", 0.8,
                 minimum=0.0, maximum=1.0, source="assumed: 0.7 to 0.9", path="contact.restitution"),
        Variable("modal_damping_time", "parameter", "s", "time tau of the law modal: damping ratio omega tau/2", 4e-6,
                 minimum=0.0, maximum=1.0, nominal=1e-6, source="assumed: ratio 0.045 at 3.5 kHz", path="contact.modal_damping_time"),
    ]


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
def power_beside(u, exponent):
    """(1 + u)^exponent by its series; for |u| <= BESIDE and exponents up to 1 right to 1e-13."""
    e = exponent
    c = 1.0 + (e - 5.0) * (1.0 / 6.0) * u
    c = 1.0 + (e - 4.0) * (1.0 / 5.0) * u * c
    c = 1.0 + (e - 3.0) * (1.0 / 4.0) * u * c
    c = 1.0 + (e - 2.0) * (1.0 / 3.0) * u * c
    c = 1.0 + (e - 1.0) * (1.0 / 2.0) * u * c
    return 1.0 + e * u * c


@kernel
def force_beside(penetration, known, known_force, stiffness, exponent):
    """``contact_force`` where it is ``known_force`` [N] at the penetration ``known`` [m]: near that without a power."""
    if known > 0.0 and abs(penetration - known) <= BESIDE * known:
        slope = known_force / known * power_beside((penetration - known) / known, exponent - 1.0)
        return slope * penetration, exponent * slope
    return contact_force(penetration, stiffness, exponent)


@kernel
def impact_speed(at_first_touch, rate):
    """rate0 of a contact [m/s]: kept from its first touch, of which the first step knows only the rate."""
    return max(at_first_touch if at_first_touch > 0.0 else rate, SLOWEST_IMPACT)


@kernel
def damped_force(penetration, rate, stiffness, exponent, law, coefficient, depth, impact_speed):
    """(force [N], dF/d penetration [N/m], dF/d rate [N s/m], elastic force [N]).

    ``coefficient`` is C [N s/m] for "step", the restitution ce for "lankarani-nikravesh",
    the time tau [s] for "modal"; ``impact_speed`` [m/s] is rate0.
    """
    elastic, tangent = contact_force(penetration, stiffness, exponent)
    if elastic == 0.0 or law == NO_DAMPING:
        return elastic, tangent, 0.0, elastic
    by_depth = by_rate = 0.0
    if law == STEP:
        share = min(1.0, penetration / depth)
        by_rate = coefficient * share * share * (3.0 - 2.0 * share)
        by_depth = coefficient * 6.0 * share * (1.0 - share) / depth * rate
    elif law == HYSTERETIC:
        factor = 0.75 * (1.0 - coefficient * coefficient) / impact_speed
        by_rate = factor * elastic
        by_depth = factor * tangent * rate
    else:
        by_rate = coefficient * tangent
        by_depth = by_rate * (exponent - 1.0) / penetration * rate
    force = elastic + by_rate * rate
    if force <= 0.0:
        return 0.0, 0.0, 0.0, elastic
    return force, tangent + by_depth, by_rate, elastic


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
