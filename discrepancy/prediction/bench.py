"""The reducer on a bench: runs of the compiled pair at stated conditions.

Runs are kept, so that parameters that a run does not depend on cost nothing.
"""

import copy
import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.lives import ROUGH_CYCLE, SHORT_CYCLE, Lives
from discrepancy.prediction.stations import Stations
from discrepancy.prediction.twins import OF_CHANGE, Places, Twins, corners, places_of, same
from discrepancy.prediction.units import TOLERANCE, Condition
from discrepancy.problem import ERROR, NEAR, ORDERS, Record
from fmu_src.arrays import Floats, copied
from fmu_src.threads import Once, Threads
from reducers.reducer import Reducer
from rv_plant.effects import EFFECTS
from studies import coupled
from studies.hysteresis import LOST_MOTION_SHARE, MEMORY
from wear_fmu import accumulator
from wear_fmu.variables import Resolution

# Surfaces are resolved as finely as inspections need, not as finely as a life run.
RESOLUTION = Resolution(flank=90, pin=90, raceway=180)
# Means over a turn: torque and cage speed are within 1e-4 of those of 72 positions; what values change in them, roughly, is seen
# within 1 % from seven.
MEAN_POSITIONS, FEW_MEAN_POSITIONS = 18, 7
# Held test: turning is averaged over positions of the cranks; what values change in it, roughly, over fewer (five see as much as
# eight, whose symmetry is that of the pins, three err by a tenth).
HELD_ANGLES, FEW_HELD_ANGLES = 16, 5
# Torques of the standard test's quarter, of the rated one: lost motion is within 0.3 % of that of a hundred even steps; what values
# change in it, roughly, is seen within a tenth from fewer.
QUARTER, FEW_OF_QUARTER = np.array([0.0, 0.01, 0.02, LOST_MOTION_SHARE, 0.06, 0.25, 0.5, 0.75, 1.0]), np.array([0.0, 0.015, LOST_MOTION_SHARE, 0.06, 1.0])
# Longest step of torque, of the rated one, where the way to a place matters: a loop is within 0.03 arcsec, and roughly so, within a tenth of what is changed.
TORQUE_STEP, ROUGH_TORQUE_STEP = 1.0 / 80.0, 1.0 / 16.0
# Runs that a search keeps: the last ones, and those beside which they start.
FEW_RUNS = 50
# From fewer than these, one is no small share of them.
LEAST_POSITIONS = 4
# Angles [rad], as many, of runs whose equilibria are near enough to start from: of values that are said to be near, and of the base model.
Starts = tuple[Floats, Floats]
# Turning of the cranks [rad] between two equilibria that is not divided.
LARGEST_CRANK_STEP = 1e3
# Equilibria that are worth a thread of their own; always parted so, for the same angles are the same whoever computes them.
PART = 1024
# Amplitudes beside which a running reducer is what its way has made of it: those of effects with states (friction's springs remember only while the
# input is held), and that with which cages lag behind.
RUNNING_MEMORY = ["skid_share", *(p.variable.name for name, e in EFFECTS.items() if e.states and name != "stribeck_friction" for p in e.amplitudes())]
# Of durations or torques.
NONE = np.zeros(0)
# A step on the spot takes the wear unit's contacts to angles that were set; one of no length only reads where they are, and FMUs refuse it [s].
MOMENT = 1e-12


