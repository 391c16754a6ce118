"""A system ready to run, from an SSP package, a scenario file, or FMUs and connections.

    system = load("RvReducer.ssp")
    system["wear.acceleration"] = 1e6
    series = system.run(duration=0.2, record=["plant.output.lag"])
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from fmu_src.faults import InputFault
from orchestrator.call_limits import USUAL_LIMITS
from orchestrator.component import Component
from orchestrator.isolation import Isolated
from orchestrator.master import Connection, Master
from orchestrator.master.connections import resolve
from orchestrator.opening import open_fmu
from orchestrator.scenario import Limit, read_scenario
from orchestrator.schemes import SCHEMES
from orchestrator.scratch import Scratch
from orchestrator.settings import set_given
from orchestrator.ssp.importer import Structure, read_ssp
from orchestrator.ssp.parameters import apply

# Steps of a system whose files give none, and the step [s] where they do not even give a duration.
USUAL_STEPS = 1000
LAST_RESORT = 1e-3
MOST_STEPS = 1e7
# Bytes of what is recorded.
MOST_RECORDED = 4e9


@dataclass
class System:
    """A master, how long it is to run, and what is recorded: (component, variable)."""

    name: str
    master: Master
    steps: int
    recorded: list[tuple[str, str]] = field(default_factory=list)
    text: str = ""
    # Folders that the units' files are in, kept until the system is gone.
    folders: list[Scratch] = field(default_factory=list)
    initialised: bool = False

    def __getitem__(self, path: str) -> np.ndarray | float | int:
        name, signal = resolve(self.master.components, path)
        return self.master.components[name].get(signal.name)

    def __setitem__(self, path: str, value: npt.ArrayLike) -> None:
        """Set a parameter or input: a number in its unit, or a text with its own ("150 N.m")."""
        name, signal = resolve(self.master.components, path)
        set_given(self.master.components[name], signal.name, value)

    def initialise(self) -> None:
        if not self.initialised:
            self.master.initialise()
            self.initialised = True

    def run(
        self, duration: float | None = None, record: Iterable[str] = (), each_step: Callable[[], None] | None = None
    ) -> dict[str, np.ndarray]:
        """Run on, for ``duration`` [s] or as the file says; ``time`` and ``component.variable`` series.

        One row per base step, the first for where it starts.  ``record`` takes patterns: ``plant.*``.
        """
        self.initialise()
        master = self.master
        steps = self.steps if duration is None else whole_steps(duration, master.step_size)
        recorded = [*self.recorded, *(found for pattern in record for found in self.matching(pattern))]
        signals = {f"{name}.{variable}": (name, master.components[name].signal(variable)) for name, variable in recorded}
        buffers = {path: signal.new_buffer() for path, (_, signal) in signals.items()}
        readers = [
            master.components[name].reader(signal.references, buffers[path]) for path, (name, signal) in signals.items()
        ]
        size = 8.0 * (steps + 1) * sum(buffer.size for buffer in buffers.values())
        if size > MOST_RECORDED:
            raise InputFault(f"{steps} steps of {len(buffers)} recorded variables take {size / 1e9:.3g} GB: record fewer (--record), or run shorter")
        rows = {path: np.zeros((steps + 1, buffer.size), buffer.dtype) for path, buffer in buffers.items()}
        time, places = np.zeros(steps + 1), count()

        def keep() -> None:
            i = next(places)
            time[i] = master.time
            for read in readers:
                read()
            for path, buffer in buffers.items():
                rows[path][i] = buffer

        def stepped() -> None:
            if each_step is not None:
                each_step()
            keep()

        keep()
        master.run(steps, stepped)
        return {"time": time} | {path: rows[path].reshape(steps + 1, *signals[path][1].shape) for path in rows}

    def matching(self, pattern: str) -> list[tuple[str, str]]:
        """Variables that a name or pattern stands for."""
        if not set(pattern) & set("*?"):
            # Under the name that was asked for, be it an old one.
            name, _ = resolve(self.master.components, pattern)
            return [(name, pattern[len(name) + 1 :])]
        found = [
            (name, variable) for name, component in self.master.components.items()
            for variable in component.signals if fnmatchcase(f"{name}.{variable}", pattern)
        ]  # fmt: skip
        if not found:
            raise InputFault(f"no variable matches {pattern!r}")
        return found

    def units(self) -> dict[str, str]:
        """Units of all variables by path, old names included."""
        found = {f"{n}.{v}": s.unit for n, c in self.master.components.items() for v, s in c.signals.items()}
        old = {f"{n}.{o}": found[f"{n}.{v}"] for n, c in self.master.components.items() for o, v in c.old_names().items() if v in c.signals}
        return old | found

    def close(self) -> None:
        self.master.close()
        for folder in self.folders:
            folder.remove()


def whole_steps(duration: float, step: float) -> int:
    steps = duration / step
    if not 1.0 <= steps * (1.0 + 1e-9) <= MOST_STEPS:
        raise InputFault(f"duration = {duration:g} s with steps of {step:g} s: from one to ten million steps")
    return round(steps)


def load(
    path: str | Path, step: float | None = None, isolate: bool = False, call_limit: Limit = None, duration: float | None = None,
    wasm: bool = False, **master: Any,
) -> System:  # fmt: skip
    """The system of an SSP package (.ssp, .ssd or a folder), a scenario (.toml), or a single FMU.

    ``step`` and ``duration`` [s] and options of ``Master`` (scheme, extrapolation, step_control, ...) go before
    what the file says; with ``isolate`` every FMU runs in a process of its own, which is ended where a call takes longer than
    ``call_limit`` [s], one number for all calls or several by kind: ``{"step": 30}``; with ``wasm`` every FMU runs as WebAssembly.
    """
    path = Path(path)
    require_duration(step, "step")
    require_duration(duration, "duration")
    system = loaded(path, step, isolate, call_limit, duration, wasm, master)
    if call_limit is not None and not any(isinstance(unit, Isolated) for unit in system.master.components.values()):
        system.close()
        raise InputFault("a call limit holds for units in processes of their own alone: give isolate (--isolate) too")
    return system


def require_duration(value: float | None, name: str) -> None:
    if value is not None and not 0.0 < value < math.inf:
        raise InputFault(f"{name} = {value:g} s: a positive number of seconds is needed")


def loaded(
    path: Path, step: float | None, isolate: bool, call_limit: Limit, duration: float | None, wasm: bool, master: dict[str, Any]
) -> System:
    if path.suffix == ".toml":
        read = read_scenario(path, step, isolate, call_limit, duration, wasm)
        made = Master(read.components, read.connections, read.step, **read.options | master)
        return System(read.name, made, round(read.duration / read.step), read.recorded, read.text)
    if path.suffix == ".fmu":
        system = connect({path.stem: path}, (), step, isolate, call_limit, wasm, **master)
        if duration is not None:
            system.steps = whole_steps(duration, system.master.step_size)
        return system
    structure = read_ssp(path)
    require_duration(structure.step, f"{path}: the communication step that it names")
    limits = USUAL_LIMITS.with_changes(call_limit)
    components = {name: open_fmu(name, fmu, isolate, limits, wasm) for name, fmu in structure.fmus.items()}
    require_shapes(path, structure, components)
    for name, variable, parameter in structure.parameters:
        if parameter.kind == "String" or components[name].has(variable):
            apply(parameter, components[name], variable)
        else:
            structure.notes.append(f"{name}.{variable}")
    named = step or structure.step or usual_step(components, structure.stop)
    size = named or LAST_RESORT
    usual: dict[str, Any] = {"start_time": structure.start, "scheme": structure.scheme or SCHEMES[0]}
    made = Master(components, structure.connections, size, **usual | master)
    if structure.notes:
        made.warn(f"{path.name}: left out the values of {', '.join(structure.notes)}, which are no variables of the system")
    if named is None:
        made.warn(f"step = {size:g} s: neither {path.name} nor its units name a communication step; give one (--step)")
    if duration is None:
        duration = structure.stop - structure.start if structure.stop is not None else USUAL_STEPS * size
    return System(structure.name, made, whole_steps(duration, size), [], str(path), structure.folders)


def require_shapes(path: Path, structure: Structure, components: dict[str, Component]) -> None:
    """InputFault if an array connector is not as large as the FMU's variable."""
    for (name, connector), shape in structure.shapes.items():
        if name in components and components[name].signal(connector).shape != shape:
            raise InputFault(
                f"{path}: connector {connector} of {name} has the dimensions {' x '.join(map(str, shape))}, its FMU's variable"
                f" {' x '.join(map(str, components[name].signal(connector).shape)) or 'none'}; write the FMU's"
            )


def connect(
    fmus: Mapping[str, str | Path | Component], connections: Sequence[Connection | tuple[str, str]],
    step: float | None = None, isolate: bool = False, call_limit: Limit = None, wasm: bool = False, **master: Any,
) -> System:  # fmt: skip
    """A system of FMUs by name and their connections; see ``load``."""
    require_duration(step, "step")
    limits = USUAL_LIMITS.with_changes(call_limit)
    components = {
        name: fmu if isinstance(fmu, Component) else open_fmu(name, fmu, isolate, limits, wasm) for name, fmu in fmus.items()
    }
    size = step or usual_step(components, None)
    if size is None:
        raise InputFault("no step: the units name no communication step; give one (step, --step)")
    return System("system", Master(components, connections, size, **master), USUAL_STEPS)


def usual_step(components: dict[str, Component], stop: float | None) -> float | None:
    """The shortest step that a unit's default experiment names, else a thousandth of the duration."""
    named = [step for c in components.values() if (step := c.usual_step) is not None]
    return min(named) if named else stop / USUAL_STEPS if stop else None
