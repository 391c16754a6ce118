"""Numbers by which names differ and that nobody understood, as patterns with a field in their place."""

import re
from collections import defaultdict
from collections.abc import Sequence

from discrepancy.campaign.guess.file_names import PARTS
from discrepancy.campaign.guess.name_units import NUMBER, is_turns

COUNTING = re.compile(rf"([^\W\d_]*)=?({NUMBER})([^\d]*)$")
# A field of a pattern is no number of its own.
FIELD = re.compile(r"\{\w+\}")


def suggested(patterns: Sequence[str], field: str) -> list[tuple[str, list[str]]]:
    """Patterns with ``field`` in place of one number each (T50, T100), and the numbers that stand there; the one with most numbers first.

    What such letters stand for a name does not say, so nobody takes it unasked.  What the names differ by besides stays a condition's name.
    """
    forms: dict[tuple[int, str], list[list[str]]] = defaultdict(list)
    for pattern in dict.fromkeys(patterns):
        parts = PARTS.split(pattern)
        # Names of one kind have the same words beside their numbers, at least the first.
        forms[len(parts), COUNTING.sub("", parts[0])].append(parts)
    found = [offer for split in forms.values() if len(split) > 1 for offer in offers(split, field)]
    return sorted(found, key=lambda offer: -len(offer[1]))


def turns_named(patterns: Sequence[str], field: str) -> list[tuple[str, list[str]]]:
    """The same where names do not differ, but have turns behind a number (15U): those a minute, perhaps."""
    found: dict[str, list[str]] = defaultdict(list)
    for pattern in dict.fromkeys(patterns):
        parts = PARTS.split(pattern)
        for place, part in enumerate(parts):
            if (match := COUNTING.match(part)) and is_turns(match[3]):
                found["".join([*parts[:place], f"{match[1]}{{{field}}}{match[3]}", *parts[place + 1 :]])].append(match[2])
    return list(found.items())


def offers(split: Sequence[Sequence[str]], field: str) -> list[tuple[str, list[str]]]:
    """Of names with equally many parts."""
    columns = list(zip(*split))
    varying = [k for k, column in enumerate(columns) if len(set(column)) > 1]
    found = []
    for place in varying:
        matches = [COUNTING.match(part) for part in columns[place]]
        kinds = {(match[1], match[3]) if match else None for match in matches}
        if len(kinds) != 1 or None in kinds:
            continue
        before, after = next(iter(kinds)) or ("", "")
        words = [k for k in varying if k != place and not FIELD.search(split[0][k])]
        others = dict.fromkeys(words, "{any}") | dict.fromkeys(words[:1], "{condition}")
        first = [others.get(k, part) for k, part in enumerate(split[0])]
        first[place] = f"{before}{{{field}}}{after}"
        numbers = dict.fromkeys(match[2] for match in matches if match)
        found.append(("".join(first), sorted(numbers, key=lambda text: float(re.sub("[,p]", ".", text)))))
    return found
