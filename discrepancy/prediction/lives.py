"""Lives of a reducer on the bench: its surfaces after stated hours, by wear cycles that stand for growing stretches."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from discrepancy.prediction.units import Condition, Units
from fmu_src.arrays import Floats, copied
from fmu_src.threads import Once
from reducers.reducer import Reducer
from studies import coupled
from studies.meshing_cycle import HOUR
from wear_fmu.variables import Resolution

# A turn of the cranks in full cycles: depths within 0.2 % (36: 0.5 %).
POSITIONS = 72
# Hours that count as none [s].
NOTHING = 1e-6 * HOUR
# Turns of the cranks in a wear cycle.  The base model's wear is run through full meshing cycles, once;
# how it changes in proportion through shorter ones of fewer positions, which err by 1 to 3 % of the change by a law of wear.
SHORT_CYCLE, SHORT_POSITIONS = 2, 18
# For searches still shorter ones: 2 to 5 % of the change.
ROUGH_CYCLE = 1
# First and longest stretch of hours that one wear cycle stands for, by its turns.
JUMPS = {SHORT_CYCLE: (100.0 * HOUR, 1000.0 * HOUR), ROUGH_CYCLE: (200.0 * HOUR, 2000.0 * HOUR)}
FULL_JUMPS = (50.0 * HOUR, 1000.0 * HOUR)
# Out-of-balance force over load while surfaces wear: depths within 1e-6.
LIFE_TOLERANCE = 1e-6
# A contact may sweep a whole step at once [rad], but on a standing pin, where it turns back (its print: 9 % instead of 3).
SWEEP, WHOLE_SWEEP = math.pi / 36.0, 1.0
# A worn reducer has some 150 kB at each of its hours.
KEPT_LIVES = 300


class Lives(Units):
    """Worn surfaces of one reducer."""

    def __init__(self, reducer: Reducer, settings: Mapping[str, float], resolution: Resolution):
        super().__init__(reducer, settings, resolution)
        self.lives = Once(KEPT_LIVES)
        # Turns of the cycles in which wear is varied.
        self.cycle_turns = SHORT_CYCLE
        self.largest_sweep = SWEEP
        # Hours [s] at which a life is looked at, by the condition when new: in fits, and besides in what was held out.
        self.planned: dict[Condition, set[float]] = {}
        self.planned_beyond: dict[Condition, set[float]] = {}

    def plan(self, conditions: Iterable[Condition], held_out: bool = False) -> None:
        """Lives are looked at under these conditions: each is lived once for all its hours, those of unused runs only where they are asked for."""
        for condition in conditions:
            (self.planned_beyond if held_out else self.planned).setdefault(fresh(condition), set()).add(condition.hours)

    def wear_steps(self, condition: Condition, turns: int) -> tuple[float, int]:
        """Communication step [s] and their number in a wear cycle of ``turns``."""
        positions = SHORT_POSITIONS if turns in JUMPS else POSITIONS
        return self.turning_time(condition) / positions, turns * positions

    def cycle(self, condition: Condition, turns: int) -> tuple[float, Floats]:
        """Communication step [s] of a wear cycle, and the share of what it stands for that each step takes.

        The wear rises through the first turn and falls through one more: places that the cycle meets early in a turn are then
        as old on average as those that it meets late.
        """
        step, steps = self.wear_steps(condition, turns)
        positions = steps // turns
        rise = (np.arange(positions) + 0.5) / positions
        weights = np.concatenate([rise, np.ones(steps - positions), rise[::-1]])
        return step, weights / steps

    def worn(self, condition: Condition, values: Mapping[str, float], hours: float, turns: int = SHORT_CYCLE) -> np.ndarray:
        """The wear unit's record after ``hours`` [s] at a condition."""
        return self.life(condition, values, {hours}, turns)[hours]

    def life(self, condition: Condition, values: Mapping[str, float], hours: set[float], turns: int) -> dict[float, np.ndarray]:
        """Wear records by operating time [s], at least at ``hours``, by cycles of ``turns`` that stand for growing stretches."""
        new = fresh(condition)
        return self.wear_to(new, values, self.looked_at(new, hours), turns)

    def looked_at(self, new: Condition, hours: set[float]) -> list[float]:
        """Hours at which a life is looked at, ``hours`` among them."""
        planned = self.planned.get(new, set())
        beyond = set() if hours <= planned else self.planned_beyond.get(new, set())
        return sorted(hours | planned | beyond)

    def wear_to(
        self, condition: Condition, values: Mapping[str, float], inspections: list[float], turns: int
    ) -> dict[float, np.ndarray]:
        """Wear records at several operating times [s] at a condition when new, see ``life``."""
        return self.lived(condition, values, inspections, turns)[0]

    def lived(self, condition: Condition, values: Mapping[str, float], inspections: list[float], turns: int) -> tuple[dict[float, np.ndarray], Floats]:
        """(records by time, equilibria): those of the base model are where others start."""
        relevant = self.relevant(values, True)
        # Of other lives nobody needs the equilibria, and not the surfaces for long.
        kept = self.lives if relevant else self.runs

        def run() -> tuple[dict[float, np.ndarray], Floats]:
            plants, wears = self.pair(condition, values, largest_crank_step=1.0, tolerance=LIFE_TOLERANCE)
            wears["largest_sweep"] = self.largest_sweep
            step, weights = self.cycle(condition, turns)
            jumps, steps = list(stretches(inspections, turns)), len(weights)
            places = np.zeros((2 + steps * len(jumps), plants["z"].shape[1]))
            similar = self.lived(condition, {}, inspections, turns)[1] if relevant else places

            def advance(accelerations: Floats, begin: int) -> None:
                rows = slice(begin, begin + len(accelerations))
                status = coupled.run_pair_beside(plants, wears, step, accelerations, places[rows], similar[rows], bool(relevant))
                self.check(status, plants, wears)

            advance(np.zeros(2), 0)
            found = {target: copied(wears) for target in inspections if target <= NOTHING}
            for k, (done, stretch, target) in enumerate(jumps):
                if "grease_age" in self.tables[0].by_name:
                    plants["grease_age"] = done + 0.5 * stretch
                advance(stretch / step * weights, 2 + k * steps)
                found[target] = copied(wears)
            return found, places[:0] if relevant else places

        return kept.get((condition, tuple(inspections), turns, relevant), run)


def stretches(inspections: list[float], turns: int) -> Iterator[tuple[float, float, float]]:
    """What the wear cycles of a life stand for: (time before, length, inspection it leads to) [s], growing in length."""
    done, (jump, longest) = 0.0, JUMPS.get(turns, FULL_JUMPS)
    for target in sorted(set(inspections)):
        while target - done > NOTHING:
            left = target - done
            stretch = left / max(1, math.ceil(left / jump - 1e-9))
            yield done, stretch, target
            done += stretch
            jump = min(longest, 2.0 * jump)


def fresh(condition: Condition) -> Condition:
    """The condition when new; a life does not know where its reducer is held."""
    return replace(condition, hours=0.0, locked_at=None)
