"""Scenario files: any number of units, their connections, and what to record.

    [scenario]
    name = "pair"
    step = { value = 1.3, unit = "ms" }
    duration = { value = 2, unit = "s" }
    scheme = "gauss-seidel"
    extrapolation = 1                 # optional, as is [step_control]

    [components.plant]
    fmu = "../dist/RvPlant.fmu"       # or reducer = "RV20E-121", unit = "plant"
    ratio = 1                         # base steps per step of this unit
    parameters = { output.load_torque = "150 N.m" }
    record = ["output.lag", "mesh.force"]

    [[connections]]
    from = "plant.mesh.force_path"
    to = "wear.mesh.force_path"

Paths are relative to the file.  Every error names file, key, value and remedy.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, field_validator

from fmu_src.faults import InputFault
from fmu_src.names import dotted
from fmu_src.reading import parse_toml, read_text
from fmu_src.strict_file import NAME, Strict, validated
from fmu_src.units import UnitError, conversion
from orchestrator.call_limits import USUAL_LIMITS, CallLimits
from orchestrator.component import Component, InProcess
from orchestrator.master import Connection, LoopSettings, StepControl
from orchestrator.master.power import THRESHOLD
from orchestrator.opening import open_fmu
from orchestrator.settings import set_given
from reducers.reducer import load_reducer

REMEDY = "see docs/scenarios.md"
# Seconds for all calls of a unit, or by kind of call; None: as the file says, or as usual.
Limit = float | Mapping[str, float] | CallLimits | None


class Quantity(Strict):
    value: float
    unit: str


class ScenarioHead(Strict):
    name: str = Field(pattern=NAME)
    step: Quantity
    duration: Quantity
    start: Quantity = Quantity(value=0.0, unit="s")
    scheme: Literal["gauss-seidel", "jacobi"] = "gauss-seidel"
    extrapolation: Literal[0, 1, 2] = 0
    power_threshold: float = Field(default=THRESHOLD, gt=0.0)
    call_limit: float | dict[str, float] | None = None


class StepControlEntry(Strict):
    tolerance: float = 1e-4
    method: Literal["auto", "doubling", "extrapolation"] = "auto"
    halvings: int = 12
    watch: tuple[str, ...] = ()


class LoopsEntry(Strict):
    method: Literal["newton", "fixed-point"] = "newton"
    tolerance: float = 1e-10
    iterations: int = 50


class ComponentEntry(Strict):
    fmu: str | None = None
    reducer: str | None = None
    unit: Literal["plant", "wear", "reducer"] | None = None
    ratio: int = Field(default=1, ge=1)
    isolate: bool = False
    wasm: bool = False
    call_limit: float | dict[str, float] | None = None
    parameters: dict[str, str | float | int] = {}
    record: list[str] = []

    @field_validator("parameters", mode="before")
    @classmethod
    def by_structured_name(cls, given: Any) -> Any:
        return dotted(given) if isinstance(given, dict) else given


class ConnectionEntry(Strict):
    source: str = Field(alias="from")
    target: str = Field(alias="to")
    factor: float = 1.0
    offset: float = 0.0


class PowerBondEntry(Strict):
    effort: str
    flow: str


class ScenarioFile(Strict):
    scenario: ScenarioHead
    components: dict[str, ComponentEntry] = Field(min_length=1)
    connections: list[ConnectionEntry] = []
    step_control: StepControlEntry | None = None
    loops: LoopsEntry = LoopsEntry()
    power_bonds: list[PowerBondEntry] = []


@dataclass(frozen=True)
class Scenario:
    """What a file says, its components made: ``step`` and ``duration`` [s], what is recorded, options of the master."""

    name: str
    components: dict[str, Component]
    connections: list[Connection]
    step: float
    duration: float
    recorded: list[tuple[str, str]]
    options: dict[str, Any]
    text: str


def read_scenario(
    path: str | Path, step: float | None = None, isolate: bool = False, call_limit: Limit = None, duration: float | None = None,
    wasm: bool = False,
) -> Scenario:  # fmt: skip
    """Read a scenario file and make its components; ``step``, ``call_limit`` and ``duration`` go before those of the file."""
    path = Path(path)
    text = read_text(path, "scenario file", REMEDY)
    content = validated(ScenarioFile, parse_toml(text, path, REMEDY), path, REMEDY)
    head = content.scenario
    own_step, own_duration, start = (
        seconds(getattr(head, key), f"{path}: scenario.{key}") for key in ("step", "duration", "start")
    )
    step, duration = own_step if step is None else step, own_duration if duration is None else duration
    if not 0.0 < step < math.inf or not step * (1.0 - 1e-9) <= duration <= 1e7 * step or not abs(start) < math.inf:
        raise InputFault(
            f"{path}: start = {start} s, step = {step} s, duration = {duration} s: step and duration both positive, from one to ten million steps"
        )
    components = {
        name: make_component(name, entry, path, isolate, (head.call_limit, entry.call_limit, call_limit), wasm)
        for name, entry in content.components.items()
    }
    control = content.step_control
    options = {
        "ratios": {name: entry.ratio for name, entry in content.components.items()},
        "scheme": head.scheme, "start_time": start, "extrapolation": head.extrapolation,
        "step_control": StepControl(**dict(control)) if control is not None else None,
        "loops": LoopSettings(**dict(content.loops)), "power_threshold": head.power_threshold,
        "power_bonds": [(bond.effort, bond.flow) for bond in content.power_bonds],
    }  # fmt: skip
    connections = [Connection(c.source, c.target, c.factor, c.offset) for c in content.connections]
    recorded = [(name, signal) for name, entry in content.components.items() for signal in entry.record]
    for name, signal in recorded:
        components[name].as_written(signal)
    return Scenario(head.name, components, connections, step, duration, recorded, options, text)


def seconds(quantity: Quantity, place: str) -> float:
    try:
        factor, _ = conversion(quantity.unit, "s")
    except UnitError as problem:
        raise InputFault(f"{place} = {quantity.value} {quantity.unit}: {problem}") from None
    return factor * quantity.value


def make_component(name: str, entry: ComponentEntry, path: Path, isolate: bool, call_limits: Sequence[Limit], wasm: bool) -> Component:
    """One unit; of the limits the later go before the earlier."""
    place = f"{path}: components.{name}"
    limits = USUAL_LIMITS
    try:
        for given in call_limits:
            limits = limits.with_changes(given)
    except InputFault as fault:
        raise InputFault(f"{place}: {fault}") from None
    if entry.call_limit is not None and not (isolate or entry.isolate):
        raise InputFault(f"{place}.call_limit = {entry.call_limit!r}: only a unit in a process of its own can be ended; set isolate = true")
    if entry.fmu is not None and entry.reducer is None:
        component = open_fmu(name, path.parent / entry.fmu, isolate or entry.isolate, limits, wasm or entry.wasm)
    elif entry.reducer is not None and entry.fmu is None:
        if entry.unit is None:
            raise InputFault(f'{place}: reducer needs unit = "plant", "wear" or "reducer" (both in one)')
        reducer_path = path.parent / entry.reducer if entry.reducer.endswith(".toml") else entry.reducer
        unit = {"plant": "rv_plant", "wear": "wear_fmu", "reducer": "rv_reducer"}[entry.unit]
        component = InProcess(name, load_reducer(reducer_path).specification(unit))
    else:
        raise InputFault(f'{place}: give either fmu = "FILE" or reducer = "NAME" with unit = "plant", "wear" or "reducer"')
    for key, value in entry.parameters.items():
        set_parameter(component, key, value, place)
    return component


def set_parameter(component: Component, key: str, value: str | float, place: str) -> None:
    """A number is in the variable's unit, a text carries its own."""
    name = component.as_written(key).name
    try:
        set_given(component, name, value)
    except (UnitError, InputFault) as problem:
        raise InputFault(f"{place}.parameters.{key} = {value!r}: {problem}") from None
