"""Loads, speeds and temperatures that stand in columns alone: what they are is said, and doubted where runs of one condition differ by them."""

from collections import defaultdict
from collections.abc import Iterable, Mapping

from discrepancy.campaign.amount import readable
from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.set_steps import MEASURED, spans_no_step
from discrepancy.campaign.quantities import FACTOR_KEYS

MOST_FILES = 3
REMEDY = "put the number and its unit into the files' names ({example}), or give each a condition of its own in campaign.toml"
EXAMPLES = {"load_torque": "50Nm", "input_speed": "1500rpm", "output_speed": "15rpm", "temperature": "25C"}


def said_by_columns(runs: Iterable[GuessedRun], stated: Mapping[str, str]) -> dict[str, dict[str, list[str]]]:
    """Key of a condition -> "50 N.m" -> files, rising, of what is steady in columns of a condition's ``runs`` and is not ``stated`` of it."""
    names = {FACTOR_KEYS[key].name for key in stated if key in FACTOR_KEYS}
    numbers: dict[tuple[str, str], list[tuple[float, str]]] = defaultdict(list)
    for run in runs:
        for role, level in run.levels.items():
            if role in MEASURED and level == level and FACTOR_KEYS[role].name not in names:
                numbers[role, run.columns[role].unit.value].append((level, run.path.name))
    found: dict[str, dict[str, list[str]]] = {}
    for (role, unit), pairs in numbers.items():
        steps: list[list[tuple[float, str]]] = []
        for level, file in sorted(pairs):
            if steps and spans_no_step([steps[-1][0][0], level], role, unit):
                steps[-1].append((level, file))
            else:
                steps.append([(level, file)])
        for step in steps:
            text = f"{readable(step[len(step) // 2][0])} {unit}"
            found.setdefault(role, {}).setdefault(text, []).extend(sorted({file for _, file in step}))
    return found


def different_in_columns(runs: Iterable[tuple[str, GuessedRun]], conditions: Mapping[str, Mapping[str, str]]) -> list[Doubt]:
    """One doubt for each number by which runs of one quantity and condition, which count as repetitions, differ in their columns alone."""
    alike: dict[tuple[str, str], list[GuessedRun]] = defaultdict(list)
    for condition, run in runs:
        alike[condition, run.quantity.value].append(run)
    found = []
    for (condition, quantity), members in alike.items():
        for key, levels in said_by_columns(members, conditions[condition]).items():
            if len(levels) > 1:
                parts = ", ".join(f"{text} in {some(files)}" for text, files in levels.items())
                text = f"{key} stands in columns alone and is {parts}: these runs of {quantity} count as repetitions of one condition"
                found.append(Doubt(f"condition {condition}", text, REMEDY.format(example=EXAMPLES[key])))
    return found


def some(files: list[str]) -> str:
    return ", ".join(files[:MOST_FILES]) + (f" and {len(files) - MOST_FILES} more" if len(files) > MOST_FILES else "")
