"""Conditions, repetitions and held-out conditions of several files."""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from discrepancy.campaign.findings import LEAST_CONDITIONS
from discrepancy.campaign.guess.said import Guess
from discrepancy.campaign.quantities import FACTOR_KEYS

NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?")


@dataclass(frozen=True)
class State:
    """What is known of a file's condition: key of a campaign's condition -> "15 rpm"; the words that name it; whether the file says either."""

    stated: tuple[tuple[str, str], ...]
    label: str
    speaks: bool


def named_conditions(states: Sequence[State]) -> dict[State, str]:
    """A name for each different state; files that say nothing belong to the only one there is."""
    distinct = list(dict.fromkeys(states))
    speaking = [s for s in distinct if s.speaks]
    only = len(speaking) == 1
    full = {state: name_of(speaking[0], speaking) if only and not state.speaks else name_of(state, distinct) for state in distinct}
    # Without words that several share, as those of a kind of file, where numbers tell all apart.
    shared = {state for state in distinct if state.label and sum(other.label == state.label for other in distinct) > 1}
    short = {state: joined(numbers_of(state, distinct)) if state in shared else name for state, name in full.items()}
    taken = Counter(short.values())
    return {state: short[state] if short[state] and taken[short[state]] == 1 else name for state, name in full.items()}


def name_of(state: State, others: Sequence[State]) -> str:
    """Its words; else what differs between it and the others."""
    own = numbers_of(state, others)
    alone = sum(other.label == state.label for other in others) == 1
    return joined([state.label] if state.label and alone else [state.label, *own] if state.label else own) or "single"


def numbers_of(state: State, others: Sequence[State]) -> list[str]:
    """What is stated of it and not of all others alike."""
    common = set.intersection(*(set(other.stated) for other in others)) if len(others) > 1 else set()
    return [value for key_value in state.stated if key_value not in common for value in key_value[1:]]


def joined(parts: Sequence[str]) -> str:
    text = "_".join(re.sub(r"[^\w.+-]", "", part.replace("%", "pct").replace("/", "per")) for part in parts if part)
    return re.sub(r"^[\W_]+", "", text)


def held_out(conditions: Mapping[str, Mapping[str, str]], quantities: Mapping[str, Sequence[str]]) -> dict[str, Guess[bool]]:
    """Conditions to keep for the test of what is found: of each quantity that has enough one inside the range of its others.

    An effect that shows in one quantity alone is proven there or nowhere.  One condition may serve several quantities; none is taken that
    would leave a quantity fewer than two to fit.  ``conditions``: name -> what is stated; ``quantities``: name -> what was measured in it.
    """
    measured: dict[str, list[str]] = {}
    for name in conditions:
        for quantity in dict.fromkeys(quantities.get(name, ())):
            measured.setdefault(quantity, []).append(name)
    found: dict[str, Guess[bool]] = {}
    # Those with fewest conditions choose first: theirs may serve the others, too.
    for names in sorted(measured.values(), key=len):
        if len(names) < LEAST_CONDITIONS or found.keys() & set(names):
            continue
        free = [n for n in names if all(sum(m not in found for m in others) >= LEAST_CONDITIONS for others in measured.values() if n in others)]
        inner, varied = inside(names, conditions, free)
        chosen = inner or (free[-1] if free and not varied else None)
        if chosen is not None:
            reason = "inside the range of the others" if inner else "the last one; nothing says which lies inside the others"
            found[chosen] = Guess(True, f"kept for the test of what is found: {reason}", False)
    return {name: found[name] for name in conditions if name in found}


def inside(names: Sequence[str], conditions: Mapping[str, Mapping[str, str]], free: Sequence[str]) -> tuple[str | None, bool]:
    """Of those that are ``free`` the condition nearest to the middle in each number that differs, none of them at an end, None without one;
    and whether any number differs over all names."""
    levels = {name: {key: float(m[0]) for key, text in conditions[name].items() if key in FACTOR_KEYS and (m := NUMBER.match(text))} for name in names}
    best: tuple[float, str] | None = None
    varied = [key for key in levels[names[0]] if len({levels[n].get(key) for n in names}) > 2 and all(key in levels[n] for n in names)]
    for name in free:
        far = 0.0
        for key in varied:
            numbers = [levels[n][key] for n in names]
            low, high = min(numbers), max(numbers)
            far = max(far, abs(2.0 * (levels[name][key] - low) / (high - low) - 1.0))
        if varied and far < 1.0 and (best is None or far < best[0]):
            best = (far, name)
    return best[1] if best else None, bool(varied)
