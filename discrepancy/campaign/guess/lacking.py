"""What the quantities need to know of their conditions and nobody has said, with the option that says it."""

import shlex
from collections import defaultdict
from collections.abc import Mapping, Sequence

from discrepancy.campaign.guess.file_names import suggested
from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.wishes import OPEN
from discrepancy.campaign.quantities import FACTOR_KEYS, FACTOR_NAMES, QUANTITIES, keys_for

# The key in which benches mostly state what several keys say.
USUAL = {"speed": "output_speed"}


def lacking(runs: Sequence[tuple[str, GuessedRun]], conditions: Mapping[str, Mapping[str, str]]) -> list[Doubt]:
    """Once for all conditions that lack the same.  ``runs``: condition and run.

    Where names differ by a number that nobody understood, it is asked whether that is the load: one value for all would be wrong then.
    """
    patterns: dict[str, list[str]] = defaultdict(list)
    for _, run in runs:
        if not run.name.given:
            patterns[run.quantity.value].append(run.name.pattern)
    found: dict[tuple[str, str, str], str] = {}
    for condition, run in runs:
        for factor in (f for f in QUANTITIES[run.quantity.value].factors if f in FACTOR_NAMES):
            keys = keys_for(factor)
            if not any(key in conditions[condition] or key in run.columns for key in keys):
                asked = suggested(patterns[run.quantity.value], "load_torque") if factor == "load" else None
                found.setdefault((condition, factor, asked or ""), f"{run.quantity.value} needs {' or '.join(keys)}")
    whole: dict[tuple[str, str, str], list[str]] = defaultdict(list)
    for (condition, factor, asked), text in found.items():
        whole[text, factor, asked].append(condition)
    return [Doubt(", ".join(names), text, remedy(factor, asked, names, conditions)) for (text, factor, asked), names in whole.items()]


def remedy(factor: str, asked: str, names: Sequence[str], conditions: Mapping[str, Mapping[str, str]]) -> str:
    """For all conditions at once, unless others say something of their own: then for each by its name."""
    key = USUAL.get(factor) or keys_for(factor)[0]
    said = any(k in stated for name, stated in conditions.items() if name not in names for k in keys_for(factor))
    options = [f"--condition '{name}:{key}={OPEN}'" for name in names] if said else [f"--condition '{key}={OPEN}'"]
    text = f"{' '.join(options)} (such as {FACTOR_KEYS[key].example}), or a {{{factor}}} in --names"
    if asked:
        text = f"{shlex.join(['--names', asked])} if the number in the names is the load, else {text}"
    return text if said or len(names) == 1 else f"{text}; for one of them --condition 'NAME:{key}={OPEN}'"
