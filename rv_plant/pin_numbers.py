"""Numbers of pins round the ring: an effect at a pin has one that is none of the whole ones, so that a fit finds the pin."""

from rv_plant.topology import Topology

# What says which pin it is.
PIN_NUMBERS = {"proud_pin_number"}
# So near to a pin a number is that pin's (assumed); further from both it lies between two.
NEAR = 0.25


def pin_of(number: float) -> float:
    """The pin that is meant; the number itself where it lies between two."""
    return float(round(number)) if abs(number - round(number)) <= NEAR else number


def pins_alike(number: float, t: Topology) -> list[float]:
    """The pin, and those that show the same: onto which it comes as the reducer is turned onto itself."""
    here = pin_of(number)
    return [here if k == 0 else (here - 1.0 + k * t.pins / t.ways) % t.pins + 1.0 for k in range(t.ways)]
