"""``rvwear effects``: the list, one effect explained, the page of all."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cli.options import IDEAL_REDUCER, add_json, add_reducer, page_path
from cli.written import say_file
from fmu_src.faults import InputFault
from fmu_src.progress import task
from fmu_src.unit_words import unit_on_screen

if TYPE_CHECKING:
    from discrepancy.catalogue.catalogue import Entry
    from discrepancy.catalogue.declared_signals import Change
    from discrepancy.catalogue.signature import Signature
    from fmu_src.effect import EffectParameter
    from fmu_src.effect_finding import Finding


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    effects = sub.add_parser("effects", help="what a real reducer may do beyond the ideal one, and how it shows")
    effects.add_argument("name", nargs="?", metavar="NAME", help="effect to explain, by name or number, or a word to look for: friction (default: list all)")
    add_reducer(effects, f"reducer on the bench (default {IDEAL_REDUCER}: rigid, without losses; other commands: RV20E-121)", IDEAL_REDUCER)
    add_json(effects, "print as JSON, nothing else")
    effects.add_argument("--html", metavar="FILE", help="write a page with a picture of each signature")
    effects.add_argument("--check", nargs="+", metavar="FILE",
                         help="look at files of effects of your own, or folders of them: what is wrong, and where; whether their signals are what they change")
    effects.set_defaults(run=run_effects)


def run_effects(options: argparse.Namespace) -> int:
    """List, or explain one; with ``--html`` the page of what was asked for; with ``--check`` look at files."""
    if options.check:
        return check_files([file for name in options.check for file in effect_files(Path(name))], options.json)
    from cli.screen import json_text
    from cli.show.effects import show_list, show_one, show_signals
    from discrepancy.catalogue.catalogue import entries, found_by

    page = page_path(options.html)
    chosen = found_by(options.name) if options.name else entries()
    one = bool(options.name) and len(chosen) == 1
    computed = compute(chosen, options.reducer) if one and not page else {}
    if page:
        computed = write_page(chosen, options.reducer, page)
    signals = changes_by_signal(chosen[0]) if one and not page and chosen[0].is_own else {}
    if options.json:
        found = [e.as_json() | {"reducer": options.reducer, "computed": [as_json(s) for s in computed.get(e.name, [])]} for e in chosen]
        judged = {"judged": {name: {"times_noise": change.ratio, "change": change.text} for name, change in signals.items()}} if signals else {}
        json_text(found[0] | judged if one else {"effects": found})
    elif one and not page:
        show_one(chosen[0], computed[chosen[0].name], options.reducer)
        if signals:
            show_signals(chosen[0], signals)
    elif not page:
        show_list(chosen, options.name)
    if page and not options.json:
        say_file(page)
    return 0


def effect_files(place: Path) -> list[Path]:
    """A file itself; of a folder its files and those in the folders of its units.  InputFault if it has none."""
    from fmu_src.effect_check import UNITS, WHERE

    if not place.is_dir():
        return [place]
    found = [file for folder in (place, *(place / unit for unit in UNITS)) for file in sorted(folder.glob("[!.]*.py")) if file.stem != "__init__"]
    if not found:
        raise InputFault(f"--check {place}: no effect in this folder; effects lie in {WHERE}")
    return found


def check_files(files: list[Path], as_json: bool) -> int:
    """Say what is wrong with effects' files, a line each; 2 if anything is."""
    from cli.screen import json_text
    from fmu_src.effect_check import check_any_file

    findings = {str(file): check_any_file(file) or unknown_words(file) or tried(file) for file in files}
    # Of signals it is no fault to leave some out.
    doubts = {name: doubtful_signals(Path(name)) for name, found in findings.items() if not found}
    if as_json:
        shown, doubted = ({name: [{"line": f.line, "text": f.text} for f in found] for name, found in told.items()} for told in (findings, doubts))
        json_text({"findings": shown, "doubts": doubted})
    else:
        for name, found in findings.items():
            print("\n".join(map(str, found) if found else sound(name, doubts[name])))
    return 2 if any(findings.values()) else 0


def sound(name: str, doubts: "list[Finding]") -> list[str]:
    """Of a file in which nothing is wrong: only such a one lies where its folder names its unit."""
    return [f"{name}: nothing wrong", *(f"  {text}" for text in of_parameters(Path(name))), *(f"  doubtful: {unit_on_screen(f.text)}" for f in doubts)]


def of_parameters(file: Path) -> list[str]:
    """A line for each parameter of a sound effect: its unit, the unit that answers give it in, and what a diagnosis does with it."""
    from fmu_src.effect_check import imported

    module = imported(file.absolute(), file.absolute().parent.name)[0]
    return [f"{p.variable.name}: {units_of(p)}; {use_of(p)}" for p in (module.EFFECT.parameters if module else ())]


