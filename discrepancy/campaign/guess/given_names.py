"""What file names say of their conditions by a pattern that is given, such as ``te_{load}Nm_{speed}rpm_{replicate}``."""

import re
from collections.abc import Sequence
from pathlib import Path

from discrepancy.campaign.guess.file_names import NUMBERS, SENSE, Parsed, count_of, proposed, stem
from discrepancy.campaign.guess.name_units import NUMBER, figure, is_turns, units_behind
from fmu_src.faults import InputFault, nearest
from fmu_src.unit_words import unit_of
from fmu_src.units import UnitError, conversion

WORDS = ("replicate", "direction", "mounting", "condition", "any")
# A field, and the unit that it may say: {load:in-lbf}.
FIELD = re.compile(r"\{(\w+)(?::([^{}]*))?\}")
LETTER = r"[^\W\d_]"
# Letters right behind a number that are no unit; an x alone stands between two numbers.
LETTERS = re.compile(rf"(?!x(?!{LETTER}))({LETTER}+)", re.IGNORECASE)
LEAST_WORD = 2


def by_pattern(path: Path, pattern: str) -> Parsed | None:
    """What a name says by a given pattern; None if it does not fit.  InputFault for a field that is not known, or a unit of another kind behind one."""
    require_fields(pattern)
    name, found = matched(path, pattern)
    if not found:
        return None
    said = found.groupdict()
    direction = said.get("direction")
    sense = next((sense for sense, fits in SENSE.items() if direction and fits.match(direction)), None)
    if direction and not sense:
        raise InputFault(f"--names {pattern!r}: {path.name}: direction {direction!r} is not known; write forward or reverse, or {{any}} in its place")
    numbers, unsure = {}, []
    fields = [match for match in FIELD.finditer(pattern) if match[1] in said]
    for place, match in enumerate(fields):
        if match[1] in NUMBERS:
            following = [f[1] for f in fields[place + 1 :] if f[1] != "condition"]
            behind = name[found.end(match[1]) : found.start(following[0]) if following else None]
            unit, doubt = unit_read(match, behind)
            numbers[match[1]] = (figure(said[match[1]]), unit)
            unsure += [(doubt, f"--names '{pattern.replace(match[0], f'{{{match[1]}:UNIT}}')}' with its unit")] if doubt else []
    replicate = count_of(said["replicate"]) if said.get("replicate") else None
    return Parsed(pattern, numbers, replicate, sense, said.get("mounting"), said.get("condition") or "", True, tuple(unsure))


def require_fields(pattern: str) -> None:
    """InputFault for a field that there is not or that stands twice, and for a unit that is none of what it stands at."""
    known_fields, names = (*NUMBERS, *WORDS), [match[1] for match in FIELD.finditer(pattern)]
    for match in FIELD.finditer(pattern):
        name, given = match[1], match[2]
        if name not in known_fields:
            raise InputFault(f"--names {pattern!r}: there is no field {{{name}}}; choose from {', '.join(known_fields)}{nearest(name, known_fields)}")
        if name != "any" and names.count(name) > 1:
            raise InputFault(f"--names {pattern!r}: {{{name}}} stands there twice; take {{any}} for what does not count")
        if given is not None:
            require_unit(pattern, name, given)
        elif name in NUMBERS and (other := of_another_kind(name, literal := pattern[match.end() :].partition("{")[0])):
            words, kind, attached = other
            if is_turns(words) and "speed" in name and (attached or literal):
                raise InputFault(
                    f"--names {pattern!r}: {words!r} behind {{{name}}} is turns: does it stand for turns a minute ({words}/min)? Then write"
                    f" {pattern.replace(match[0], f'{{{name}:rpm}}')!r}; {{{name}:turn/s}} are turns a second"
                )
            if attached or (len(words) >= LEAST_WORD and literal):
                raise InputFault(
                    f"--names {pattern!r}: {words!r} behind {{{name}}} is a unit of {kind}, not of {NUMBERS[name][0]}; correct the field, or say"
                    f" in which unit the number is: {{{name}:{NUMBERS[name][1]}}}"
                )


def require_unit(pattern: str, name: str, given: str) -> None:
    """InputFault for a unit that no number of the field can have."""
    if name not in NUMBERS:
        raise InputFault(f"--names {pattern!r}: {{{name}}} has no unit; write {{{name}}}")
    if given.strip() == "%" and "load" in name:
        return
    try:
        conversion(given.strip(), NUMBERS[name][1])
    except UnitError as problem:
        raise InputFault(f"--names {pattern!r}: {{{name}:{given}}}: {problem}") from None


