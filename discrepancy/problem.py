"""What the statistics sees: measured series, and a model that predicts them.

The campaign turns files into ``Record``s, the physics turns parameter values into
predictions; between them the statistics knows neither files nor reducers.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any, Protocol, runtime_checkable

import numpy as np

from discrepancy.held_names import LOCKED_AT
from fmu_src.arrays import Floats, Mask
from fmu_src.threads import Threads

# Values that were predicted before, of which the next are a little beside: where a model that iterates may start.
NEAR: ContextVar[Mapping[str, float] | None] = ContextVar("near", default=None)
# Quantities whose zero nobody knows unless it is said: an encoder starts anywhere.
FREE_ZERO = ("transmission_error", "hysteresis")
# Orders of a transmission error: what shows in one shows in the other.
ERROR, ORDERS = "transmission_error", "transmission_order"
# Quantities whose zero may be said to be known; an order table has a mean then, order 0.
WITH_ZERO = (*FREE_ZERO, ORDERS)
# Axis of a record that lacks some of its samples: their numbers in the file, which say where they stand beside those of a repetition.
SAMPLE = "sample"
# Said in place of an angle: what was measured is a mean over a turn of the cranks.
MEAN = "mean"
# ``part`` of a candidate that is no effect but a number of the base model, which may be off within its range.
BASE = "base"
# ``part`` of an error of the instruments and not of the reducer.
CHAIN = "chain"


def effect_of(name: str) -> str:
    """The effect of a candidate's name: variants have it before the dot."""
    return name.partition(".")[0]


# Of a typical size: what a solver leaves of a number that is off.
ROUNDING = 1e-9
# Bounds of an angle [rad] that are so far apart are those of a direction, where a gear or a wave stands; errors of angles are far smaller.
WIDE = 1.5


def is_direction(unit: str, low: float, high: float) -> bool:
    """Whether a parameter with these bounds says where something stands, and not how large an error is."""
    return unit == "rad" and high - low > WIDE


@contextmanager
def near(values: Mapping[str, float]) -> Iterator[None]:
    """Predictions in this block are of values a little beside ``values``."""
    before = NEAR.set(dict(values))
    try:
        yield
    finally:
        NEAR.reset(before)


@dataclass(frozen=True)
class Record:
    """One measured series: a signal over its axis, or the numbers of one inspection.

    ``values`` (n,) in ``unit``; ``axes`` maps the names of axes (``angle`` [rad],
    ``time`` [s], ``torque`` [N.m], ``hours`` [s], ``depth_angle`` [rad] ...) to arrays of
    the same length.  ``factors`` are the condition's numbers (``speed`` [rad/s] of the
    input, ``load`` [N.m], ``temperature`` [K], ``hours`` [s] ..., ``direction`` +1 or -1; of ``HELD`` quantities
    ``locked_at``, the angle [rad] of the input at which they were measured).
    Runs with one ``condition`` and different ``replicate`` repeat each other; runs with one
    ``mounting`` share its phases.  ``held_out`` runs are never used for fitting.
    ``stated_noise`` is the standard deviation that the campaign states, if it does.
    ``tags`` say what is meant (surface, disc, crank, lobe ...).  ``zero_known``: the mean counts, too, of a quantity whose
    zero is free otherwise; ``zero_noise`` is the standard deviation by which that zero differs from run to run.
    ``of_output``: its ``angle`` is that of the output as an encoder there shows it, which lags under load behind the input over the ratio.
    ``far_off`` are the rows of samples that stand alone, far off: nothing counts them.
    ``of_positions``: measured at positions of the input over a turn of the cranks, of which it is the mean.
    ``closed``: a loop that was gone round before its first sample.
    ``left_out``: it stands out against most of its repetitions, and takes no part in what is fitted, judged or averaged.
    ``angle_noise``: its angles were written with so much noise [rad], and are those of an even turning now.
    """

    name: str
    quantity: str
    unit: str
    condition: str
    replicate: int
    values: Floats
    axes: Mapping[str, Floats]
    factors: Mapping[str, float]
    mounting: str = "1"
    held_out: bool = False
    stated_noise: float | None = None
    tags: Mapping[str, str] = field(default_factory=dict)
    zero_known: bool = False
    zero_noise: float = 0.0
    of_output: bool = False
    of_positions: bool = False
    closed: bool = False
    far_off: tuple[int, ...] = ()
    left_out: bool = False
    angle_noise: float = 0.0

    @property
    def fitted(self) -> bool:
        """Whether it is of the runs that parameters are fitted to."""
        return not self.held_out and not self.left_out

    @property
    def unused(self) -> bool:
        """Whether it is of the runs that were held out to judge by."""
        return self.held_out and not self.left_out

    @property
    def counted(self) -> Mask:
        """(n,) Samples that do not stand far off."""
        counted = np.ones(np.size(self.values), bool)
        counted[list(self.far_off)] = False
        return counted

    @property
    def free_zero(self) -> bool:
        """Whether the mean of its values says nothing."""
        return self.quantity in FREE_ZERO and not self.zero_known


