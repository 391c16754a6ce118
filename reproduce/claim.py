"""What a claim is: quoted, held against computed numbers, judged.

A claim is a function of the shared ``Context`` that returns a ``Finding``; the decorator
``states`` registers it under its id with the source and what the source says.  Every
number of a finding comes out of a kernel, a run or a printed form at that moment.  The
``grounds`` of a verdict are conditions on these numbers: if one of them ceases to hold,
the verdict no longer stands, and table, page and tests say so.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import wraps

import numpy as np

from pages.look import Figure
from reproduce.context import Context

REPRODUCED = "reproduced"
CONDITIONAL = "reproduced under a stated condition"
CONTRADICTED = "contradicted"
NOT_TESTABLE = "not testable"
VERDICTS = (REPRODUCED, CONDITIONAL, CONTRADICTED, NOT_TESTABLE)
# Of a claim whose grounds no longer hold, as with other numbers than the sources'.
FALLEN = "no longer carried by the numbers"

TOOTH = "tooth-profile document (BX-40E)"
NEEDLE = "needle-bearing document (RV20E-121)"
LITERATURE = "later literature"
CATALOGUE = "catalogue"
INDIVIDUALITY = "individuality of parts"
SOURCES = (TOOTH, NEEDLE, LITERATURE, CATALOGUE, INDIVIDUALITY)

# A value, or a range (low, high).
Audited = float | tuple[float, float]


@dataclass(frozen=True)
class Number:
    """One computed number, and what it is held against.

    ``value`` is what the right physics gives, ``printed`` what the printed formula gives,
    ``audited`` what an independent solver found earlier: a value, held to the relative
    ``tolerance``, or a range (low, high).  ``published`` is the source's figure, measured or computed
    there, a value or a range; ``low`` and ``high`` are the ends of ours over what is not known
    (``unknowns``), left out where that is not reckoned.  All in ``unit``.  A published figure that has
    no computed one beside it stands alone: the claim's ``why`` says what is missing.
    """

    label: str
    unit: str
    value: float | None = None
    printed: float | None = None
    audited: Audited | None = None
    tolerance: float = 0.03
    published: Audited | None = None
    low: float | None = None
    high: float | None = None

    @property
    def found(self) -> float:
        """What the right physics gives, else what the printed formula gives."""
        found = self.printed if self.value is None else self.value
        if found is None:
            raise ValueError(f"{self.label}: neither computed nor printed")
        return found

    @property
    def agrees(self) -> bool | None:
        """Whether the number confirms the independent check; None without one."""
        if self.audited is None:
            return None
        if isinstance(self.audited, tuple):
            low, high = self.audited
            spare = self.tolerance * max(abs(low), abs(high))
            return bool(low - spare <= self.found <= high + spare)
        return math.isclose(self.found, self.audited, rel_tol=self.tolerance, abs_tol=1e-12)

    @property
    def off(self) -> float:
        """How far the number lies from the independent check, or the nearer end of its range, as a share of that; NaN without one, or from 0."""
        if self.audited is None:
            return math.nan
        near = min(max(self.found, self.audited[0]), self.audited[1]) if isinstance(self.audited, tuple) else self.audited
        return (self.found - near) / abs(near) if near else math.nan


def held(label: str, unit: str, value: float | None, theirs: Audited, span: tuple[float, float] | None = None) -> Number:
    """A number beside the source's: ours, theirs, and the range of ours over what is not known."""
    low, high = span or (None, None)
    return Number(label, unit, value, published=theirs, low=low, high=high)


@dataclass(frozen=True)
class Finding:
    """What the numbers say of a claim; ``condition`` is needed with the verdict CONDITIONAL."""

    verdict: str
    why: str
    numbers: list[Number]
    grounds: Sequence[tuple[str, bool | np.bool]]
    condition: str = ""
    figures: list[Figure] = field(default_factory=list)


@dataclass(frozen=True)
class Claim:
    """A judged claim."""

    id: str
    source: str
    title: str
    says: str
    verdict: str
    condition: str
    why: str
    numbers: list[Number]
    grounds: list[tuple[str, bool]]
    figures: list[Figure]
    # Of which its numbers are, as the library calls them; those that a claim made itself are not among them.
    reducers: tuple[str, ...] = ()
    # Other numbers than the sources' that it was computed with, and which reducers had what instead.
    altered: tuple[str, ...] = ()
    # The same for what each figure shows, which may be fewer reducers than the numbers are of; empty where nothing was changed.
    drawn_with: tuple[tuple[str, ...], ...] = ()
    # Whether the other numbers moved any of the claim's, and what each of its figures shows.
    numbers_moved: bool = True
    figures_moved: tuple[bool, ...] = ()

    @property
    def is_moved(self) -> bool:
        """Whether anything of it is other than with the sources' numbers."""
        return self.numbers_moved or any(self.figures_moved)

    @property
    def stands(self) -> bool:
        """Whether the numbers still carry the verdict."""
        return all(holds for _, holds in self.grounds)

    @property
    def outcome(self) -> str:
        """The verdict, as far as the numbers still carry it."""
        return self.verdict if self.stands else FALLEN

    @property
    def told(self) -> str:
        """The outcome in words: of other numbers than the sources' it is said that these are judged, and that the claim is not of them."""
        if not self.altered:
            return self.outcome
        return f"with other numbers than the source's{'' if self.is_moved else ', which move nothing here'}, judged anew: {self.outcome}"

    @property
    def cause(self) -> str:
        """Why the claim is judged so.  That was written of the sources' numbers: where others move something, it is said which, and nothing of theirs."""
        if not self.altered or not self.is_moved:
            return self.why
        return f"{', '.join(self.altered)}: the cause that is told with the source's numbers need not hold here."

    @property
    def held(self) -> list[Number]:
        """Numbers of the source, with ours beside them."""
        return [number for number in self.numbers if number.published is not None]

    @property
    def discrepancies(self) -> list[Number]:
        """Numbers that do not confirm the independent check."""
        return [number for number in self.numbers if number.agrees is False]


def counts_of(claims: Iterable[Claim]) -> dict[str, int]:
    """How many claims came out how; those that have fallen, if any, are counted for themselves."""
    outcomes = [claim.outcome for claim in claims]
    return {verdict: outcomes.count(verdict) for verdict in (*VERDICTS, *([FALLEN] if FALLEN in outcomes else []))}


Finder = Callable[[Context], Finding]
REGISTRY: dict[str, Callable[[Context], Claim]] = {}


def states(identity: str, source: str, title: str, says: str) -> Callable[[Finder], Finder]:
    """Register the function below as the claim ``identity`` of a source; ``statements`` reads what stands here."""
    if identity in REGISTRY:
        raise ValueError(f"claim {identity} is registered twice")

    def register(function: Finder) -> Finder:
        @wraps(function)
        def judge(context: Context) -> Claim:
            f, reducers = context.reducers_of(function)
            if f.verdict not in VERDICTS or (f.verdict == CONDITIONAL) != bool(f.condition):
                raise ValueError(f"claim {identity}: verdict {f.verdict!r} with condition {f.condition!r}")
            grounds = [(text, bool(holds)) for text, holds in f.grounds]
            return Claim(
                identity, source, title, says, f.verdict, f.condition, f.why, f.numbers, grounds, f.figures, reducers
            )

        REGISTRY[identity] = judge
        return function

    return register


def listed(values: Iterable[float], unit: str = "", digits: int = 3) -> str:
    """Numbers in running text."""
    return ", ".join(f"{v:.{digits}g}" for v in values) + (f" {unit}" if unit else "")
