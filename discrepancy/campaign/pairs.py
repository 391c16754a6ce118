"""Pairs of effects that look alike, and the experiment that tells them apart (to number 13: physics audit, section 6).

Each experiment is a list of needs; a pair has one or several alternative experiments.
"""

from collections.abc import Callable
from dataclasses import dataclass

from discrepancy.campaign.design import FRICTION, PLAY, RACES, WEAR, Design, turns
from discrepancy.campaign.quantities import INTERVENTIONS

# What "not separable" means: the conditions decide, not the numbers that were measured.
HOLDS_FOR = "judged by the campaign's conditions alone, for effects just above the noise; larger ones a diagnosis may tell apart by their form"


@dataclass(frozen=True)
class Need:
    """Something an experiment must have."""

    text: str
    met: Callable[[Design], bool]
    # What of it the campaign has, beside what is asked for.
    has: Callable[[Design], str] | None = None
    # What is done to the unit between its runs, by the word that a campaign has for it.
    intervention: str = ""

    def lacking(self, design: Design) -> str:
        """What is asked for, with what there is of it."""
        there = self.has(design) if self.has else ""
        return f"{self.text}; there are {there}" if there else self.text


@dataclass(frozen=True)
class Pair:
    """Effects that are hard to separate; ``signals`` are the quantities in which both show.  ``within``: how the variables
    begin that both are in the catalogue."""

    number: int
    effects: tuple[str, ...]
    experiment: str
    signals: tuple[str, ...]
    alternatives: tuple[tuple[Need, ...], ...]
    within: str = ""


@dataclass(frozen=True)
class Verdict:
    """What this campaign can say of a pair: "separable", "not separable" (see ``HOLDS_FOR``) or "not visible"."""

    pair: Pair
    status: str
    missing: tuple[str, ...] = ()


def measured(*quantities: str) -> Need:
    return Need(f"measure {' or '.join(quantities)}", lambda d: d.measures(*quantities))


def levels(factor: str, count: int, *quantities: str) -> Need:
    what = {"load": "loads", "speed": "speeds", "temperature": "temperatures", "hours": "numbers of hours"}[factor]
    return Need(
        f"at least {count} {what} of {' or '.join(quantities)}", lambda d: len(d.levels(factor, *quantities)) >= count
    )


def intervention(name: str, *quantities: str) -> Need:
    text = f"{' or '.join(quantities)} before and after {name} ({INTERVENTIONS[name]})"
    return Need(text, lambda d: d.intervened(name, *quantities), intervention=name)


def both_directions(*quantities: str) -> Need:
    return Need(f"both directions of {' or '.join(quantities)}", lambda d: len(d.directions(*quantities)) == 2)


def worn(*surfaces: str) -> Need:
    text = f"wear_profile or wear_depth of the {' or the '.join(surfaces)}"
    return Need(text, lambda d: bool(d.surfaces() & set(surfaces)))


def full_turns(count: int) -> Need:
    text = f"transmission error over at least {count} output turn{'s' if count > 1 else ''}"
    return Need(text, lambda d: any(turns(record) >= count - 0.01 for record in d.of("transmission_error")))


LOOP_BOTH_SIGNS = Need("hysteresis loops to torques of both signs", lambda d: d.loaded_both_ways())
TWO_MOUNTINGS = Need(
    "transmission error in at least 2 mountings of the encoder", lambda d: len(d.mountings("transmission_error")) > 1
)
DRIVEN_BACK = Need(
    "a load that drives (negative load_torque)", lambda d: any(load < 0.0 for load in d.levels("load", *FRICTION))
)
SAME_TURNS = Need(
    "the same number of turns at 2 speeds, in wear or friction",
    lambda d: d.same_turns_at_two_speeds(*WEAR) or d.same_turns_at_two_speeds(*FRICTION),
)


def wide_torques(design: Design) -> bool:
    smallest, largest, count = design.torque_reach()
    rated = design.campaign.rated_torque or largest
    return count >= 4 and largest >= 0.99 * rated and smallest <= 0.11 * largest


def reach_text(design: Design) -> str:
    smallest, largest, count = design.torque_reach()
    rated = design.campaign.rated_torque
    share = f", which is {100.0 * smallest / rated:.0f} % to {100.0 * largest / rated:.0f} % of the rated" if rated else ""
    return f"{count} from {smallest:.3g} to {largest:.3g} N.m{share}" if count else ""


WIDE_TORQUES = Need("at least 4 torques from 10 % to 100 % of the rated torque or more (better 200 %)", wide_torques, reach_text)

