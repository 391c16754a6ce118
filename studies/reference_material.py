"""What this project's FMUs carry besides themselves (FMI-LS-REF): experiments with their results, values, worn states, their effects.

``smoke-test`` runs at rated speed and torque for one crank turn, ``validation`` through a change of torque
and a reversal while wear counts a million times.
"""

import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.description import guid
from fmu_src.effect import Effect
from fmu_src.package import write_archive
from fmu_src.presentation import STYLE
from fmu_src.references import DOCUMENTATION, EXPERIMENTS, FOLDER, MANIFEST, VALUES, VERSION, Experiment, Related, experiments, manifest, written
from fmu_src.source_hash import source_hash
from fmu_src.state import STEPPING, State, pack
from orchestrator.component import InProcess
from orchestrator.experiments import Carried, Series, perform
from orchestrator.ssp.exporter import Unit, value_set, values
from orchestrator.ssp.parameters import Parameter
from reducers.reducer import Reducer
from rv_plant.effects import EFFECTS as PLANT_EFFECTS
from studies.worn import worn_reducer
from wear_fmu.effects import EFFECTS as WEAR_EFFECTS

TURN = 72
TOLERANCE = 1e-6
# Part by which inputs are moved to see what is rounding.
ROUNDING = 1e-13
# How the solver fared is another matter on another machine.
OF_THE_SOLVER = {"residual", "iterations", "substeps", "constraint_drift", "energy_error"}
# States of worn reducers [h]; the unit that carries the surfaces has them.
WORN_HOURS = (2000.0, 5000.0, 10_000.0)
CARRIES_SURFACES = ("wear_fmu", "rv_reducer")
ACCELERATION = 1e6
# Forces that the wear unit is tried with, alike at all contacts [N]: a third of rated ones, assumed.
TRIAL_FORCES = {"mesh.force": 100.0, "roller.force": 50.0}
# Inputs of the plant.
SPEED, TORQUE, SURROUNDINGS = "input.speed", "output.load_torque", "heat.ambient_temperature"
EFFECTS = {"rv_plant": (PLANT_EFFECTS,), "wear_fmu": (WEAR_EFFECTS,), "rv_reducer": (PLANT_EFFECTS, WEAR_EFFECTS)}


@dataclass(frozen=True)
class Run:
    """An experiment with the inputs, settings and results that all flavours of a unit have in common."""

    kind: str
    description: str
    stop: float
    settings: list[Parameter]
    stimuli: Series
    results: Series


def add_references(paths: Iterable[Path], reducer: Reducer, unit: str, step: float) -> None:
    """Put them into finished FMUs of a reducer's unit; ``step`` [s] is a position of the crank turn."""
    runs = runs_of(reducer, unit, step)
    is_new = unit in CARRIES_SURFACES and not reducer.worn
    states = {hours: worn_state(reducer, unit, hours) for hours in (WORN_HOURS if is_new else ())}
    page = "documentation/index.html"
    link = b"<p><a href=fmi-ls-ref.html>Experiments, values and states</a> that this FMU carries; <a href=effects.html>effects</a> that it knows.</p>\n<h2>"
    for path in paths:
        with zipfile.ZipFile(path) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        files[page] = files[page].replace(b"<h2>", link, 1)
        write_archive(files | material(path, reducer, unit, step, runs, states), path)


def runs_of(reducer: Reducer, unit: str, step: float) -> list[Run]:
    found = []
    for kind, description in (("smoke-test", "one crank turn at rated speed and torque"),
                              ("validation", "three crank turns: a change of torque, a reversal, wear that counts a million times")):
        stimuli, settings = stimuli_of(kind, reducer, unit, step), settings_of(kind, reducer, unit)
        experiment = Carried(kind, step * (len(stimuli["time"]) - 1), step, TOLERANCE, settings, stimuli, {})
        found.append(Run(kind, description, experiment.stop, settings, stimuli, results_of(reducer, unit, experiment)))
    return found


