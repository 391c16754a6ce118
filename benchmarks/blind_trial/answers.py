"""The file in which a method answers: what docs/blind_trial_enter.md describes, read, checked and joined with the truths."""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.words import BASE_OFF, CRASH, INCOMPLETE, NONE, ONE, SEALS, SET, SEVERAL, UNKNOWN
from fmu_src.faults import InputFault

FORMAT = "rvwear blind trial answers 1"
VERDICTS = (NONE, ONE, SET, SEVERAL, INCOMPLETE, UNKNOWN, BASE_OFF)
# Keys of an answer and of one of its effects; those that are numbers.
KEYS, EFFECT_KEYS = {"verdict", "effects", "set", "seconds", "captured"}, {"name", "parameters", "held_out_error_before", "held_out_error_after"}
NUMBERS = ("seconds", "captured", "held_out_error_before", "held_out_error_after")

Answer = dict[str, Any]


def write_answers(path: Path, method: str, answers: Mapping[str, Answer]) -> None:
    path.write_text(json.dumps({"format": FORMAT, "method": method, "answers": dict(answers)}, indent=1, default=float) + "\n", encoding="utf-8")


def read_answers(path: Path) -> tuple[str, dict[str, Answer]]:
    """The method's name and its answers by campaign; InputFault with the place of what is wrong."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except json.JSONDecodeError as problem:
        raise InputFault(f"{path}: no JSON: {problem}") from None
    if not isinstance(content, dict) or content.get("format") != FORMAT or not isinstance(content.get("answers"), dict):
        raise InputFault(f'{path}: write {{"format": "{FORMAT}", "method": NAME, "answers": {{CAMPAIGN: ANSWER, ...}}}}')
    for name, answer in content["answers"].items():
        if fault := wrong_with(answer):
            raise InputFault(f"{path}: answers.{name}: {fault}")
    return str(content.get("method", path.stem)), content["answers"]


def wrong_with(answer: Any) -> str:
    """What is wrong with an answer, if anything."""
    if not isinstance(answer, dict) or answer.get("verdict") not in VERDICTS:
        return f"verdict must be one of {', '.join(VERDICTS)}"
    effects = answer.get("effects", [])
    if not isinstance(effects, list) or not all(isinstance(e, dict) and isinstance(e.get("name"), str) for e in effects):
        return 'effects is a list of {"name": EFFECT, ...}, the best first'
    entries = [(answer, KEYS, ""), *((e, EFFECT_KEYS, f"effects[{k}].") for k, e in enumerate(effects))]
    for entry, keys, place in entries:
        if unknown := sorted(entry.keys() - keys):
            return f"{place}{unknown[0]} is not known; possible: {', '.join(sorted(keys))}"
        for key in NUMBERS:
            if key in entry and not isinstance(entry[key], (int, float)):
                return f"{place}{key} must be a number"
    if not all(isinstance(n, str) for n in answer.get("set", [])):
        return "set is a list of names of effects"
    if answer["verdict"] in (ONE, SET, SEVERAL, INCOMPLETE) and not effects:
        return f"{answer['verdict']!r} names no effect"
    if answer["verdict"] == ONE and len(effects) > 1:
        return f"{ONE!r} names {len(effects)}"
    return ""


def seals_of(folder: Path) -> dict[str, str]:
    """SHA-256 of every truth by campaign, as they were published."""
    lines = (folder / SEALS).read_text(encoding="utf-8").split("\n")
    return {name: seal for seal, name in (line.split() for line in lines if line.strip())}


def results_of(answers: Mapping[str, Answer], trial: Path, sealed: Path) -> dict[int, dict[str, Any]]:
    """Answers beside the truths, as ``score.score`` takes them; a campaign without an answer counts as failed.

    InputFault if a truth is not the one that was sealed, or an answer is of no campaign.
    """
    seals = seals_of(trial)
    if strangers := sorted(answers.keys() - seals.keys()):
        raise InputFault(f"{strangers[0]}: there is no such campaign in {trial / SEALS}")
    results = {}
    for number, (name, seal) in enumerate(sorted(seals.items())):
        text = (sealed / f"{name}.json").read_bytes()
        if hashlib.sha256(text).hexdigest() != seal:
            raise InputFault(f"{sealed / name}.json: not the truth that was sealed")
        given = answers.get(name)
        answer: Answer = {"verdict": CRASH, "error": "no answer"} if given is None else given
        effects: list[Answer] = [{"parameters": {}, **e} for e in answer.get("effects", [])]
        results[number] = {"number": number, "truth": json.loads(text), "answer": {
            **answer, "effects": effects, "confusable": answer.get("set", []), "times": {"whole": float(answer.get("seconds", 0.0))}}}
    return results
