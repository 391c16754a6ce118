"""A pythonfmu slave around a unit's record: what RvPlant and RvWear have in common.

Get and set move whole vectors between the importer and the record.  The FMU state is
the record's leading cells, hidden state included.  A step runs the object code that
the FMU carries; where that is missing, is for another machine, or the sources beside it
were edited, the kernels are compiled on the spot.
"""

import _ctypes
import ctypes
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

import fmu_src
from fmu_src.arrays import Floats, Integers
from fmu_src.native import host_triple, load_object
from fmu_src.source_hash import LOADED_HASH, STAMP, source_hash
from fmu_src.state import INSTANTIATED, STEPPING, State, StateFault, pack, unpack
from fmu_src.unit import LOG_CATEGORIES, LONGEST_STEP, UnitFault, make_unit
from fmu_src.variables import ValueFault

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

OBJECT_CODE = "unit.o"


def add_reference(held: object) -> None:
    """One reference more, to make up for one that pythonfmu drops without owning it."""
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(held))


def let_go_of_wrapper_state(folder: Path, name: str) -> None:
    """Has pythonfmu's wrapper give up its global state while that is still whole.

    Under Linux the wrapper releases it twice when it is unloaded, the second time after it was freed, which damages
    the heap of the importer.  The state only keeps an interpreter alive that the wrapper itself started: in
    an importer that runs in Python nothing needs it.  ``folder``: the FMU's resources; ``name``: its model identifier.
    """
    started_by_wrapper = not sys.orig_argv
    library = folder.parent / "binaries" / "linux64" / f"{name}.so"
    if started_by_wrapper or not sys.platform.startswith("linux") or not library.is_file():
        return
    loaded = ctypes.CDLL(str(library))
    loaded.finalizePythonInterpreter()
    _ctypes.dlclose(loaded._handle)