def material(path: Path, reducer: Reducer, unit: str, step: float, runs: Iterable[Run], states: Mapping[float, bytes]) -> dict[str, bytes]:
    """The files by their place in the archive; ``states`` are those of worn units, by hours."""
    fmu = Unit(unit, path)
    files: dict[str, bytes] = {}
    listed = []
    for run in runs:
        kind = run.kind
        described = Experiment(kind, run.description, run.stop, step, TOLERANCE, f"{kind}-results.csv", f"{kind}-inputs.csv",
                               f"{kind}-values.ssv" if run.settings else "")
        files |= {f"{kind}.exp": experiments(f"{reducer.name} {fmu.described.description.modelName}", [described]),
                  f"{kind}-inputs.csv": csv_of(run.stimuli), f"{kind}-results.csv": csv_of(run.results)}
        if run.settings:
            files[f"{kind}-values.ssv"] = written(parameter_set(fmu, run.settings, kind))
        listed.append(Related(EXPERIMENTS, f"{kind}.exp", f"experiment/{kind}", run.description))
    files["new.ssv"] = written(renamed(value_set([fmu], values(fmu, {}, set()), ""), f"{reducer.name} new"))
    listed.append(Related(VALUES, "new.ssv", "parameter", f"{reducer.name} as its reducer file has it", ("hours:0",)))
    for hours, state in states.items():
        files[f"worn-{hours:g}h.state"] = state
        listed.append(Related("application/octet-stream", f"worn-{hours:g}h.state", "serialized-state",
                              f"{reducer.name} after {hours:g} h at rated speed and torque, at rest at time 0", (f"hours:{hours:g}",)))
    listed.append(Related("text/html", f"{DOCUMENTATION}/effects.html", "rationale", "effects beyond the ideal reducer: laws, ranges, sources"))
    listed.append(Related("text/html", f"{DOCUMENTATION}/index.html", "document", "the unit, its connections, every variable"))
    placed = {f"{FOLDER}/{name}": content for name, content in files.items()} | {MANIFEST: manifest(listed)}
    return placed | {
        "documentation/fmi-ls-ref.html": about(listed).encode(), "documentation/effects.html": effects_page(unit).encode(),
    }  # fmt: skip


