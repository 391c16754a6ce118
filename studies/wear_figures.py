"""How deep the surfaces of a wear unit are worn, and where."""

import numpy as np

from studies.pair import Pair

# Surfaces of the wear unit that a result keeps, by the names of its table.
SURFACES = ("disc_wear", "pin_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear")
# What the error estimate looks at: deepest wear of each kind of surface.
WATCHED = ("disc_flank_um", "pin_um", "inner_raceway_um", "outer_raceway_um")
# Harmonics of a profile that place its peak.
SMOOTH_HARMONICS = 12
# Points per bin when the peak between bins is looked for.
FINE = 16


def wear_figures(record: np.ndarray) -> dict[str, float]:
    """Deepest wear and its place, from a wear unit's record.

    Places in degrees: on an inner raceway from the eccentric's direction, on an
    outer one from the outward radial of its hole, both counted the way the cranks turn;
    on a tooth the local phase, 0 root and 180 tip.
    """
    sense = -1.0 if record["crank_speed"][0] < 0.0 else 1.0
    inner, inner_angle = peak_of_circle(record["inner_race_wear"][0])
    outer, outer_angle = peak_of_circle(record["outer_race_wear"][0])
    teeth = record["disc_wear"][0].reshape(-1, record["slide"].shape[-1])
    flank, phase = peak_of_circle(teeth)
    return {
        "inner_raceway_um": inner * 1e6,
        "outer_raceway_um": outer * 1e6,
        "disc_flank_um": flank * 1e6,
        "pin_um": float(record["pin_depth"].max()) * 1e6,
        "inner_peak_deg": signed_degrees(sense * inner_angle),
        "outer_peak_deg": signed_degrees(sense * outer_angle),
        "disc_peak_deg": abs(signed_degrees(phase)),
    }


def peak_of_circle(profiles: np.ndarray) -> tuple[float, float]:
    """(depth, angle [rad]) of the deepest place among closed profiles (..., bins).

    Both are those of the profile's first harmonics.  A jump samples the roller cage at
    the few hundred phases of its cycles and leaves a ripple of a few tenths of a
    percent that real hours average out; it would also shift the top of a broad hump by
    degrees.  A tooth's profile, zero at both roots, counts as closed.
    """
    rows = profiles.reshape(-1, profiles.shape[-1])
    row = rows[rows.max(axis=1).argmax()]
    if row.max() == 0.0:
        return 0.0, 0.0
    harmonics = np.fft.rfft(row)
    harmonics[SMOOTH_HARMONICS + 1 :] = 0.0
    fine = np.fft.irfft(harmonics, FINE * row.size) * FINE
    # Bin i covers [i, i + 1): its value stands in its middle.
    return float(fine.max()), 2.0 * np.pi * (fine.argmax() / FINE + 0.5) / row.size


def signed_degrees(angle: float) -> float:
    """Angle in degrees within (-180, 180]."""
    degrees = float(np.degrees(angle)) % 360.0
    return degrees - 360.0 if degrees > 180.0 else degrees


def depths(pair: Pair) -> np.ndarray:
    """The watched depths, one number per kind of surface [um]."""
    figures = wear_figures(pair.wear.record())
    return np.array([figures[name] for name in WATCHED])
