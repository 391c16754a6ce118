"""The running bench: what shows over the output's angle, and means over a turn of the cranks."""

import math
from collections.abc import Mapping

import numpy as np

from discrepancy.prediction.runs import MOMENT, NONE, Runs, parts
from discrepancy.prediction.twins import OF_CHANGE, Places, corners, places_of, same
from discrepancy.prediction.units import TOLERANCE, Condition
from fmu_src.arrays import Floats, copied
from rv_plant.effects import EFFECTS
from studies import coupled

# Means over a turn: torque and cage speed are within 1e-4 of those of 72 positions.
MEAN_POSITIONS = 18
# Angles [rad], as many, of runs whose equilibria are near enough to start from: of values that are said to be near, and of the base model.
Starts = tuple[Floats, Floats]
# Turning of the cranks [rad] between two equilibria that is not divided.
LARGEST_CRANK_STEP = 1e3
# Amplitudes beside which a running reducer is what its way has made of it: those of effects with states (friction's springs remember only while the
# input is held), and that with which cages lag behind.
RUNNING_MEMORY = ["skid_share", *(p.variable.name for name, e in EFFECTS.items() if e.states and name != "stribeck_friction" for p in e.amplitudes())]


class Running(Runs):
    """Series over the output's angle; what values change in means over a turn is seen from ``mean_positions`` positions of the cranks."""

    mean_positions: int

    def forgets(self, condition: Condition, values: Mapping[str, float]) -> bool:
        """Whether what a running bench shows at an angle does not depend on the way there."""
        return condition.hours == 0.0 and not self.has(RUNNING_MEMORY, values)

    def running(self, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0) -> Floats:
        """What a running bench shows at output angles [rad]; columns as coupled.COLUMNS.

        ``cage`` is how far the roller cages stand ahead at the first angle [rad].
        """
        return self.running_places(condition, values, angles, cage)[0]

    def column(self, name: str, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0,
               starts: Starts | None = None) -> Floats:  # fmt: skip
        """One column of ``running``, which may be that of another condition under which it is the same."""
        k = coupled.COLUMNS.index(name)

        def repeats(other: Condition, chosen: Places) -> bool:
            known, places = self.running_places(other, values, angles, cage, starts)
            plants = self.new_plant(condition, values, float(angles[0]), cage, largest_crank_step=LARGEST_CRANK_STEP, z=places[0])
            seen, durations = np.zeros((len(chosen), len(coupled.COLUMNS))), self.durations(condition, angles[chosen])
            status = coupled.sweep(plants, self.templates[1], durations, seen, False, places[chosen], places[chosen], True)
            self.check(status, plants, self.templates[1])
            base = self.running_places(other, {}, starts[-1] if starts else angles)[0] if self.relevant(values, False) else known
            # Forces on the housing cancel but for what equilibria leave.
            left = TOLERANCE * self.rated_load / self.starts[0]["pin_circle_radius"] if name.startswith("housing_force") else 0.0
            return same(seen[:, k], known[chosen, k], known[:, k], base[:, k], left)

        run = ("running", k, self.relevant(values, condition.hours > 0.0), angles.tobytes(), cage)
        return self.running_places(self.twins.of(run, condition, places_of(len(angles)), repeats), values, angles, cage, starts)[0][:, k]

    def durations(self, condition: Condition, angles: Floats) -> Floats:
        """Times [s] in which the output turns to each of its ``angles`` from the one before."""
        found: Floats = np.maximum(np.abs(np.diff(angles, prepend=angles[0])) / (condition.speed / abs(self.ratio)), MOMENT)
        return found

    def running_places(self, condition: Condition, values: Mapping[str, float], angles: Floats, cage: float = 0.0,
                       starts: Starts | None = None) -> tuple[Floats, Floats]:  # fmt: skip
        """(series, equilibria): the equilibria of the base model are where others start."""
        relevant = self.relevant(values, condition.hours > 0.0)
        key = ("running", condition, relevant, angles.tobytes(), cage)

        def run() -> tuple[Floats, Floats]:
            # Beside a similar run each angle has a start of its own, however far the cranks turn between them.
            guessed = bool(relevant) or cage != 0.0
            step = LARGEST_CRANK_STEP if guessed and condition.hours == 0.0 else 1.0
            places = np.zeros((len(angles), self.templates[0]["z"].shape[1]))
            if cage != 0.0:
                similar = self.running_places(condition, values, angles, 0.0, starts)[1]
            else:
                base = starts[-1] if starts else angles
                similar = self.beside(key, lambda: self.running_places(condition, {}, base), starts or ()) if relevant else places
            series = np.zeros((len(angles), len(coupled.COLUMNS)))

            def along(part: slice) -> None:
                plants = self.new_plant(condition, values, float(angles[0]), cage, largest_crank_step=step, z=similar[part][0])
                self.turn_on(plants, float(angles[part][0] - angles[0]))
                # The wear unit of a new reducer has nothing to do.
                wears = self.templates[1]
                if condition.hours > 0.0:
                    wears = copied(self.worn(condition, values, condition.hours))
                    for name in ("crank_angle", "output_angle", "cage_angle"):
                        wears[name] = wears[f"{name}_before"] = plants[name]
                    wears["acceleration"] = 0.0
                    # The profile errors of the first angle, before it counts.
                    self.put_wear(copied(wears), plants)
                durations = self.durations(condition, angles[part])
                status = coupled.sweep(plants, wears, durations, series[part], condition.hours > 0.0, places[part], similar[part], guessed)
                self.check(status, plants, wears)

            self.threads.map(along, parts(len(angles)) if guessed and self.forgets(condition, values) else [slice(None)])
            return series, places

        return self.kept(key, run)

    def error_beside(self, condition: Condition, values: Mapping[str, float], angles: Floats,
                     base: Mapping[str, float], base_angles: Floats, cage: float = 0.0, starts: Starts | None = None) -> Floats:  # fmt: skip
        """Transmission error [rad] of a new reducer with ``values`` and cages ``cage`` ahead, to first order beside the run with ``base``."""
        relevant, before = self.relevant(values, False), self.relevant(base, False)

        def beside(setting: Condition, chosen: slice | Places, similar: Floats) -> Floats:
            passed, errors, forgets = angles[chosen], np.zeros(len(similar)), self.forgets(setting, values)

            def along(part: slice) -> None:
                plants = self.new_plant(setting, values, float(passed[0]), cage, z=similar[part][0])
                self.turn_on(plants, float(passed[part][0] - passed[0]))
                status = coupled.sweep_beside(plants, self.durations(setting, passed[part]), NONE, errors[part], similar[part], forgets)
                self.check((status, 0), plants, self.templates[1])

            self.threads.map(along, parts(len(passed)) if forgets else [slice(None)])
            return errors

        def whole(setting: Condition) -> Floats:
            key = ("beside", setting, relevant, before, angles.tobytes(), base_angles.tobytes(), cage)
            return self.kept(key, lambda: beside(setting, slice(None), self.running_places(setting, base, base_angles, 0.0, starts)[1]))

        def repeats(other: Condition, chosen: Places) -> bool:
            series, places = self.running_places(other, base, base_angles, 0.0, starts)
            known = whole(other)
            return same(beside(condition, chosen, places[chosen]), known[chosen], known, series[:, coupled.COLUMNS.index("transmission_error")])

        run = ("beside", relevant, before, angles.tobytes(), base_angles.tobytes(), cage)
        return whole(self.twins.of(run, condition, places_of(len(angles)), repeats))

    def average(self, name: str, condition: Condition, values: Mapping[str, float]) -> float:
        """Mean of a column of ``running`` over one turn of the cranks."""
        k = coupled.COLUMNS.index(name)
        whole = float(self.means(condition, {}, MEAN_POSITIONS)[k])
        if not self.relevant(values, condition.hours > 0.0):
            return whole

        def change(setting: Condition) -> float:
            # What the values change, roughly seen from fewer positions.
            return float(self.means(setting, values, self.mean_positions)[k] - self.means(setting, {}, self.mean_positions)[k])

        extremes = self.kept(("corners", condition), lambda: corners(condition, self.planned))
        if extremes:
            changes = np.array([change(c) for c in extremes])
            if float(np.ptp(changes)) <= OF_CHANGE * float(np.abs(changes).max()) + TOLERANCE * abs(whole):
                # At all speeds and temperatures between them, too.
                return whole + float(changes[0])
        return whole + change(condition)

    def lag(self, condition: Condition) -> float:
        """Mean of the output's angle less the input's over the ratio [rad], of the base model."""
        return self.average("transmission_error", condition, {})

    def means(self, condition: Condition, values: Mapping[str, float], positions: int) -> Floats:
        """Mean of each column over ``positions`` of a turn of the cranks."""
        return self.kept(("means", condition, self.relevant(values, condition.hours > 0.0), positions), lambda: self.mean_run(condition, values, positions))

    def mean_run(self, condition: Condition, values: Mapping[str, float], positions: int) -> Floats:
        turn = 2.0 * math.pi / self.reducer.topology.lobes
        angles = condition.direction * np.linspace(0.0, turn, positions, endpoint=False)
        if self.has(["thermal_resistance"], values):
            # A second pass: what depends on the losses of the first has settled.
            angles = np.concatenate([angles, angles + condition.direction * turn])
        found: Floats = self.running(condition, values, angles)[-positions:].mean(axis=0)
        return found
