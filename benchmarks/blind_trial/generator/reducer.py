"""The plain reducer, by the compiled kernels with this generator's own steps, resolution and life integration."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchmarks.blind_trial.generator import stepping
from benchmarks.blind_trial.generator.stepping import COLUMNS
from fmu_src.arrays import Floats
from reducers.reducer import Reducer, load_reducer
from rv_plant import plant
from rv_plant.gear_stage import total_ratio
from wear_fmu import accumulator
from wear_fmu.variables import Resolution

# With rigid supports and no losses, and as soft, as loose and as lossy as a real one.
RIGID, SOFT = "RV20E-121-rigid", "RV20E-121"
HOUR = 3600.0
# Of the bearings' rollers [N], nominal.
ROLLER_STIFFNESS = {RIGID: 5.1e5, SOFT: 2.37e5}
# Not those of the tool's bench.
RESOLUTION = Resolution(flank=72, pin=60, raceway=144)
# Crank turns of a wear cycle and positions in each: quick, for the size of a law, and whole, for what is measured
# (a quick life errs by 1 %, which a rich null campaign would show).
QUICK, WHOLE = (10, 30), (39, 48)
TORQUE_POSITIONS = 20
HELD_POSITIONS = 12
# Longest step of a held torque where friction remembers its way, of the rated one: for the size of a law, and for what is measured.
QUICK_STEP, WHOLE_STEP = 1.0 / 60.0, 1.0 / 250.0
# Share of the rated torque below which a held output floats in its play, and no step ends.
FLOATING = 0.003
FIRST_JUMP, JUMP_GROWTH, LONGEST_JUMP = 25.0 * HOUR, 1.6, 800.0 * HOUR
# Changes records before a run; factor on the wear of a surface ("flank", "race") in the course of a life.
Change = Callable[[np.ndarray], None]
Rate = Callable[[str, Mapping[str, float]], float]
# Further gaps of the pins (steps, discs, pins) [m] at output angles [rad] under forces [N] of that shape.
Gaps = Callable[[Floats, Floats], Floats]
# Gaps that follow the forces are found by so many runs, from none.
PASSES = 4
# No force is so small that it would not wear.
ALL_WEAR = np.array([0.0, 1.0, 1.0])
SURFACES = ("flank", "pin", "inner_race", "outer_race")


@dataclass(frozen=True)
class Setting:
    """What the bench is set to, SI; ``direction`` +1 or -1."""

    speed: float
    load: float
    temperature: float = 293.15
    hours: float = 0.0
    direction: int = 1


class Plain:
    """One reducer with its true (not nominal) parameters."""

    def __init__(self, parameters: dict[str, float] | None = None, cycle: tuple[int, int] = QUICK, resolution: Resolution = RESOLUTION,
                 name: str = RIGID):
        self.cycle, self.name = cycle, name
        reducer = load_reducer(name)
        self.reducer = Reducer(**{**reducer.__dict__, "resolution": resolution})
        self.plants, self.wears = self.reducer.plant.new_records(), self.reducer.wear.new_records()
        for name, value in (parameters or {}).items():
            for records in (self.plants, self.wears):
                if name in (records.dtype.names or ()):
                    records[name] = value
        t = reducer.topology
        ratio = float(total_ratio(float(self.plants["first_stage_ratio"][0]), t.pins, t.lobes))
        self.ratio, self.sense = abs(ratio), math.copysign(1.0, ratio)
        self.lobes = t.lobes
        self.torque_step = QUICK_STEP if cycle == QUICK else WHOLE_STEP
        # A held output's place depends on the way there, and the input's torque is more than the load's share.
        self.rubs = float(self.plants["mesh_friction"][0]) > 0.0
        self.rated_load, self.rated_speed = float(self.plants["load_torque"][0]), float(self.plants["input_speed"][0])

    def start(
        self, setting: Setting, parts: Change | None = None, surfaces: Change | None = None, **more: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Initialised records of both units; ``parts(p)`` and ``surfaces(w)`` may change them before."""
        p, w = self.plants.copy(), self.wears.copy()
        p["input_speed"] = self.sense * setting.direction * setting.speed
        p["load_torque"] = setting.direction * setting.load
        p["temperature"] = w["temperature"] = setting.temperature
        p["largest_crank_step"] = 1.0
        for name, value in more.items():
            p[name] = value
        if parts is not None:
            parts(p)
        require(plant.initialise(p) == 0)
        for name in ("crank_angle", "crank_speed", "output_angle", "cage_angle"):
            w[name] = p[name]
        require(accumulator.initialise(w) == 0)
        if surfaces is not None:
            surfaces(w)
        w["acceleration"] = 0.0
        return p, w

    def sweep(
        self, setting: Setting, angles: Floats, cage: float, parts: Change | None = None, surfaces: Change | None = None,
        gaps: Gaps | None = None,
    ) -> Floats:
        """What turning through ``angles`` [rad] of the output shows; columns as COLUMNS."""
        order = np.argsort(angles, kind="stable")[:: setting.direction]
        way = angles[order]
        if gaps is not None:
            found = np.empty((len(way), len(COLUMNS)))
            found[order] = self.sweep_with_gaps(setting, way, cage, gaps, parts)
            return found
        p, w = self.start(setting, parts, surfaces, ideal_output=float(way[0]), cage=cage)
        series = np.zeros((len(way), len(COLUMNS)))
        if surfaces is not None:
            require(stepping.run(p, w, 1, 0.0, ALL_WEAR))
        durations = np.abs(np.diff(way, prepend=way[0])) * self.ratio / setting.speed
        require(stepping.turn(p, w, durations, series, surfaces is not None, ALL_WEAR))
        back = np.empty_like(series)
        back[order] = series
        return back

    def sweep_with_gaps(self, setting: Setting, way: Floats, cage: float, gaps: Gaps, parts: Change | None) -> Floats:
        """``sweep`` along a way of a new reducer; all columns but the rollers' load."""
        series, forces = np.zeros((len(way), len(COLUMNS))), np.zeros((len(way), *self.plants["mesh_force"].shape[1:]))
        durations = np.abs(np.diff(way, prepend=way[0])) * self.ratio / setting.speed
        for _ in range(PASSES):
            wanted = gaps(way, forces)

            def first(p: np.ndarray, at: Floats = wanted[0]) -> None:
                p["mesh_profile_error"][0] = at

            p, _w = self.start(setting, both(parts, first), None, ideal_output=float(way[0]), cage=cage)
            require(stepping.turn_with_gaps(p, durations, series, wanted, forces))
        return series

    def means(self, setting: Setting, parts: Change | None = None) -> dict[str, float]:
        """Means over one turn of the cranks."""
        angles = np.linspace(0.0, 2.0 * math.pi / self.lobes, TORQUE_POSITIONS, endpoint=False)
        return dict(zip(COLUMNS, self.sweep(setting, angles, 0.3, parts).mean(axis=0)))

    def held(self, setting: Setting, torques: Floats, parts: Change | None = None, surfaces: Change | None = None) -> Floats:
        """Turning [rad] under output torques in order, input held."""
        torques, places = self.way_of(torques)
        total = np.zeros(len(torques))
        for k in range(HELD_POSITIONS):
            angle = 2.0 * math.pi * (k + 0.5) / (HELD_POSITIONS * self.lobes)
            p, w = self.start(setting, parts, surfaces, input_speed=0.0, load_torque=float(torques[0]), ideal_output=angle, cage=0.1 * k)
            if surfaces is not None:
                require(stepping.run(p, w, 1, 0.0, ALL_WEAR))
                p["load_torque"] = torques[0]
            turning = np.zeros(len(torques))
            require(stepping.load(p, torques, turning))
            total += turning / HELD_POSITIONS
        return total[places]

    def way_of(self, torques: Floats) -> tuple[Floats, npt.NDArray[np.intp]]:
        """The way on which a drive goes from hardly any torque to the first and from torque to torque, and where those are in it: one step each where
        nothing remembers."""
        if not self.rubs:
            return torques, np.arange(len(torques))
        least, step = FLOATING * self.rated_load, self.torque_step * self.rated_load
        stations = np.concatenate([[math.copysign(least, torques[0])], torques])
        counts = np.concatenate([[1], np.maximum(np.ceil(np.abs(np.diff(stations)) / step).astype(int), 1)])
        way = np.interp(np.arange(counts.sum()), np.cumsum(counts) - 1, stations)
        own = np.zeros(len(way), bool)
        own[np.cumsum(counts)[1:] - 1] = True
        kept = own | (np.abs(way) >= 0.999 * least)
        return way[kept], np.flatnonzero(own[kept])

    def live(
        self, setting: Setting, inspections: list[float], rate: Rate | None = None, parts: Change | None = None, mild: Floats = ALL_WEAR
    ) -> list[np.ndarray]:
        """Wear records at operating times [s]; ``rate(surface, life) -> factor`` on the wear of flanks and races.

        ``mild`` as in ``stepping.run``; ``life`` has the keys hours, travel, depth (by surface), iron (kg).
        """
        p, w = self.start(setting, parts)
        turn = 2.0 * math.pi * self.ratio / (setting.speed * self.lobes)
        turns, positions = self.cycle
        step, steps = turn / positions, turns * positions
        mesh, rough = float(w["mesh_wear_coefficient"][0]), float(w["roughness"][0])
        require(stepping.run(p, w, 3, step, mild))
        done, jump, found = 0.0, FIRST_JUMP, []
        for target in inspections:
            while target - done > 1.0:
                stretch = min(jump, target - done) if target - done > 1.3 * jump else target - done
                w["acceleration"] = stretch / (steps * step)
                if rate is not None:
                    life = life_of(w[0], done + 0.5 * stretch)
                    w["mesh_wear_coefficient"] = mesh * rate("flank", life)
                    # The raceways' law grows with roughness^1.589.
                    w["roughness"] = rough * rate("race", life) ** (1.0 / 1.589)
                require(stepping.run(p, w, steps, step, mild))
                done += stretch
                jump = min(LONGEST_JUMP, JUMP_GROWTH * jump)
            found.append(w.copy())
        return found