def is_loop(record: Record) -> bool:
    """Whether a record is the output's turning over its torque, predicted as a mean over positions: no one of them is stated."""
    if LOCKED_AT in record.factors or LOCKED_AT in record.axes:
        return False
    return record.quantity == "hysteresis" and record.tags.get("locked") != "output" and "torque" in record.axes


def is_unplaced(record: Record) -> bool:
    """Whether a record is such a loop and nobody said that it is a mean over positions: it may be that of one."""
    return is_loop(record) and not record.of_positions


@dataclass(frozen=True)
class Parameter:
    """A number that may be estimated.

    ``off`` is its value in the base model (for an effect's amplitude the value at which the
    effect vanishes); ``scale`` a typical size, for steps and for reports; ``sign`` is +1 or
    -1 where physics allows only values above or below ``off``, else 0.  ``prior`` is a
    standard deviation around ``off`` known from elsewhere (None: nothing is known).
    ``of_base``: what the base model itself gets wrong; where it is large, the base is off.
    ``counts``: the number of a part; between two a fit may have optima of its own.
    ``said``: where the base model's file says that its number lies, if it may be elsewhere all the same.
    """

    name: str
    unit: str
    off: float
    lower: float
    upper: float
    scale: float
    sign: int = 0
    prior: float | None = None
    description: str = ""
    of_base: bool = False
    counts: bool = False
    said: tuple[float, float] | None = None

    def is_off(self, value: float) -> bool:
        """Whether a value is ``off``, but for what a solver leaves."""
        return abs(value - self.off) <= ROUNDING * self.scale

    @property
    def is_direction(self) -> bool:
        return is_direction(self.unit, self.lower, self.upper)


@dataclass(frozen=True)
class Candidate:
    """An effect that the model may lack.

    ``amplitudes`` are the parameters that are ``off`` in the base model: with all of them off
    the effect vanishes exactly, whatever its ``shapes``.  ``shape_grid`` lists the values of
    the shape parameters at which the screening looks; empty without shape parameters.
    ``signals`` names the quantities that the effect can touch (empty: any).
    ``families`` names orders that show it as soon as the model has placed it in each record (``Settling``), and hardly before.
    """

    name: str
    title: str
    amplitudes: tuple[Parameter, ...]
    shapes: tuple[Parameter, ...] = ()
    shape_grid: tuple[Mapping[str, float], ...] = ()
    signals: tuple[str, ...] = ()
    part: str = "plant"
    families: tuple[str, ...] = ()

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        return self.amplitudes + self.shapes


class Model(Protocol):
    """Predicts all records.  Names of parameters are unique over nuisances and candidates."""

    @property
    def records(self) -> Sequence[Record]: ...

    @property
    def nuisances(self) -> tuple[Parameter, ...]: ...

    @property
    def candidates(self) -> tuple[Candidate, ...]: ...

    def predict(self, values: Mapping[str, float], which: Sequence[int] | None = None) -> list[Floats]:
        """Predicted ``values`` of the records ``which`` (all by default), parameters not named being off."""
        ...


