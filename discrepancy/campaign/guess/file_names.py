"""What file names seem to say of their conditions, as a pattern such as ``te_{load}Nm_{speed}rpm_{replicate}``."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from discrepancy.campaign.guess.column_words import IN_NAMES, ON_SURFACE
from discrepancy.campaign.guess.name_units import FIELDS, NUMBER, figure, is_speed_in_turns, plain_field, spelled, with_units
from discrepancy.held_names import LOCKED_AT
from fmu_src import unit_words as u

# Field of a pattern -> kind of its unit and the unit where the name has none; fields without a unit have none here.
NUMBERS = {
    "load": (u.TORQUE, "N.m"), "load_torque": (u.TORQUE, "N.m"), "speed": (u.SPEED, "rpm"), "input_speed": (u.SPEED, "rpm"), "output_speed": (u.SPEED, "rpm"),
    "temperature": (u.TEMPERATURE, "degC"), "hours": (u.TIME, "h"), LOCKED_AT: (u.ANGLE, "deg"),
}  # fmt: skip
SENSES = {
    "forward": r"fwd|forward|fw|cw|vor|vorwärts|vorwaerts|rechts|avant|avanti|adelante|正转|正転",
    "reverse": r"rev|reverse|bwd|backward|ccw|rück|rueck|rückwärts|links|arri[èe]re|indietro|atr[áa]s|反转|逆転",
}  # fmt: skip
SENSE = {sense: re.compile(rf"(?:{words})$", re.IGNORECASE) for sense, words in SENSES.items()}
WITH_UNIT = re.compile(rf"({NUMBER})[_\s]*([^\d\s_-].*)$")
COUNTED = re.compile(
    r"(?:rep|replicate|repetition|repeat|run|r|wdh|wiederholung|w|lauf|messung|versuch|meas|mesure|essai|prova|ensayo|prueba|ensaio|teste|medida|medición|medição"
    r"|misura|[mv](?=\d$)|répétition|trial|test|n|no|nr|#|第)?\.?(\d{1,2})(?:次|回目?|遍|度目)?$",
    re.IGNORECASE,
)
# Words behind which a letter counts, too: run A, Lauf B.
REPEATED = (
    "rep|reps|replicate|repetition|repeat|run|trial|meas|measurement|wdh|wiederholung|lauf|durchlauf|durchgang|messung|versuch|essai|mesure|répétition"
    "|prova|misura|ripetizione|ensayo|prueba|medida|medición|repetición|ensaio|medição|repetição"
)
REPEATED_WORD = re.compile(rf"(?:{REPEATED})\.?$", re.IGNORECASE)
COUNT = re.compile(r"\d{1,2}$|[A-Za-z]$")
COUNTED_WORD = re.compile(rf"(?i:{REPEATED})\.?(\d{{1,2}}|[A-Z])$")
NUMBERED_WORD = re.compile(r"([^\W\d_]+)(\d{1,2})$")
# Parts of names of quantities and surfaces, and words that say nothing.
PARTS_OF_QUANTITIES = {
    "race", "ring", "inner", "outer", "error", "transmission", "no", "load", "input", "run", "messung", "messreihe", "test", "lauf", "meas", "measurement",
    "essai", "mesure", "prova", "misura", "ensayo", "prueba", "ensaio", "teste", "medida", "medición", "medição",
    "data", "export", "rep", "speed", "depth", "motion", "lost", "torsional", "torsionale", "torsionnelle", "trasmissione", "transmisión", "transmision",
    "ingresso", "ciclo", "cycle", "di", "de",
}  # fmt: skip
# Dates and times, which differ from file to file and say nothing of the condition.
MOMENT = re.compile(r"\d{4}-\d\d-\d\d|\d\d[-.]\d\d[-.]\d{4}|\d{8}T?|\d{6}|\d\d[-.h]\d\d(?:[-.m]\d\ds?)?$")
PARTS = re.compile(r"([_\s]+|(?<=\D)-(?=\D)|(?<=\w)-(?=\D)|-(?=[A-Za-z])|[()]+)")
# Where nothing else parts a name a hyphen before a number with a unit, or before the last one, does and is no minus: te-50Nm-40C-1.
HYPHENS = re.compile(PARTS.pattern[:-1] + rf"|(?<=\w\w)(?<![Tt]emp)-(?={NUMBER}[^\W\d_])|(?<=[^\W\d_])-(?=\d{{1,2}}$))")
# Letters before a number, as in T40 or n15: what they mostly stand for.
LETTERS = {
    "t": "temperature", "n": "speed", "m": "load", "temp": "temperature", "load": "load", "last": "load", "torque": "load", "speed": "speed", "h": "hours",
}  # fmt: skip
LETTERED = re.compile(rf"([^\W\d_]+)=?({NUMBER})([^\d]*)$")


@dataclass(frozen=True)
class Parsed:
    """``numbers``: field -> (number, unit); ``label``: words that are left; ``pattern`` that was used; ``unsure``: what of it may be meant
    otherwise, and what settles it."""

    pattern: str
    numbers: Mapping[str, tuple[float, str]] = field(default_factory=dict)
    replicate: int | None = None
    direction: str | None = None
    mounting: str | None = None
    label: str = ""
    given: bool = False
    unsure: tuple[tuple[str, str], ...] = ()


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
    counted = repetition(parts, last)
    for k, part in enumerate(parts):
        if k % 2 or not part:
            pattern += part
        elif (found := number_of(part)) and found[0] not in numbers:
            name, number, unit, text = found
            numbers[name] = (number, unit)
            pattern += text
        elif MOMENT.fullmatch(part):
            pattern += "{any}"
        elif counted and k == counted[0]:
            replicate = count_of(counted[1])
            pattern += "{replicate}".join(part.rsplit(counted[1], 1))
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


def repetition(parts: Sequence[str], last: int) -> tuple[int, str] | None:
    """(place, count) of the part that ends with the number of a repetition: the last one, or one behind a word that says so, by a letter, too."""
    if last > 0 and (match := COUNTED.match(parts[last])):
        return last, match[1]
    for k in range(0, len(parts), 2):
        if (match := COUNTED_WORD.match(parts[k])) and k > 0:
            return k, match[1]
        if k > 0 and REPEATED_WORD.match(parts[k - 2]) and COUNT.match(parts[k]):
            return k, parts[k]
    return None


def count_of(text: str) -> int:
    """Of a number, or of a letter: A is 1."""
    return int(text) if text.isdigit() else ord(text.lower()) - ord("a") + 1


def number_of(part: str) -> tuple[str, float, str, str] | None:
    """(field, number, unit, part of the pattern) of a part such as 167Nm or T40."""
    match = WITH_UNIT.match(part)
    if match and is_speed_in_turns(match[1], match[2]):
        return "speed", figure(match[1]), "rpm", f"{{speed:rpm}}{part[match.end(1):]}"
    if match and (known := spelled(match[2])):
        unit, kind = known
        name = FIELDS.get(kind) or ("hours" if unit == "h" else "load" if unit == "%" else None)
        if name:
            return name, figure(match[1]), unit, f"{{{name}}}{part[match.end(1):]}"
    if (match := LETTERED.match(part)) and (word := match[3].strip("_ ")):
        known, name = spelled(word), LETTERS.get(match[1].lower())
        # A single letter without a unit may count anything; with one of another kind that one decides: T100Nm.
        if known and name and known[1] == NUMBERS[name][0]:
            return name, figure(match[2]), known[0], part[: match.start(2)] + f"{{{name}}}{match[3]}"
        if plainly := plain_field(word):
            return plainly[0], figure(match[2]), plainly[1], part[: match.start(2)] + f"{{{plainly[0]}}}{match[3]}"
    return None


def is_quantity(word: str) -> bool:
    """Whether a word names what was measured, or that it was repeated, and no condition."""
    counts = REPEATED_WORD.match(word) is not None
    return counts or word.lower() in PARTS_OF_QUANTITIES or any(fits.fullmatch(word) for fits in (*IN_NAMES.values(), *ON_SURFACE.values()))
