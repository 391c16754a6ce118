"""An FMU (co-simulation, FMI 2.0 or 3.0) as a component."""

import contextlib
import json
import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar
from zipfile import is_zipfile

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from fmu_src.arrays import Records
from fmu_src.faults import InputFault, RunFault
from fmu_src.reading import quoted, reading, require_size, unpack_archive
from fmu_src.source_hash import STAMP, source_hash
from fmu_src.state import unpack
from fmu_src.unit import Specification
from orchestrator.component import Component, Element, Snapshot, unit_of
from orchestrator.fmi2 import Fmi2
from orchestrator.fmi3 import Fmi3
from orchestrator.model_description import Described
from orchestrator.scratch import Scratch
from orchestrator.wasm import FOLDER as COMPONENTS
from orchestrator.wasm import Wasm, component_of

if TYPE_CHECKING:
    from fmpy.model_description import ModelDescription

# Bytes of a description (assumed: 100,000 variables take a third).
MOST = 100_000_000
IDENTIFIER = re.compile("[A-Za-z_][A-Za-z0-9_]*")
VERSIONS: dict[str, type[Fmi2 | Fmi3]] = {"2.0": Fmi2, "3.0": Fmi3}
Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


class Fmu(Component):
    """One instance of an FMU."""

    def __init__(self, name: str, path: str | Path, wasm: bool = False):
        """``wasm``: as WebAssembly even where there is a library for this machine."""
        self.name = name
        self.path = Path(path)
        if not self.path.is_file():
            raise InputFault(f"no FMU at {self.path}; this project's own are built with: rvwear build")
        self.scratch = Scratch()
        self.folder = self.scratch.path
        self.description = description_of(self.path, self.folder)
        version = self.description.fmiVersion
        if self.description.coSimulation is None:
            raise InputFault(f"{self.path} is for model exchange only; the master steps co-simulation units")
        if version not in VERSIONS:
            raise InputFault(f"{self.path} is of FMI {version}; the master steps units of FMI 2.0 and 3.0")
        self.require_same_sources()
        self.messages: list[str] = []
        with reading(self.path, "an FMU"):
            self.described = Described(self.description)
            self.signals = self.described.signals()
            self.take(version)
        try:
            self.calls = self.calls_of(version, wasm)
        except InputFault:
            raise
        except Exception as problem:  # noqa: BLE001
            # fmpy raises a bare Exception for a library that is missing or does not load.
            raise InputFault(f"{self.path} has nothing to run on this machine: {problem}") from None
        try:
            self.calls.instantiate()
        except Exception as problem:  # noqa: BLE001
            # fmpy raises a bare Exception here; the reason is in what the FMU logged.
            raise RunFault(f"{self.name} ({self.path}): {problem}: {self.last_messages()}") from None
        self.step = self.begin_step = self.calls.step  # type: ignore[method-assign]  # a call less per step

    def calls_of(self, version: str, wasm: bool) -> Fmi2 | Fmi3:
        """What the FMU is run by: this machine's library, or its WebAssembly component."""
        component = component_of(self.folder, self.described)
        if wasm and component is None:
            raise InputFault(f"{self.path} has no binaries/{COMPONENTS}/*.wasm; FMUs that have one are built with: rvwear build --wasm")
        if component is not None and (wasm or not (self.folder / "binaries" / fmpy.platform_tuple).is_dir()):
            return Wasm(self.name, self.described, component, self.messages.append, self.refuse)
        return VERSIONS[version](self.name, self.described, self.folder, self.messages.append, self.refuse)

    def take(self, version: str) -> None:
        """What the description says of the unit's capabilities."""
        capability = self.description.coSimulation
        if not IDENTIFIER.fullmatch(capability.modelIdentifier or ""):
            raise InputFault(f"{self.path}: modelIdentifier = {quoted(capability.modelIdentifier)}: letters, digits and underscores name the library")
        self.can_restore = capability.canGetAndSetFMUstate
        self.can_vary_step = capability.canHandleVariableCommunicationStepSize
        # FMI 2 does not say up to which order; FMI 3 has dropped input derivatives.
        self.input_derivatives = int(capability.canInterpolateInputs and version == "2.0")
        experiment = self.description.defaultExperiment
        step = float(experiment.stepSize) if experiment and experiment.stepSize else None
        # A step that is none is no suggestion.
        self.usual_step = step if step is not None and 0.0 < step < math.inf else None

    def old_names(self) -> Mapping[str, str]:
        return {} if self.stamp() is None else unit_of(self.specification()).table.renamed

    @property
    def slave(self) -> FMU2Slave | FMU3Slave:
        """fmpy's object, for what the master does not need."""
        return self.calls.slave

    def feedthrough(self) -> dict[Element, tuple[Element, ...]]:
        return self.described.feedthrough()

    def last_messages(self) -> str:
        return "; ".join(self.messages[-3:]) or "it logged nothing"

    def attempt(self, function: Callable[Arguments, Result], *arguments: Arguments.args, **named: Arguments.kwargs) -> Result:
        """Call it; on an FMI error raise RunFault with what the FMU logged."""
        try:
            return function(*arguments, **named)
        except FMICallException as problem:
            raise RunFault(f"{self.name} ({self.path.name}): {problem}: {self.last_messages()}") from None

    def refuse(self, function: str, status: int) -> None:
        """Raise for a call that the unit refused."""
        self.attempt(raise_refusal, function, status)

    def reader(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        return self.calls.reader(references, buffer)

    def writer(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        return self.calls.writer(references, buffer)

    def derivative_writer(self, references: tuple[int, ...], order: int, buffer: np.ndarray) -> Callable[[], None]:
        # FMI 3 has none: its units say so by ``input_derivatives``.
        assert isinstance(self.calls, Fmi2)
        return self.calls.derivative_writer(references, order, buffer)

    def set_text(self, name: str, text: str) -> None:
        if name not in self.described.texts:
            super().set_text(name, text)
        self.attempt(self.calls.set_text, self.described.texts[name], text)

    def enter_initialisation(self, start_time: float) -> None:
        self.attempt(self.calls.enter_initialisation, start_time)

    def exit_initialisation(self) -> None:
        try:
            self.attempt(self.calls.exit_initialisation)
        except RunFault as fault:
            raise InputFault(str(fault)) from None

    def step(self, time: float, duration: float) -> None:
        """Replaced in the instance by the bound call."""

    def snapshot(self) -> Snapshot:
        return self.attempt(self.calls.snapshot)

    def revert(self, snapshot: Snapshot) -> None:
        self.attempt(self.calls.revert, snapshot)

    def forget(self, snapshot: Snapshot) -> None:
        self.calls.forget(snapshot)

    def save(self) -> bytes:
        if not self.description.coSimulation.canSerializeFMUstate:
            raise InputFault(f"{self.path}: this unit cannot write its state down (canSerializeFMUstate)")
        snapshot = self.snapshot()
        try:
            return self.attempt(self.calls.serialise, snapshot)
        finally:
            self.forget(snapshot)

    def restore(self, state: bytes) -> None:
        snapshot = self.attempt(self.calls.deserialise, state)
        try:
            self.revert(snapshot)
        finally:
            self.forget(snapshot)

    def stamp(self) -> dict[str, Any] | None:
        """What this project writes into its FMUs; None for an FMU made by others."""
        path = self.folder / "resources" / STAMP
        if not path.is_file():
            return None
        # Others may have a file of this name, too.
        with reading(self.path, f"an FMU of this project (resources/{STAMP})", "build it anew with: rvwear build"):
            require_size(path, MOST)
            stamp = json.loads(path.read_text(encoding="utf-8"))
        return stamp if isinstance(stamp, dict) and stamp.keys() >= {"source_hash", "specification"} else None

    def require_same_sources(self) -> None:
        """This project's editable FMUs share this process's modules: they must be of its sources.

        So must native ones, whose states are read by the tables of those modules.
        """
        stamp = self.stamp()
        if stamp is not None and stamp["source_hash"] != source_hash():
            raise InputFault(
                f"{self.path} was built from other sources than those installed, or with effects of one's own: set RVWEAR_EFFECTS as it was then,"
                " or build anew with: rvwear build"
            )

    def specification(self) -> Specification:
        """What this project's FMU was built from, see fmu_src.unit."""
        stamp = self.stamp()
        if stamp is None:
            raise InputFault(f"{self.path} is not one of this project's FMUs; build them with: rvwear build")
        specification: Specification = stamp["specification"]
        return specification

    def record(self) -> Records:
        table = unit_of(self.specification()).table
        records = table.new_records()
        identity = self.description.guid or self.description.instantiationToken
        table.cells(records)[: table.state_cells] = unpack(identity, self.save(), table.state_cells).cells
        return records

    def cautions(self) -> list[str]:
        returns = [f"{self.name}.{text}" for text in getattr(self.calls, "returns", [])]
        if self.stamp() is None:
            return returns
        cautions = unit_of(self.specification()).cautions
        return [*returns, *(f"{self.name}: {text}" for name, text in cautions.items() if self.number(name) > 0)]

    def close(self) -> None:
        with contextlib.suppress(FMICallException):
            # Refused before initialisation; it is freed all the same.
            self.slave.terminate()
        self.slave.freeInstance()
        self.scratch.remove()


def description_of(path: Path, folder: Path) -> "ModelDescription":
    """The model description of an FMU, which is unpacked into the folder."""
    if not is_zipfile(path):
        raise InputFault(f"{path} is not an FMU: it is no zip archive")
    unpack_archive(path, folder, "FMU")
    text = folder / "modelDescription.xml"
    if not text.is_file():
        raise InputFault(f"{path} is not an FMU: it holds no modelDescription.xml")
    with reading(path, "an FMU"):
        require_size(text, MOST)
        # Other people's descriptions need not be flawless: what matters is checked where it is used.
        return fmpy.read_model_description(str(folder), validate=False)


def raise_refusal(function: str, status: int) -> None:
    raise FMICallException(function, status)
