"""Radial clearance of the needle bearings other than the reducer file's.

A dead zone: approach of roller = u.e_r - (c_r + dc).

Source: needle bearings of RV reducers, 0 to 12 um radial (both sources' parameter).
"""

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel

UM = 1e-6
EFFECT = Effect(
    10, "needle clearance",
    "approach = u.e_r - (c_r + dc)",
    "needle-bearing document; 0 to 12 um radial",
    "order 80 of the output (0.55, 6.8, 12.7, 24 arcsec peak to peak at 0, 2.5, 5, 10 um), mean lag + 20 arcsec/um;"
    " nearly independent of load from a tenth of a N m on; with exactly none the output floats and shows nothing",
    (amplitude("needle_clearance_added", "m", "radial clearance beyond the file's", 1 * UM, -15 * UM, 30 * UM),),
    signals=("transmission_error", "lost_motion", "hysteresis", "vibration", "wear_profile", "wear_depth", "no_load_torque"),
)


@kernel
def prepare(r):
    discs, cranks, rollers = r.roller_gap_added.shape
    for d in range(discs):
        for c in range(cranks):
            for k in range(rollers):
                r.roller_gap_added[d, c, k] += r.needle_clearance_added
