"""Reducer: one of the library, a file of the folder, or completed from a few numbers; drawn to scale, every number with unit, source and range."""

import math
import re
import shlex
import tomllib
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from discrepancy.model_file import ModelFile, every_effect, extended_reducer, load_model, parameter_variable, written_name
from discrepancy.scales import of_number
from discrepancy.words.as_told import is_direction
from discrepancy.words.intervals import both_texts, pins_in
from discrepancy.words.written_number import written_entry
from fmu_src.checked_file import write_text
from fmu_src.effect_words import effect_title
from fmu_src.faults import InputFault, RunFault
from pages.content import Card
from pages.words import in_print, number
from reducers.checking import Check, check
from reducers.completion.command import usual_name, words_of
from reducers.completion.complete import UNITS, Completion
from reducers.completion.file import text_of
from reducers.completion.given import Given, given_with, of_ratio
from reducers.completion.known import FROM_OPTIONS, known_numbers
from reducers.library import available
from reducers.reducer import Reducer, reducer_of
from studies.catalogue_lost_motion import Meets, as_in_catalogue
from studies.catalogue_targets import LOST_MOTION, Target, asked_of, targets_of
from studies.hysteresis import hysteresis
from studies.report.completed import page_of
from studies.report.not_made import drawings
from workbench import form
from workbench.folder import CAMPAIGN, NAME, Folder
from workbench.form_words import in_form
from workbench.left_open import left_open_in
from workbench.told import figure_data, page_data

# What the form asks for: name, what it is, unit, whether it must be given.
ASKED = (
    ("ratio", "ratio, carrier as output", "", True), ("pins", "pins in the ring", "", False), ("rated", "rated torque", "N m", True),
    ("diameter", "outer diameter of the housing", "mm", False), ("speed", "rated output speed", "rpm", False), ("cranks", "cranks", "", False),
    ("rollers", "rollers of a crank bearing", "", False), ("lost_motion", "lost motion of the catalogue", "arcmin", False),
    ("stiffness", "torsional stiffness of the catalogue", "N m/arcmin", False),
)  # fmt: skip
WHOLE = ("pins", "cranks", "rollers")


def shown(folder: Folder, model: str) -> dict[str, Any]:
    """A reducer as it stands in its file; without one the choice."""
    found: dict[str, Any] = {"library": available(), "files": folder.models(), "asked": [list(row) for row in ASKED], "reducer": None,
                             "completes": sorted(UNITS.keys() - FROM_OPTIONS.keys())}  # fmt: skip
    if model:
        file = load_model(folder.model({"model": model}))
        found["reducer"] = described(file) | headed(file) | {"added": in_print(added(file)), "open": in_print(left_open_in(file, folder))}
    return found


def headed(file: ModelFile) -> dict[str, str]:
    """What it is: of a model file with effects that it is a model with them."""
    description = file.reducer.description
    if not file.effects:
        return {"title": file.heading, "lead": description}
    effects = ", ".join(effect_title(name) for name in file.effects)
    return {"title": f"{file.heading} with {effects}", "lead": f"The model is {file.reducer.name} with {effects}. Of the reducer: {description}"}


def added(file: ModelFile) -> list[dict[str, Any]]:
    """Rows as of ``numbers`` for what the model's effects carry, elements of arrays and those of the measuring chain, too."""
    known, rows = every_effect(), []
    for name, parameters in file.effects.items():
        for key, entry in parameters.items():
            variable = parameter_variable(known[name], key)
            if variable.choices:
                told, unit = {"value": variable.choices[int(entry["value"])]}, ""
            else:
                written = written_entry(variable, entry)
                unit = written["unit"]
                # With the other value that shows the same, where there is one.
                value, ends = written["value"], [written[end] for end in ("low", "high") if end in written]
                estimate = {**written, "interval": ends if len(ends) == 2 else (value, value), "direction": is_direction(name, key)}
                estimate |= pins_in(key, value, file.reducer)
                told = dict(zip(("value", "interval") if len(ends) == 2 else ("value",), both_texts(estimate, float, 5, number)))
            interval = f", interval {told['interval']}" if "interval" in told else ""
            rows.append({
                "name": f"effects.{name}.{written_name(known[name], key)}", "value": told["value"], "unit": "" if unit == "1" else unit, "range": "",
                "meaning": variable.description, "source": f"{file.path.name if file.path else file.name}{interval}", "assumed": False, "outside": False,
            })  # fmt: skip
    return rows


