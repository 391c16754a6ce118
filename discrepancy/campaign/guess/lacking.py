"""What the quantities need to know of their conditions and nobody has said, with the option that says it."""

import shlex
from collections import defaultdict
from collections.abc import Mapping, Sequence

from discrepancy.campaign.guess.file_names import NUMBERS
from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.unread_numbers import suggested, turns_named
from discrepancy.campaign.guess.wishes import OPEN
from discrepancy.campaign.quantities import FACTOR_KEYS, FACTOR_NAMES, QUANTITIES, keys_for

# The key in which benches mostly state what several keys say.
USUAL = {"speed": "output_speed"}
# Field of a pattern of names that a number may be.
FIELDS = {"load": "load_torque", "speed": "speed", "temperature": "temperature", "hours": "hours"}
MOST_SHOWN = 6


def lacking(runs: Sequence[tuple[str, GuessedRun]], conditions: Mapping[str, Mapping[str, str]]) -> list[Doubt]:
    """Once for all conditions that lack the same.  ``runs``: condition and run.

    Where names differ by a number that nobody understood, it is asked whether that is it: one value for all would be wrong then.
    """
    patterns: dict[str, list[str]] = defaultdict(list)
    for _, run in runs:
        if not run.name.given:
            patterns[run.quantity.value].append(run.name.pattern)
    found: dict[tuple[str, str, tuple[str, ...]], str] = {}
    for condition, run in runs:
        missing = [f for f in QUANTITIES[run.quantity.value].factors if f in FACTOR_NAMES and not is_said(f, run, conditions[condition])]
        for factor in missing:
            # One number is not two things: that of a load first.
            field = field_of(factor) if factor == "load" or "load" not in missing else None
            own = patterns[run.quantity.value]
            numbers = (suggested(own, field) or (turns_named(own, field) if factor == "speed" else [])) if field else []
            asked = tuple(offer(*pair) for pair in numbers)
            found.setdefault((condition, factor, asked), f"{run.quantity.value} needs {' or '.join(keys_for(factor))}")
    whole: dict[tuple[str, str, tuple[str, ...]], list[str]] = defaultdict(list)
    for (condition, factor, asked), text in found.items():
        whole[text, factor, asked].append(condition)
    return [Doubt(", ".join(names), text, remedy(factor, asked, names, conditions)) for (text, factor, asked), names in whole.items()]


def field_of(factor: str) -> str | None:
    """Of a pattern, with the unit that would be taken: where names have none, it is seen."""
    name = FIELDS.get(factor)
    return f"{name}:{NUMBERS[name][1]}" if name else None


def is_said(factor: str, run: GuessedRun, stated: Mapping[str, str]) -> bool:
    return any(key in stated or key in run.columns for key in keys_for(factor))


def offer(pattern: str, numbers: Sequence[str]) -> str:
    shown = ", ".join(numbers[:MOST_SHOWN]) + (" ..." if len(numbers) > MOST_SHOWN else "")
    return f"{shlex.join(['--names', pattern])} if {shown} in the names are the {{}}"


def remedy(factor: str, asked: Sequence[str], names: Sequence[str], conditions: Mapping[str, Mapping[str, str]]) -> str:
    """For all conditions at once, unless others say something of their own, or names differ by numbers: then for each by its name."""
    key = USUAL.get(factor) or keys_for(factor)[0]
    if asked:
        offers = ", ".join(text.replace("{}", factor) for text in asked)
        return f"{offers}, with its unit; else --condition 'NAME:{key}={OPEN}' for each condition"
    said = any(k in stated for name, stated in conditions.items() if name not in names for k in keys_for(factor))
    options = [f"--condition '{name}:{key}={OPEN}'" for name in names] if said else [f"--condition '{key}={OPEN}'"]
    text = f"{' '.join(options)} (such as {FACTOR_KEYS[key].example}), or a {{{factor}}} in --names"
    return text if said or len(names) == 1 else f"{text}; for one of them --condition 'NAME:{key}={OPEN}'"
