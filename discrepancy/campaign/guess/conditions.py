"""Conditions of several files, and their names."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

from discrepancy.held_names import LOCKED_AT

# Behind a number; n° and 1º count.
DEGREES = re.compile(r"(?<=\d)[ _]?°|(?<=\d\d)[ _]?º")


@dataclass(frozen=True)
class State:
    """What is known of a file's condition: key of a campaign's condition -> "15 rpm"; the words that name it; whether the file says either;
    whether the reducer turned."""

    stated: tuple[tuple[str, str], ...]
    label: str
    speaks: bool
    turned: bool = False


def named_conditions(states: Sequence[State]) -> dict[State, str]:
    """A name for each different state; files that say nothing belong to the only one there is, but none of a reducer that turned to one with
    its input locked."""
    speaking = list(dict.fromkeys(s for s in states if s.speaks))
    only = len(speaking) == 1
    apart = only and any(key == LOCKED_AT for key, _ in speaking[0].stated)
    alike = {state: state if apart and not state.speaks else replace(state, turned=False) for state in states}
    names = names_of(list(dict.fromkeys(alike.values())), replace(speaking[0], turned=False) if only else None)
    return {state: names[same] for state, same in alike.items()}


def names_of(distinct: Sequence[State], only: State | None) -> dict[State, str]:
    """``only``: the one state of which files speak, which is that of those that do not."""
    full = {state: name_of(only, [only]) if only and not state.speaks and not state.turned else name_of(state, distinct) for state in distinct}
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
    text = "_".join(re.sub(r"[^\w.+-]", "", DEGREES.sub("deg", part).replace("%", "pct").replace("/", "per")) for part in parts if part)
    return re.sub(r"^[\W_]+", "", text)