def stimuli_of(kind: str, reducer: Reducer, unit: str, step: float) -> Series:
    """Inputs at every communication point, so that nothing depends on how a tool interpolates."""
    count = TURN if kind == "smoke-test" else 3 * TURN
    plant = InProcess("plant", reducer.specification("rv_plant"))
    n: Floats = np.arange(count + 1.0)
    speed, torque, temperature = (np.full(count + 1, plant.number(name)) for name in (SPEED, TORQUE, SURROUNDINGS))
    if kind == "validation":
        torque[n >= TURN // 2] *= 0.6
        # Down to rest and up the other way within half a turn's time.
        speed *= np.clip(1.0 - (n - TURN) / (0.25 * TURN), -1.0, 1.0)
    time: Floats = step * n
    stimuli = {"time": time, SPEED: speed, TORQUE: torque, SURROUNDINGS: temperature}
    if unit != "wear_fmu":
        return stimuli
    moved = ("crank.angle", "crank.speed", "output.angle", "cage.angle")
    driven = Carried(kind, step * count, step, TOLERANCE, [], stimuli, dict.fromkeys(moved, n))
    return perform(plant, driven) | {"heat.contact_temperature": stimuli[SURROUNDINGS]}


def settings_of(kind: str, reducer: Reducer, unit: str) -> list[Parameter]:
    settings = []
    if kind == "validation" and unit in CARRIES_SURFACES:
        settings.append(Parameter("acceleration", "Real", repr(ACCELERATION)))
    if unit == "wear_fmu":
        settings += [Parameter(name, "Real", repr(force), reducer.wear.by_path[name].unit) for name, force in TRIAL_FORCES.items()]
    return settings


def results_of(reducer: Reducer, unit: str, experiment: Carried) -> Series:
    """All scalar outputs but those of rounding alone: forces that balance to 1e-8 N are others on the next machine."""
    runs = []
    for factor in (1.0, 1.0 + ROUNDING):
        component = InProcess(unit, reducer.specification(unit))
        outputs = [v.path for v in component.table.of_role("output") if not v.shape and v.name not in OF_THE_SOLVER]
        stimuli = {name: values if name == "time" else factor * values for name, values in experiment.stimuli.items()}
        runs.append(perform(component, replace(experiment, stimuli=stimuli, references={name: np.zeros(1) for name in outputs})))
    exact, moved = runs
    return {name: v for name, v in exact.items() if np.abs(moved[name] - v).max() <= 1e-3 * TOLERANCE * np.abs(v).max()}


def csv_of(series: Series) -> bytes:
    rows = [",".join(series), *(",".join(repr(float(value)) for value in row) for row in zip(*series.values()))]
    return ("\n".join(rows) + "\n").encode()


def parameter_set(fmu: Unit, settings: list[Parameter], name: str) -> Element:
    """An SSV of settings, arrays element by element in FMI 2 and whole in FMI 3."""
    root = renamed(value_set([fmu], [], ""), name)
    parameters = root.find("ssv:Parameters")
    assert parameters is not None
    kind = "Float64" if fmu.version == "2.0" else "Real"
    for setting in settings:
        signal = fmu.signals[setting.name]
        names = fmu.names(setting.name)
        for element_name in names:
            element = ElementTree.SubElement(parameters, "ssv:Parameter", name=element_name)
            size = len(signal.references) if len(names) == 1 else 1
            value = ElementTree.SubElement(element, f"ssv:{kind}", value=" ".join([setting.text] * size))
            if setting.unit:
                value.set("unit", setting.unit)
            for length in signal.shape if len(names) == 1 else ():
                ElementTree.SubElement(element, "ssc:Dimension", size=str(length))
    return root


def renamed(root: Element, name: str) -> Element:
    root.set("name", name)
    return root


def worn_state(reducer: Reducer, unit: str, hours: float) -> bytes:
    """What fmi3SerializeFMUState gives of the worn unit; it goes into the new one, whose identity it bears."""
    component = InProcess(unit, worn_reducer(reducer, hours).specification(unit))
    component.exit_initialisation()
    identity = guid(reducer.specification(unit), source_hash())
    return pack(identity, State(component.cells[: component.table.state_cells], STEPPING, 0.0))


def about(listed: Iterable[Related]) -> str:
    """documentation/fmi-ls-ref.html."""
    rows = "\n".join(f"<tr><td><code>{escape(file.source)}</code><td>{escape(file.role)}<td>{escape(file.description)}" for file in listed)
    return (
        f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Experiments, values and states</title><style>{STYLE}</style>\n"
        f"<h1>Experiments, values and states</h1><p>Described in <code>{FOLDER}</code> by the layered standard FMI-LS-REF {VERSION}.</p>\n"
        "<p>An experiment sets its values before initialisation, and at every communication point the inputs of its row; results are those of the"
        f" communication points. They are met to {TOLERANCE:g} of a variable's largest value: <code>rvwear check</code> does them.</p>\n"
        "<p>A serialised state is restored after initialisation, at time 0. It is complete: parameters too are those that it was saved with.</p>\n"
        f"<table><tr><th>file<th>role<th>what it is\n{rows}</table>\n"
    )


def effects_page(unit: str) -> str:
    """documentation/effects.html: every effect with law, source, signature and parameters."""
    parts = [
        f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Effects</title><style>{STYLE}</style>\n<h1>Effects</h1>\n"
        "<p>What a real reducer may do beyond the ideal model. Each is off as the unit comes: figures are then the same to the last bit.</p>"
    ]
    for catalogue in EFFECTS[unit]:
        parts += [effect_section(name, effect) for name, effect in sorted(catalogue.items())]
    return "\n".join(parts) + "\n"


def effect_section(name: str, effect: Effect) -> str:
    rows = "".join(
        f"<tr><td><code>{escape(p.variable.name)}</code><td>{escape(p.variable.unit)}<td>{p.variable.start:g}<td>{escape(p.kind)}"
        f"<td>{escape(p.variable.description)}" for p in effect.parameters
    )
    return (
        f"<h2>{escape(effect.title)}</h2><p><code>{escape(name)}</code>: {escape(effect.law)}</p><p>Expected: {escape(effect.signature)}."
        f" Source: {escape(effect.source)}.</p><table><tr><th>parameter<th>unit<th>off<th>kind<th>meaning{rows}</table>"
    )
