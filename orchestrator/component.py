"""What the master steps: a unit in this process, or an FMU.

Both show the same face.  Values move as vectors: ``reader`` and ``writer`` prepare a
transfer once and return a function that fills a buffer, or empties it, without
allocating.
"""

import json
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Integers, Records
from fmu_src.faults import InputFault, RunFault, nearest
from fmu_src.names import warn_of_old_name
from fmu_src.table import Table
from fmu_src.unit import Specification, Unit, make_unit
from fmu_src.units import BaseUnit
from fmu_src.variables import ValueFault, Variable

# (dtype, reference): FMI 2 counts its references anew for each type.
Element = tuple[str, int]
# A component's state as only the component itself can read it.
Snapshot = Any


@dataclass(frozen=True)
class Signal:
    """One variable, scalar or array, as the master sees it.

    ``references`` name its elements to the component's ``reader`` and ``writer``; ``shape``
    is () for a scalar.  A Boolean has the choices false and true.  ``base_unit`` is what an
    FMU says its unit is made of; ``unit_given`` is false where it says nothing at all.
    """

    name: str
    causality: str
    unit: str
    references: tuple[int, ...]
    shape: tuple[int, ...]
    is_integer: bool = False
    is_tunable: bool = False
    choices: tuple[str, ...] = ()
    is_boolean: bool = False
    unit_given: bool = True
    base_unit: BaseUnit | None = None
    nominal: float | None = None

    @property
    def dtype(self) -> str:
        """Of the buffers that hold its values."""
        return "?" if self.is_boolean else "i8" if self.is_integer else "f8"

    @property
    def elements(self) -> list[Element]:
        return [(self.dtype, reference) for reference in self.references]

    def new_buffer(self) -> np.ndarray:
        return np.zeros(len(self.references), self.dtype)


