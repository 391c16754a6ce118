"""What is known of a reducer, checked: catalogue numbers, tooth numbers, and measures of parts that somebody has held in hands."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fmu_src.faults import InputFault

# Teeth of a sun, and of planet over sun, that one may expect (assumed: suns of RV reducers have 10 to 40 teeth).
SUN_TEETH = range(10, 41)
FIRST_STAGE = (0.5, 8.0)
SUN, GAP, SHIFT = "first_stage.sun_teeth", "disc.equidistant_modification", "disc.shift_modification"
# What nobody measures without taking it apart and lost motion is made of, in the order in which it is made smaller where a catalogue's asks for that.
PLAY = (GAP, "bearing.clearance", "first_stage.backlash")
# From this rated torque on three cranks are usual (assumed: the RV-E series changes between its sizes 80 and 110 to 160).
THREE_CRANKS = 1000.0
# Pins of a reducer whose pins nobody counted, and what they may be instead where no whole teeth make its ratio (assumed: as the RV-20E and BX-40E).
USUAL_PINS, OTHER_PINS = 40, range(30, 61)


@dataclass(frozen=True)
class Given:
    """Task and outer measures: rated output torque [N m] and speed [rpm], outer diameter [mm], lost motion of the catalogue [arcmin].

    ``known`` are measured numbers by their names in a reducer file, in the units of ``complete.UNITS``.  ``made`` are some of ``PLAY`` [um] that were
    found to bring the lost motion to that of the catalogue: nobody measured them, so that they keep the range of their rules.  ``stiffness``: the torsional one
    of the catalogue [N m/arcmin], which supports among ``known`` were found to make.  ``usual``: which of speed and rollers nobody gave.
    """

    ratio: float
    pins: int
    rated: float
    diameter: float | None = None
    speed: float = 15.0
    cranks: int | None = None
    rollers: int = 16
    lost_motion: float = 1.0
    lobes: int | None = None
    known: Mapping[str, float] = field(default_factory=dict)
    pins_counted: bool = True
    made: Mapping[str, float] = field(default_factory=dict)
    stiffness: float | None = None
    usual: frozenset[str] = frozenset()

    @property
    def asks_lost_motion(self) -> bool:
        """Whether the lost motion is somebody's: the usual one that made nothing is nobody's."""
        return bool(self.made) or self.lost_motion != Given.lost_motion

    def __post_init__(self) -> None:
        self.check_numbers()
        if self.lobes is not None and self.lobes != self.pins - 1:
            raise InputFault(
                f"--pins {self.pins} and --lobes {self.lobes}: the pins do not close the ring; a cycloid disc needs one pin more than it has"
                f" lobes: give --pins {self.lobes + 1} or --lobes {self.pins - 1}"
            )

    def check_numbers(self) -> None:
        """InputFault that names option, value, unit and remedy."""
        for option, value, unit, low, high in (
            ("ratio", self.ratio, "", 2.0, 1000.0), ("pins", self.pins, "", 8, 200), ("rated", self.rated, " N m", 1.0, 1e5),
            ("diameter", self.diameter, " mm", 20.0, 2000.0), ("speed", self.speed, " rpm", 0.01, 1000.0),
            ("cranks", self.cranks, "", 2, 3), ("rollers", self.rollers, "", 6, 60), ("lost-motion", self.lost_motion, " arcmin", 0.0, 10.0),
        ):  # fmt: skip
            if value is not None and not (math.isfinite(value) and low <= value <= high):
                raise InputFault(f"--{option} {value:g}{unit}: must lie from {low:g} to {high:g}{unit}; look at name plate and unit")

    @property
    def crank_count(self) -> int:
        return self.cranks or (3 if self.rated >= THREE_CRANKS else 2)

    @property
    def stage(self) -> float:
        """Planet over sun teeth that the ratio 1 + pins z2/z1 asks for."""
        return (self.ratio - 1.0) / self.pins

    @property
    def suns(self) -> list[int]:
        """Teeth of the suns that make the ratio with whole planets."""
        return [sun for sun in SUN_TEETH if self.makes_whole_planets(sun)] if FIRST_STAGE[0] <= self.stage <= FIRST_STAGE[1] else []

    @property
    def teeth(self) -> tuple[int, int]:
        """Teeth (planet, sun) of a first stage that makes the ratio, with the known sun or as few as possible; InputFault where none does."""
        fitting = self.suns
        if not fitting:
            raise InputFault(
                f"--ratio {self.ratio:g} with --pins {self.pins}: the first stage would need {self.stage:.4g} = planet over sun teeth, which no sun of"
                f" {SUN_TEETH[0]} to {SUN_TEETH[-1]} teeth and no stage from {FIRST_STAGE[0]:g} to {FIRST_STAGE[1]:g} has; the ratio with the carrier as"
                f" output is 1 + pins z2/z1: with {self.pins} pins the nearest is {self.nearest():g}; count the pins, or give the ratio of shaft rotation"
            )
        sun = self.known.get(SUN, fitting[0])
        if not self.makes_whole_planets(sun):
            nearest = " or ".join(str(one) for one in sorted(sorted(fitting, key=lambda one: abs(one - sun))[:2]))
            raise InputFault(
                f"{SUN} = {sun:g}: with --ratio {self.ratio:g} and --pins {self.pins} the planets would have {self.stage * sun:.4g} teeth;"
                f" whole planets go with a sun of {nearest} teeth; count the teeth, or look at ratio and pins"
            )
        return round(self.stage * sun), int(sun)

    def makes_whole_planets(self, sun: float) -> bool:
        # A ratio that a catalogue rounds, 127.7, is met within its last digit.
        allowed = 0.051 / self.pins if self.ratio % 1.0 else 1e-9
        return sun % 1.0 == 0.0 and abs(round(self.stage * sun) / sun - self.stage) <= allowed

    def nearest(self) -> float:
        """The ratio nearest to the one given that whole teeth make."""
        low, high = FIRST_STAGE
        found = (1.0 + self.pins * planet / sun for sun in SUN_TEETH for planet in range(math.ceil(low * sun), math.floor(high * sun) + 1))
        return min(found, key=lambda ratio: abs(ratio - self.ratio))


def given_with(ratio: float, pins: int | None, rated: float, lobes: int | None = None, **more: Any) -> Given:
    """What is known where nobody may have counted the pins: lobes tell them, else there are as many as usual.  What of ``more`` is None was not given."""
    stated = {name: value for name, value in more.items() if value is not None}
    counted = pins if pins is not None or lobes is None else lobes + 1
    return Given(ratio, usual_pins(ratio) if counted is None else counted, rated, lobes=lobes, pins_counted=counted is not None,
                 usual=frozenset({"speed", "rollers"} - stated.keys()), **stated)  # fmt: skip


def usual_pins(ratio: float) -> int:
    """Pins that a reducer of this ratio is assumed to have: the usual number, or the nearest with which whole teeth make the ratio."""
    found = sorted(OTHER_PINS, key=lambda pins: abs(pins - USUAL_PINS))
    return next((pins for pins in found if Given(ratio, pins, 1.0).suns), USUAL_PINS)


def of_ratio(text: str) -> str:
    """The number of a ratio as a catalogue prints it: 121 of 1:121, 121:1 and 1/121; other texts as they are."""
    parts = [part.strip() for part in text.replace("/", ":").split(":")]
    return next((part for part in parts if part != "1"), "1") if len(parts) == 2 and "1" in parts else text