@runtime_checkable
class OnThreads(Protocol):
    """What a model may be besides: one whose predictions several threads can ask for at once."""

    threads: Threads


# What a model has placed beside effects, which nobody else looks into.
Places = tuple[Any, ...]


@runtime_checkable
class Settling(Protocol):
    """What a model may be besides: one with corrections of its own that depend on what is fitted."""

    def settle(self, values: Mapping[str, float], which: Sequence[int] | None = None) -> bool:
        """Find the corrections for the effects that are on in ``values``, none that only records beside ``which`` need; False if there are none."""
        ...

    def stands_elsewhere(self, values: Mapping[str, float]) -> bool:
        """Whether ``values`` ask for others of these corrections than were found last for their effects."""
        ...


@runtime_checkable
class Placing(Protocol):
    """What a model may be besides: one with nuisances that have many optima, since what they place repeats itself."""

    def placed_anew(self, values: Mapping[str, float]) -> tuple[float, dict[str, float]]:
        """The best places beside the effects in ``values``, looked for everywhere, by name; before them what they leave, to compare such values by."""
        ...

    def unplaced(self) -> Sequence[int]:
        """Records that say nothing before it is known where they were taken: ``Settling`` finds it beside effects that are about right."""
        ...

    def unseen(self, values: Mapping[str, float]) -> Sequence[int]:
        """Records of which nobody says where they were taken, and for which no place was found beside the effects in ``values`` either."""
        ...

    def otherwise(self, values: Mapping[str, float]) -> dict[str, float]:
        """The nuisances that place what was found beside the effects in ``values`` at the other place that looks alike; none where there is none."""
        ...

    def elsewhere(self, values: Mapping[str, float]) -> list[Places]:
        """``places`` with something at further places that look nearly alike."""
        ...

    def places(self, values: Mapping[str, float]) -> Places:
        """All that is placed beside the effects in ``values``."""
        ...

    def put(self, values: Mapping[str, float], places: Places) -> None:
        """All that is placed beside the effects in ``values`` goes where ``places`` have it."""
        ...

    def waves_on(self, values: Mapping[str, float], directions: Sequence[str]) -> tuple[Sequence[dict[str, float]], Sequence[int]]:
        """Other places that look alike without the effects in ``values``, and may not with them: by name, each to be tried at once, with those of the
        ``directions`` of the effects that stand elsewhere there; then the records by which effects are found there."""
        ...


@runtime_checkable
class PlacedAlone(Protocol):
    """What a model may be besides: one that finds where records were taken that do not say it, without any effect."""

    def place_alone(self, instead_of: str, values: Mapping[str, float]) -> bool:
        """Whether such records, beside the nuisances ``values``, are as measured at one place, for which the candidate ``instead_of`` stands; there they
        are then."""
        ...


@runtime_checkable
class Cheaper(Protocol):
    """What a model may have besides: predictions next to others to first order, such at any distance from others, and rough ones."""

    def predict_beside(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int], roughly: bool) -> list[Floats]:
        """``Model.predict``, or ``predict_roughly``, for values next to ``base``."""
        ...

    def predict_near(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int]) -> list[Floats]:
        """``Model.predict`` that may err by a few parts in a hundred of what ``values`` change next to ``base``, whose predictions are exact."""
        ...

    def predict_roughly(self, values: Mapping[str, float], which: Sequence[int]) -> list[Floats]:
        """``Model.predict`` with errors of a few parts in a hundred of what ``values`` change."""
        ...


@runtime_checkable
class Glimpsing(Protocol):
    """What a model may have besides: a look at a few places of the records, to compare directions by."""

    def glimpse(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int], first_order: bool) -> Floats:
        """What ``values`` change next to ``base`` at a few places of the records ``which``, one after the other, roughly in units of
        their noise; whole or to first order."""
        ...