class Component(ABC):
    """A unit that can be initialised, stepped, saved and restored.

    What it can do is declared: ``can_restore`` (state), ``can_vary_step``, and
    ``input_derivatives``, the highest derivative of an input that it takes.
    ``usual_step`` [s] is the communication step that it suggests.
    """

    name: str
    signals: dict[str, Signal]
    can_restore = True
    can_vary_step = True
    input_derivatives = 0
    usual_step: float | None = None

    def old_names(self) -> Mapping[str, str]:
        """Of this project's units: the name that kernels have for a variable, once that of files too, and its own."""
        return {}

    def feedthrough(self) -> dict[Element, tuple[Element, ...]]:
        """Output element -> the input elements that it depends on at once; none is the usual case."""
        return {}

    def signal(self, name: str) -> Signal:
        """The signal of a name, kernels' names and an array's elements included; InputFault if there is none."""
        if name in self.signals:
            return self.signals[name]
        base, _, index = name.partition("[")
        array = self.signals.get(base)
        if array is None and (new := self.old_names().get(base)) is not None:
            return self.signal(new + name[len(base) :])
        if array is not None and array.shape and index.endswith("]"):
            try:
                place = np.ravel_multi_index(tuple(int(i) - 1 for i in index[:-1].split(",")), array.shape)
            except ValueError:
                raise InputFault(f"{self.name}.{name}: {base} has the shape {array.shape}, counted from 1") from None
            return replace(array, name=name, references=(array.references[place],), shape=())
        raise InputFault(f"{self.name} has no variable {name!r}{nearest(base, self.signals, old=self.old_names())}")

    def as_written(self, name: str) -> Signal:
        """The signal of a name that a user wrote; an old one is said to be one."""
        signal = self.signal(name)
        base = name.partition("[")[0]
        if name not in self.signals and base not in self.signals:
            # Once for all elements of an array.
            warn_of_old_name(f"{self.name}.{base}", f"{self.name}.{self.old_names()[base]}")
        return signal

    def has(self, name: str) -> bool:
        """Whether there is a variable or array element of this name."""
        base = name.partition("[")[0]
        if base not in self.signals and base not in self.old_names():
            # Asked of many that have none: a refusal looks for names that are like it.
            return name in self.signals
        try:
            self.signal(name)
        except InputFault:
            return False
        return True

    def get(self, name: str) -> np.ndarray | float | int:
        """Present value of a signal, an array in its shape."""
        signal = self.signal(name)
        buffer = signal.new_buffer()
        self.reader(signal.references, buffer)()
        return buffer.reshape(signal.shape) if signal.shape else buffer[0].item()

    def number(self, name: str) -> float:
        """Present value of a scalar signal."""
        value = self.get(name)
        if isinstance(value, np.ndarray):
            raise InputFault(f"{self.name}.{name} has the shape {value.shape}: one element of it is needed, {name}[1]")
        return value

    def set(self, name: str, value: npt.ArrayLike) -> None:
        """Set a parameter or input; a scalar given for an array fills it."""
        signal = self.signal(name)
        buffer = signal.new_buffer()
        try:
            buffer[:] = np.broadcast_to(value, signal.shape).ravel() if signal.shape else value
        except (ValueError, OverflowError) as problem:
            raise InputFault(f"{self.name}.{name} = {value!r}: {problem}") from None
        self.writer(signal.references, buffer)()

    @abstractmethod
    def reader(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        """A function that fills ``buffer`` (f8, i8 for integers, bool) with present values."""

    @abstractmethod
    def writer(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        """A function that sets variables to what ``buffer`` holds."""

    def derivative_writer(self, references: tuple[int, ...], order: int, buffer: np.ndarray) -> Callable[[], None]:
        """A function that sets the inputs' derivatives of an order up to ``input_derivatives``."""
        raise NotImplementedError

    def set_text(self, name: str, text: str) -> None:
        """Set a string parameter; only FMUs have some."""
        raise InputFault(f"{self.name} has no string variable {name!r}")

    @abstractmethod
    def enter_initialisation(self, start_time: float) -> None: ...

    @abstractmethod
    def exit_initialisation(self) -> None:
        """Compute the initial outputs; InputFault if the parameters do not allow it."""

    @abstractmethod
    def step(self, time: float, duration: float) -> None:
        """Advance from ``time`` by ``duration`` [s]; RunFault if that fails."""

    def begin_step(self, time: float, duration: float) -> None:
        """Start a step; a unit in a process of its own goes on while others start theirs."""
        self.step(time, duration)

    def end_step(self) -> None:
        """Wait for the end of the step begun."""

    @abstractmethod
    def save(self) -> bytes:
        """The complete state, hidden parts included."""

    @abstractmethod
    def restore(self, state: bytes) -> None: ...

    def snapshot(self) -> Snapshot:
        """The state for ``revert`` in this process, cheaper than ``save`` where that is possible."""
        return self.save()

    def revert(self, snapshot: Snapshot) -> None:
        self.restore(snapshot)

    def forget(self, snapshot: Snapshot) -> None:
        """Free a snapshot."""

    def record(self) -> Records:
        """The unit's record (one element, dtype of its table), hidden surfaces included."""
        raise InputFault(f"{self.name} is not one of this project's units: it has no record")

    def cautions(self) -> list[str]:
        """What the user should know of the run so far."""
        return []

    def close(self) -> None:
        """Free what the component holds."""


def unit_of(specification: Specification) -> Unit:
    """The unit of a specification.  Those of equal ones share unit and table, which nobody changes: thousands of variables are made once."""
    return unit_of_text(json.dumps(specification, sort_keys=True))


@lru_cache(maxsize=32)
def unit_of_text(specification: str) -> Unit:
    return make_unit(json.loads(specification))


class InProcess(Component):
    """A unit whose compiled kernels run in this process."""

    def __init__(self, name: str, specification: Specification):
        self.name = name
        self.unit = unit_of(specification)
        self.table: Table = self.unit.table
        self.signals = {v.path: signal_of(v, self.table) for v in self.table.interface()}
        self.records = self.table.new_records()
        self.cells = self.table.cells(self.records)
        self.integers: Integers = self.cells.view("i8")

    def old_names(self) -> Mapping[str, str]:
        return self.table.renamed

    @cached_property
    def entry_points(self) -> tuple[Callable[[], int], Callable[[float, float], int]]:
        """Compiled when they are first needed: who only asks for values waits for nothing."""
        return self.unit.bound(self.records)

    def reader(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        cells: np.ndarray = self.integers if buffer.dtype == np.int64 else self.cells
        index = np.array(references)

        def read() -> None:
            np.take(cells, index, out=buffer, mode="clip")

        return read

    def writer(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        cells: np.ndarray = self.integers if buffer.dtype == np.int64 else self.cells
        index = np.array(references)
        lowest, highest = (bound[index] for bound in self.table.bounds)

        def write() -> None:
            # A NaN fails both comparisons, as does a cell that may not be set.
            if not ((buffer >= lowest) & (buffer <= highest)).all():
                try:
                    self.table.check_values(references, buffer)
                except ValueFault as fault:
                    raise InputFault(f"{self.name}: {fault}") from None
            cells[index] = buffer

        return write

    def enter_initialisation(self, start_time: float) -> None:
        pass

    def exit_initialisation(self) -> None:
        code = self.entry_points[0]()
        if code != 0:
            raise InputFault(self.unit.refusal(code, self.records) or f"{self.name}: {self.unit.fault_text(code, self.records, 0.0)}")

    def step(self, time: float, duration: float) -> None:
        code = self.entry_points[1](time, duration)
        if code != 0:
            raise RunFault(f"{self.name}: {self.unit.fault_text(code, self.records, time)}")

    def save(self) -> bytes:
        return self.cells[: self.table.state_cells].tobytes()

    def restore(self, state: bytes) -> None:
        """InputFault for bytes that are no state of this unit: they may come from a file."""
        try:
            cells = np.frombuffer(state, "f8")
            self.table.check_state(cells)
        except ValueError as problem:
            raise InputFault(f"{self.name}: {problem}") from None
        self.cells[: self.table.state_cells] = cells

    def revert(self, snapshot: Snapshot) -> None:
        self.cells[: self.table.state_cells] = np.frombuffer(snapshot, "f8")

    def record(self) -> Records:
        return self.records.copy()

    def cautions(self) -> list[str]:
        return [f"{self.name}: {text}" for text in self.unit.due_cautions(self.records).values()]


def signal_of(v: Variable, table: Table) -> Signal:
    first = table.offset[v.name]
    references = tuple(range(first, first + v.size))
    return Signal(v.path, v.role, v.unit, references, v.shape, v.is_integer, v.tunable, v.choices, nominal=v.nominal)
