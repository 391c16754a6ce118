"""What each kind of job computes: the same functions as the commands, their results as data and as the page of one file."""

import shlex
import time
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fmu_src.checked_file import replacing
from fmu_src.faults import InputFault
from fmu_src.progress import task
from workbench.doubts import apart, cells_of, in_page_words
from workbench.ensemble_step import ensemble
from workbench.folder import CAMPAIGN, MODEL, Folder
from workbench.left_open import left_open, sentence
from workbench.life_step import life
from workbench.makers import makers
from workbench.page_words import on_page
from workbench.told import in_words, page_data, write_json

if TYPE_CHECKING:
    from discrepancy.campaign.model import Campaign
    from discrepancy.model_file import ModelFile
    from discrepancy.verdict import Answer

# Endings of tables for other programs, and of pictures for a paper.
TABLES, PICTURES = ("csv", "xlsx", "parquet", "mat"), ("svg", "pdf", "png")
# What is done where the diagnosis was kept from before; static/diagnose.js knows it by this name.
PAGE_OF_FOUND = "drawing the page of the diagnosis that was found again"
# (folder, what was asked, cores, place of the results) -> whether it was stopped.
Step = Callable[[Folder, dict[str, Any], int, Path], bool]


def inputs(folder: Folder, given: dict[str, Any]) -> "tuple[ModelFile, Campaign]":
    """InputFault in the words of the page."""
    from discrepancy.campaign.load import load_campaign
    from discrepancy.model_file import load_model

    if not folder.campaign.is_file():
        raise InputFault(f"there is no {CAMPAIGN} yet: drop files under In, look at what they are taken for, and save")
    campaign = load_campaign(folder.root)
    campaign.require_fittable()
    return load_model(folder.model(given)), campaign


def begun(folder: Folder, kind: str) -> float | None:
    """When the job was asked for: it tells its result from that of the one before."""
    at = folder.recall(f"jobs/{kind}/job").get("begun")
    return None if at is None else float(at)


def report(result: object, place: Path) -> None:
    """The page of the result as one file."""
    from discrepancy.page import write_page

    write_page(result, place / "report.html")


