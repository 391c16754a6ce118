"""Experiments that an FMU carries (FMI-LS-REF): read, done, held against the results that came with it.

At each communication point inputs are set to the stimuli there (straight between two rows), then the
unit steps; the first row of results is that of the initialised unit.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, nearest
from fmu_src.references import EXPERIMENTS, FOLDER, MANIFEST
from orchestrator.component import Component
from orchestrator.regression import SAME_TIME, Comparison, Tolerance, compare
from orchestrator.series import read_series
from orchestrator.ssp.parameters import Parameter, apply, values_in
from orchestrator.ssp.xml import child, children, number, parse

Series = Mapping[str, Floats]
USUAL_TOLERANCE = 1e-6


@dataclass(frozen=True)
class Carried:
    """One experiment with its files read; times in s, ``tolerance`` relative to the largest value of a variable."""

    name: str
    stop: float
    step: float
    tolerance: float
    parameters: list[Parameter]
    stimuli: Series
    references: Series


def experiments_in(folder: Path) -> list[Carried]:
    """Those of an unpacked FMU; InputFault if it carries none, or one that cannot be read."""
    manifest = folder / MANIFEST
    if not manifest.is_file():
        raise InputFault(f"the FMU carries no experiments (no {MANIFEST}): give --reference, results of an earlier run")
    found = []
    for related in children(parse(manifest), "Related"):
        if related.get("type") == EXPERIMENTS and related.get("role", "").startswith("experiment"):
            file = beside(manifest, related.get("source", ""), folder)
            found += [read_experiment(element, file, folder) for element in children(parse(file), "Experiment")]
    if not found:
        raise InputFault(f"the FMU carries no experiments ({FOLDER} names none): give --reference, results of an earlier run")
    return found


def beside(file: Path, source: str, folder: Path) -> Path:
    """The file that another one refers to; it must lie within the FMU."""
    place = (file.parent / PurePosixPath(source)).resolve()
    if not source or not place.is_relative_to(folder.resolve()):
        raise InputFault(f"{file.name}: source {source!r} is not a file within the FMU")
    return place


def read_experiment(element: object, file: Path, folder: Path) -> Carried:
    from lxml import etree

    assert isinstance(element, etree._Element)
    name = element.get("name", "")
    times = child(element, "TransientSimulation")
    # Before mid 2026 the times stood in the experiment itself.
    times = element if times is None else times
    start, stop, step = (number(times, key, 0.0) for key in ("startTime", "stopTime", "stepSize"))
    if start != 0.0 or not 0.0 < step <= stop < np.inf:
        raise InputFault(
            f"{file.name}: experiment {name!r}: startTime = {start:g} s, stopTime = {stop:g} s, stepSize = {step:g} s: a start at 0, a positive"
            " step and an end after it are needed"
        )
    parts = {kind: None if (part := child(element, kind)) is None else beside(file, part.get("source", ""), folder)
             for kind in ("Parameters", "Stimuli", "References")}  # fmt: skip
    if parts["References"] is None:
        raise InputFault(f"{file.name}: experiment {name!r} has no References to be held against")
    stimuli = {} if parts["Stimuli"] is None else read_series(parts["Stimuli"])
    parameters = [] if parts["Parameters"] is None else values_in(parse(parts["Parameters"]))
    return Carried(name, stop, step, number(element, "tolerance", USUAL_TOLERANCE), parameters, stimuli, read_series(parts["References"]))


def perform(component: Component, experiment: Carried) -> dict[str, Floats]:
    """The variables of the references over the run of a unit that is not initialised yet."""
    for parameter in experiment.parameters:
        require(component, parameter.name, f"experiment {experiment.name!r} sets")
        apply(parameter, component, parameter.name)
    inputs = [name for name in experiment.stimuli if name != "time"]
    recorded = [name for name in experiment.references if name != "time"]
    for name in (*inputs, *recorded):
        require(component, name, f"experiment {experiment.name!r} names")
    steps = round(experiment.stop / experiment.step)
    time: Floats = experiment.step * np.arange(steps + 1.0)
    if inputs and experiment.stimuli["time"][-1] < time[-2] - SAME_TIME * experiment.stop:
        raise InputFault(
            f"experiment {experiment.name!r}: its stimuli end at {experiment.stimuli['time'][-1]:g} s, the run at {experiment.stop:g} s"
        )
    given = {name: np.interp(time, experiment.stimuli["time"], experiment.stimuli[name]) for name in inputs}
    rows = {name: np.zeros(steps + 1) for name in recorded}

    def exchange(n: int) -> None:
        for name in inputs:
            component.set(name, given[name][n])

    component.enter_initialisation(0.0)
    exchange(0)
    component.exit_initialisation()
    for n in range(steps + 1):
        if n > 0:
            exchange(n - 1)
            component.step(time[n - 1], experiment.step)
        for name in recorded:
            rows[name][n] = component.number(name)
    return {"time": time} | rows


def require(component: Component, name: str, said: str) -> None:
    if not component.has(name):
        raise InputFault(f"{said} {name!r}, which {component.name} does not have{nearest(name, component.signals)}")


def judged(component: Component, experiment: Carried, tolerances: list[Tolerance]) -> list[Comparison]:
    """Do the experiment and compare; ``tolerances`` go before its own."""
    series = perform(component, experiment)
    return compare(series, dict(experiment.references), [Tolerance("*", experiment.tolerance), *tolerances])
