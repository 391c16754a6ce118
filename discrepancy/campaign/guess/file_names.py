"""What file names say of their conditions, by a pattern such as ``te_{load}Nm_{speed}rpm_{replicate}``."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from discrepancy.campaign.guess import unit_words as u
from discrepancy.campaign.guess.column_words import IN_NAMES, ON_SURFACE
from discrepancy.campaign.guess.unit_words import unit_of
from fmu_src.faults import InputFault, nearest

# Field of a pattern -> kind of its unit and the unit where the name has none; fields without a unit have none here.
NUMBERS = {
    "load": (u.TORQUE, "N.m"), "load_torque": (u.TORQUE, "N.m"), "speed": (u.SPEED, "rpm"), "input_speed": (u.SPEED, "rpm"), "output_speed": (u.SPEED, "rpm"),
    "temperature": (u.TEMPERATURE, "degC"), "hours": (u.TIME, "h"),
}  # fmt: skip
WORDS = ("replicate", "direction", "mounting", "condition", "any")
SENSES = {
    "forward": r"fwd|forward|fw|cw|vor|vorwärts|vorwaerts|rechts|avant|avanti|adelante|正转|正転",
    "reverse": r"rev|reverse|bwd|backward|ccw|rück|rueck|rückwärts|links|arri[èe]re|indietro|atr[áa]s|反转|逆転",
}  # fmt: skip
SENSE = {sense: re.compile(rf"(?:{words})$", re.IGNORECASE) for sense, words in SENSES.items()}
NUMBER = r"[+-]?\d+(?:[.,p]\d+)?"
WITH_UNIT = re.compile(rf"({NUMBER})[_\s]*([^\d\s_-]\S*)$")
COUNTED = re.compile(
    r"(?:rep|replicate|repetition|repeat|run|r|wdh|wiederholung|w|lauf|messung|versuch|meas|mesure|essai|prova|ensayo|prueba|ensaio|teste|medição"
    r"|misura|[mv](?=\d$)|répétition|trial|test|n|no|nr|#|第)?\.?(\d{1,2})(?:次|回)?$",
    re.IGNORECASE,
)
NUMBERED_WORD = re.compile(r"([^\W\d_]+)(\d{1,2})$")
# Parts of names of quantities and surfaces, and words that say nothing.
PARTS_OF_QUANTITIES = {
    "race", "ring", "inner", "outer", "error", "transmission", "no", "load", "input", "run", "messung", "messreihe", "test", "lauf", "meas", "measurement",
    "essai", "mesure", "prova", "misura", "ensayo", "prueba", "ensaio", "teste", "medição",
    "data", "export", "rep", "speed", "depth", "motion", "lost", "torsional", "torsionale", "torsionnelle", "trasmissione", "transmisión", "transmision",
    "ingresso", "ciclo", "cycle", "di", "de",
}  # fmt: skip
# Dates and times, which differ from file to file and say nothing of the condition.
MOMENT = re.compile(r"\d{4}-\d\d-\d\d|\d\d[-.]\d\d[-.]\d{4}|\d{8}T?|\d{6}|\d\d[-.h]\d\d(?:[-.m]\d\ds?)?$")
FIELD = re.compile(r"\{(\w+)\}")
PARTS = re.compile(r"([_\s]+|(?<=\D)-(?=\D)|(?<=\w)-(?=\D)|-(?=[A-Za-z])|[()]+)")
# Where nothing else parts a name a hyphen before a number with a unit, or before the last one, does and is no minus: te-50Nm-40C-1.
HYPHENS = re.compile(PARTS.pattern[:-1] + rf"|(?<=\w\w)(?<![Tt]emp)-(?={NUMBER}[^\W\d_])|(?<=[^\W\d_])-(?=\d{{1,2}}$))")
# Letters before a number, as in T40 or n15: what they mostly stand for.
LETTERS = {
    "t": "temperature", "n": "speed", "m": "load", "temp": "temperature", "load": "load", "last": "load", "torque": "load", "speed": "speed", "h": "hours",
}  # fmt: skip
LETTERED = re.compile(rf"([^\W\d_]+)=?({NUMBER})([^\d]*)$")
# The same of which letters may be missing.
COUNTING = re.compile(rf"([^\W\d_]*)=?({NUMBER})([^\d]*)$")
FIELDS = {u.TORQUE: "load", u.SPEED: "speed", u.TEMPERATURE: "temperature"}
# Signs of a unit that speaks for itself behind letters or a gap: Last50Nm, 100_Nm; "Probe2h" and "2_C" may count anything.
LEAST_UNIT = 2


@dataclass(frozen=True)
class Parsed:
    """``numbers``: field -> (number, unit); ``label``: words that are left; ``pattern`` that was used."""

    pattern: str
    numbers: Mapping[str, tuple[float, str]] = field(default_factory=dict)
    replicate: int | None = None
    direction: str | None = None
    mounting: str | None = None
    label: str = ""
    given: bool = False


def stem(path: Path) -> str:
    name = path.name.removesuffix(".gz")
    return name.rpartition(".")[0] or name


def proposed(path: Path) -> Parsed:
    """The pattern that a name seems to follow, and what it says by it."""
    pattern, numbers, words = "", dict[str, tuple[float, str]](), list[str]()
    replicate, direction = None, None
    whole = stem(path)
    parts = with_units((PARTS if re.search(r"[_\s]", whole) else HYPHENS).split(whole))
    # A word within those of a kind ("errore_di_trasmissione") names no condition either.
    kinds = [match.span() for fits in (*IN_NAMES.values(), *ON_SURFACE.values()) for match in fits.finditer(whole)]
    place = 0
    last = max((k for k in range(0, len(parts), 2) if parts[k]), default=0)
    for k, part in enumerate(parts):
        if k % 2 or not part:
            pattern += part
        elif (found := number_of(part)) and found[0] not in numbers:
            name, number, unit, text = found
            numbers[name] = (number, unit)
            pattern += text
        elif MOMENT.fullmatch(part):
            pattern += "{any}"
        elif k == last and k > 0 and (match := COUNTED.match(part)):
            replicate = int(match[1])
            pattern += part[: match.start(1)] + "{replicate}" + part[match.end(1) :]
        elif sense := next((name for name, fits in SENSE.items() if fits.match(part)), None):
            direction = sense
            pattern += "{direction}"
        elif k == last == 0 and (match := NUMBERED_WORD.match(part)) and is_quantity(match[1]):
            replicate = int(match[2])
            pattern += match[1] + "{replicate}"
        else:
            pattern += part
            if not is_quantity(part) and not any(first <= place and place + len(part) <= end for first, end in kinds):
                words.append(part)
        place += len(part)
    return Parsed(pattern, numbers, replicate, direction, None, "_".join(words))


def with_units(parts: Sequence[str]) -> list[str]:
    """Parts of a name, those of a number and of its unit as one: 100_Nm."""
    found: list[str] = []
    for part in parts:
        gap = found[-1] if len(found) > 1 else ""
        if part and gap and re.fullmatch(r"[_\s]", gap) and re.fullmatch(rf"[^\W\d_]*{NUMBER}", found[-2]) and plain_field(part):
            found[-2:] = [found[-2] + gap + part]
        else:
            found.append(part)
    return found


def plain_field(word: str) -> tuple[str, str] | None:
    """(field, unit) of a word that is a unit of a condition and hardly anything else."""
    known = unit_of(word) if len(word) >= LEAST_UNIT else None
    return (FIELDS[known[1]], known[0]) if known and known[1] in FIELDS else None


def suggested(patterns: Sequence[str], field: str) -> str | None:
    """The one pattern of names that differ by one number alone (T50, T100), with ``field`` in its place; None where it is not so plain.

    What such letters stand for a name does not say, so nobody takes it unasked.
    """
    split = [PARTS.split(pattern) for pattern in dict.fromkeys(patterns)]
    if len(split) < 2 or len({len(parts) for parts in split}) > 1:
        return None
    varying = [k for k, column in enumerate(zip(*split)) if len(set(column)) > 1]
    if len(varying) != 1:
        return None
    matches = [COUNTING.match(parts[varying[0]]) for parts in split]
    kinds = {(match[1], match[3]) if match else None for match in matches}
    if len(kinds) != 1 or None in kinds or matches[0] is None:
        return None
    first = split[0]
    return "".join((*first[: varying[0]], f"{matches[0][1]}{{{field}}}{matches[0][3]}", *first[varying[0] + 1 :]))


def number_of(part: str) -> tuple[str, float, str, str] | None:
    """(field, number, unit, part of the pattern) of a part such as 167Nm or T40."""
    if (match := WITH_UNIT.match(part)) and (known := unit_of(match[2])):
        unit, kind = known
        name = FIELDS.get(kind) or ("hours" if unit == "h" else "load" if unit == "%" else None)
        if name:
            return name, figure(match[1]), unit, f"{{{name}}}{part[match.end(1):]}"
    if (match := LETTERED.match(part)) and (word := match[3].strip("_ ")):
        known, name = unit_of(word), LETTERS.get(match[1].lower())
        # A single letter without a unit may count anything; with one of another kind that one decides: T100Nm.
        if known and name and known[1] == NUMBERS[name][0]:
            return name, figure(match[2]), known[0], part[: match.start(2)] + f"{{{name}}}{match[3]}"
        if plainly := plain_field(word):
            return plainly[0], figure(match[2]), plainly[1], part[: match.start(2)] + f"{{{plainly[0]}}}{match[3]}"
    return None


def figure(text: str) -> float:
    return float(text.replace(",", ".").replace("p", "."))


def is_quantity(word: str) -> bool:
    """Whether a word names what was measured and no condition."""
    return word.lower() in PARTS_OF_QUANTITIES or any(fits.fullmatch(word) for fits in (*IN_NAMES.values(), *ON_SURFACE.values()))


def by_pattern(path: Path, pattern: str) -> Parsed | None:
    """What a name says by a given pattern; None if it does not fit.  InputFault for a field that is not known."""
    fields, units = FIELD.findall(pattern), {}
    known_fields = (*NUMBERS, *WORDS)
    for name in fields:
        if name not in known_fields:
            raise InputFault(f"--names {pattern!r}: there is no field {{{name}}}; choose from {', '.join(known_fields)}{nearest(name, known_fields)}")
        if name != "any" and fields.count(name) > 1:
            raise InputFault(f"--names {pattern!r}: {{{name}}} stands there twice; take {{any}} for what does not count")
    expression, place = "", 0
    for match in FIELD.finditer(pattern):
        name = match[1]
        after = re.match(r"[_\s]?([^\s_\-{}()]*)", pattern[match.end() :])
        if name in NUMBERS:
            word = after[1] if after else ""
            known = unit_of(word)
            units[name] = known[0] if known and (known[1] == NUMBERS[name][0] or (known[0] == "%" and "load" in name)) else NUMBERS[name][1]
        group = r"\d+" if name == "replicate" else NUMBER if name in NUMBERS else r".*?" if name == "any" else r".+?"
        expression += re.escape(pattern[place : match.start()]) + (f"(?P<{name}>{group})" if name != "any" else group)
        place = match.end()
    found = re.fullmatch(expression + re.escape(pattern[place:]), stem(path)) or re.fullmatch(expression + re.escape(pattern[place:]), path.name)
    if not found:
        return None
    said = found.groupdict()
    direction = said.get("direction")
    sense = next((name for name, fits in SENSE.items() if direction and fits.match(direction)), None)
    if direction and not sense:
        raise InputFault(f"--names {pattern!r}: {path.name}: direction {direction!r} is not known; write forward or reverse, or {{any}} in its place")
    numbers = {name: (figure(said[name]), unit) for name, unit in units.items()}
    return Parsed(pattern, numbers, int(said["replicate"]) if said.get("replicate") else None, sense, said.get("mounting"), said.get("condition") or "", True)


def parsed(path: Path, patterns: Sequence[str]) -> Parsed:
    """By the first given pattern that fits, else by a proposed one."""
    return next((found for pattern in patterns if (found := by_pattern(path, pattern))), None) or proposed(path)
