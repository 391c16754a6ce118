"""A unit: its table and its compiled entry points, made from a specification.

The specification is a plain dictionary, so that it travels inside an FMU as JSON:
``unit`` names the package that makes it (``rv_plant``, ``wear_fmu``), ``sizes`` its
array sizes, ``starts`` and ``sources`` the start values that differ from the table's, ``worn``
what else a unit starts with that is not new.
"""

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NotRequired, TypedDict

from fmu_src.arrays import Records
from fmu_src.kernel import Kernel
from fmu_src.start_arrays import decode
from fmu_src.table import Table

# A communication step beyond this is a slip, not a wish [s].
LONGEST_STEP = 3600.0

LOG_CATEGORIES = {
    "logStatusWarning": "values that were accepted but are doubtful",
    "logStatusDiscard": "steps that could not be done",
    "logStatusError": "errors: which unit, when, and the remedy",
    "logStatusFatal": "errors that end the unit",
    "logAll": "all messages",
}


class UnitFault(RuntimeError):
    """A unit that refused to initialise or to step; the text says what, where and the remedy."""


class Worn(TypedDict):
    """Operating hours, and start values of outputs and states by name (see fmu_src.start_arrays)."""

    hours: float
    arrays: dict[str, str]


class Specification(TypedDict):
    """See above; ``reducer`` is the name of the reducer file's."""

    unit: str
    reducer: str
    sizes: dict[str, dict[str, int]]
    starts: dict[str, float]
    sources: dict[str, str]
    worn: NotRequired[Worn]


@dataclass(frozen=True)
class Unit:
    """``initialise(records)`` and ``step(records, time, duration)`` return 0 or a key of ``faults``.

    ``fault_reach`` is how many of the leading cells a step that returns a fault may have
    changed (None: all of the state).  An FMU keeps a copy of these during each step.
    ``cautions`` are said once when the integer output of the name is no longer 0.
    ``refusal(code, records)`` says of some status codes more than their text can, which an FMU in any language has; empty of others.
    ``pause`` names two states of a unit whose steps may end before their time: where they may (0 nowhere, 1 where a
    judgement changes, 2 after every part), which the importer's wishes decide, and how much of the step was done (0: all) [s].
    """

    table: Table
    initialise: Callable[[Records], int]
    step: Callable[[Records, float, float], int]
    faults: dict[int, str]
    fault_reach: int | None = None
    cautions: Mapping[str, str] = field(default_factory=dict)
    pause: tuple[str, str] | None = None
    refusal: Callable[[int, Records], str] = field(default=lambda code, records: "")

    @property
    def guarded_cells(self) -> int:
        """Number of leading cells that are put back after a fault."""
        return self.table.state_cells if self.fault_reach is None else self.fault_reach

    @property
    def kernels(self) -> tuple[Kernel, Kernel] | None:
        """``initialise`` and ``step`` as the compiler takes them; None where kernels run as plain Python."""
        if isinstance(self.initialise, Kernel) and isinstance(self.step, Kernel):
            return self.initialise, self.step
        return None

    def bound(self, records: Records) -> tuple[Callable[[], int], Callable[[float, float], int]]:
        """``initialise()`` and ``step(time, duration)`` of one record, which must stay where it is; compiled now if need be."""
        kernels = self.kernels
        if kernels is None:
            return lambda: self.initialise(records), lambda time, duration: self.step(records, time, duration)
        from fmu_src.compiler.calling import bound_unit

        return bound_unit(*kernels, records)

    def due_cautions(self, records: Records) -> dict[str, str]:
        """Those that this record gives cause for."""
        return {name: text for name, text in self.cautions.items() if records[name][0] > 0}

    def fault_text(self, code: int, records: Records, time: float) -> str:
        """What a status code means for this record, in words."""
        return f"{self.table.name} at time {time:.9g} s: {self.faults[code].format(**self.table.scalars(records))}"


def started(table: Table, specification: Specification) -> Table:
    """A unit's table with the specification's start values."""
    table = table.with_starts(specification["starts"], specification["sources"])
    worn = specification.get("worn")
    if worn is None:
        return table
    arrays = {name: decode(text, table.by_name[name].shape) for name, text in worn["arrays"].items()}
    return table.with_arrays(arrays, f"{table.description}; delivered as after {worn['hours']:g} hours")


def make_unit(specification: Specification) -> Unit:
    """The unit of a specification."""
    unit: Unit = importlib.import_module(f"{specification['unit']}.unit").make_unit(specification)
    return unit
