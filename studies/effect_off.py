"""An effect of one's own, tried with its amplitudes off: it has to change nothing.

No reading of its text can tell that, so the units' kernels run as plain Python, at rest and in motion, and what the
effect's hooks change meanwhile is looked at from outside.
"""

import json
import sys
import traceback
from collections.abc import Callable
from itertools import product
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from fmu_src.effect import Effect
from fmu_src.effect_finding import Finding
from reducers.reducer import load_reducer
from rv_plant import effects as of_plant
from rv_plant import plant
from rv_reducer.exchange import PLANT_TO_WEAR
from studies.effect_child import findings_by
from wear_fmu import accumulator
from wear_fmu import effects as of_wear

# The effects of each unit, and whether it is the one that wears.
UNITS = {"rv_plant": (of_plant, False), "wear_fmu": (of_wear, True)}
# Nothing of what an effect changes is set in the first; on the second an effect of output pins can act.
REDUCER, WITH_PINS = "RV20E-121-rigid", "cycloidal-actuator"
# Communication steps [s]: at rest, and in motion, where the plant divides them.
STEP, IN_MOTION = 1e-3, 2e-5
PATIENCE = 120.0
# What ``factor`` is asked beside a reducer's own contacts: surface, line load [N/m], radius [m], sliding speed [m/s], depth worn [m].
PROBES = ((0, 1, 2), (1e3, 1e4, 5e4, 2e5, 1e6, 1e7), (1e-3, 1e-2), (1e-3, 1.0), (0.0, 1e-6, 1e-5, 1e-4))


def changes_when_off(file: Path) -> list[Finding]:
    """What a sound effect's file changes with its amplitudes off, a line for each hook; see ``findings_by``."""
    return findings_by("studies.effect_off:main", file, "tried with its amplitudes off", PATIENCE, plain=True)


def main(name: str) -> None:
    """In the process itself: prints the findings as JSON."""
    file = Path(name)
    print(json.dumps([(name, line, text) for line, text in changes_of(file.parent.name, file.stem)[file.stem]]))


def changes_of(unit: str, *names: str) -> dict[str, list[tuple[int, str]]]:
    """By effect (line, what is wrong) for each of its hooks that does something while it is off; where kernels are plain Python.

    Several run at once, on a reducer on which all of them can act, and each of their hooks is looked at by itself.
    """
    effects, wears = UNITS[unit]
    composed, chosen = sys.modules[f"{unit}.effects.composed"], [effects.EFFECTS[name] for name in names]
    found: dict[str, dict[str, tuple[int, str]]] = {name: {} for name in names}
    hooks: dict[str, Any] = {}
    for name in names:
        hooks |= watch(composed, effects, name, found[name])
    try:
        for fidelity in (0,) if wears else (0, 1):
            with np.errstate(all="ignore"):
                run(chosen, wears, fidelity)
    except ArithmeticError as error:
        lines = {name: line_in(error, name) for name in names}
        name = next((name for name, line in lines.items() if line), names[0])
        found[name][""] = lines[name], f"with its amplitudes off, the effect ends in {type(error).__name__}: {error}"
    finally:
        vars(composed).update(hooks)
    return {name: list(told.values()) for name, told in found.items()}


def run(effects: list[Effect], wears: bool, fidelity: int) -> None:
    """Start the units and step them once."""
    reducer = load_reducer(WITH_PINS if any(effect.needs == "output pins" for effect in effects) else REDUCER)
    machine, surface = (table.new_records().view(np.recarray) for table in (reducer.plant, reducer.wear))
    machine["fidelity"] = fidelity
    for off in (p.variable for effect in effects for p in effect.amplitudes()):
        (surface if wears else machine)[off.name] = off.start
    plant.initialise(machine)
    if wears:
        give(machine, surface)
        accumulator.initialise(surface)
    step = IN_MOTION if fidelity else STEP
    plant.step(machine, 0.0, step)
    if wears:
        give(machine, surface)
        accumulator.step(surface, 0.0, step)


def give(machine: "np.recarray[Any, Any]", surface: "np.recarray[Any, Any]") -> None:
    """What the plant hands to the wear unit."""
    # The temperature stays as it is.
    for name in (name.replace(".", "_") for name in PLANT_TO_WEAR if not name.startswith("heat.")):
        surface[name] = machine[name]


def watch(composed: ModuleType, effects: ModuleType, name: str, found: dict[str, tuple[int, str]]) -> dict[str, Any]:
    """Look over the shoulder of each of the effect's hooks; what they were before."""
    # Counts of who is on, not physics.
    counts = set(getattr(effects, "NEEDS", {}).values())
    hooks = {f"{hook}_{name}": getattr(composed, f"{hook}_{name}", None) for hook in effects.HOOKS}
    present = {called: function for called, function in hooks.items() if function is not None}
    for called, function in present.items():
        hook = called.removesuffix(f"_{name}")
        fields = [field for field, how in effects.ALLOWED[hook].items() if how in ("+=", "*=") and field not in counts]
        count = next(iter(counts), "") if hook == "prepare" else ""
        setattr(composed, called, Watched(function, hook, fields, count, found))
    return present


class Watched:
    """A hook that tells what it changes; ``count`` is set after it, so that hooks are called that wait for an effect to be on."""

    def __init__(self, hook: Callable[..., Any], name: str, fields: list[str], count: str, found: dict[str, tuple[int, str]]):
        self.hook, self.name, self.fields, self.count, self.found = hook, name, fields, count, found
        self.is_probed = False

    def __call__(self, r: Any, *arguments: Any) -> Any:
        before = {field: np.array(r[field]) for field in self.fields}
        result = self.hook(r, *arguments)
        for field, old in before.items():
            if not np.array_equal(r[field], old):
                largest = np.max(np.abs(np.asarray(r[field]) - old))
                self.tell(f"changes r.{field} by {'up to ' if np.ndim(old) else ''}{largest:.3g}")
        if result is not None:
            self.judge(result, arguments)
            self.probe(r)
        if self.count:
            r[self.count] += 1
        return result

    def judge(self, factor: float, contact: tuple[Any, ...]) -> None:
        if factor != 1.0:
            surface, load, radius, speed, depth = contact
            place = f"surface {surface}, {load:.3g} N/m, radius {radius:.3g} m, {speed:.3g} m/s, {depth:.3g} m worn"
            self.tell(f"returns {factor:.6g}, not 1.0 ({place})")

    def probe(self, r: Any) -> None:
        """Contacts of every kind, once: an effect may wait for a load that this reducer does not have."""
        for contact in () if self.is_probed else product(*PROBES):
            self.judge(self.hook(r, *contact), contact)
        self.is_probed = True

    def tell(self, what: str) -> None:
        text = f"with its amplitudes off, {self.name} {what}: an effect that is off must change nothing"
        self.found.setdefault(self.name, (self.hook.__code__.co_firstlineno, text))


def line_in(error: BaseException, name: str) -> int:
    """The line of the effect's file on which it went wrong, or 0."""
    lines = [frame.lineno or 0 for frame in traceback.extract_tb(error.__traceback__) if Path(frame.filename).stem == name]
    return lines[-1] if lines else 0
