"""Bounds and nominal values of variables whose table states none.

An importing tool scales its tolerances by nominal values and refuses values outside of
the bounds.  The bounds lie far beyond any machine: they catch slips of units and
overflow, not unusual designs.
"""

# unit -> (lowest, highest, nominal)
USUAL = {
    "m": (-10.0, 10.0, 1e-3),
    "rad": (-1e12, 1e12, 1.0),
    "rad/s": (-1e5, 1e5, 10.0),
    "N": (-1e12, 1e12, 100.0),
    "N.m": (-1e9, 1e9, 100.0),
    "K": (0.0, 1e4, 300.0),
    "Pa": (0.0, 1e15, 1e9),
    "W": (-1e12, 1e12, 100.0),
}
ANY = (-1e15, 1e15, 1.0)
# What an FMI 2.0 Integer holds.
INTEGER = (-(2**31 - 1), 2**31 - 1, 1.0)

# From here on a number that was given without a unit is not taken for SI, whatever the bounds allow: pins 0.25 m from the
# axis, motors at 9500 rpm [assumed: larger and faster than any reducer of catalogues].
DOUBTFUL = {"m": 0.25, "rad/s": 1000.0}


def usual_limits(unit: str, integer: bool) -> tuple[float, float, float]:
    """(lowest, highest, nominal) for a unit."""
    return INTEGER if integer else USUAL.get(unit, ANY)
