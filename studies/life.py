"""A reducer's life in jumps: one full meshing cycle stands for many hours.

In a full meshing cycle (z_c crank turns, every lobe meets every pin) the wear counts
``acceleration`` times.  Because the profile errors are exchanged all along, wear and
load distribution develop together within the cycle.  The jumps grow in proportion to the
root of the hours, because new parts wear fastest.  How many a life needs is decided by
running the whole of it again with several times as many, until depths of both runs agree
within ``tolerance`` of the depth at the end.  The finer run is kept.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, RunFault
from rv_plant.faults import DYNAMIC
from studies.coupled_master import CoupledMaster
from studies.pair import Pair
from studies.solve import ARCSEC, Turn, measure
from studies.swing import swing_damping

HOUR = 3600.0
# Surfaces of the wear unit that a result keeps, by the names of its table.
SURFACES = ("disc_wear", "pin_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear")
# What the error estimate looks at: deepest wear of each kind of surface.
WATCHED = ("disc_flank_um", "pin_um", "inner_raceway_um", "outer_raceway_um")

# Jumps of the first run are this over the root of the tolerance: its error falls with their number to the power of 1 to 2.
FIRST_JUMPS = 0.3
# Where jumps are long against running-in, twice as many do not halve the error; the estimate is raised by this.
CAUTION = 1.3
# The order at which the error is taken to fall, where it seems to fall faster.
HIGHEST_ORDER = 1.5
# A depth below a picometre is rounding, no wear [um].
LEAST_DEPTH = 1e-6
# No more jumps than this: the life shall end.
MOST_JUMPS = 256
# Unless so many points of the curve are asked for.
MOST_ASKED = 10_000
# From this many jumps on, an error that hardly falls is that of the positions per turn.
MANY_JUMPS = 32

# Harmonics of a profile that place its peak.
SMOOTH_HARMONICS = 12
# Points per bin when the peak between bins is looked for.
FINE = 16


@dataclass(frozen=True)
class LifeSettings:
    """How a life is run; hours are operating hours at the set speed and torque."""

    hours: float = 10_000.0
    tolerance: float = 0.01
    # No longer than these, whatever the tolerance: points of the curve over the hours.
    first_jump: float | None = None
    largest_jump: float | None = None

    def check(self) -> None:
        """InputFault unless the numbers make sense together."""
        for name in ("hours", "tolerance", "first_jump", "largest_jump"):
            value = getattr(self, name)
            if value is not None and not 0.0 < value < np.inf:
                raise InputFault(f"{name} = {value}: a positive finite number is needed")
        if self.tolerance > 0.5:
            raise InputFault(f"tolerance = {self.tolerance}: it is relative; 0.01 is usual, 0.5 the largest")
        least = (2.0 * FIRST_JUMPS / MOST_JUMPS) ** 2
        if self.tolerance < least:
            raise InputFault(f"tolerance = {self.tolerance:g}: it would need more than {MOST_JUMPS} jumps; {least:.1g} is the smallest")
        if not self.wanted_jumps() <= MOST_ASKED:
            raise InputFault(
                f"first_jump = {self.first_jump}, largest_jump = {self.largest_jump}: more than {MOST_ASKED} jumps in {self.hours:g} h; give longer ones"
            )

    def first_jumps(self) -> int:
        """Jumps of the first run."""
        return math.ceil(self.wanted_jumps() * (1.0 - 1e-9))

    def wanted_jumps(self) -> float:
        number = FIRST_JUMPS / math.sqrt(self.tolerance)
        # Of n jumps the first takes 1/n^2 of the hours, the last (2 n - 1)/n^2.
        if self.first_jump is not None:
            number = max(number, math.sqrt(self.hours / self.first_jump))
        if self.largest_jump is not None:
            share = max(1.0, self.hours / self.largest_jump)
            number = max(number, share + math.sqrt(share * (share - 1.0)))
        return number


@dataclass
class Life:
    """What a life run has found so far, one entry per recorded hour of the present run.

    ``start`` is the state of the new pair; ``passes``: runs through the hours that were begun; ``coarse`` holds the watched depths [um]
    of the run before, whose error was ``error_before``.  ``over_turn`` has rows of hours and the transmission error's peak to peak over a turn of the
    output [arcsec]: of each jump but the first, at the middle of its hours, and at 0 h and at the end, where that is known; ``drifted``: hours
    from and to, and how far the output went on in the last jump [rad], if there was one.
    """

    settings: LifeSettings
    hours: list[float] = field(default_factory=list)
    figures: list[dict[str, float]] = field(default_factory=list)
    surfaces: list[dict[str, np.ndarray]] = field(default_factory=list)
    turns: list[Turn] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)
    cycles: int = 0
    jumps: int = 0
    passes: int = 0
    coarse: list[list[float]] = field(default_factory=list)
    error_before: float = math.inf
    start: dict[str, Any] | None = None
    over_turn: list[list[float]] = field(default_factory=list)
    drifted: list[float] = field(default_factory=list)

    def note(self, pair: Pair) -> None:
        """Record the present state of the pair."""
        record = pair.wear.record()
        turn, figures = measure(pair)
        self.hours.append(float(record["operating_time"][0]) / HOUR)
        self.surfaces.append({name: record[name][0].copy() for name in SURFACES})
        self.turns.append(turn)
        self.figures.append(figures | wear_figures(record))
        # Unknown until the run is held against a coarser one.
        self.errors.append(math.nan)

    def watched(self) -> list[list[float]]:
        """The watched depths of all recorded hours [um]."""
        return [[figures[name] for name in WATCHED] for figures in self.figures]

    def forget(self) -> None:
        """No recorded hours; what a new reducer has over a turn stays known."""
        for rows in (self.hours, self.figures, self.surfaces, self.turns, self.errors):
            rows.clear()
        self.over_turn, self.drifted = [row for row in self.over_turn if row[0] == 0.0], []

    def note_turn(self, span: float, errors: Floats, positions: int) -> None:
        """The transmission error [rad] of the jump that was recorded last; ``span``: hours of the cycle that it is of.

        How the output falls behind within a jump is told from this jump and the one before, so the first gives none.
        """
        end, before = self.hours[-1], self.drifted
        self.drifted = [end - span, end, drift_of(errors, positions)]
        if before:
            self.over_turn.append([end - 0.5 * span, swing_over_turn(errors, positions, before, self.drifted)])

    def over_turn_at_hours(self, known: Mapping[float, float] | None = None) -> list[float]:
        """Transmission error's peak to peak over a turn of the output at each recorded hour [arcsec].

        Between jumps straight from one to the next, and through hours at which it is ``known``; NaN if there was no jump.
        """
        swings = {row[0]: row[1] for row in self.over_turn} | dict(known or {})
        if not swings:
            return [math.nan] * len(self.hours)
        hours = sorted(swings)
        found: list[float] = np.interp(self.hours, hours, [swings[hour] for hour in hours]).tolist()
        return found


def wear_figures(record: np.ndarray) -> dict[str, float]:
    """Deepest wear and its place, from a wear unit's record.

    Places in degrees: on an inner raceway from the eccentric's direction, on an
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