def compare_step(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    from discrepancy.compare import compare
    from discrepancy.page import page_of
    from workbench.look import view

    with task("comparing"):
        comparison = compare(*inputs(folder, given), jobs=jobs)
        page = page_of(comparison)
        found, columns = view(comparison, page)
    with replacing(place / "columns.bin") as partial:
        partial.write_bytes(columns)
    found |= {"model": str(given["model"]), "makers": {}, "command": command(folder, given, "compare"), "begun": begun(folder, "compare")}
    write_json(place / "result.json", found)
    with task("drawing the page"):
        report(page, place)
    with task("which effects make which order"):
        found["makers"] = makers(comparison)
    write_json(place / "result.json", found)
    return False


def diagnose_step(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    """What was known by then is an answer, too; ``found`` says when one was made that is found again [s since 1970], ``found_in`` from which other folder."""
    from discrepancy.remembered import diagnosed, elsewhere, with_profiles
    from discrepancy.verdict import AnswerSoFar

    stopped, began = False, time.time()
    file, campaign = inputs(folder, given)
    try:
        answer = diagnosed(file, campaign, jobs=jobs)
    except AnswerSoFar as stop:
        answer, stopped = stop.answer, True
    found = answer.made if answer.made < began else None
    with task(PAGE_OF_FOUND if found else "drawing the page"):
        with with_profiles(answer, file, campaign):
            report(answer, place)
        about = {"model": str(given["model"]), "command": command(folder, given, "diagnose"), "begun": begun(folder, "diagnose"), "found": found,
                 "found_in": elsewhere(answer, campaign)}  # fmt: skip
        write_json(place / "result.json", answer_data(answer) | about)
    return stopped


def answer_data(answer: "Answer") -> dict[str, Any]:
    from discrepancy.page.amounts import signal_title, with_minus, with_titles
    from discrepancy.page.answer import headline, reason_text
    from discrepancy.page.write import page_of
    from discrepancy.verdict import added_of, instead_of
    from discrepancy.words.held_shapes import held_text
    from discrepancy.words.left_sizes import left_sizes
    from discrepancy.words.wording import (
        base_texts,
        error_text,
        fitted_together,
        left_text,
        other_form_text,
        shares_text,
        stand_ins,
        together_text,
        told_apart_by,
        tone,
        turned_down,
        variant_text,
    )
    from fmu_src.effect_words import effect_title

    content = page_of(answer)
    page = page_data(content)
    cells = cells_of(content.warnings, answer.model.campaign)
    doubts, page["warnings"] = apart(content.warnings, answer.model.campaign)
    effects = []
    for effect in answer.effects:
        effects.append({
            "name": effect["name"], "title": effect["title"], "place": variant_text(effect),
            "candidates": added_of(effect), "instead": instead_of(effect), "share": shares_text(answer, effect),
            "error": "" if fitted_together(answer) else error_text(answer, effect).replace("->", "→"), "parameters": parameters(answer, effect["parameters"]),
            "others": [{"said": other_form_text(form), "parameters": parameters(answer, form["parameters"])} for form in effect["other_forms"]],
            "held": held_text(effect["name"], answer.model),
        })  # fmt: skip
    off = answer.diagnosis.base_off
    others = [with_minus(text) for text in stand_ins(answer, effect_title).values()]
    return {
        "headline": headline(answer),
        "verdict": answer.verdict, "tone": tone(answer), "reason": reason_text(answer), "effects": effects, "confusable": answer.confusable,
        "untold": [sentence(text) for text in answer.untold], "open": left_open(answer),
        "alike": told_apart_by(answer, effect_title),
        "base_off": [{"name": e.name, "text": with_minus(text)} for e, text in zip(off, base_texts(answer))], "left": in_words(left_text(answer)),
        "sizes": left_sizes(answer, signal_title),
        "together": together_text(answer).replace("->", "→"), "stand_ins": others,
        "rejected": turned_down(answer),
        "would_show": sentence(answer.would_show.sentence) if answer.would_show else "",
        "laws": [with_minus(with_titles(law.text)) for law in answer.laws],
        "p_screen": answer.diagnosis.p_screen, "seconds": answer.diagnosis.seconds, "page": page,
        "doubts": doubts, "cells": cells,
    }  # fmt: skip


def parameters(answer: "Answer", given: dict[str, Any]) -> list[dict[str, Any]]:
    from discrepancy.page.amounts import pretty, with_minus
    from discrepancy.page.whys import of_estimate
    from discrepancy.scales import estimate_texts
    from discrepancy.words.as_told import tables_of, told_name
    from discrepancy.words.wording import with_base_text

    found = []
    for name, entry in given.items():
        value, interval, unit = estimate_texts(entry)
        told = told_name(name, tables_of(answer.model))
        found.append({"name": told, "value": with_minus(value), "interval": with_minus(interval), "unit": pretty(unit), "bound": bool(entry.get("bound")),
                      "with_base": with_minus(with_base_text(entry)), "meaning": entry.get("meaning", ""),
                      "why": asdict(of_estimate(answer.diagnosis.fits.space, entry))})  # fmt: skip
    return found


def next_step(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    from discrepancy.experiment.next_run import next_run
    from discrepancy.page.amounts import with_titles
    from discrepancy.page.write import page_of

    with task("looking for the next experiment"):
        run = next_run(*inputs(folder, given), jobs=jobs)
        report(run, place)
    asked = [{key: in_page_words(value) if isinstance(value, str) else value for key, value in asdict(one).items()} for one in run.asked]
    cells = cells_of([one.why for one in run.asked], run.answer.model.campaign)
    best = run.result.proposals[:12] if run.result else ()
    proposals = [{"experiment": with_titles(p.experiment), "cost": p.cost, "least": p.least, "mean": p.score} for p in best]
    write_json(place / "result.json", {
        "verdict": [on_page(with_titles(line)) for line in run.lines], "rivals": run.rivals, "asked": asked, "cells": cells, "proposals": proposals,
        "stakes": {with_titles(where): at_stake for where, at_stake in run.stakes().items()}, "cost_unit": run.cost_unit,
        "page": page_data(page_of(run)), "command": command(folder, given, "next"),
    })  # fmt: skip
    return False


def extend_step(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    """The extended model is ``model.toml`` of the folder; the ladder stands in it."""
    from discrepancy.ladder_step import step_of
    from discrepancy.model_file import save_model
    from discrepancy.page.amounts import signal_title
    from discrepancy.page.write import page_of
    from discrepancy.remembered import extended
    from discrepancy.words.wording import signals_left
    from fmu_src.held_file import held

    names = [str(name) for name in given.get("effects", [])]
    if not names:
        raise InputFault("no effect is named that could be added")
    target = folder.root / MODEL
    with task(f"adding {', '.join(names)}"), held(target):
        file, campaign = inputs(folder, given)
        # The answer stands on the page.
        extension = extended(file, campaign, names, anyway=bool(given.get("anyway")), jobs=jobs, said=True)
        save_model(extension.file, target)
        report(extension, place)
    words = " ".join(f"--effect {shlex.quote(name)}" for name in names)
    # By now the file is there, which the command writes over only where it is its model.
    over = "" if given.get("model") == MODEL else " --overwrite"
    write_json(place / "result.json", {
        "verdict": extension.verdict, "kept": bool(extension.step["kept"]), "reason": extension.step["reason"], "effects": names,
        "steps": list(extension.file.steps), "left": signals_left(step_of(extension.step).left, signal_title),
        "page": page_data(page_of(extension)), "ladder": page_data(page_of(extension.file)),
        "command": f"{command(folder, given, 'extend')} {words} --output {shlex.quote(str(target))}{over}",
    })  # fmt: skip
    if extension.step["kept"]:
        # All views go on with the better model; a life begun right after was one of the former.
        folder.remember("view", folder.recall("view") | {"model": MODEL})
    return False


def export_step(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    """Curves and figures of a comparison or a diagnosis for other programs, or its pictures for a paper, in ``results``."""
    from discrepancy.compare import compare
    from discrepancy.page.write import page_of
    from discrepancy.remembered import diagnosed
    from discrepancy.tables import tables_of
    from exports.write import require_writable, write_tables
    from pages.paper import require_drawable, width_of, write_pictures

    what, ending = str(given.get("what")), str(given.get("ending"))
    if what not in ("compare", "diagnose") or ending not in TABLES + PICTURES:
        raise InputFault(f"{what}, {ending}: there is no such export; choose from {', '.join(TABLES + PICTURES)}")
    path = folder.root / "results" / f"{what}.{ending}"
    path.parent.mkdir(exist_ok=True)
    (require_writable if ending in TABLES else require_drawable)(path)
    with task("computing what is exported"):
        made = (compare if what == "compare" else diagnosed)(*inputs(folder, given), jobs=jobs)
    with task(f"writing {path.name}"):
        if ending in TABLES:
            written = write_tables(tables_of(made), path)
        else:
            written = write_pictures(page_of(made).figures, path, width_of("single"))
    option = "--export" if ending in TABLES else "--picture"
    files = [{"name": file.relative_to(folder.root).as_posix(), "bytes": file.stat().st_size} for file in written]
    line = f"{command(folder, given, what)} {option} {shlex.quote(str(path))}"
    write_json(place / "result.json", {"files": files, "what": what, "begun": begun(folder, "export"), "command": line})
    return False


def build_step(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    from discrepancy.named_reducer import named_reducer
    from studies import building
    from studies.which_unit import which_to_take

    with task("building the FMUs"):
        built, packages = building.build_units(named_reducer(folder.model(given)), folder.root / "fmus")
    paths = [Path(entry["fmu"]) for entry in built] + packages
    files = [{"name": path.relative_to(folder.root).as_posix(), "bytes": path.stat().st_size} for path in paths if path.is_relative_to(folder.root)]
    name = str(given["model"])
    reducer, output = (shlex.quote(str(path)) for path in (folder.model(given), folder.root / "fmus"))
    take = which_to_take(Path("fmus"), [path.relative_to(folder.root) for path in paths if path.is_relative_to(folder.root)])
    write_json(place / "result.json", {"files": files, "take": take, "model": name, "command": f"rvwear build --reducer {reducer} --output {output}"})
    return False


def command(folder: Folder, given: dict[str, Any], name: str) -> str:
    """The command line that does the same."""
    return f"rvwear {name} {shlex.quote(str(folder.model(given)))} {shlex.quote(str(folder.root))}"


STEPS: dict[str, Step] = {
    "compare": compare_step, "diagnose": diagnose_step, "next": next_step, "extend": extend_step, "build": build_step, "export": export_step,
    "life": life, "ensemble": ensemble,
}  # fmt: skip
