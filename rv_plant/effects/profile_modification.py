"""Profile modification beyond what the reducer file says: equidistant and shift.

To first order the gap at the phase phi is

    gap(phi) = dr_rp - dr_p (1 - K1 cos phi)/sqrt(1 + K1^2 - 2 K1 cos phi)

computed here exactly: the profile is generated with the radius r + dr_rp on the circle R + dr_p.

Source: usual gear practice, 5 to 30 um.
"""

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel

UM = 1e-6
EFFECT = Effect(
    9, "profile modification",
    "gap(phi) = dr_rp - dr_p (1 - K1 cos phi)/sqrt(S)",
    "generation of cycloid discs; 5 to 30 um",
    "constant in time; lost motion larger, stiffness low at low torque and rising with load, fewer loaded teeth,"
    " order 1560; the same for both signs of torque",
    (
        amplitude("equidistant_added", "m", "equidistant modification beyond the file's", 5 * UM, -60 * UM, 60 * UM),
        amplitude("shift_added", "m", "shift modification beyond the file's (negative: gap)", 5 * UM, -60 * UM, 60 * UM),
    ),
    signals=("transmission_error", "lost_motion", "hysteresis", "torsional_stiffness", "wear_profile", "wear_depth", "efficiency"),
)


@kernel
def prepare(r):
    r.profile_radius_added += r.equidistant_added
    r.profile_circle_added += r.shift_added
