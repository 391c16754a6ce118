"""Held tests: how far the output turns under torques while the input stands still."""

import math
from collections.abc import Mapping

import numpy as np

from discrepancy.prediction.lives import SHORT_CYCLE
from discrepancy.prediction.runs import NONE, Runs, parts
from discrepancy.prediction.twins import Places, places_of, same
from discrepancy.prediction.units import Condition
from fmu_src.arrays import Floats, copied
from studies import coupled
from studies.hysteresis import MEMORY

# Turning is averaged over so many positions of the cranks.
HELD_ANGLES = 16
# From fewer than these, one is no small share of them.
LEAST_POSITIONS = 4


class Held(Runs):
    """Turning of the output with the input held; what values change in it is seen from ``held_angles`` positions of the cranks."""

    held_angles: int

    def remembers(self, values: Mapping[str, float]) -> bool:
        """Whether a held output's place depends on the way to it: friction's springs, a seat that slips."""
        return self.has(MEMORY, values)

    def held(self, condition: Condition, values: Mapping[str, float], torques: Floats, positions: int = HELD_ANGLES) -> Floats:
        """Turning [rad] of the output under torques [N m] applied in order, input held; mean over crank positions, or at the condition's one."""
        positions = positions_of(condition, positions)
        whole = self.held_mean(condition, {}, torques, positions, SHORT_CYCLE)
        if not self.relevant(values, condition.hours > 0.0):
            return whole
        fewer = min(self.held_angles, positions)
        turning = self.held_mean(condition, values, torques, fewer, self.cycle_turns)
        if fewer == positions and (condition.hours == 0.0 or self.cycle_turns == SHORT_CYCLE):
            return turning
        # What the values change, seen from fewer positions and by rougher lives.
        return whole + turning - self.held_mean(condition, {}, torques, fewer, self.cycle_turns)

    def held_mean(self, condition: Condition, values: Mapping[str, float], torques: Floats, positions: int, turns: int) -> Floats:
        """``held`` from so many positions."""
        found: Floats = (self.held_turnings(condition, values, torques, positions, turns) / positions).sum(axis=0)
        return found

    def held_halves(self, condition: Condition, torques: Floats) -> Floats:
        """Half of what every other position's mean differs by from that of the rest, in the base model: about what ``held`` may err as a mean."""
        turning = self.held_turnings(condition, {}, torques, HELD_ANGLES, SHORT_CYCLE)
        found: Floats = 0.5 * (turning[0::2].mean(axis=0) - turning[1::2].mean(axis=0))
        return found

    def held_turnings(self, condition: Condition, values: Mapping[str, float], torques: Floats, positions: int, turns: int) -> Floats:
        """Turning [rad] from each of so many positions, which may be that of another condition under which it is the same."""

        def repeats(other: Condition, chosen: Places) -> bool:
            known, places = self.held_places(other, values, torques, positions, turns)
            seen, found = np.zeros(len(chosen)), np.zeros((len(chosen), places.shape[2]))
            plants = self.new_held(condition, values, 0.0, torques, places[0][0])
            self.check((coupled.torque_sweep(plants, torques[chosen], seen, found, places[0][chosen], True), 0), plants, self.templates[1])
            base = self.held_places(other, {}, torques, positions, turns)[0] if self.relevant(values, False) else known
            return same(seen, known[0][chosen], known[0], base[0])

        run = ("held", self.relevant(values, condition.hours > 0.0), torques.tobytes(), positions, turns)
        # A way that leaves its mark is gone again whole, from one position.
        chosen = np.arange(len(torques)) if self.remembers(values) else places_of(len(torques))
        twin = self.twins.of(run, condition, chosen if positions >= LEAST_POSITIONS else None, repeats)
        return self.held_places(twin, values, torques, positions, turns)[0]

    def new_held(self, condition: Condition, values: Mapping[str, float], angle: float, torques: Floats, z: Floats) -> np.ndarray:
        """A plant with its input held at an output angle [rad] under the first of ``torques``; its equilibrium is looked for from ``z`` on."""
        return self.new_plant(condition, values, angle, condition.cage, input_speed=0.0, load_torque=float(torques[0]), z=z)

    def held_places(self, condition: Condition, values: Mapping[str, float], torques: Floats, positions: int, turns: int) -> tuple[Floats, Floats]:
        """(turning, equilibria), each by crank position: those of the base model are where others start."""
        worn = condition.hours > 0.0
        relevant = self.relevant(values, worn)
        key = ("held", condition, relevant, torques.tobytes(), positions, turns if worn else 0)

        def run() -> tuple[Floats, Floats]:
            turning = np.zeros((positions, len(torques)))
            places = np.zeros((positions, len(torques), self.templates[0]["z"].shape[1]))
            similar = self.beside(key, lambda: self.held_places(condition, {}, torques, positions, turns)) if relevant else places
            guessed, remembers = bool(relevant), self.remembers(values)
            surfaces = self.worn(condition, values, condition.hours, turns) if worn else None
            angles = self.held_at(condition, positions)

            def at(part: slice) -> None:
                plants, worn_there = None, None if surfaces is None else copied(surfaces)
                for k in range(*part.indices(positions)):
                    z = similar[k][0] if guessed else np.zeros(places.shape[2])
                    if plants is None or remembers or not guessed:
                        plants = self.new_held(condition, values, angles[k], torques, z)
                    else:
                        self.place(plants, angles[k], condition.cage, z=z, advance_before=0.0)
                    if worn_there is not None:
                        self.put_wear(worn_there, plants)
                    status = coupled.torque_sweep(plants, torques, turning[k], places[k], similar[k], guessed)
                    self.check((status, 0), plants, self.templates[1])

            self.threads.map(at, parts(positions, len(torques)))
            return turning, places

        return self.kept(key, run)

    def held_at(self, condition: Condition, positions: int) -> list[float]:
        """Output angles [rad] at which the cranks stand in so many places of a turn, or the condition's one."""
        if condition.locked_at is not None:
            return [condition.locked_at]
        return [2.0 * math.pi * k / (positions * self.reducer.topology.lobes) for k in range(positions)]

    def held_beside(self, condition: Condition, values: Mapping[str, float], torques: Floats, base: Mapping[str, float]) -> Floats:
        """``held`` of a new reducer with ``values`` to first order beside the run with ``base``; neither may remember its way."""
        positions, relevant, before = positions_of(condition, self.held_angles), self.relevant(values, False), self.relevant(base, False)

        def beside(setting: Condition, angle: float, chosen: slice | Places, similar: Floats) -> Floats:
            applied, errors = torques[chosen], np.zeros(len(similar))
            plants = self.new_held(setting, values, angle, applied, similar[0])
            self.check((coupled.sweep_beside(plants, NONE, applied, errors, similar, True), 0), plants, self.templates[1])
            # The output turns in the torque's sense.
            return -errors

        def whole(setting: Condition) -> Floats:
            def run() -> Floats:
                similar = self.held_places(setting, base, torques, positions, SHORT_CYCLE)[1]
                return np.array([beside(setting, angle, slice(None), similar[k]) for k, angle in enumerate(self.held_at(setting, positions))])

            return self.kept(("held beside", setting, relevant, before, torques.tobytes(), positions), run)

        def repeats(other: Condition, chosen: Places) -> bool:
            turning, places = self.held_places(other, base, torques, positions, SHORT_CYCLE)
            known = whole(other)[0]
            return same(beside(condition, self.held_at(condition, positions)[0], chosen, places[0][chosen]), known[chosen], known, turning[0])

        run = ("held beside", relevant, before, torques.tobytes(), positions)
        found: Floats = (whole(self.twins.of(run, condition, places_of(len(torques)), repeats)) / positions).sum(axis=0)
        return found


def positions_of(condition: Condition, positions: int) -> int:
    """Of how many positions of the cranks a held test is the mean: one where it is stated."""
    return positions if condition.locked_at is None else 1
