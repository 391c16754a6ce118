"""A reducer's life in jumps: one full meshing cycle stands for many hours.

In a full meshing cycle (z_c crank turns, every lobe meets every pin) the wear counts
``acceleration`` times.  Because the profile errors are exchanged all along, wear and
load distribution develop together within the cycle.  The jumps grow in proportion to the
root of the hours, because new parts wear fastest.  How many a life needs is decided by
running the whole of it again with several times as many, until depths of both runs agree
within ``tolerance`` of the depth at the end.  The finer run is kept.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, RunFault
from rv_plant.faults import DYNAMIC
from studies.held_input import lost_motion
from studies.meshing_cycle import HOUR, drift_of, run_cycle, swing_over_turn
from studies.pair import Pair
from studies.solve import Turn, measure
from studies.swing import swing_damping
from studies.wear_figures import SURFACES, WATCHED, wear_figures

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
        self.figures.append(figures | {"lost_motion_arcmin": lost_motion(pair)} | wear_figures(record))
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

