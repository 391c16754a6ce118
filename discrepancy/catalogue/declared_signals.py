"""The ``signals`` that an effect of one's own declares, held against what it changes on the virtual bench at its parameters' usual size.

A diagnosis looks for an effect where one of its signals was measured, and nowhere else: a word that is missing hides it, one that is too much has it looked
for in vain.  What takes a campaign's own axes or minutes is not judged: vibration, pin-on-disc tests, wear over hours of a plant's effect.
"""

import ast
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path

import numpy as np

from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.catalogue.examples import HOUR, cases
from discrepancy.catalogue.signature import SURFACES, WEAR_HOURS, conditions, record_of
from discrepancy.experiment.usual_noise import UNMEASURED
from discrepancy.held_names import HELD
from discrepancy.model_file import every_effect
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.candidates import shown_by
from discrepancy.prediction.observe import OBSERVED
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from discrepancy.scales import shown
from fmu_src.effect import Effect
from fmu_src.effect_finding import Finding
from reducers.reducer import load_reducer
from studies.effect_child import findings_by
from studies.hysteresis import torque_way
from wear_fmu.effects import EFFECTS as WEAR

# With friction, supports and heat, so that what multiplies them shows, too; on the second an effect of output pins can act.
REDUCER, WITH_PINS = "RV20E-121", "cycloidal-actuator"
PATIENCE = 120.0
# What changes by less than the noise of a usual bench shows nothing there; what is not declared has to stand out of it so many times (assumed).
STANDS_OUT = 3.0
# What a solver leaves is no change: less of the noise is nothing.
LEAST_RATIO = 0.01
# Noise (SI) beside that of ``UNMEASURED``, and of what has none there its share of the size (all assumed).
NOISE = UNMEASURED | {"temperature": 0.5, "efficiency": 0.005, "wear_profile": 1e-7}
SHARE = 0.05
HELD_AT, RUNNING_AT = ("rated", "40 K warmer"), ("rated", "40 K warmer", "load 10 %", "speed 10 %", "speed 200 %")
WORN_AT = ("rated", "40 K warmer", "load 150 %", "speed 20 %")
# Samples of an output turn, steps of a loop, samples of a surface.
TURN, STEPS, SURFACE = 360, 6, 24
PLANT = ("transmission_error", "hysteresis", "lost_motion", "torsional_stiffness", "input_torque", "no_load_torque", "efficiency", "temperature", "cage_speed")
WORN = ("wear_depth", "wear_profile", "mass_loss", "debris_iron")
# What is made of another quantity shows nothing where that does not.
MADE_OF = {"transmission_order": "transmission_error"}


def signal_doubts(file: Path) -> list[Finding]:
    """What a sound effect's file declares too much or too little, as findings at the line of its signals; empty of one without signals."""
    return findings_by("discrepancy.catalogue.declared_signals:main", file, "held against what it changes", PATIENCE, plain=False)


def main(name: str) -> None:
    """In the process itself: prints the findings as JSON."""
    file = Path(name)
    effect = every_effect()[file.stem]
    given = [node.lineno for node in ast.walk(ast.parse(file.read_bytes())) if isinstance(node, ast.keyword) and node.arg == "signals"]
    print(json.dumps([(name, given[0] if given else 0, text) for text in doubts_of(file.stem, effect)]))


def doubts_of(name: str, effect: Effect) -> list[str]:
    """A sentence for what changes and is not declared, and one for what is declared and does not change: all of it, or some."""
    return doubts_in(effect, changes_of(name, effect)) if effect.signals else []


def doubts_in(effect: Effect, found: Mapping[str, "Change"]) -> list[str]:
    """The same of changes that were computed; whoever shows these has the same sentences."""
    declared, reducer = shown_by(effect), reducer_for(effect)
    if not declared:
        return []
    lacking = [f"{q} ({change.text})" for q, change in found.items() if q not in declared and change.ratio > STANDS_OUT]
    said = []
    if lacking:
        said.append(f"signals lack {', '.join(lacking)}, which it changes at its usual size on {reducer}: where nothing else is measured a diagnosis does not"
                    " look for it; declare them, or leave them out on purpose")  # fmt: skip
    judged = {MADE_OF.get(q, q) for q in declared}
    if judged <= set(found) and all(found[q].ratio < 1.0 for q in judged):
        most = max((change for q, change in found.items() if q in judged), key=lambda change: change.ratio)
        said.append(f"none of its signals is changed by more than noise at its usual size on {reducer}, most {most.quantity} ({most.text}):"
                    " look at the usual size in EFFECT, and at what the hooks change")  # fmt: skip
    elif still := [q for q in declared if (change := found.get(MADE_OF.get(q, q))) and change.ratio < LEAST_RATIO]:
        said.append(f"signals have {', '.join(still)}, changed by nothing at its usual size on {reducer}: where nothing else is measured a diagnosis looks"
                    " for it in vain; leave it out, or look at what the hooks change")  # fmt: skip
    return said