def run_cycle(pair: Pair, hours: float) -> tuple[float, Floats]:
    """One full meshing cycle that counts as ``hours``; with a duty, cycles of its segments by their shares.

    Returned are the hours of the last cycle and its transmission error after each step [rad].

    Segments really alternate all the time.  Run one after the other, the first would find
    the surfaces less run in than the last, an error that goes with the hours.  There and
    back (1 2 3 2 1, the outer ones by halves) all have the same mean age, and it goes with
    the hours' square.
    """
    if not pair.duty:
        return hours, count_cycle(pair, hours)
    *outer, last = pair.duty
    there = [(segment, 0.5 * segment.share) for segment in outer]
    for segment, share in [*there, (last, last.share), *reversed(there)]:
        pair.set_operation(segment.speed, segment.torque)
        span, errors = hours * share, count_cycle(pair, hours * share)
    return span, errors


def count_cycle(pair: Pair, hours: float) -> Floats:
    """One full meshing cycle at the present speed and torque; the transmission error after each step [rad].

    Wear rises through the first crank turn and falls through one turn more.  A contact that the cycle meets early
    in each turn is then as old on average as one that it meets late; cut off sharply, the two would differ by
    the wear of a turn.
    """
    positions = pair.positions
    steps = pair.reducer.topology.lobes * positions
    full = hours * HOUR / (steps * pair.master.step_size)
    rise = (np.arange(positions) + 0.5) / positions
    errors = [count_steps(pair, full * share, 1) for share in rise]
    errors.append(count_steps(pair, full, steps - positions))
    errors += [count_steps(pair, full * share, 1) for share in rise[::-1]]
    return np.concatenate(errors)


def count_steps(pair: Pair, acceleration: float, steps: int) -> Floats:
    """Steps whose wear, time and distance count ``acceleration`` times; the transmission error after each [rad]."""
    pair.wear.set("acceleration", acceleration)
    errors = np.zeros(steps)
    if isinstance(pair.master, CoupledMaster) and pair.master.scheme == "gauss-seidel":
        pair.master.run_compiled(steps, errors)
        return errors
    buffer, done = np.zeros(1), pair.master.steps_done
    read = pair.plant.reader(pair.plant.signal("transmission_error").references[:1], buffer)

    def keep() -> None:
        read()
        errors[pair.master.steps_done - 1 - done] = buffer[0]

    pair.master.run(steps, keep)
    return errors


def drift_of(errors: Floats, positions: int) -> float:
    """How far the output went on by wear [rad] in a cycle, which ends with a crank turn where it began."""
    turn = len(errors) - positions
    return float((errors[turn:] - errors[:positions]).mean())


