"""Units, and the sizes of the true reducer that laws reckon with."""

import math

UM = 1e-6
ARCSEC = math.pi / 648000.0
# Quantities that a law touches, for several laws.
BOTH = ("transmission_error", "hysteresis", "vibration_order")
WEAR = ("wear_depth", "wear_profile")
PINS, LOBES, RATIO = 40, 39, 121.0
ECCENTRICITY, CIRCLE = 0.9e-3, 52e-3
# Lever of a tooth force of the first stage [m].
LEVER = 21e-3 * math.cos(math.radians(20.0))