def described(file: ModelFile) -> dict[str, Any]:
    """Drawn as it is, effects included; these stand beside its numbers, not among them: what scatters in many lives is chosen from the numbers."""
    drawn, reducer = extended_reducer(file), extended_reducer(replace(file, effects={}))
    checked = check(reducer)
    figures, without = drawings(drawn, checked.place if checked.faults else None)
    t = reducer.topology
    return {
        "speed": speed_of(reducer),
        "counts": {"discs": t.discs, "cranks": t.cranks, "pins": t.pins, "lobes": t.lobes, "rollers": t.rollers, "output pins": t.output_pins},
        "figures": [*map(figure_data, figures)], "numbers": in_print(numbers(reducer)), "findings": in_print(findings(checked)),
        "doubts": in_print([*(text for text in checked.doubts if text not in checked.outdated), *filter(None, [without])]),
    }  # fmt: skip


def speed_of(reducer: Reducer) -> str:
    """At which speed it runs, and whose that is: catalogues rate at another one than many run at."""
    figures, rpm = check(reducer).figures, reducer.starts["input_speed"] * 30.0 / math.pi
    source = reducer.sources.get("input_speed", "")
    return f"runs at {rpm:,.5g} rpm at the input, {rpm / figures['ratio']:.3g} rpm at the output" + (f" ({source})" if source else "")


def numbers(reducer: Reducer) -> list[dict[str, Any]]:
    """Every number of the file in the unit that people read it in."""
    rows = []
    for name, value in reducer.starts.items():
        variable = next((t.by_name[name] for t in (reducer.plant, reducer.wear, reducer.joint) if name in t.by_name), None)
        if variable is None:
            continue
        scale = of_number(variable)
        low, high = reducer.ranges.get(name, (math.nan, math.nan))
        text = variable.choices[int(value)] if variable.choices else number(scale.number(value), 5)
        source = reducer.sources.get(name, "")
        rows.append({
            "name": variable.path, "value": text, "unit": "" if scale.unit == "1" or variable.choices else scale.unit, "meaning": variable.description,
            "source": source, "assumed": source.startswith(("assumed", "completed", "found")), "outside": bool(low > value or high < value),
            "range": f"{number(scale.number(low))} to {number(scale.number(high))}" if math.isfinite(low) else "",
        })  # fmt: skip
    return rows


def findings(checked: Check) -> list[str]:
    """What cannot be made, is outdated, or lies where its own file says that it does not; in words with place, value and bound."""
    found = [*map(plainly, checked.faults), *checked.outdated]
    if checked.outdated:
        found.append(f"of a number that was measured say so as its source; the others are completed anew by: {checked.completing}")
    found += [f"{row['name']} = {row['value']} {row['unit']}: outside of its range, {row['range']}" for row in numbers(checked.reducer) if row["outside"]]
    return found