class Bench(Lives):
    """Runs of one reducer with settings; every method takes the values of further parameters."""

    def __init__(self, reducer: Reducer, settings: Mapping[str, float], resolution: Resolution = RESOLUTION):
        super().__init__(reducer, settings, resolution)
        self.held_angles, self.mean_positions, self.quarter, self.torque_step = HELD_ANGLES, MEAN_POSITIONS, QUARTER, TORQUE_STEP
        # By its name (``conditions.angle_zero``) the output angle [rad] of the model at which a mounting's angle is 0, if it is not 0.
        self.zeros: dict[str, float] = {}
        # How finely runs are computed for a campaign's samples; None: at every sample.
        self.fineness: Fineness | None = None
        # By a record's angles those at which it is computed, if others share them.
        self.stations: Mapping[bytes, Stations] = {}
        self.twins = Twins()
        # What shares the parts of one run.
        self.threads = Threads()

    @cached_property
    def rougher(self) -> "Bench":
        """The same bench with the same runs, as coarse as a search allows."""
        other = copy.copy(self)
        other.__dict__["rougher"] = other
        other.fineness = self.fineness.roughly() if self.fineness else None
        other.held_angles, other.mean_positions, other.cycle_turns = FEW_HELD_ANGLES, FEW_MEAN_POSITIONS, ROUGH_CYCLE
        other.quarter, other.torque_step = FEW_OF_QUARTER, ROUGH_TORQUE_STEP
        return other

    def forgetful(self) -> "Bench":
        """The same bench with few runs of its own, for searches among many that nobody asks for again."""
        other = copy.copy(self)
        other.__dict__["rougher"] = other
        other.runs = Once(FEW_RUNS)
        return other

    def allowed(self, record: Record) -> float:
        """What a prediction of this record may err; 0 where nothing is known of its noise."""
        return self.fineness.allowed.get((ERROR if record.quantity == ORDERS else record.quantity, record.condition), 0.0) if self.fineness else 0.0

    def beside(self, key: tuple[Hashable, ...], base: Callable[[], tuple[Floats, Floats]], ways: Sequence[Floats] = ()) -> Floats:
        """Equilibria where the run of ``key`` (kind, condition, relevant values, way, ...) starts: those of one whose values are said to be near, or
        of the same values, along the same way or one of other ``ways``, if it was made; else of the ``base`` model's."""
        kind, condition, relevant, own_way, *rest = key
        assert isinstance(condition, Condition)
        near = self.relevant(NEAR.get() or {}, condition.hours > 0.0)
        for way in (own_way, *(other.tobytes() for other in ways)):
            for values in (near, relevant) if near else (relevant,):
                like = (kind, condition, values, way, *rest)
                found = self.runs.peek(like) if like != key else None
                if isinstance(found, tuple):
                    equilibria: Floats = found[1]
                    return equilibria
        return base()[1]

    def remembers(self, values: Mapping[str, float]) -> bool:
        """Whether a held output's place depends on the way to it: friction's springs, a seat that slips."""
        return any(values.get(name, self.starts[0][name]) != 0.0 for name in MEMORY)

    def forgets(self, condition: Condition, values: Mapping[str, float]) -> bool:
        """Whether what a running bench shows at an angle does not depend on the way there."""
        return condition.hours == 0.0 and not any(values.get(name, self.starts[0][name]) != 0.0 for name in RUNNING_MEMORY)

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
            passed, errors = angles[chosen], np.zeros(len(similar))

            def along(part: slice) -> None:
                plants = self.new_plant(setting, values, float(passed[0]), cage, z=similar[part][0])
                self.turn_on(plants, float(passed[part][0] - passed[0]))
                status = coupled.sweep_beside(plants, self.durations(setting, passed[part]), NONE, errors[part], similar[part])
                self.check((status, 0), plants, self.templates[1])

            self.threads.map(along, parts(len(passed)) if self.forgets(setting, values) else [slice(None)])
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
        if values.get("thermal_resistance", self.starts[0]["thermal_resistance"]) > 0.0:
            # A second pass: what depends on the losses of the first has settled.
            angles = np.concatenate([angles, angles + condition.direction * turn])
        found: Floats = self.running(condition, values, angles)[-positions:].mean(axis=0)
        return found

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
            self.check((coupled.sweep_beside(plants, NONE, applied, errors, similar), 0), plants, self.templates[1])
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

    def put_wear(self, wears: np.ndarray, plants: np.ndarray) -> None:
        """Profile errors of worn surfaces at the present angles, to which their unit (a copy that may be turned) is turned without wear."""
        for name in ("crank_angle", "output_angle", "cage_angle"):
            wears[name] = wears[f"{name}_before"] = plants[name]
        wears["acceleration"] = wears["crank_speed"] = 0.0
        self.check((0, accumulator.step(wears, 0.0, MOMENT)), plants, wears)
        for name in ("mesh_profile_error", "roller_profile_error"):
            plants[name] = wears[name]


def parts(count: int, equilibria: int = 1) -> list[slice]:
    """So many angles, of so many ``equilibria`` each, in parts of about the same length."""
    wanted = min(count, max(1, round(count * equilibria / PART)))
    ends = [k * count // wanted for k in range(wanted + 1)]
    return [slice(*pair) for pair in pairwise(ends)]


def positions_of(condition: Condition, positions: int) -> int:
    """Of how many positions of the cranks a held test is the mean: one where it is stated."""
    return positions if condition.locked_at is None else 1
