"""Teeth of the discs out of place: run-out of the profile, ovality, random pitch.

    material missing on lobe l of disc d   A1 cos(lambda - d1) + A2 cos 2(lambda - d2)
    pitch error                            s w_ld

with lambda the angle of the lobe's tip in the disc, 2 pi (l + 1/2 - d/discs)/z_c + p pi d: p = 0 for discs ground as a pair (the same error on both
after marking), 1 for an opposed pair.

Source: geometry; 3 to 5 um is usual for ground discs.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from rv_plant.effects.pin_position_errors import scatter

UM = 1e-6
EFFECT = Effect(
    8, "disc tooth and pitch errors",
    "e_l = A1 cos(lambda - d1) + A2 cos 2(lambda - d2), pitch s w_l; lambda = 2 pi (l + 1/2 - d/discs)/z_c + p pi d",
    "geometry; sizes: ground discs, 3 to 5 um",
    "fixed to the carrier: order 40 for unpaired discs, 80 only for a pair ground together; does not move when"
    " the ring is clamped anew",
    (
        amplitude("disc_runout", "m", "profile of the discs off centre", 3 * UM, -50 * UM, 50 * UM, sign=1, group="runout"),
        shape("disc_runout_angle", "rad", "direction in which the discs' profile is off centre", 0.0, -20.0, 20.0, "assumed",
              grid=(0.0, 1.5708, 3.1416, 4.7124), group="runout"),
        amplitude("disc_ovality", "m", "profile of the discs oval", 3 * UM, -50 * UM, 50 * UM, sign=1, group="ovality"),
        shape("disc_ovality_angle", "rad", "direction of the long axis of the oval discs", 0.0, -20.0, 20.0, "assumed",
              grid=(0.0, 0.7854, 1.5708, 2.3562), group="ovality"),
        amplitude("lobe_pitch_scatter", "m", "scatter of the pitch, standard deviation", 2 * UM, -20 * UM, 20 * UM, group="scatter"),
        shape("disc_pairing", "1", "0: both discs carry the same error, 1: opposed ones", 1.0, 0.0, 1.0, "assumed: unpaired", held=True),
    ),
    signals=("transmission_error", "vibration", "wear_profile", "wear_depth", "input_torque", "lost_motion",
             "hysteresis", "torsional_stiffness", "no_load_torque", "efficiency"),
)


@kernel
def prepare(r):
    discs, lobes = r.lobe_gap_added.shape
    for d in range(discs):
        for lobe in range(lobes):
            # The profiles are cut turned against each other, errors of a pair are not.
            place = 2.0 * math.pi * (lobe + 0.5 - d / discs) / lobes + math.pi * r.disc_pairing * d
            r.lobe_gap_added[d, lobe] += r.disc_runout * math.cos(place - r.disc_runout_angle) + r.disc_ovality * math.cos(
                2.0 * (place - r.disc_ovality_angle)
            )
            r.lobe_pitch_added[d, lobe] += r.lobe_pitch_scatter * scatter(d * lobes + lobe)
