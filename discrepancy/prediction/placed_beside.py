"""What is placed beside effects, since what tells where it stands looks another with each of them: roller cages, zeros of angles, locked inputs."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any

import numpy as np

from discrepancy.held_names import HELD, LOCKED_POSITION
from discrepancy.prediction.angle_zeros import best_zeros, likely_in_turn, telling
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.by_effects import Effects, with_most
from discrepancy.prediction.cages import Cages
from discrepancy.prediction.conditions import LAG_SHARE, Values, angle_zero
from discrepancy.prediction.lags import Lags
from discrepancy.prediction.locked_places import LockedPlaces
from discrepancy.prediction.locked_waves import LockedWaves
from discrepancy.prediction.unstated_places import UnstatedPlaces
from discrepancy.prediction.zero_bounds import ZeroBounds
from discrepancy.problem import ERROR, Places, Record, effect_of, is_unplaced
from fmu_src.arrays import Floats


class PlacedBeside:
    """That part of a model of a campaign; how it predicts is another (``PhysicalModel``).

    ``zeros`` by mounting [rad of the output], which the ``zero_bounds`` hold, ``wave`` of the pattern that they were found by [rad of the output],
    ``discs`` that take turns at the pins.
    """

    bench: Bench
    records: list[Record]
    zeros: dict[str, float]
    wave: float
    discs: int
    zero_bounds: ZeroBounds
    without_own: dict[str, float]
    lags: Lags
    cages: Cages
    locked_places: LockedPlaces
    locked_waves: LockedWaves
    unstated_places: UnstatedPlaces

    def standing(self) -> dict[str, float]:
        """Nuisances where they start."""
        raise NotImplementedError

    def for_record(self, record: Record, values: Values) -> dict[str, float]:
        """What a reducer knows of ``values`` for a record."""
        raise NotImplementedError

    def loop_at(self, values: Values, record: Record, place: float | None) -> Floats:
        """A loop [rad] roughly, with its input locked at ``place`` [rad], None: as the record has it, else as the mean over positions."""
        raise NotImplementedError

    def error_with(self, values: Values, effects: Effects, record: Record, which: bool) -> Floats:
        """A transmission error [rad] roughly, with the ``effects`` of ``values`` or without."""
        raise NotImplementedError

    def effects_in(self, values: Mapping[str, float]) -> Effects:
        """The effects that are on in ``values``."""
        return self.cages.effects(self.standing() | dict(values))

    def settle(self, values: Mapping[str, float], which: Sequence[int] | None = None) -> bool:
        """See ``problem.Settling``: the roller cages are placed anew, and where inputs were locked."""
        every, names = self.standing() | dict(values), None if which is None else {self.records[i].name for i in which}
        effects = self.cages.effects(every)
        moved = [self.lags.place(effects, every)]
        if which is None or any(self.records[i].quantity in HELD for i in which):
            moved.append(self.locked_places.place(effects, every))
            moved.append(self.locked_waves.place(effects, self.loop_of(every), lambda record: self.locked_places.placed(record, effects)))
        # Dear, and of no use to others.
        if which is None or any(is_unplaced(self.records[i]) for i in which):
            moved.append(self.place_unstated(effects, every))
        return (self.cages.place(every, names) if self.cages.ripples else False) or any(moved)

    def loop_of(self, values: Mapping[str, float]) -> Callable[[Record], Floats]:
        """Loops [rad] roughly, as their records are placed."""
        return lambda record: self.loop_at(values, record, None)

    def place_unstated(self, effects: Effects, every: Mapping[str, float], fitted: bool = False) -> bool:
        """Where inputs were locked of which nobody says it, looked for beside the ``effects`` of the values, else beside those of the model file: of one
        that was ``fitted`` to this campaign even if these show in loops alone."""
        if not (effects or self.without_own):
            return False
        predicted = partial(self.loop_at, every)
        found = self.unstated_places.place(effects, every, predicted, partial(self.error_with, every, effects))
        return found or (fitted and self.unstated_places.place_alone(predicted))

    def place_alone(self, instead_of: str, values: Mapping[str, float]) -> bool:
        """See ``problem.PlacedAlone``: inputs that were locked at one position."""
        every = self.standing() | dict(values)
        return effect_of(instead_of) == LOCKED_POSITION and self.unstated_places.place_alone(partial(self.loop_at, every))

    def placed_anew(self, values: Mapping[str, float]) -> tuple[float, dict[str, float]]:
        """See ``problem.Placing``: zeros of angles, with the lag of the base model."""
        every = self.standing() | {name: value for name, value in values.items() if name != LAG_SHARE}
        left, found = best_zeros(self.bench, self.records, self.wave, self.for_record, every, list(self.zeros), self.zero_bounds)
        # The nearest of those that look alike.
        return left, {name: self.zero_bounds.nearest(zero, self.wave, self.zeros[name]) for name, zero in found.items()}

    def zeros_in_turn(self, values: Mapping[str, float]) -> dict[str, float]:
        """Likely zeros of angles beside the effects in ``values``, looked for all round: beside parts that are off waves of the pattern are not alike."""
        every = self.standing() | dict(values)
        return {name: likely_in_turn(self.bench, record, self.for_record(record, every), self.wave, self.zeros[name], self.zero_bounds)
                for name, record in telling(self.bench, self.records).items() if name in self.zeros}  # fmt: skip

    def unplaced(self) -> list[int]:
        """See ``problem.Placing``: loops of which nobody says where the input was locked, or whose places count from a zero that is found."""
        return [i for i, record in enumerate(self.records) if is_unplaced(record) or self.locked_waves.counts(record)]

    def unseen(self, values: Mapping[str, float]) -> list[int]:
        """See ``problem.Placing``: loops that are predicted as the mean over positions."""
        places = self.unstated_places.taken(self.effects_in(values), values)
        return [i for i, record in enumerate(self.records) if is_unplaced(record) and record.condition not in places]

    def otherwise(self, values: Mapping[str, float]) -> dict[str, float]:
        """See ``problem.Placing``: inputs whose place was found are locked where the discs have changed places."""
        every = self.standing() | dict(values)
        return self.unstated_places.half_a_turn_on(self.cages.effects(every), every, partial(self.loop_at, every))

    def elsewhere(self, values: Mapping[str, float]) -> list[Places]:
        """See ``problem.Placing``: inputs whose place was found are locked in another turn of the cranks."""
        every, here = self.standing() | dict(values), list(zip(self.found_beside(), self.places(values)))
        turns = self.unstated_places.in_other_turns(self.cages.effects(every), every, partial(self.loop_at, every))
        return [tuple(turn if found is self.unstated_places.found else there for found, there in here) for turn in turns]

    def places(self, values: Mapping[str, float]) -> Places:
        """See ``problem.Placing``."""
        effects = self.effects_in(values)
        return tuple(with_most(found, effects, None) for found in self.found_beside())

    def put(self, values: Mapping[str, float], places: Places) -> None:
        """See ``problem.Placing``."""
        effects = self.effects_in(values)
        for found, there in zip(self.found_beside(), places):
            found.pop(effects, None)
            if there is not None:
                found[effects] = there

    def found_beside(self) -> tuple[dict[Effects, Any], ...]:
        """Where everything is kept that is found beside effects."""
        return self.locked_places.found, self.lags.found, self.locked_waves.found, self.unstated_places.found, self.cages.ahead, self.cages.ripples

    def waves_on(self, values: Mapping[str, float], directions: Sequence[str]) -> tuple[list[dict[str, float]], list[int]]:
        """See ``problem.Placing``: zeros found by the pattern, where the discs have changed places; of transmission errors one of each load is enough.

        What is fixed to the discs has turned with them by their share of a turn there, what is fixed to ring or carrier has not.
        """
        every, found = self.standing() | dict(values), []
        for name, zero in self.zeros.items():
            for k in range(1, self.discs):
                further = every[name] + k * self.wave
                there = {name: further if further <= zero + (self.discs - 0.5) * self.wave else further - self.discs * self.wave}
                if not self.zero_bounds.hold(there[name]):
                    continue
                turned = {direction: every[direction] + 2.0 * np.pi * k / self.discs for direction in directions}
                found += [there, there | turned] if turned else [there]
        errors = [i for i, r in enumerate(self.records) if r.quantity == ERROR and r.fitted and angle_zero(r) in self.zeros]
        few = {(angle_zero(self.records[i]), self.records[i].factors.get("load")): i for i in errors}
        return found, sorted(few.values())

    def stands_elsewhere(self, values: Mapping[str, float]) -> bool:
        """See ``problem.Settling``: inputs were locked elsewhere, or outputs lag by more."""
        every = self.standing() | dict(values)
        effects = self.cages.effects(every)
        moved = any(found.are_elsewhere(effects, every) for found in (self.locked_places, self.lags))
        if moved or self.locked_waves.are_elsewhere(effects, self.loop_of(every), lambda record: self.locked_places.placed(record, effects)):
            return True
        return self.unstated_places.are_elsewhere(effects, every, partial(self.loop_at, every))

    @contextmanager
    def locked_as(self, values: Mapping[str, float], fitted: Mapping[str, float]) -> Iterator[None]:
        """Inputs are locked where ``values`` have them, those of which nobody says it where they were found beside what was ``fitted``, for a while."""
        every = self.standing() | dict(values)
        effects, known = self.cages.effects(every), self.effects_in(fitted)
        with self.locked_places.tried(effects, every), self.unstated_places.tried(effects, known):
            yield

    def placed(self, record: Record, effects: Effects, values: Values, closely: bool = True) -> Record:
        """The record, as if locked where that is with the effects that are on: ``closely`` by their own values, else as it was placed with such last."""
        if record.quantity not in HELD:
            return self.cages.placed(record, effects, values)
        known = self.locked_waves.placed(self.locked_places.placed(record, effects, values if closely else None), effects)
        return self.unstated_places.placed(known, effects, values)
