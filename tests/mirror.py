"""Symmetries of the reducer: what its parts become in a mirror, or turned by whole pin pitches.

Mirrored at the axis through pin 1, angles and torques change their signs, and the parts stand in the other order.
"""

import numpy as np

# Along the circumference: the sign changes.
SIDEWAYS = ("_tangential", "crank_phase_error", "lobe_pitch_error", "lobe_pitch_added")


def reversed_order(count):
    """Places of equal parts on a circle in a mirror; the first stays."""
    return -np.arange(count) % count


def mirrored_lobes(discs, lobes):
    """[disc, lobe] -> lobe of the same disc's twin in a mirror.

    Lobes are counted from the root that disc 0 turns to pin 1.  The lobes of the other discs stand d/D of a
    lobe ahead, so that they are counted from the root behind.
    """
    behind = (np.arange(discs) == 0).astype(int)[:, None]
    return (-np.arange(lobes) - behind) % lobes


def mirrored(values, reducer):
    """Errors of parts by name, as the same parts have them in a mirror."""
    topology = reducer.topology
    order = {axis: reversed_order(count) for axis, count in topology.sizes().items()}
    result = {}
    for name, value in values.items():
        axes = reducer.plant.by_name[name].axes
        value = np.array(value)
        for place, axis in enumerate(axes):
            if axis == "lobe":
                lobes = mirrored_lobes(topology.discs, topology.lobes)
                value = np.take_along_axis(value, lobes, axis=place)
            else:
                value = np.take(value, order[axis], axis=place)
        result[name] = -value if name.endswith(SIDEWAYS) else value
    return result