PAIRS = (
    Pair(1, ("needle clearance", "raceway wear"),
         "torque both ways (wear is one-sided) with a trend over hours, or raceways measured",
         (*PLAY, "transmission_error"),
         ((LOOP_BOTH_SIGNS, levels("hours", 2, *PLAY)),
          (both_directions("transmission_error"), levels("hours", 2, "transmission_error")),
          (worn(*RACES),))),
    Pair(2, ("running-in", "lubrication regime"),
         "a used unit at two speeds and equal turns: running-in does not come back", (*WEAR, *FRICTION),
         ((SAME_TURNS, levels("hours", 3, *WEAR, *FRICTION)),)),
    Pair(3, ("debris abrasion", "hardness gradient"),
         "change the grease: debris abrasion drops, the hardness effect stays", WEAR,
         ((intervention("grease_changed", *WEAR), levels("hours", 3, *WEAR)),)),
    Pair(4, ("profile modification", "mesh wear"),
         "hysteresis loops to both signs: wear after running one way shows on one flank", PLAY, ((LOOP_BOTH_SIGNS,),)),
    Pair(5, ("thermal expansion", "viscosity"), "lost motion at standstill, hot and cold: only expansion changes it",
         (*PLAY, *FRICTION), ((levels("temperature", 2, *PLAY),),)),
    Pair(6, ("throw of one eccentric", "hole position error", "planet run-out"),
         "vary the load, or mesh the planets one tooth further", ("transmission_error",),
         ((levels("load", 2, "transmission_error"), full_turns(1)),
          (intervention("planets_reindexed", "transmission_error"), full_turns(1)))),
    Pair(7, ("compliance of housing and supports", "softer contacts"),
         "stiffness at 10, 50, 100 and 200 % of the rated torque: contacts stiffen, the housing does not",
         ("hysteresis", "torsional_stiffness", "lost_motion"), ((WIDE_TORQUES,),)),
    Pair(8, ("the pins' own places", "an oval or clamped ring"),
         "record one output turn or more (better three), turn the ring by some pins or clamp it anew, and record again: pins go with it, what the"
         " housing does stays",
         ("transmission_error",), ((full_turns(1), intervention("ring_turned", "transmission_error")),), "pin_ring_"),
    Pair(9, ("encoder eccentricity", "carrier run-out"), "turn the encoder on its shaft, or use two reading heads",
         ("transmission_error",), ((intervention("encoder_turned", "transmission_error"),), (TWO_MOUNTINGS,))),
    Pair(10, ("load-dependent wear exponent", "slip depending on load"), "wear at two loads, and the cage's speed",
         WEAR, ((levels("load", 2, *WEAR), levels("load", 2, "cage_speed")),)),
    Pair(11, ("friction of the mesh", "friction of the bearings"),
         "vary only the speed, or drive from the output", FRICTION,
         ((levels("speed", 3, *FRICTION),), (DRIVEN_BACK,))),
    Pair(12, ("pin wear", "disc wear"), "tear-down, or new pins on worn discs",
         ("transmission_error", *PLAY, *WEAR),
         ((intervention("pins_exchanged", "transmission_error", *PLAY),), (worn("pin"), worn("flank")))),
    Pair(13, ("mesh wear", "raceway wear"),
         "flanks and raceways measured; or torque reversed after one-sided running, with vibration",
         ("transmission_error", *PLAY),
         ((worn("flank"), worn(*RACES)),
          (intervention("load_reversed", *PLAY), measured("vibration", "vibration_order")))),
    Pair(14, ("ring stiffness round the circle", "oval ring"),
         "vary the load: stiffness shows in proportion to it, an oval ring at any load", ("transmission_error",),
         ((levels("load", 2, "transmission_error"), full_turns(1)),)),
    Pair(15, ("discs misaligned with the ring", "tilting moment of the load"),
         "vary the load: misalignment stays, the moment of what makes the load goes with it", ("transmission_error",),
         ((levels("load", 2, "transmission_error"), full_turns(1)),)),
    Pair(16, ("play of the first stage over the angle", "planet run-out"),
         "turn both ways under load: play changes its sign, a run-out does not", ("transmission_error",),
         ((both_directions("transmission_error"), full_turns(1)),)),
    Pair(17, ("support with memory", "friction of the contacts"),
         "loops to small and large torques: a seat that slips holds the same torque at all, friction one in proportion",
         ("hysteresis", "lost_motion"), ((WIDE_TORQUES,),)),
    Pair(18, ("torsional resonance of the rig", "errors of parts"),
         "vary the speed: a resonance keeps its frequency, a part its order", ("transmission_error",),
         ((levels("speed", 2, "transmission_error"), full_turns(1)),)),
    Pair(19, ("wear coefficient growing with time", "debris abrasion"),
         "wear at two loads: iron comes with the wear, time does not; or change the grease", WEAR,
         ((levels("load", 2, *WEAR), levels("hours", 3, *WEAR)),
          (intervention("grease_changed", *WEAR), levels("hours", 3, *WEAR)))),
    Pair(20, ("wear over temperature", "lubrication regime"),
         "vary speed and temperature: a film goes with both, chemistry with the temperature alone", WEAR,
         ((levels("temperature", 2, *WEAR), levels("speed", 2, *WEAR)),)),
    Pair(21, ("wear threshold of pressure", "load-dependent wear exponent"),
         "wear at three loads: a power is a straight line over the logarithm, a threshold is a step", WEAR,
         ((levels("load", 3, *WEAR),),)),
)  # fmt: skip


def judge(pair: Pair, design: Design) -> Verdict:
    """The alternative that lacks least decides."""
    if not design.measures(*pair.signals):
        return Verdict(pair, "not visible", (f"none of {', '.join(pair.signals)} is measured",))
    lacking = [tuple(need.lacking(design) for need in needs if not need.met(design)) for needs in pair.alternatives]
    least = min(lacking, key=len)
    return Verdict(pair, "not separable" if least else "separable", least)
