"""A reducer's life in jumps: one full meshing cycle stands for many hours.

In a full meshing cycle (z_c crank turns, every lobe meets every pin) the wear counts
``acceleration`` times.  Because the profile errors are exchanged all along, wear and
load distribution develop together within the cycle.  How long a jump may be is
decided by comparing it with two half as long, run from the same restored state: the
difference must stay below ``tolerance`` of the wear that was added.  The two halves,
which are the better result, are kept.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from orchestrator.faults import InputFault
from orchestrator.pair import Pair
from orchestrator.solve import Turn, measure

HOUR = 3600.0
# Surfaces of the wear unit that a result keeps, by the names of its table.
SURFACES = ("disc_wear", "pin_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear")
# What the error estimate looks at: deepest wear of each kind of surface.
WATCHED = ("disc_flank_um", "pin_um", "inner_raceway_um", "outer_raceway_um")

# Wear added by a jump that its error is relative to, at least, as a share of the depth.
LEAST_ADDED = 0.01
# Shortest jump that is cut for its error, as a share of the life: it shall end.
SHORTEST_SHARE = 0.005

# Harmonics of a profile that place its peak.
SMOOTH_HARMONICS = 12
# Points per bin when the peak between bins is looked for.
FINE = 16


@dataclass(frozen=True)
class LifeSettings:
    """How a life is run; hours are operating hours at the set speed and torque."""

    hours: float = 10_000.0
    tolerance: float = 0.01
    first_jump: float = 50.0
    largest_jump: float = 2_000.0
    smallest_jump: float = 1.0

    def check(self) -> None:
        """InputFault unless the numbers make sense together."""
        for name in ("hours", "tolerance", "first_jump", "largest_jump"):
            value = getattr(self, name)
            if not 0.0 < value < np.inf:
                raise InputFault(f"{name} = {value}: a positive finite number is needed")
        if self.tolerance > 0.5:
            raise InputFault(f"tolerance = {self.tolerance}: it is relative; 0.01 is usual, 0.5 the largest")


@dataclass
class Life:
    """What a life run has found so far, one entry per recorded hour."""

    settings: LifeSettings
    hours: list[float] = field(default_factory=list)
    figures: list[dict[str, float]] = field(default_factory=list)
    surfaces: list[dict[str, np.ndarray]] = field(default_factory=list)
    turns: list[Turn] = field(default_factory=list)
    next_jump: float = 0.0
    errors: list[float] = field(default_factory=list)
    cycles: int = 0

    def note(self, pair: Pair, error: float) -> None:
        """Record the present state of the pair."""
        record = pair.wear.record()
        turn, figures = measure(pair)
        self.hours.append(float(record["operating_time"][0]) / HOUR)
        self.surfaces.append({name: record[name][0].copy() for name in SURFACES})
        self.turns.append(turn)
        self.figures.append(figures | wear_figures(record))
        self.errors.append(error)


def wear_figures(record: np.ndarray) -> dict[str, float]:
    """Deepest wear and its place, from a wear unit's record.

    Places in degrees: on an inner raceway from the lobe's eccentric direction, on an
    outer one from the outward radial of its hole, both counted the way the cranks turn;
    on a tooth the local phase, 0 root and 180 tip.
    """
    sense = -1.0 if record["crank_speed"][0] < 0.0 else 1.0
    inner, inner_angle = peak_of_circle(record["inner_race_wear"][0])
    outer, outer_angle = peak_of_circle(record["outer_race_wear"][0])
    teeth = record["disc_wear"][0].reshape(-1, record["slide"].shape[-1])
    flank, phase = peak_of_circle(teeth)
    return {
        "inner_raceway_um": inner * 1e6,
        "outer_raceway_um": outer * 1e6,
        "disc_flank_um": flank * 1e6,
        "pin_um": float(record["pin_depth"].max()) * 1e6,
        "inner_peak_deg": signed_degrees(sense * inner_angle),
        "outer_peak_deg": signed_degrees(sense * outer_angle),
        "disc_peak_deg": abs(signed_degrees(phase)),
    }


def peak_of_circle(profiles: np.ndarray) -> tuple[float, float]:
    """(depth, angle [rad]) of the deepest place among closed profiles (..., bins).

    Both are those of the profile's first harmonics.  A jump samples the roller cage at
    the few hundred phases of its cycles and leaves a ripple of a few tenths of a
    percent that real hours average out; it would also shift the top of a broad hump by
    degrees.  A tooth's profile, zero at both roots, counts as closed.
    """
    rows = profiles.reshape(-1, profiles.shape[-1])
    row = rows[rows.max(axis=1).argmax()]
    if row.max() == 0.0:
        return 0.0, 0.0
    harmonics = np.fft.rfft(row)
    harmonics[SMOOTH_HARMONICS + 1 :] = 0.0
    fine = np.fft.irfft(harmonics, FINE * row.size) * FINE
    # Bin i covers [i, i + 1): its value stands in its middle.
    return float(fine.max()), 2.0 * np.pi * (fine.argmax() / FINE + 0.5) / row.size


def signed_degrees(angle: float) -> float:
    """Angle in degrees within (-180, 180]."""
    degrees = float(np.degrees(angle)) % 360.0
    return degrees - 360.0 if degrees > 180.0 else degrees


def run_cycle(pair: Pair, hours: float) -> None:
    """One full meshing cycle that counts as ``hours``; with a duty, cycles of its segments by their shares.

    Segments really alternate all the time.  Run one after the other, the first would find
    the surfaces less run in than the last, an error that goes with the hours.  There and
    back (1 2 3 2 1, the outer ones by halves) all have the same mean age, and it goes with
    the hours' square.
    """
    if not pair.duty:
        count_cycle(pair, hours)
        return
    *outer, last = pair.duty
    there = [(segment, 0.5 * segment.share) for segment in outer]
    for segment, share in [*there, (last, last.share), *reversed(there)]:
        pair.set_operation(segment.speed, segment.torque)
        count_cycle(pair, hours * share)


def count_cycle(pair: Pair, hours: float) -> None:
    """One full meshing cycle at the present speed and torque."""
    steps = pair.reducer.topology.lobes * pair.positions
    pair.wear.set("acceleration", hours * HOUR / (steps * pair.master.step_size))
    pair.master.run(steps)


def depths(pair: Pair) -> np.ndarray:
    """The watched depths, one number per kind of surface [um]."""
    figures = wear_figures(pair.wear.record())
    return np.array([figures[name] for name in WATCHED])


def jump(pair: Pair, hours: float) -> float:
    """Advance by ``hours`` in two halves; returns the error of one jump against them.

    The error is relative to the wear added, or to a hundredth of the depth if that is more.
    """
    saved, before = pair.master.save(), depths(pair)
    run_cycle(pair, hours)
    whole = depths(pair)
    pair.master.restore(saved)
    run_cycle(pair, 0.5 * hours)
    run_cycle(pair, 0.5 * hours)
    halves = depths(pair)
    added = halves - before
    # Wear below a picometre is rounding, no wear; a surface that hardly wears on says nothing of the jump.
    return float(np.max(np.abs(whole - halves) / np.maximum(added, np.maximum(1e-6, LEAST_ADDED * halves))))


def controlled_jump(pair: Pair, life: Life, hours: float) -> tuple[float, float, float]:
    """Jump by at most ``hours`` within the tolerance; (hours done, error, factor for the next).

    The error of a jump relative to its wear is proportional to its length.  Where a
    shorter jump is hardly better, the positions per turn limit the accuracy, not the jump:
    it is taken, and its error stands in the result.
    """
    tolerance = life.settings.tolerance
    smallest = max(life.settings.smallest_jump, SHORTEST_SHARE * life.settings.hours)
    before = np.inf
    while True:
        saved = pair.master.save()
        error = jump(pair, hours)
        life.cycles += 3
        if error <= tolerance:
            return hours, error, 0.9 * tolerance / max(error, 1e-12)
        if error > 0.7 * before or hours <= smallest:
            return hours, error, 1.0
        pair.master.restore(saved)
        before = error
        hours = max(smallest, hours * max(0.2, 0.5 * tolerance / error))


def live(pair: Pair, life: Life, progress: Callable[[Life], None], keep: Callable[[Life], None]) -> Life:
    """Run ``life`` to its end from where it stands.

    ``progress`` is called after each accepted jump, ``keep`` whenever the state is worth
    a checkpoint: at the start and after each accepted jump.
    """
    settings = life.settings
    if not life.hours:
        life.note(pair, 0.0)
        life.next_jump = min(settings.first_jump, settings.largest_jump)
        keep(life)
    while life.hours[-1] < settings.hours * (1.0 - 1e-9):
        left = settings.hours - life.hours[-1]
        hours = min(life.next_jump, left)
        # No last jump that is hardly worth a cycle: share what is left.
        if hours < left < 1.5 * hours:
            hours = 0.5 * left
        hours, error, factor = controlled_jump(pair, life, hours)
        life.note(pair, error)
        life.next_jump = min(settings.largest_jump, hours * min(2.0, max(0.5, factor)))
        keep(life)
        progress(life)
    return life


def as_arrays(life: Life) -> dict[str, list[float]]:
    """Figures as arrays parallel to ``hours``."""
    names = life.figures[0]
    return {"hours": life.hours} | {name: [f[name] for f in life.figures] for name in names} | {
        "error_estimate": life.errors
    }