def units_of(p: "EffectParameter") -> str:
    """The unit of a parameter's file and that of answers, where that is another."""
    from discrepancy.catalogue.ranges import scale_of

    v, told = p.variable, scale_of(p)
    if v.unit == "1":
        return "a number without a unit"
    if told.unit == v.unit:
        return f"in {v.unit}, here and in answers"
    same = f"0 {told.unit} is {-told.offset:g} {v.unit}" if told.offset else f"1 {v.unit} is {told.factor:.6g} {told.unit}"
    return f"in {v.unit} here, for kernels, in {told.unit} in answers at its usual size ({same})"


def use_of(p: "EffectParameter") -> str:
    """Whether a diagnosis fits a parameter, within which bounds, and from where."""
    from discrepancy.catalogue.ranges import goes_all_round

    v = p.variable
    unit = "" if v.unit == "1" else f" {v.unit}"
    if p.kind == "choice":
        return f"chosen by you, not fitted: {', '.join(v.choices) or f'{v.minimum:g} to {v.maximum:g}'}"
    if p.is_held:
        return f"shape, held at {float(v.start):g}{unit}, not fitted: held=True"
    # A fit goes on from there: these are no values that it is held to.
    grid = f", first tried at {', '.join(f'{value:g}' for value in p.grid)}" if p.kind == "shape" else ""
    bounds = "to any direction" if goes_all_round(p) else f"within {v.minimum:g} to {v.maximum:g}{unit}"
    return f"{p.kind}, fitted {bounds}{grid}"


def tried(file: Path) -> "list[Finding]":
    """What the compiler refuses of an effect, or what it changes while it is off; only of files in which nothing else is wrong."""
    from studies.effect_code import not_translated
    from studies.effect_off import changes_when_off

    with task(f"translating {file.name}"):
        if refused := not_translated(file.absolute()):
            return refused
    with task(f"trying {file.name} with its amplitudes off"):
        return changes_when_off(file.absolute())


def doubtful_signals(file: Path) -> "list[Finding]":
    """Where what a sound effect declares is not what it changes; one that declares nothing is looked for everywhere."""
    from discrepancy.catalogue.declared_signals import signal_doubts
    from fmu_src.effect_check import imported

    module = imported(file.absolute(), file.absolute().parent.name)[0]
    if module is None or not module.EFFECT.signals:
        return []
    with task(f"holding the signals of {file.name} against what it changes"):
        return signal_doubts(file.absolute())


def unknown_words(file: Path) -> "list[Finding]":
    """Quantities that no campaign has, in which an effect would never be looked for, at the line where they stand."""
    import ast

    from discrepancy.catalogue.signal_words import unknown
    from fmu_src.effect_check import imported
    from fmu_src.effect_finding import Finding

    module = imported(file.absolute(), file.absolute().parent.name)[0]
    texts = unknown(module.EFFECT.signals) if module else []
    if not texts:
        return []
    given = [node for node in ast.walk(ast.parse(file.read_bytes())) if isinstance(node, ast.keyword) and node.arg == "signals"]
    return [Finding(file, given[0].lineno if given else 0, text) for text in texts]


def compute(chosen: "list[Entry]", reducer: str) -> "dict[str, list[Signature]]":
    from discrepancy.catalogue.signature import new_bench, signature

    with task("computing the signature"):
        bench = new_bench(reducer)
        return {e.name: [signature(bench, e.name, case) for case in e.cases] for e in chosen}


def changes_by_signal(own: "Entry") -> "dict[str, Change]":
    """What an own effect changes of the signals that ``--check`` holds its file against, by the same computation."""
    from discrepancy.catalogue.declared_signals import changes_of

    with task("what it changes of each signal"):
        return changes_of(own.name, own.effect)


def write_page(chosen: "list[Entry]", reducer: str, path: Path) -> "dict[str, list[Signature]]":
    """Compute all signatures and pictures and write them."""
    from discrepancy.catalogue.page import page_of
    from discrepancy.catalogue.plots import figure
    from discrepancy.catalogue.signature import new_bench, signature
    from pages.render import written

    bench, shown = new_bench(reducer), []
    with task("effects", total=len(chosen)) as drawing:
        for e in chosen:
            shown.append((e, [signature(bench, e.name, case) for case in e.cases], figure(bench, e.name, e.cases)))
            drawing.advance()
    written(page_of(shown, reducer), path)
    return {e.name: found for e, found, _ in shown}


def as_json(found: "Signature") -> dict[str, Any]:
    """A signature with all its figures, visible or not."""
    rows = [
        {"figure": r.figure, "condition": r.condition, "unit": r.unit, "without": float(r.without), "with": float(r.present)}
        for r in found.rows
    ]  # fmt: skip
    return {"case": found.case.title, "values": dict(found.case.values), "rows": rows}
