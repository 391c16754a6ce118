"""Pins in seats that yield like springs, more on some sides of the ring than on others.

    c(eta) = c_0 + sum_m (c_m cos m eta + s_m sin m eta),  m = 2 and 4; each seat takes the force F of one pin
    turning of the output  phi = sum F^2 c/M  (Castigliano), M the torque on the ring; with F = M_d n/(e z_p S)
    phi = M/(D (e z_p)^2 S) (c_0 + sum_m (c_m cos m eta_0 + s_m sin m eta_0)),  eta_0 = theta_crank -+ psi_0
    n = sin psi/sqrt(1 + K1^2 - 2 K1 cos psi) for the loaded half, S = sum n^2, M_d = M/D for each of D discs

Pins carry on one side of the eccentricity, around the direction psi_0, where the lever n is longest: at acos K1 if only few carry
(modified profiles), further off if many do.  c_m is what the loaded arc averages.  The side goes round with the cranks: of m
waves the order m z_c remains if m is a multiple of D, in proportion to the torque.  With the torque's sign the side changes,
so that a pattern shows forwards and backwards with phases 2 m psi_0 apart.  ``ring_stiffness`` lets contacts share the force
otherwise, by far less for the same pattern where contacts are stiff; here seats add their own yielding.

Source: Castigliano's theorem; forces of equal linear springs (Malhotra and Parameswaran 1983); 1e-9 to 1e-8 m/N assumed.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from rv_plant.gear_stage import fall_back, total_ratio
from rv_plant.geometry import shortening

STEPS = 40


def _part(name: str, text: str, group: str):
    return amplitude(name, "m/N", f"compliance of a pin's seat, {text}", 1e-9, -1e-6, 1e-6, source="assumed: rigid, as in both sources", group=group)


EFFECT = Effect(
    0, "pin seats that yield",
    "phi = M/(D (e z_p)^2 S) (c_0 + sum_m (c_m cos m eta_0 + s_m sin m eta_0)), eta_0 = theta_crank -+ psi_0",
    "Castigliano; forces of linear springs, Malhotra and Parameswaran 1983; 1e-9 to 1e-8 m/N assumed",
    "mean: linear in torque, a compliance among others; two waves: order 78 (2 z_c) in proportion to the torque, not less than that at small loads;"
    " four waves: order 156; forwards and backwards with phases that psi_0 sets apart",
    (
        amplitude("pin_seat_compliance", "m/N", "compliance of a pin's seat, mean", 1e-9, 0.0, 1e-6, sign=1,
                  source="assumed: rigid, as in both sources", group="mean"),
        _part("pin_seat_cos_2", "cosine of two waves round the ring", "two waves"),
        _part("pin_seat_sin_2", "sine of two waves", "two waves"),
        _part("pin_seat_cos_4", "cosine of four waves", "four waves"),
        _part("pin_seat_sin_4", "sine of four waves", "four waves"),
        shape("pin_seat_direction", "rad", "psi_0: middle of the loaded arc from the eccentricity", 0.7, 0.0, 1.571,
              "assumed: acos K1, K1 0.65 to 0.9", grid=(0.7,), group="two waves four waves"),
    ),
    signals=("transmission_error", "vibration", "hysteresis", "torsional_stiffness", "input_torque"),
)  # fmt: skip


@kernel
def levers_squared(k1):
    """Mean of n^2 over the loaded half."""
    total = 0.0
    for k in range(STEPS):
        psi = math.pi * (k + 0.5) / STEPS
        total += math.sin(psi) ** 2 / (1.0 + k1 * k1 - 2.0 * k1 * math.cos(psi))
    return total / STEPS


@kernel
def before(r):
    if (r.pin_seat_compliance == 0.0 and r.pin_seat_cos_2 == 0.0 and r.pin_seat_sin_2 == 0.0
            and r.pin_seat_cos_4 == 0.0 and r.pin_seat_sin_4 == 0.0):
        return
    discs, lobes = r.lobe_gap_added.shape
    pins = r.pin_x.shape[0]
    torque = r.load_torque * (1.0 - 1.0 / total_ratio(r.first_stage_ratio, pins, lobes))
    # The cranks turn against the output: a load that opposes its positive turning presses on the pins behind the eccentricity.
    behind = 1.0 if torque >= 0.0 else -1.0
    eta = -lobes * r.ideal_output - behind * r.pin_seat_direction
    compliance, rate = r.pin_seat_compliance, 0.0
    for m in range(2, 5, 2):
        if m % discs == 0:
            c, s = (r.pin_seat_cos_2, r.pin_seat_sin_2) if m == 2 else (r.pin_seat_cos_4, r.pin_seat_sin_4)
            compliance += c * math.cos(m * eta) + s * math.sin(m * eta)
            rate -= m * lobes * (s * math.cos(m * eta) - c * math.sin(m * eta))
    squares = 0.5 * pins * levers_squared(shortening(r.eccentricity, lobes, r.pin_circle_radius))
    per_compliance = torque / (discs * (r.eccentricity * pins) ** 2 * squares)
    fall_back(r, compliance * per_compliance, rate * per_compliance)
