"""The counts that fix the sizes of a unit's arrays."""

from dataclasses import dataclass
from math import gcd, pi

from fmu_src.variables import Sizes


@dataclass(frozen=True)
class Topology:
    """How many of each part a reducer has."""

    discs: int
    cranks: int
    pins: int
    lobes: int
    rollers: int
    # Pins with rollers in holes of the discs; 0: the output goes through the cranks, as in an RV reducer.
    output_pins: int = 0

    @property
    def ways(self) -> int:
        """In how many ways it is turned onto itself, by parts of a turn: discs, cranks and pins each onto others of their kind."""
        return gcd(self.discs, self.cranks, self.pins)

    @property
    def roller_pitch(self) -> float:
        """From a roller to the next [rad]: cages so much further on look as they did."""
        return 2.0 * pi / self.rollers

    def sizes(self) -> Sizes:
        """The same by axis; arrays over output pins are never empty."""
        return Sizes({
            "disc": self.discs, "crank": self.cranks, "pin": self.pins, "lobe": self.lobes, "roller": self.rollers,
            "output pin": max(1, self.output_pins),
        })  # fmt: skip


# Where only the names of the variables matter.
SMALLEST = Topology(discs=1, cranks=1, pins=4, lobes=3, rollers=3)
