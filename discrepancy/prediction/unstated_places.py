"""Where the input was locked in loops of which nobody says it: found beside an effect that explains the transmission error.

A loop at one position departs from the mean over positions by more than the noise of good benches, and what an effect of the ring or of a crank adds to it
is another at each position.  With such an effect known from the transmission error the form of the loop tells the position; without, an
effect of loops alone could hide in it, so that none is looked for (``effects.locked_position`` then says how far a position may be meant).

Effects that a model file has itself are such, too.

A search says which turn of the cranks it is, and about where; how far from there is fitted with the effect, which the position may stand for in part.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from discrepancy.closed_loop import scatter
from discrepancy.held_names import LOCKED_AT
from discrepancy.prediction.by_effects import Effects, restored, with_most
from discrepancy.prediction.parabola import vertex
from discrepancy.problem import ERROR, Parameter, Record, is_unplaced
from fmu_src.arrays import Floats

FROM_PLACE = "from_unstated_place"
# A loop's prediction [rad] with its input locked at an angle [rad], None: as the mean over positions; a transmission error's with the effects or without.
LoopAt = Callable[[Record, float | None], Floats]
ErrorWith = Callable[[Record, bool], Floats]

# Positions of a turn of the cranks that are looked at first (discs that jam show another loop 20 deg further); parts into which what is left is divided,
# and how often (to a degree of the input, and between); of first positions, and of turns of the cranks, those about which is looked so closely.
PER_TURN, CLOSER, TIMES, MOST_CLOSER = 64, 4, 2, 3
# Turns of the cranks other than that of a place that was fitted that are looked at as finely as any prediction.
MOST_TURNS = 8
# A place that was fitted is not left for one that a search, which is rough, sees nearer than this share of its first steps.
NEAR = 0.5
# How far from where a search saw it a place may be [first steps of the search], as a standard deviation.
FROM_THERE = 4.0
# Squares that a position leaves, of those that the mean over positions leaves: from more nobody can say that there is one.
CLEARLY = 0.25
# Parts of a turn of the output at which turns of the cranks are compared first; squares, of those that are left, by which they differ where nobody
# could tell them apart.
OTHER_TURNS, SAME = (2, 3, 5, 40), 1e-3
# Squares that another place leaves, of those that the one taken leaves: from more it stays.
BETTER = 0.5
# Squares beyond its noise of a transmission error that effects leave, of those without: less explains it, if there are more than so many deviations of
# what the noise's own squares may be.
EXPLAINED, SEEN = 0.5, 5.0
# Samples of a loop that are looked at.
SAMPLES = 40


class UnstatedPlaces:
    """By effects and condition where inputs were locked [rad of the input], of loops of which nobody says it; ``turn``, ``period``: turn of the output
    and of the cranks against the carrier [rad of the input]."""

    def __init__(self, records: Sequence[Record], turn: float, period: float):
        self.turn, self.period = turn, period
        self.errors = [record for record in records if record.quantity == ERROR and record.fitted]
        # One of each condition tells: they were not turned between.
        first: dict[str, Record] = {}
        for record in records:
            if is_unplaced(record) and not record.left_out:
                first.setdefault(record.condition, record)
        self.loops = {condition: fewer_samples(record) for condition, record in first.items()}
        self.found: dict[Effects, dict[str, float]] = {}

    @property
    def step(self) -> float:
        """Of a search [rad of the input]."""
        return self.period / PER_TURN

    def parameters(self) -> list[Parameter]:
        """How far from where they were seen loops were locked: of each condition one, which does nothing as long as none was seen;
        none without transmission errors, beside which they are looked for."""
        limit, text = 0.5 * self.period + FROM_THERE * self.step, "where the input was locked in these loops, from where a search saw it"
        return [Parameter(from_there(c), "rad", 0.0, -limit, limit, self.step, 0, limit, text) for c in self.loops if self.errors]

    def taken(self, effects: Effects, values: Mapping[str, float]) -> dict[str, float]:
        """The places found with these effects, else with the most of them, as far from there as ``values`` have them."""
        return {condition: place + values.get(from_there(condition), 0.0) for condition, place in with_most(self.found, effects, {}).items()}

    def placed(self, record: Record, effects: Effects, values: Mapping[str, float]) -> Record:
        """The record as if it was locked where that was found with these effects."""
        place = self.taken(effects, values).get(record.condition) if is_unplaced(record) else None
        return record if place is None else locked(record, place)

    def place(self, effects: Effects, values: Mapping[str, float], predicted: LoopAt, error: ErrorWith) -> bool:
        """Looks for the places with these effects if they explain transmission errors; False if that changes nothing."""
        if not self.loops or not self.explain(error):
            return False
        before, now, found = with_most(self.found, effects, {}), self.taken(effects, values), {}
        for condition, loop in self.loops.items():
            place = self.searched(loop, predicted, now.get(condition))
            if place is not None:
                found[condition] = before[condition] if place == now.get(condition) else place - values.get(from_there(condition), 0.0)
        self.found[effects] = found
        return found != before

    def place_alone(self, predicted: LoopAt) -> bool:
        """Looks for the places without any effect, which transmission errors beside would tell; False, and nothing changes, where one has none."""
        if not self.loops or not self.errors or self.found.get(frozenset()):
            return False
        found = {}
        for condition, loop in self.loops.items():
            place = self.searched(loop, predicted, None)
            if place is None:
                return False
            found[condition] = place
        self.found[frozenset()] = found
        return True

    def are_elsewhere(self, effects: Effects, values: Mapping[str, float], predicted: LoopAt) -> bool:
        """Whether loops were locked elsewhere than where they are taken to with these effects."""
        if effects not in self.found:
            return False
        return any(self.searched(self.loops[condition], predicted, now) != now for condition, now in self.taken(effects, values).items())

    def half_a_turn_on(self, effects: Effects, values: Mapping[str, float], predicted: LoopAt) -> dict[str, float]:
        """The parameters with which loops were locked half a turn of the cranks from where they are taken to: discs have changed places there, and a
        fit that has settled with one looks as good to a search as the other."""
        other = {}
        for condition, place in self.taken(effects, values).items():
            far = self.closer(self.loops[condition], predicted, place + 0.5 * self.period) - place
            name = from_there(condition)
            there = values.get(name, 0.0) + far
            other[name] = there - self.period if there > 0.5 * self.period else there
        return other

    def in_other_turns(self, effects: Effects, values: Mapping[str, float], predicted: LoopAt) -> list[dict[str, float]]:
        """What was found with these effects, each time with one condition's loops locked in another turn of the cranks, or half a one on, of those
        that leave least.

        An effect of the ring shows nearly the same in some turns, and a search, which is rough, may have taken the wrong one.
        """
        before, others = with_most(self.found, effects, {}), []
        for condition, now in self.taken(effects, values).items():
            loop, moved = self.loops[condition], values.get(from_there(condition), 0.0)
            if self.all_alike(loop, predicted, now, left_of(loop, predicted, now)):
                continue
            turns = now + 0.5 * self.period * np.arange(1, round(2.0 * self.turn / self.period))
            likely = turns[np.argsort([left_of(loop, predicted, place) for place in turns])[:MOST_TURNS]]
            others += [{**before, condition: self.closer(loop, predicted, place) % self.turn - moved} for place in likely]
        return others

    def all_alike(self, loop: Record, predicted: LoopAt, place: float, left: float) -> bool:
        """Whether turns of the cranks show the same as that of ``place``, which leaves so much: what is fixed to the ring makes them differ."""
        turns, there = place + np.arange(0.0, self.turn, self.period), predicted(loop, place)
        return all(float(np.var(predicted(loop, turns[len(turns) // part]) - there)) < SAME * left for part in OTHER_TURNS)

    @contextmanager
    def tried(self, effects: Effects, known: Effects) -> Iterator[None]:
        """The places of ``known`` effects for these, for a while."""
        with restored(self.found):
            self.found[effects] = with_most(self.found, known, {})
            yield

    def other(self, values: Mapping[str, float]) -> dict[str, float]:
        """The parameters of loops that are locked half a turn of the cranks from where ``values`` have them."""
        return {name: values.get(name, 0.0) + 0.5 * self.period for name in map(from_there, self.loops)}

    def closer(self, loop: Record, predicted: LoopAt, centre: float) -> float:
        """The best place about another, within a step of the search."""
        step = self.step
        for _ in range(TIMES):
            centre = best_of(loop, predicted, centre + np.linspace(-step, step, 2 * CLOSER + 1))
            step /= CLOSER
        before, at, after = (left_of(loop, predicted, centre + part) for part in (-step, 0.0, step))
        return centre + step * vertex(before, at, after)

    def are_near(self, place: float, other: float) -> bool:
        """Whether two places are one, as roughly as a search sees it."""
        return abs(math.remainder(place - other, self.turn)) < NEAR * self.step

    def explain(self, error: ErrorWith) -> bool:
        """Whether effects leave far less of the transmission errors, beyond their noise, than is there without."""
        left = whole = wide = 0.0
        for record in self.errors:
            beside, without = (record.values - error(record, which) for which in (True, False))
            count, noise = len(beside), min(scatter(beside) ** 2, float(np.mean(beside**2)))
            left, whole = left + float(np.sum(beside**2)) - count * noise, whole + float(np.sum(without**2)) - count * noise
            wide += 2.0 * count * noise**2
        return whole > SEEN * math.sqrt(wide) and left < EXPLAINED * whole

    def searched(self, loop: Record, predicted: LoopAt, now: float | None) -> float | None:
        """The place [rad] at which a loop is as measured, if there is one that leaves far less than the mean over positions; that where it is ``now``
        taken to be if none is clearly better."""

        def left(place: float | None) -> float:
            return left_of(loop, predicted, place)

        def closest_of(places: npt.NDArray[np.floating]) -> float:
            likely = places[np.argsort([left(place) for place in places])[:MOST_CLOSER]]
            return best_of(loop, predicted, np.array([self.closer(loop, predicted, place) for place in likely]))

        # Turns of the cranks differ by little, by what is fixed to the ring: one of them first, then all, unless some of them show the same.
        first = closest_of(np.arange(PER_TURN) * self.step)
        alike = self.all_alike(loop, predicted, first, left(first))
        found = (first if alike else closest_of(first + np.arange(0.0, self.turn, self.period))) % self.turn
        if now is not None and (self.are_near(found, now) or left(found) > BETTER * left(now)):
            found = now
        return found if left(found) < CLEARLY * left(None) else None


def left_of(loop: Record, predicted: LoopAt, place: float | None) -> float:
    """What a place leaves of a loop, as a variance."""
    return float(np.var(loop.values - predicted(loop, place)))


def best_of(loop: Record, predicted: LoopAt, places: Floats) -> float:
    return float(places[int(np.argmin([left_of(loop, predicted, place) for place in places]))])


def from_there(condition: str) -> str:
    """The name of the parameter of a condition's loops."""
    return f"{FROM_PLACE}[{condition}]"


def is_from_there(name: str) -> bool:
    """Whether a value is such a parameter, and nothing that a reducer knows of."""
    return name.startswith(FROM_PLACE)


def locked(record: Record, place: float) -> Record:
    """A loop as if its input was locked at ``place`` [rad]."""
    return replace(record, factors={**record.factors, LOCKED_AT: place})


def fewer_samples(record: Record) -> Record:
    """Some samples of a loop, enough to tell its form, with those where its torque turns: how far it went is what friction remembers."""
    torque, size = np.asarray(record.axes["torque"], float), len(record.values)
    turns = 1 + np.flatnonzero(np.diff(np.sign(np.diff(torque))))
    few = len(turns) <= SAMPLES
    rows = np.unique(np.concatenate([np.linspace(0, size - 1, min(SAMPLES, size)).astype(np.intp), turns])) if few else np.arange(size)
    return replace(record, values=record.values[rows], axes={name: np.asarray(axis)[rows] for name, axis in record.axes.items()})
