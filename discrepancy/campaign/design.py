"""What a campaign varies: levels, replicates, record lengths, counted from its training records."""

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from discrepancy.campaign.model import Campaign
from discrepancy.problem import ERROR, ORDERS, Record
from fmu_src.arrays import Floats

# Two numbers nearer than this are one level: a share of the largest, or for temperatures an absolute difference.
SAME_SHARE = 0.03
SAME_KELVIN = 2.0

WEAR = ("wear_profile", "wear_depth", "mass_loss", "debris_iron")
PLAY = ("lost_motion", "hysteresis")
FRICTION = ("input_torque", "no_load_torque", "efficiency")
RACES = ("inner_race", "outer_race")


@dataclass(frozen=True)
class Design:
    """The training part of a campaign, as a design of experiments."""

    campaign: Campaign

    @property
    def records(self) -> tuple[Record, ...]:
        return self.campaign.training

    @property
    def quantities(self) -> list[str]:
        return list(dict.fromkeys(record.quantity for record in self.records))

    def of(self, *quantities: str) -> list[Record]:
        # Orders of a transmission error are one.
        wanted = {*quantities, ORDERS} if ERROR in quantities else set(quantities)
        return [record for record in self.records if not quantities or record.quantity in wanted]

    def measures(self, *quantities: str) -> bool:
        return bool(self.of(*quantities))

    def levels(self, factor: str, *quantities: str) -> list[float]:
        """Distinct values of a factor over records and rows."""
        numbers = [number for record in self.of(*quantities) for number in values_of(record, factor)]
        return distinct(numbers, factor)

    def directions(self, *quantities: str) -> set[int]:
        return {int(record.factors["direction"]) for record in self.of(*quantities)}

    def mountings(self, *quantities: str) -> set[str]:
        return {record.mounting for record in self.of(*quantities)}

    def intervened(self, name: str, *quantities: str) -> bool:
        """Whether there are records of these quantities with and without the intervention."""
        after = {name in self.campaign.conditions[r.condition].interventions for r in self.of(*quantities)}
        return len(after) == 2

    def surfaces(self) -> set[str]:
        return {record.tags["surface"] for record in self.of("wear_profile", "wear_depth")}

    def replicates(self, quantity: str) -> dict[str, int]:
        """By condition, the runs that repeat each other most often."""
        counts = Counter(
            (r.condition, (r.mounting, r.factors["direction"], *sorted(r.tags.items()))) for r in self.of(quantity)
        )
        best: dict[str, int] = {}
        for (condition, _), count in counts.items():
            best[condition] = max(best.get(condition, 0), count)
        return best

    def loaded_both_ways(self) -> bool:
        """Whether loops reach, both ways, at least half of their largest torque."""
        loops = [record.axes["torque"] for record in self.of("hysteresis")]
        return any(min(torque.max(), -torque.min()) >= 0.5 * np.abs(torque).max() > 0.0 for torque in loops)

    def same_turns_at_two_speeds(self, *quantities: str) -> bool:
        """Whether a number of turns was reached at more than one speed."""
        reached = []
        for record in self.of(*quantities):
            speed, hours = values_of(record, "speed"), values_of(record, "hours")
            if len(speed) and len(hours):
                reached += [(v, v * t) for v, t in zip(*np.broadcast_arrays(speed, hours)) if v * t > 0.0]
        return any(
            abs(v - w) > SAME_SHARE * max(v, w) and abs(m - n) <= 2 * SAME_SHARE * max(m, n)
            for (v, m), (w, n) in combinations(reached, 2)
        )

    def torque_reach(self) -> tuple[float, float, int]:
        """Smallest and largest torque [N.m] at which stiffness shows, and how many levels lie between."""
        steady = [abs(load) for load in self.levels("load", "torsional_stiffness", "transmission_error")]
        swept = [np.abs(record.axes["torque"]) for record in self.of("hysteresis")]
        numbers = [number for number in steady + [number for torque in swept for number in torque] if number > 0.0]
        # Levels stand for all numbers near them: the ends are those that were measured.
        return (float(min(numbers)), float(max(numbers)), len(distinct(numbers, "load"))) if numbers else (0.0, 0.0, 0)

    def coupled_factors(self) -> list[tuple[str, str]]:
        """Pairs of factors that always change together over the conditions."""
        names = ("speed", "load", "temperature", "hours")
        # Records that were made by a program may name conditions that no table states.
        known, own = self.campaign.conditions, {r.condition: r.factors for r in self.records}
        rows = [known[name].factors if name in known else factors for name, factors in own.items()]
        found = []
        for i, a in enumerate(names):
            for b in names[i + 1 :]:
                both = np.array([(row[a], row[b]) for row in rows if a in row and b in row])
                if len(both) < 3 or len(distinct(both[:, 0], a)) < 2 or len(distinct(both[:, 1], b)) < 2:
                    continue
                if abs(np.corrcoef(both.T)[0, 1]) > 0.98:
                    found.append((a, b))
        return found


def values_of(record: Record, factor: str) -> Floats:
    """A record's values of a factor: row by row, one, or none."""
    if factor in record.axes:
        return record.axes[factor]
    return np.array([record.factors[factor]] if factor in record.factors else [])


def distinct(numbers: Iterable[float], factor: str) -> list[float]:
    """One number for each cluster of equal ones."""
    ordered = np.unique(np.asarray(list(numbers), float))
    if not len(ordered):
        return []
    same = SAME_KELVIN if factor == "temperature" else SAME_SHARE * np.abs(ordered).max()
    levels = [ordered[0]]
    for number in ordered[1:]:
        if number - levels[-1] > same:
            levels.append(number)
    return [float(level) for level in levels]


def turns(record: Record) -> float:
    """Output turns that a record over angle spans; orders were made of as many as they needed."""
    if "angle" not in record.axes:
        return math.inf
    return float(np.ptp(record.axes["angle"])) / (2.0 * math.pi)


def highest_order(record: Record) -> float:
    """Highest order per output turn that the sampling shows (half the samples per turn), by the mean spacing."""
    span = turns(record)
    return 0.5 * (len(record.values) - 1) / span if span > 0.0 else 0.0


def worst_gap(axis: Floats) -> float:
    """Largest step of an axis over its median step."""
    steps = np.abs(np.diff(axis))
    steps = steps[steps > 0.0]
    return float(steps.max() / np.median(steps)) if len(steps) else 1.0