class KernelSlave(Fmi2Slave):  # type: ignore[misc]  # pythonfmu has no types
    """Base of the leaf classes; reads what it is from ``unit.json`` in the resources."""

    log_categories = LOG_CATEGORIES

    def __init__(self, **kwargs: Any):
        super().__init__(**kwargs)
        folder = Path(self.resources)
        self.stamp = json.loads((folder / STAMP).read_text(encoding="utf-8"))
        self.check_sources(folder)
        self.unit = make_unit(self.stamp["specification"])
        self.table = self.unit.table
        self.modelName = self.table.name
        let_go_of_wrapper_state(folder, self.modelName)
        self.records = self.table.new_records()
        self.cells = self.table.cells(self.records)
        self.integers: Integers = self.cells.view("i8")
        self.lowest, self.highest = self.table.bounds
        self.initialised = False
        # Whether outputs asked for in initialisation mode have to be computed anew.
        self.initialising = self.stale = False
        self.first_output = self.table.offset[self.table.of_role("output")[0].name]
        self.time = 0.0
        self.cautioned: set[str] = set()
        self.lists: dict[tuple[bool, int, int], tuple[list[int], Integers]] = {}
        self.initialise, self.step = self.entry_points(folder)

    def check_sources(self, folder: Path) -> None:
        """Two FMUs in one process share imported modules: they must be of one source."""
        imported = Path(fmu_src.__file__).resolve().parents[1]
        if imported != folder.resolve() and self.stamp["source_hash"] != LOADED_HASH:
            raise UnitFault(
                f"this process already runs another version of fmu_src, from {imported}."
                " Use FMUs of one build in one process, or start a fresh process"
            )

    def entry_points(self, folder: Path) -> tuple[Callable[[], int], Callable[[float, float], int]]:
        """Carried object code if it fits machine and sources, else compiled in this process."""
        code = folder / OBJECT_CODE
        fits = code.exists() and self.stamp["triple"] == host_triple()
        if not fits or source_hash(root=folder) != self.stamp["source_hash"]:
            return self.unit.bound(self.records)
        functions = load_object(code.read_bytes())
        pointer = ctypes.c_void_p(self.records.ctypes.data)
        return (
            lambda: functions["initialise"](pointer),
            lambda time, duration: functions["step"](pointer, time, duration),
        )

    def to_xml(self, model_options: dict[str, str] | None = None) -> "Element":
        # Only a build describes the unit; an importer needs no unit library.
        from fmu_src.description import model_description
        from fmu_src.project import Project

        stamp = self.stamp
        made_by = Project(**stamp["made_by"])
        return model_description(self.table, stamp["guid"], stamp["source_hash"], stamp["step_size"], stamp["tool"], made_by)

    def fail(self, text: str) -> NoReturn:
        """Log and raise: pythonfmu turns an exception into an FMI error status.

        It also drops its references to instance, class and log on every exception, and
        again when the importer frees the instance; one more of each prevents a crash.
        """
        for held in (self, type(self), self.log_queue):
            add_reference(held)
        self.log(text, Fmi2Status.error)
        raise UnitFault(text)

    # FMI life cycle

    def enter_initialization_mode(self) -> None:
        self.initialising = self.stale = True

    def compute_initial_outputs(self) -> None:
        """Some masters exchange values before they leave initialisation mode, as the standard allows."""
        self.stale = False
        self.attempt(self.initialise, 0.0, self.table.state_cells)

    def exit_initialization_mode(self) -> None:
        self.compute_initial_outputs()
        self.initialising, self.initialised = False, True

    def do_step(self, current_time: float, step_size: float) -> bool:
        if not self.initialised:
            self.fail(f"{self.table.name}: a step before initialisation; enter and exit initialisation mode first")
        if not 0.0 < step_size <= LONGEST_STEP:
            self.fail(
                f"{self.table.name}: at time {current_time:.9g} s: communication step of {step_size:g} s:"
                f" give a positive one of at most {LONGEST_STEP:g} s"
            )
        self.attempt(lambda: self.step(current_time, step_size), current_time, self.unit.guarded_cells)
        self.time = current_time + step_size
        for name, text in self.unit.due_cautions(self.records).items():
            if name not in self.cautioned:
                self.cautioned.add(name)
                self.log(f"{self.table.name}: at time {self.time:.9g} s: {text}", Fmi2Status.warning)
        return True

    def attempt(self, entry_point: Callable[[], int], time: float, guarded: int) -> None:
        """Run an entry point; on a fault, which may change the ``guarded`` leading cells, the state is what it was."""
        before = self.cells[:guarded].copy()
        code = entry_point()
        if code != 0:
            text = self.unit.fault_text(code, self.records, time)
            self.cells[:guarded] = before
            self.fail(text)

    # values

    def index(self, vrs: list[int], integer: bool) -> Integers:
        """The cells of value references; an importer asks for the same few lists all the time."""
        known = self.lists.get((integer, vrs[0], len(vrs)))
        if known is None or known[0] != vrs:
            if not all(0 <= vr < self.table.interface_cells for vr in vrs):
                self.fail(f"{self.table.name}: not all of the value references {vrs[:5]}... are its own")
            cells = np.array(vrs)
            if (self.table.integer_cells[cells] != integer).any():
                wrong = int(cells[self.table.integer_cells[cells] != integer][0])
                kind = "a real" if integer else "an integer or enumeration"
                self.fail(f"{self.table.name}: {self.table.element_at(wrong)[1]} is {kind}: use the functions of its type")
            known = self.lists[integer, vrs[0], len(vrs)] = (vrs, cells)
        return known[1]

    def get_real(self, vrs: list[int]) -> list[float]:
        if self.stale and self.initialising and any(vr >= self.first_output for vr in vrs):
            self.compute_initial_outputs()
        values: list[float] = self.cells[self.index(vrs, False)].tolist() if vrs else []
        return values

    def get_integer(self, vrs: list[int]) -> list[int]:
        if self.stale and self.initialising and any(vr >= self.first_output for vr in vrs):
            self.compute_initial_outputs()
        values: list[int] = self.integers[self.index(vrs, True)].tolist() if vrs else []
        return values

    def set_real(self, vrs: list[int], values: list[float]) -> None:
        self.set_cells(self.cells, vrs, values)

    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        self.set_cells(self.integers, vrs, values)

    def set_cells(self, cells: Floats | Integers, vrs: list[int], values: list[float] | list[int]) -> None:
        if not vrs:
            return
        index, given = self.index(vrs, cells is self.integers), np.array(values, cells.dtype)
        # A NaN fails both comparisons, as does a cell that may not be set.
        if not ((given >= self.lowest[index]) & (given <= self.highest[index])).all():
            try:
                self.table.check_values(vrs, values)
            except ValueFault as fault:
                self.fail(f"{self.table.name}: {fault}")
        if self.initialised and self.table.fixed_cells[index].any():
            fixed = self.table.element_at(int(index[self.table.fixed_cells[index]][0]))[1]
            self.fail(f"{self.table.name}: {fixed} is fixed once the unit is initialised; reset the unit to change it")
        cells[index] = given
        self.stale = True

    # state: the block of fmu_src.state, the same in memory and serialised

    def _get_fmu_state(self) -> bytes:
        phase = STEPPING if self.initialised else INSTANTIATED
        return pack(self.stamp["guid"], State(self.cells[: self.table.state_cells], phase, self.time))

    def _set_fmu_state(self, state: bytes) -> None:
        try:
            saved = unpack(self.stamp["guid"], state, self.table.state_cells)
            self.table.check_state(saved.cells)
        except (StateFault, ValueFault) as fault:
            self.fail(f"{self.table.name}: {fault}")
        self.cells[: self.table.state_cells] = saved.cells
        self.initialised = saved.phase == STEPPING
        self.time = saved.time

    @staticmethod
    def _fmu_state_to_bytes(state: bytes) -> bytes:
        return state

    @staticmethod
    def _fmu_state_from_bytes(data: bytes) -> bytes:
        # Checked when it is set: an exception here, without the instance, would crash the importer.
        return data
