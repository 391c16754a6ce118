"""A carrier on n cranks is not equally stiff at every angle.

    turning back  phi = T (a_c cos n theta + a_s sin n theta + b_c cos n D beta + b_s sin n D beta)

theta is the carrier's angle in the housing, beta = z_p theta that of the cranks against the carrier, n the number of cranks, D that of
the discs.  Posts and bearings of a carrier repeat themselves n times round: what stands still in the housing (a bearing
seat that is not round, the weight on the flange) meets them n times per turn of the output; the forces of a disc go
round on the carrier once per turn of the cranks and meet them n times, those of D discs, evenly spread, n D times together.
Compliance times torque: nothing without load, the sign that of the torque.

Source: symmetry of springs in series; up to 3 % of a drive's compliance assumed.
"""

import math

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from rv_plant.gear_stage import fall_back


def _part(name: str, text: str, group: str):
    return amplitude(name, "rad/(N.m)", f"compliance over {text}", 1e-8, -1e-3, 1e-3, source="assumed: equally stiff, as in both sources", group=group)


EFFECT = Effect(
    0, "stiffness of the carrier over its angle",
    "phi = T (a_c cos n theta + a_s sin n theta + b_c cos n D beta + b_s sin n D beta), beta = z_p theta",
    "symmetry of springs in series; up to 3 % of a drive's compliance assumed",
    "orders n (turn) and n D z_p (cranks) of the output in proportion to the torque, of the torque's sign, nothing without load",
    (
        _part("carrier_turn_cos", "the carrier's turn, cosine", "carrier"),
        _part("carrier_turn_sin", "the carrier's turn, sine", "carrier"),
        _part("carrier_crank_cos", "the cranks' turn against the carrier, cosine", "cranks"),
        _part("carrier_crank_sin", "the cranks' turn against the carrier, sine", "cranks"),
    ),
    signals=("transmission_error", "vibration", "hysteresis", "input_torque"),
)  # fmt: skip


@kernel
def before(r):
    slow = r.carrier_turn_cos != 0.0 or r.carrier_turn_sin != 0.0
    fast = r.carrier_crank_cos != 0.0 or r.carrier_crank_sin != 0.0
    if not (slow or fast):
        return
    discs, cranks = r.throw_added.shape
    lag = rate = 0.0
    if slow:
        c, s = math.cos(cranks * r.ideal_output), math.sin(cranks * r.ideal_output)
        lag += r.carrier_turn_cos * c + r.carrier_turn_sin * s
        rate += cranks * (r.carrier_turn_sin * c - r.carrier_turn_cos * s)
    if fast:
        order = cranks * discs * r.pin_x.shape[0]
        c, s = math.cos(order * r.ideal_output), math.sin(order * r.ideal_output)
        lag += r.carrier_crank_cos * c + r.carrier_crank_sin * s
        rate += order * (r.carrier_crank_sin * c - r.carrier_crank_cos * s)
    fall_back(r, r.load_torque * lag, r.load_torque * rate)