def both(first: Change | None, second: Change | None) -> Change | None:
    """Two hooks on the same record, one after the other."""
    if first is None or second is None:
        return first or second

    def run(records: np.ndarray) -> None:
        first(records)
        second(records)

    return run


def life_of(w: np.void, hours: float) -> dict[str, float]:
    volume = w["flank_volume"] + w["pin_volume"] + w["inner_race_volume"] + w["outer_race_volume"]
    return {"hours": hours / HOUR, "travel": float(w["crank_travel"]), "iron": 7850.0 * float(volume),
            "flank": float(w["flank_depth"].max()), "race": float(w["inner_race_depth"].max())}


def require(ok: bool) -> None:
    if not ok:
        raise RuntimeError("the plain reducer has no equilibrium with these parts")


def print_of(w: np.ndarray, surface: str) -> tuple[Floats, Floats]:
    """(angle [rad], depth [m]) of the worn surface: mean flank and pin, deepest race."""
    r = w[0]
    if surface == "pin":
        depth = (r["pin_wear"] + r["pin_even_wear"][..., None]).sum(axis=0).mean(axis=0)
        return (np.arange(len(depth)) + 0.5) / len(depth) * math.pi - 0.5 * math.pi, depth
    if surface == "flank":
        depth = r["disc_wear"].reshape(-1, r["slide"].shape[0]).mean(axis=0)
    else:
        races = r[{"inner_race": "inner_race_wear", "outer_race": "outer_race_wear"}[surface]]
        races = races.reshape(-1, races.shape[-1])
        depth = races[races.sum(axis=1).argmax()]
    return (np.arange(len(depth)) + 0.5) / len(depth) * 2.0 * math.pi, depth


def rounded(depth: Floats, share: float = 0.06) -> Floats:
    """Closed profile averaged over a share of its length by a Hann window: a stylus has a radius."""
    half = max(1, int(share * len(depth)) // 2)
    window = np.hanning(2 * half + 3)[1:-1]
    padded = np.concatenate([depth[-half:], depth, depth[:half]])
    return np.convolve(padded, window / window.sum(), "valid")


def deepest(w: np.ndarray, surface: str) -> float:
    depth = print_of(w, surface)[1]
    return float(depth.max() if surface == "pin" else rounded(depth, 0.04).max())


def lost_mass(w: np.ndarray, part: str) -> float:
    names = {"disc": ("flank_volume", "outer_race_volume"), "pin": ("pin_volume",), "crank": ("inner_race_volume",)}
    return 7850.0 * sum(float(w[0][n]) for n in names.get(part, sum(names.values(), ())))