def not_judged(effect: Effect, found: Mapping[str, "Change"]) -> list[str]:
    """What an effect declares and nobody looks at here: it may show there, so that it is not said to show nowhere."""
    return [q for q in shown_by(effect) if MADE_OF.get(q, q) not in found]


@dataclass(frozen=True)
class Change:
    """The largest change of a quantity, as a multiple of a usual bench's noise and in words: how much, at which condition, and that noise."""

    quantity: str
    ratio: float = 0.0
    size: str = ""
    place: str = ""
    noise: str = ""

    @property
    def text(self) -> str:
        return f"by {self.size}, {self.place}; a usual bench's noise is {self.noise}" if self.size else "by nothing"


def reducer_for(effect: Effect) -> str:
    """The reducer on which its signals are judged."""
    return WITH_PINS if effect.needs == "output pins" else REDUCER


def changes_of(name: str, effect: Effect) -> dict[str, Change]:
    """What an effect changes of each quantity that is judged, at its parameters' usual size."""
    bench = Bench(load_reducer(reducer_for(effect)), {})
    return largest_changes(bench, effect, [case.values for case in cases(name, effect)], WORN if name in WEAR else PLANT)


def largest_changes(bench: Bench, effect: Effect, strengths: Sequence[Mapping[str, float]], quantities: Sequence[str]) -> dict[str, Change]:
    """By quantity, over the strengths and all conditions at which it is looked at."""
    at, found = conditions(bench), {quantity: Change(quantity) for quantity in quantities}
    for quantity, values in product(quantities, strengths):
        places = HELD_AT if quantity in HELD else WORN_AT if quantity in WORN else RUNNING_AT
        changes = [change_of(bench, record, values, place) for place in places for record in records(bench, quantity, at[place], effect)]
        found[quantity] = max(found[quantity], *changes, key=lambda change: change.ratio)
    return found


def change_of(bench: Bench, record: Record, values: Mapping[str, float], place: str) -> Change:
    without, present = (OBSERVED[record.quantity](bench, record, v) for v in ({}, values))
    change = present - without
    # Nobody knows the zero of an angle.
    change = np.abs(change - change.mean() if record.free_zero else change).max()
    noise = NOISE.get(record.quantity) or SHARE * float(np.abs(without).max())
    size, usual = (shown(value, QUANTITIES[record.quantity].unit, record.quantity) for value in (float(change), noise))
    return Change(record.quantity, float(change) / noise, size, place, usual)


def records(bench: Bench, quantity: str, condition: Condition, effect: Effect) -> Iterator[Record]:
    """What is measured of a quantity at a condition."""
    match quantity:
        case "transmission_error":
            yield record_of(quantity, condition, {"angle": np.linspace(0.0, 2.0 * np.pi, TURN, endpoint=False)})
        case "hysteresis":
            locked = "output" if effect.needs == "locked output" else "input"
            yield record_of(quantity, condition, {"torque": torque_way(bench.rated_load, STEPS, np.zeros(0))[1:]}, locked=locked)
        case "temperature":
            yield record_of(quantity, condition, {"time": np.zeros(1)})
        case "efficiency" if condition.load < 0.5 * bench.rated_load:
            return
        case "wear_depth" | "wear_profile":
            for surface in SURFACES:
                axes = {"depth_angle": np.linspace(0.0, 2.0 * np.pi, SURFACE, endpoint=False)} if quantity == "wear_profile" else {}
                yield record_of(quantity, replace(condition, hours=WEAR_HOURS * HOUR), axes, surface=surface)
        case "mass_loss" | "debris_iron":
            yield record_of(quantity, replace(condition, hours=WEAR_HOURS * HOUR))
        case _:
            yield record_of(quantity, condition)
