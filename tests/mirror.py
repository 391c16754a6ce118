"""Symmetries of the reducer: the same parts seen in a mirror, turned by whole pin pitches, or measured by other units.

The mirror stands at the axis through pin 1: angles and torques change their signs, and equal parts stand in the
other order.
"""

import numpy as np

from fmu_src.units import fmi_base_unit

# Along the circumference: the sign changes in the mirror.
SIDEWAYS = ("_tangential", "crank_phase_error", "lobe_pitch_error")


def backwards(count):
    """Places of equal parts on a circle in the mirror; the first stays."""
    return -np.arange(count) % count


def between_backwards(discs, count):
    """[disc, place] of what stands between marks on a disc: lobes between roots, bins between their ends.

    Marks are counted from the root that disc 1 turns to pin 1 (the first one of a surface).  Those of the other
    discs stand d/D of a lobe ahead: their mirror images are counted from one lobe, ``count`` / lobes places, further.
    """
    return lambda a_lobe: (np.where(np.arange(discs) > 0, a_lobe, 0)[:, None] - np.arange(count) - 1) % count


def mirrored_parts(values, reducer):
    """Errors of parts by name, as the same parts have them in the mirror."""
    topology = reducer.topology
    sizes = topology.sizes()
    result = {}
    for name, value in values.items():
        for place, axis in enumerate(reducer.plant.by_name[name].axes):
            if axis == "lobe":
                value = np.take_along_axis(value, between_backwards(topology.discs, topology.lobes)(1), place)
            else:
                value = np.take(value, backwards(sizes[axis]), place)
        result[name] = -value if name.endswith(SIDEWAYS) else value
    return result


def mirrored_contacts(values):
    """What each contact has, [disc, pin] or [disc, crank, roller]."""
    for place, count in enumerate(values.shape):
        values = np.take(values, backwards(count), place)
    return values


def turned_parts(values, reducer, pitches):
    """Errors of parts by name when disc, cranks and carrier have turned by whole pin pitches: the pins alone stand still."""
    return {
        name: np.roll(value, pitches) if reducer.plant.by_name[name].axes == ("pin",) else value for name, value in values.items()
    }


class Measures:
    """Other units for length, mass and time: what a number in SI units becomes, by its unit."""

    def __init__(self, length, mass, time):
        self.of = {"m": length, "kg": mass, "s": time}

    def factor(self, unit):
        exponents = fmi_base_unit(unit)
        return float(np.prod([factor ** exponents.get(base, 0) for base, factor in self.of.items()]))

    def at_1_mm(self, exponent):
        """Of a force at 1 mm of penetration: that millimetre does not grow with the lengths."""
        return self.factor("N") / self.of["m"] ** exponent
