"""Units as WebAssembly components (draft FMI-LS-WASM) under wasmtime: the same face as ``fmi3``.

Only the component's interface is used, so components of other makers run too.  The unit sees its own memory and
the function that takes its messages, and nothing of this machine.
"""

import ctypes
import importlib.util
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from fmpy.fmi1 import FMICallException

from fmu_src.faults import MissingPart
from fmu_src.wasm.interface import INSTANCE, PACKAGE
from orchestrator.bound_calls import ERROR, WARNING
from orchestrator.component import Snapshot
from orchestrator.fmi3 import Block, Fmi3
from orchestrator.model_description import Described

STATUS = ("ok", "warning", "discard", "error", "fatal")
FOLDER = "wasm32-wasip2"


def component_of(folder: Path, described: Described) -> Path | None:
    """The component in the folder of an unpacked FMU, if it has one."""
    path = folder / "binaries" / FOLDER / f"{described.description.coSimulation.modelIdentifier}.wasm"
    return path if path.is_file() else None


@cache
def engine() -> Any:
    """wasmtime's compiler; translated components are kept between runs where that can be."""
    if importlib.util.find_spec("wasmtime") is None:
        raise MissingPart("a unit as WebAssembly", "wasmtime", "wasm")
    import wasmtime

    config = wasmtime.Config()
    config.cache = True
    return wasmtime.Engine(config)


class WasmInstance:
    """What ``Fmu`` asks of fmpy's object at the end."""

    def __init__(self, calls: "Wasm"):
        self.calls = calls

    def terminate(self) -> None:
        self.calls.done("fmi3Terminate", self.calls.call("terminate"))

    def reset(self) -> None:
        self.calls.done("fmi3Reset", self.calls.call("reset"))

    def freeInstance(self) -> None:
        self.calls.resource.drop(self.calls.store)


class Wasm(Fmi3):
    """One instance of a component."""

    def __init__(
        self, name: str, described: Described, component: Path, log: Callable[[str], None], refuse: Callable[[str, int], None]
    ):
        compiler = engine()
        import wasmtime.component

        self.name, self.described, self.log, self.refuse = name, described, log, refuse
        self.keeps_state = not described.description.coSimulation.canGetAndSetFMUstate
        self.slave = WasmInstance(self)
        self.returns: list[str] = []
        self.reached = ctypes.c_double()
        self.store = wasmtime.Store(compiler)
        with wasmtime.component.Linker(compiler) as linker:
            with linker.root() as root:
                with root.add_instance(PACKAGE.format("callbacks")) as callbacks:
                    callbacks.add_func("log-message", self.message)
                    for name_of_none in ("clock-update", "lock-preemption", "unlock-preemption"):
                        callbacks.add_func(name_of_none, lambda store: None)
                with root.add_instance(PACKAGE.format("intermediate-update-callbacks")) as callbacks:
                    callbacks.add_func("intermediate-update", lambda store, *_: (False, 0.0))
            linker.add_wasip2()
            self.store.set_wasi(wasmtime.WasiConfig())
            self.unit = linker.instantiate(self.store, wasmtime.component.Component.from_file(compiler, component))
        self.interface = self.unit.get_export_index(self.store, PACKAGE.format("co-simulation"))

    def message(self, store: Any, instance: str, status: str, category: str, text: str) -> None:
        self.log(text.strip())

    def function(self, name: str) -> Callable[..., Any]:
        index = self.unit.get_export_index(self.store, name, self.interface)
        found = self.unit.get_func(self.store, index) if index is not None else None
        if found is None:
            raise FMICallException(name, ERROR)
        return found  # type: ignore[no-any-return]

    def call(self, method: str, *arguments: Any) -> Any:
        """A method of the instance; a status comes as its name."""
        return self.function(f"[method]{INSTANCE}.{method}")(self.store, self.resource, *arguments)

    def done(self, function: str, answer: Any) -> None:
        """Raises where the answer is the name of a status that is worse than a warning."""
        if isinstance(answer, str) and STATUS.index(answer) > WARNING:
            raise FMICallException(function, STATUS.index(answer))

    def instantiate(self) -> None:
        make = self.function(f"[static]{INSTANCE}.instantiate-co-simulation")
        token = self.described.description.instantiationToken
        self.resource = make(self.store, self.name, token, "", False, True, False, True, [])
        if self.resource is None:
            raise FMICallException("instantiate-co-simulation", ERROR)
        self.judged = self.judgements()

    def call_on(self, verb: str, block: Block) -> Callable[[], None]:
        kind = "int64" if block.kind == "Enumeration" else block.kind.lower()
        function = self.function(f"[method]{INSTANCE}.{verb.lower()}-{kind}")
        references, name = list(block.numbers), f"fmi3{verb}{block.kind}"

        def get() -> None:
            found = function(self.store, self.resource, references)
            if isinstance(found, str):
                self.refuse(name, STATUS.index(found))
            block.values[...] = found

        def put() -> None:
            status = STATUS.index(function(self.store, self.resource, references, block.values.tolist()))
            if status > WARNING:
                self.refuse(name, status)

        return get if verb == "Get" else put

    def set_text(self, reference: int, text: str) -> None:
        self.done("fmi3SetString", self.call("set-string", [reference], [text]))

    def enter_initialisation(self, start_time: float) -> None:
        self.done("fmi3EnterInitializationMode", self.call("enter-initialization-mode", None, start_time, None))

    def exit_initialisation(self) -> None:
        self.done("fmi3ExitInitializationMode", self.call("exit-initialization-mode"))

    def step(self, time: float, duration: float) -> None:
        for _, _, _, read in self.judged:
            read()
        found = self.call("do-step", time, duration, self.keeps_state)
        if isinstance(found, str):
            self.refuse("fmi3DoStep", STATUS.index(found))
            return
        self.reached.value = getattr(found, "last-successful-time")
        if getattr(found, "terminate-simulation"):
            self.log(f"the unit asked to end the simulation at time {self.reached.value:.9g} s")
            self.refuse("fmi3DoStep", ERROR)
        if getattr(found, "early-return"):
            self.go_on(time, duration)

    # The draft knows states as bytes only.

    def snapshot(self) -> Snapshot:
        state = self.call("get-fmu-state")
        self.done("fmi3GetFMUState", state)
        return state

    def revert(self, snapshot: Snapshot) -> None:
        self.done("fmi3SetFMUState", self.call("set-fmu-state", snapshot))

    def forget(self, snapshot: Snapshot) -> None:
        pass

    def serialise(self, snapshot: Snapshot) -> bytes:
        return bytes(snapshot)

    def deserialise(self, state: bytes) -> Snapshot:
        return state