def swing_over_turn(errors: Floats, positions: int, before: Sequence[float], now: Sequence[float]) -> float:
    """Peak to peak [arcsec] over a turn of the output, less how the output falls behind while the jump wears it.

    ``before`` and ``now``: hours from and to, and drift [rad], of the jump before and of this one.  With a times the root
    of the hours and b times the hours both are met: parts that run in wear fast at first, which a straight line would leave in the error.
    """
    rows = np.array([[math.sqrt(end) - math.sqrt(max(start, 0.0)), end - start] for start, end, _ in (before, now)])
    a, b = np.linalg.solve(rows, [before[2], now[2]])
    turn = len(errors) - positions
    passed = np.arange(turn) - 0.5 * positions
    hours = now[0] + (now[1] - now[0]) * np.clip(passed / turn, 0.0, 1.0)
    return float(np.ptp(errors[:turn] - a * np.sqrt(np.maximum(hours, 0.0)) - b * hours)) * ARCSEC


def depths(pair: Pair) -> np.ndarray:
    """The watched depths, one number per kind of surface [um]."""
    figures = wear_figures(pair.wear.record())
    return np.array([figures[name] for name in WATCHED])


def live(pair: Pair, life: Life, progress: Callable[[Life], None], keep: Callable[[Life], None]) -> Life:
    """Run ``life`` to its end from where it stands.

    ``progress`` is called after each jump, ``keep`` whenever the state is worth a checkpoint: at the start of each run
    through the life and after each jump.
    """
    if life.start is None:
        # One that is set is kept.
        if pair.plant.get("fidelity") == DYNAMIC and pair.plant.number("swing_damping") == 0.0:
            pair.plant.set("swing_damping", swing_damping(pair.plant.record()))
        life.start = pair.master.save()
        begin(pair, life, life.settings.first_jumps(), keep)
    while True:
        try:
            run_through(pair, life, progress, keep)
        except RunFault as fault:
            # Too much wear in one position; a fault that as many jumps as there may be do not cure is the reducer's.
            if 2 * life.jumps > MOST_JUMPS:
                raise worn_through(life, fault) from None
            life.coarse = []
            begin(pair, life, 2 * life.jumps, keep)
            continue
        factor = refinement(life)
        if factor == 1:
            return life
        life.coarse = life.watched()
        begin(pair, life, factor * life.jumps, keep)


def worn_through(life: Life, fault: RunFault) -> RunFault:
    """The fault with when it came, and how deep the surfaces were worn by then."""
    reached, deepest = life.hours[-1], max(life.figures[-1][name] for name in WATCHED)
    if reached == 0.0:
        return fault
    return RunFault(f"after {reached:.0f} of {life.settings.hours:g} h, worn by up to {deepest:.3g} um: {fault}; up to these hours the life can be had")


def begin(pair: Pair, life: Life, jumps: int, keep: Callable[[Life], None]) -> None:
    """From the new state again, in ``jumps`` jumps."""
    assert life.start is not None
    pair.master.restore(life.start)
    life.forget()
    life.jumps = jumps
    life.passes += 1
    life.note(pair)
    keep(life)


def run_through(pair: Pair, life: Life, progress: Callable[[Life], None], keep: Callable[[Life], None]) -> None:
    """All jumps that are left."""
    while (done := len(life.hours) - 1) < life.jumps:
        # From (i/n)^2 of the hours to ((i + 1)/n)^2: hours of a coarser run are among those of a finer one.
        span, errors = run_cycle(pair, life.settings.hours * (2 * done + 1) / life.jumps**2)
        life.cycles += 1
        life.note(pair)
        life.note_turn(span, errors, pair.positions)
        keep(life)
        progress(life)


def refinement(life: Life) -> int:
    """How many times as many jumps the life needs; 1 if it may end.  Sets its ``errors``."""
    if not life.coarse:
        return 2
    factor = life.jumps // (len(life.coarse) - 1)
    errors = estimates(life, factor)
    raw, before = max(errors), life.error_before
    # From three runs on, the order at which the error falls is known.
    order = 1.0
    if 0.0 < raw < before < math.inf:
        order = min(HIGHEST_ORDER, max(1.0, math.log(before / raw) / math.log(factor)))
    life.errors = [error * (factor - 1) / (factor**order - 1) for error in errors]
    life.error_before, error = raw, max(life.errors)
    stuck = life.jumps >= MANY_JUMPS and raw > 0.7 * before
    if error <= life.settings.tolerance or stuck or 2 * life.jumps > MOST_JUMPS:
        return 1
    # The error often falls faster than to the half.
    return 4 if error > 8.0 * life.settings.tolerance and 4 * life.jumps <= MOST_JUMPS else 2


def estimates(life: Life, factor: int) -> list[float]:
    """Error of the depths at each recorded hour over those at the end, worst of the watched, if it is of first order.

    ``factor`` times as many jumps as in the coarser run then leave 1/(factor - 1) of the difference.
    """
    fine = np.array(life.watched())
    apart = np.abs(fine[::factor] - life.coarse) / np.maximum(fine[-1], LEAST_DEPTH)
    known = CAUTION / (factor - 1) * apart.max(axis=1)
    errors: list[float] = np.interp(life.hours, life.hours[::factor], known).tolist()
    return errors


def as_arrays(life: Life) -> dict[str, list[float]]:
    """Figures as arrays parallel to ``hours``."""
    names = life.figures[0]
    return {"hours": life.hours} | {name: [f[name] for f in life.figures] for name in names} | {
        "error_estimate": life.errors
    }

