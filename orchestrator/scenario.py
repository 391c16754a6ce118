"""Scenario files: any number of units, their connections, and what to record.

    [scenario]
    name = "pair"
    step = { value = 1.3, unit = "ms" }
    duration = { value = 2, unit = "s" }
    scheme = "gauss-seidel"

    [components.plant]
    fmu = "../dist/RvPlant.fmu"       # or reducer = "RV20E-121", unit = "plant"
    ratio = 1                         # base steps per step of this unit
    parameters = { load_torque = "150 N.m" }
    record = ["lag", "mesh_force"]

    [[connections]]
    from = "plant.mesh_force"
    to = "wear.mesh_force"

Paths are relative to the file.  Every error names file, key, value and remedy.
"""

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field, ValidationError

from fmu_src.units import UnitError, conversion
from orchestrator.component import Component, InProcess
from orchestrator.faults import InputFault
from orchestrator.fmu import open_fmu
from orchestrator.master import Master
from orchestrator.reducer import NAME, Strict, load_reducer
from orchestrator.settings import parse_value


class Quantity(Strict):
    value: float
    unit: str


class ScenarioHead(Strict):
    name: str = Field(pattern=NAME)
    step: Quantity
    duration: Quantity
    start: Quantity = Quantity(value=0.0, unit="s")
    scheme: Literal["gauss-seidel", "jacobi"] = "gauss-seidel"


class ComponentEntry(Strict):
    fmu: str | None = None
    reducer: str | None = None
    unit: Literal["plant", "wear"] | None = None
    ratio: int = Field(default=1, ge=1)
    parameters: dict[str, str | float | int] = {}
    record: list[str] = []


class ConnectionEntry(Strict):
    source: str = Field(alias="from")
    target: str = Field(alias="to")


class ScenarioFile(Strict):
    scenario: ScenarioHead
    components: dict[str, ComponentEntry] = Field(min_length=1)
    connections: list[ConnectionEntry] = []


@dataclass
class Scenario:
    """A master ready to be initialised, and what to record."""

    name: str
    master: Master
    steps: int
    recorded: list[tuple[str, str]]
    text: str


def load_scenario(path: str | Path) -> Scenario:
    """Read a scenario file and make its components."""
    path = Path(path)
    if not path.is_file():
        raise InputFault(f"no scenario file at {path}")
    try:
        text = path.read_text(encoding="utf-8")
        content = ScenarioFile(**tomllib.loads(text))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        raise InputFault(f"{path}: not a TOML file: {problem}") from None
    except ValidationError as problem:
        first = problem.errors()[0]
        key = ".".join(str(part) for part in first["loc"])
        raise InputFault(f"{path}: {key} = {first['input']!r}: {first['msg']}; see docs/scenarios.md") from None
    head = content.scenario
    step, duration, start = (
        seconds(getattr(head, key), f"{path}: scenario.{key}") for key in ("step", "duration", "start")
    )
    if not step > 0.0 or not step <= duration <= 1e7 * step:
        raise InputFault(
            f"{path}: step = {step} s, duration = {duration} s: both positive, from one to ten million steps"
        )
    components = {
        name: make_component(name, entry, path) for name, entry in content.components.items()
    }
    master = Master(
        components, [(c.source, c.target) for c in content.connections], step,
        {name: entry.ratio for name, entry in content.components.items()}, head.scheme, start,
    )
    recorded = [(name, signal) for name, entry in content.components.items() for signal in entry.record]
    for name, signal in recorded:
        components[name].signal(signal)
    return Scenario(head.name, master, round(duration / step), recorded, text)


def seconds(quantity: Quantity, place: str) -> float:
    try:
        factor, _ = conversion(quantity.unit, "s")
    except UnitError as problem:
        raise InputFault(f"{place} = {quantity.value} {quantity.unit}: {problem}") from None
    return factor * quantity.value


def make_component(name: str, entry: ComponentEntry, path: Path) -> Component:
    place = f"{path}: components.{name}"
    if (entry.fmu is None) == (entry.reducer is None):
        raise InputFault(f'{place}: give either fmu = "FILE" or reducer = "NAME" with unit = "plant" or "wear"')
    if entry.fmu is not None:
        component: Component = open_fmu(name, path.parent / entry.fmu)
    else:
        if entry.unit is None:
            raise InputFault(f'{place}: reducer needs unit = "plant" or unit = "wear"')
        reducer_path = path.parent / entry.reducer if entry.reducer.endswith(".toml") else entry.reducer
        unit = {"plant": "rv_plant", "wear": "wear_fmu"}[entry.unit]
        component = InProcess(name, load_reducer(reducer_path).specification(unit))
    for key, value in entry.parameters.items():
        set_parameter(component, key, value, place)
    return component


def set_parameter(component: Component, key: str, value: str | float, place: str) -> None:
    """A number is in the variable's unit, a text carries its own."""
    signal = component.signal(key)
    try:
        component.set(key, parse_value(value, signal) if isinstance(value, str) else value)
    except (UnitError, InputFault) as problem:
        raise InputFault(f"{place}.parameters.{key} = {value!r}: {problem}") from None


def run_scenario(scenario: Scenario, each_step=None) -> dict[str, np.ndarray]:
    """Run it; returns ``time`` and ``component.signal`` series, one row per base step."""
    master = scenario.master
    master.initialise()
    buffers, readers = [], []
    for name, signal_name in scenario.recorded:
        component = master.components[name]
        signal = component.signal(signal_name)
        buffers.append(np.zeros(len(signal.references), "i8" if signal.is_integer else "f8"))
        readers.append(component.reader(signal.references, buffers[-1]))
    rows = [np.zeros((scenario.steps + 1, buffer.size), buffer.dtype) for buffer in buffers]
    time = np.zeros(scenario.steps + 1)
    for i in range(scenario.steps + 1):
        if i > 0:
            master.step()
            if each_step is not None:
                each_step()
        time[i] = master.time
        for read, buffer, row in zip(readers, buffers, rows):
            read()
            row[i] = buffer
    series = {"time": time}
    for (name, signal_name), row in zip(scenario.recorded, rows):
        shape = master.components[name].signal(signal_name).shape
        series[f"{name}.{signal_name}"] = row.reshape(scenario.steps + 1, *shape)
    return series