def completed(folder: Folder, given: Mapping[str, Any]) -> dict[str, Any]:
    """A reducer completed by design rules; with ``save`` its file is written, under a name that is free."""
    try:
        known, stiffness = given_of(given)
        told = str(given.get("lost_motion") or "").strip()
        meets = Meets.SURELY if given.get("meets_lost_motion") else Meets.AS_NEAR_AS_IT_GOES if told else Meets.NOT
        completion = as_in_catalogue(known, stiffness, meets, str(given.get("stiffness") or "").replace(",", "."))
        name = str(given.get("name") or "").strip() or usual_name(completion.given)
        if not NAME.fullmatch(name):
            raise InputFault(f"name {name!r}: it becomes a file's name; leave out / \\ : * ? \" < > |")
        text = text_of(completion, name)
        reducer = reducer_of(tomllib.loads(text), folder.root / f"{name}.toml")
    except InputFault as fault:
        # The file that it would be is not there yet.
        raise InputFault(plainly(re.sub(rf"^{re.escape(str(folder.root))}/\S+\.toml: ", "", str(fault)))) from None
    saved = ""
    if given.get("save"):
        place = folder.inside(f"{name}.toml")
        if place.exists() or place.name == CAMPAIGN:
            raise InputFault(f"{place.name} is in the folder already and is not overwritten; give another name")
        write_text(place, text)
        saved = place.name
    page = page_of(completion, reducer, [])
    cards = test_cards(reducer, completion, stiffness)
    page = replace(page, cards=[*page.cards, *cards], warnings=[*map(plainly, page.warnings)])
    words = [*words_of(completion.given), "--name", name]
    found = {"name": name, "saved": saved, "findings": in_print(findings(check(reducer)))}
    return {"page": page_data(page), "numbers": in_print(rows_of(completion)), **found, "command": shlex.join(words)}


def test_cards(reducer: Reducer, completion: Completion, stiffness: float | None) -> list[Card]:
    """What the stiffness test reads of it, beside what was asked for: nobody keeps a stiffness that was never looked at."""
    asked = "not given: made by rules alone, hold it against the catalogue" if stiffness is None else f"{stiffness:.4g} asked for"
    try:
        found = hysteresis(reducer, [])
    except RunFault as fault:
        return [Card("torsional stiffness", "unknown", f"{asked}; the test fails: {fault}")]
    target = next((one for one in targets_of(found, asked_of(completion.given)) if one.name == LOST_MOTION), None)
    return [
        Card("torsional stiffness", f"{found.stiffness_Nm_per_arcmin:.4g}", asked, unit="N m/arcmin"),
        Card("lost motion", f"{found.lost_motion_arcmin:.3g}", lost_motion_words(target, completion), unit="arcmin"),
    ]


def lost_motion_words(target: Target | None, completion: Completion) -> str:
    """Beside what the test reads: what the catalogue has, and what was taken for it."""
    if target is None:
        return "not given: made by rules alone, hold it against the catalogue"
    made = ", ".join(f"{name} = {completion.numbers[name].value:.3g} µm" for name in completion.given.made)
    taken = f"; taken for it: {made}" if made else ""
    return f"{target.asked:g} of the catalogue{'' if target.is_met else ', missed'}{taken}"


def given_of(given: Mapping[str, Any]) -> tuple[Given, float | None]:
    """What is given, and the catalogue's torsional stiffness [N m/arcmin]."""
    values: dict[str, Any] = {}
    for name, label, unit, needed in ASKED:
        text = str(given.get(name) or "").strip()
        if not text:
            if needed:
                raise InputFault(f"{label} is needed")
            continue
        text = of_ratio(text) if name == "ratio" else text
        values[name] = form.whole(text, label) if name in WHOLE else form.in_unit(text, unit, label)
    stiffness = values.pop("stiffness", None)
    known = given.get("known") or {}
    if not isinstance(known, dict):
        raise InputFault("known numbers are a table of names and values")
    measured = known_numbers(f"{name}={value}" for name, value in known.items() if str(value).strip())
    return given_with(**{"pins": None} | values, known=measured), stiffness


def rows_of(completion: Completion) -> list[dict[str, Any]]:
    return [
        {"name": n.name, "value": f"{n.value:.5g}", "unit": n.unit, "range": f"{n.low:.4g} to {n.high:.4g}" if n.low < n.high else "",
         "source": n.source, "given": n.is_given, "asked": n.name not in FROM_OPTIONS}
        for n in (number.as_read for number in completion.numbers.values())
    ]  # fmt: skip


def plainly(text: str) -> str:
    """The fault of an option in the words of the form."""
    return in_form(text, {name: label for name, label, _, _ in ASKED})