def unit_read(field: re.Match[str], behind: str) -> tuple[str, str]:
    """The unit of a field's number, and what of it is doubted: as the field says, else as stands ``behind`` the number, else the usual one."""
    name, given = field[1], field[2]
    if given is not None:
        known = unit_of(given)
        return known[0] if known else given.strip(), ""
    kind, usual = NUMBERS[name]
    for unit, found, _, _ in units_behind(behind):
        if found == kind or (unit == "%" and "load" in name):
            return unit, ""
    if letters := LETTERS.match(behind):
        return usual, f"{letters[1]!r} behind the number of {{{name}}} is no unit of {kind} that is known here; {usual} is taken"
    return usual, ""


def of_another_kind(name: str, behind: str) -> tuple[str, str, bool] | None:
    """(words, kind, whether they follow at once) of a unit behind a field that is none of its own; None where one of its own stands
    there, or none, or a sense of rotation: 50_rev."""
    found = [
        (words, kind, not gap) for unit, kind, gap, words in units_behind(behind)
        if unit != "1" and not any(fits.match(words) for fits in SENSE.values())
    ]  # fmt: skip
    own = any(kind == NUMBERS[name][0] or (unit == "%" and "load" in name) for unit, kind, _, _ in units_behind(behind))
    return found[0] if found and not own else None


def pieces(pattern: str) -> list[tuple[str, str]]:
    """Fields, and the words and signs between them: as the pattern has them, and the expression that fits."""
    found, place = [], 0
    for match in FIELD.finditer(pattern):
        before, after = pattern[place : match.start()], pattern[match.end() :]
        found += [(word, re.escape(word)) for word in re.findall(r"[^\W_]+|[\W_]+", before)]
        found.append((match[0], expression_of(match[1], before, after)))
        place = match.end()
    return found + [(word, re.escape(word)) for word in re.findall(r"[^\W_]+|[\W_]+", pattern[place:])]


def expression_of(name: str, before: str, after: str) -> str:
    """Of one field; a letter counts repetitions where it stands alone, or where the pattern itself has letters beside it."""
    if name == "any":
        return ".*?"
    if name != "replicate":
        return f"(?P<{name}>{NUMBER if name in NUMBERS else '.+?'})"
    first, last = "" if re.search(rf"{LETTER}$", before) else rf"(?<!{LETTER})", "" if re.match(LETTER, after) else rf"(?!{LETTER})"
    return rf"(?P<replicate>\d+|{first}[A-Za-z]{last})"


def matched(path: Path, pattern: str) -> tuple[str, re.Match[str] | None]:
    """The name that fits, without its ending or with it."""
    expression = "".join(part for _, part in pieces(pattern))
    names = (stem(path), path.name)
    return next(((name, found) for name in names if (found := re.fullmatch(expression, name))), (names[0], None))


def require_fit(paths: Sequence[Path], patterns: Sequence[str]) -> None:
    """InputFault for a pattern of names that fits none of the files, with how far it fits the nearest."""
    for pattern in patterns:
        if not any(by_pattern(path, pattern) for path in paths):
            raise InputFault(f"--names {pattern!r} fits none of the {len(paths)} files ({how_far(paths, pattern)}); correct it, or leave it out")


def how_far(paths: Sequence[Path], pattern: str) -> str:
    """Up to where the pattern fits the name that it fits best."""
    parts = pieces(pattern)
    best, end, nearest_one = -1, 0, paths[0]
    for path in paths:
        for count in range(len(parts), -1, -1):
            if found := re.match("".join(part for _, part in parts[:count]), stem(path)):
                if (count, found.end()) > (best, end):
                    best, end, nearest_one = count, found.end(), path
                break
    fitted, rest = "".join(written for written, _ in parts[:best]), stem(nearest_one)[end:]
    if best == len(parts):
        return f"{nearest_one.name} fits to its end, but {rest!r} is left of the name; {{any}} stands for it"
    wanted = f"{parts[best][0]!r}{of_what(parts[best][0])}"
    there = f"{rest!r} stands there" if rest else "the name ends there"
    return f"{nearest_one.name} fits up to {fitted!r}, but instead of {wanted} {there}" if best else f"{nearest_one.name} does not begin with {wanted}"


def of_what(written: str) -> str:
    """What a field takes, where that is not anything."""
    match = FIELD.fullmatch(written)
    return "" if not match else " (a number)" if match[1] in NUMBERS else " (a number or one letter)" if match[1] == "replicate" else ""


def parsed(path: Path, patterns: Sequence[str]) -> Parsed:
    """By the first given pattern that fits, else by a proposed one."""
    return next((found for pattern in patterns if (found := by_pattern(path, pattern))), None) or proposed(path)
