"""One file's run: its quantity, columns, units, tags."""

import re
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from discrepancy.campaign.guess.assign import MARGIN, Assignment, Column, assignments, columns_of
from discrepancy.campaign.guess.column_words import quantities_named, surface_named
from discrepancy.campaign.guess.entry import Entry
from discrepancy.campaign.guess.file_names import Parsed, stem
from discrepancy.campaign.guess.given_names import parsed
from discrepancy.campaign.guess.header_units import name_of, unknown_in
from discrepancy.campaign.guess.locked_words import held_angle, locked_angle
from discrepancy.campaign.guess.magnitudes import unit_by_size
from discrepancy.campaign.guess.said import Doubt, Guess
from discrepancy.campaign.guess.set_steps import held_level
from discrepancy.campaign.guess.state_words import locked_side, unloaded
from discrepancy.campaign.guess.stated_factors import ABOVE, factors_of
from discrepancy.campaign.guess.table import Table, table_of
from discrepancy.campaign.guess.tag_words import meant_by, words_for
from discrepancy.campaign.guess.uneven import is_of_output
from discrepancy.campaign.guess.wishes import Wishes, of_column
from discrepancy.campaign.quantities import FACTOR_KEYS, QUANTITIES, VALUE
from discrepancy.held_names import HELD, LOCKED_AT
from fmu_src.faults import InputFault
from fmu_src.unit_words import COUNTS
from fmu_src.units import UnitError, conversion

ANGLES = ("angle", "input_angle")
# A clock that starts so many times its range away has its zero elsewhere.
FAR_START = 10.0
# A turn is short of its last step.
JUST_ABOVE = 1.002
MOST_REPETITIONS = 50
NUMBERS = r"\d+(?:[.,]\d+)?"


class NothingFits(InputFault):
    """A file whose columns are no quantity of a campaign; ``on_page`` says what to do where no option can be given."""

    def __init__(self, text: str, file: str):
        quantities = ", ".join(QUANTITIES)
        words = quantities.replace("_", " ")
        super().__init__(f"{text}; give units by --unit 'COLUMN=UNIT', what it is by --quantity '{file}=QUANTITY' ({quantities}), or a column by"
                         " --column value=COLUMN")  # fmt: skip
        self.on_page = f"{text}; write units into the heads of its columns, and what was measured into its name or a head ({words}), and drop it again"


@dataclass(frozen=True)
class GuessedRun:
    """What one file holds; ``factors``: key of a condition -> "15 rpm"; ``repeated``: its column that numbers repetitions, and their numbers;
    ``headers``: of every column that holds numbers, without units; ``left_out``: as the file has them, of those without a part; ``above``: keys that lines
    above its table state; ``actual``: key -> "25.2 degC", where it was not quite what its condition says; ``levels``: what columns of a condition's
    numbers hold throughout, in their units; NaN where they do not."""

    path: Path
    quantity: Guess[str]
    columns: dict[str, Entry]
    tags: dict[str, Guess[str]]
    reading: dict[str, Any]
    name: Parsed
    factors: dict[str, Guess[str]]
    repeated: tuple[str, tuple[int, ...]] | None
    doubts: tuple[Doubt, ...]
    headers: tuple[str, ...]
    left_out: tuple[str, ...]
    above: frozenset[str]
    actual: Mapping[str, str]
    levels: Mapping[str, float]
    # Above the table, as they stand there.
    lines: tuple[str, ...]
    # Whether the angle is the output's by how it turns, or the input's over the ratio; None where that cannot be seen.
    of_output: bool | None


def guessed_run(path: Path, wishes: Wishes) -> GuessedRun:
    """InputFault with the file's name where nothing can be made of it."""
    wishes = replace(wishes, columns=wishes.columns_for(path.name), scales=wishes.scales_for(path.name))
    table = table_of(path)
    name = parsed(path, wishes.names)
    columns = columns_of(table, wishes.units_for(path.name))
    speaking = stem(path)
    wanted = wishes.quantity_for(path.name)
    text = " ".join((path.parent.name, speaking, *table.above, *table.headers.values()))
    named = quantities_named(speaking) or quantities_named(path.parent.name)
    if unloaded(text) and "no_load_torque" not in named:
        named = [*named, "no_load_torque"]
    stated = stated_roles(table, wishes)
    numbers = {role: name for role, name in stated.items() if role in FACTOR_KEYS}
    known = given_roles(columns, stated)
    found = assignments(axes_only(known, stated), named, wishes.tags, numbers)
    if VALUE in stated and not any(VALUE in a.roles and a.roles[VALUE].value == stated[VALUE] for a in found):
        # Beside columns that say nothing a value without name or unit is none.
        found = assignments([c for c in known if c.name in stated.values()], named, wishes.tags, numbers) or found
    if wanted:
        found = [a for a in found if a.quantity == wanted]
    if not found:
        holds = ", ".join(f"{c.name} [{c.stated[0] if c.stated else '?'}]" for c in columns) or "no column of numbers"
        raise NothingFits(f"{path.name}: {holds}: no quantity{f' {wanted}' if wanted else ''} of a campaign fits", path.name)
    found = as_stated(found, stated)
    best = found[0]
    quantity = quantity_guess(found, wanted, path)
    doubts = [*table.doubts, *unsure_units(path, name), *not_taken(path, best, stated)]
    if not quantity.sure:
        doubts.append(Doubt(path.name, f"taken for {quantity.value}: {quantity.reason}", f"--quantity '{path.name}=QUANTITY'",
                            so=shlex.join(["--quantity", f"{path.name}={quantity.value}"])))  # fmt: skip
    by_name = {c.name: c for c in columns}
    entries = {}
    for role, guess in best.roles.items():
        if stated.get(role) == guess.value:
            guess = Guess(guess.value, "given")
        entries[role], more = entry(by_name[guess.value], role, quantity.value, guess, table, wishes)
        doubts += [Doubt(path.name, text, remedy, so=so) for text, remedy, so in more]
        if not guess.sure:
            doubts.append(Doubt(path.name, f"column {entries[role].header!r} is taken for {role}: {guess.reason}", f"--column '{role}=COLUMN'",
                                so=shlex.join(["--column", f"{role}={entries[role].header}"])))  # fmt: skip
    tags, more_doubts = tags_of(quantity.value, text, speaking, wishes, path)
    factors, actual, factor_doubts = factors_of(name, table, path, entries, wishes.speeds_of)
    if "load" in QUANTITIES[quantity.value].factors and "load_torque" not in factors.keys() | entries.keys() and unloaded(text):
        factors["load_torque"] = Guess("0 N.m", "the file's name or head says that nothing loads it")
    if quantity.value in HELD and LOCKED_AT not in entries.keys() | factors.keys() and (at := where_locked(path, table, tags)):
        factors[LOCKED_AT] = Guess(at, "the file's name or head says so")
    headers = tuple(name_of(name) for c in columns for name in dict.fromkeys((table.headers.get(c.name, c.name), c.name)))
    repeated = repetitions(table, columns)
    used = {guess.value for guess in best.roles.values()} | {repeated[0] if repeated else ""}
    left_out = tuple(table.headers.get(c.name, c.name) for c in columns if c.name not in used)
    if VALUE in entries and VALUE not in stated:
        doubts += side_by_side(path, entries[VALUE].header, left_out)
    levels = {role: held_level(table.columns[e.column.value]) * float(e.keys.get("scale", 1.0)) for role, e in entries.items() if role in FACTOR_KEYS}
    return GuessedRun(path, quantity, entries, tags, dict(table.reading), name, factors, repeated, (*doubts, *more_doubts, *factor_doubts), headers, left_out,
                      frozenset(key for key, guess in factors.items() if guess.reason.startswith(ABOVE)), actual, levels, table.above,
                      of_output_by_steps(table, columns, entries))  # fmt: skip


def of_output_by_steps(table: Table, columns: Sequence[Column], entries: Mapping[str, Entry]) -> bool | None:
    """See ``GuessedRun.of_output``: of an error over an angle, beside a column of the input's angle where there is one."""
    found = [entries[role] for role in ("angle", VALUE) if role in entries]
    if len(found) < 2:
        return None
    try:
        angle, error = (table.columns[entry.column.value] * conversion(entry.unit.value, "rad")[0] for entry in found)
    except UnitError:
        # A value that is no angle, or of which nobody knows the unit.
        return None
    beside = next((table.columns[c.name] for c in columns if c.meaning == "input_angle"), None)
    return is_of_output(angle, error, beside)


def given_roles(columns: list[Column], stated: Mapping[str, str]) -> list[Column]:
    """Columns as ``--column ROLE=HEADER`` says: they mean their role and nothing else does."""
    named = {name: role for role, name in stated.items()}
    found = []
    for c in columns:
        role = named.get(c.name)
        meaning = {"angle": "angle", "value": None, "load_torque": "torque", "depth_angle": "angle"}.get(role, role) if role else c.meaning
        if role == VALUE:
            meaning = {"angle": "error", "torque": "input_torque", "length": "wear"}.get(c.stated[1] if c.stated else "")
        found.append(Column(c.name, meaning, c.stated, c.shape))
    return found


def axes_only(columns: list[Column], stated: Mapping[str, str]) -> list[Column]:
    """Those that are stated, where value and an axis are: no other is either then."""
    axes = stated.keys() - FACTOR_KEYS.keys()
    return [c for c in columns if c.name in stated.values()] if VALUE in axes and len(axes) > 1 else columns


def stated_roles(table: Table, wishes: Wishes) -> dict[str, str]:
    """Role -> the reader's name of the column that ``--column`` says for it, of those that this file has."""
    return {role: name for role, given in wishes.columns.items() for name in table.columns if is_meant(given, name, table.headers.get(name, name))}


def is_meant(given: str, name: str, header: str) -> bool:
    """Whether a column is given by the reader's name or by its header, with its unit or without."""
    return given in (name, header, name_of(header))


def as_stated(found: list[Assignment], stated: Mapping[str, str]) -> list[Assignment]:
    """What is stated wins over what looks likelier: those that follow most of it."""
    followed = [sum(role in a.roles and a.roles[role].value == name for role, name in stated.items()) for a in found]
    return [a for a, count in zip(found, followed) if count == max(followed)]


def unsure_units(path: Path, name: Parsed) -> list[Doubt]:
    return [Doubt(path.name, text, remedy) for text, remedy in name.unsure]


def where_locked(path: Path, table: Table, tags: Mapping[str, Guess[str]]) -> str | None:
    """The angle at which the input was held: said of it plainly, or of what was held where only the input can be meant."""
    side = tags.get("locked")
    if side and side.value != "input":
        return None
    texts = (path.parent.name, stem(path), *table.above, *table.headers.values())
    of_input = side.sure if side else locked_side(" ".join(texts)) == "input"
    return locked_angle(texts) or (held_angle(texts) if of_input else None)


def not_taken(path: Path, best: Assignment, stated: Mapping[str, str]) -> list[Doubt]:
    return [
        Doubt(path.name, f"column {name!r} is not taken for {role}, as --column says: {best.quantity} has no place for it beside the others",
              f"--quantity '{path.name}=QUANTITY', or leave --column '{role}={name}' out")
        for role, name in stated.items() if role not in best.roles or best.roles[role].value != name
    ]  # fmt: skip


def side_by_side(path: Path, taken: str, left_out: Sequence[str]) -> list[Doubt]:
    """Columns whose heads differ by a number alone, as "TE 50Nm" and "TE 100Nm": several conditions side by side, of which one is taken."""
    alike = [header for header in left_out if re.sub(NUMBERS, "#", header) == re.sub(NUMBERS, "#", taken) and header != taken]
    if not alike:
        return []
    text = f"of columns whose heads differ by a number alone {taken!r} is taken, not {', '.join(map(repr, alike))}: one condition each, it seems"
    remedy = "save each as a file with that number in its name, or write a run for each in campaign.toml (same file, another columns.value)"
    return [Doubt(path.name, text, remedy)]


def quantity_guess(found: list[Assignment], wanted: str | None, path: Path) -> Guess[str]:
    best = found[0]
    if wanted:
        return Guess(wanted, "given")
    parts = [f"{role} is column {g.value} ({g.reason})" for role, g in best.roles.items()]
    reason = "; ".join(parts)
    if best.quantity in quantities_named(stem(path)):
        reason += "; the file's name says so"
    rival = found[1] if len(found) > 1 else None
    sure = best.points >= 3.0 and (rival is None or best.points - rival.points >= MARGIN)
    if not sure and rival:
        reason += f"; it might be {rival.quantity}"
    return Guess(best.quantity, reason, sure)


def entry(column: Column, role: str, quantity: str, guess: Guess[str], table: Table, wishes: Wishes) -> tuple[Entry, list[tuple[str, str, str]]]:
    """A column's entry and its doubts: text, remedy, and what states the guess."""
    header = table.headers.get(column.name, column.name)
    what = quantity if role == VALUE else role
    doubts: list[tuple[str, str, str]] = []
    keys: dict[str, Any] = {}
    scale = of_column(wishes.scales, header, column.name) or 1.0
    if scale != 1.0:
        keys["scale"] = scale
    counts = wishes.counts.get(header) or wishes.counts.get(column.name)
    if counts or (column.stated and column.stated[0] == COUNTS):
        if not counts:
            counts, why = steps_above(max(column.shape.high - min(column.shape.low, 0.0), 1.0))
            text = f"column {header!r} counts steps; {counts:.0f} a turn are assumed ({why})"
            doubts.append((text, f"--counts '{header}=STEPS_PER_TURN'", shlex.join(["--counts", f"{header}={counts:.0f}"])))
        keys["scale"] = scale / float(counts)
        unit = Guess("turn", f"steps of an encoder, {counts:.0f} a turn")
        if column.shape.jumps:
            doubts.append((f"column {header!r} jumps where a turn is over", "export it running on over full turns", ""))
        return Entry(guess, header, unit, keys), doubts
    if column.stated:
        unit = Guess(column.stated[0], column.stated[2])
    else:
        unit = unit_by_size(what, column.shape)
        if written := unknown_in(header):
            unit = Guess(unit.value, f"[{written}] in its header is no unit that is known here; {unit.reason.partition('; ')[2]}", False)
        if not unit.sure:
            so = shlex.join(["--unit", f"{header}={unit.value}"])
            doubts.append((f"unit of column {header!r} taken for {unit.value}: {unit.reason}", f"--unit '{header}=UNIT'", so))
    if column.shape.jumps and role in ANGLES:
        keys["unwrap"] = True
    if role == "time" and column.shape.low > FAR_START * column.shape.span:
        keys["from_start"] = True
    return Entry(guess, header, unit, keys), doubts


def steps_above(reach: float) -> tuple[float, str]:
    """Steps a turn of an encoder that reached so many, and why: encoders have powers of two, or round numbers that a whole turn just misses."""
    power = 2.0 ** np.ceil(np.log2(reach))
    tens = 10.0 ** (np.floor(np.log10(reach)) - 1.0)
    decimal = tens * np.ceil(reach / tens)
    if decimal <= JUST_ABOVE * reach < power:
        return float(decimal), "the round number just above its range"
    return float(power), "the power of two above its range"


def tags_of(quantity: str, text: str, name: str, wishes: Wishes, path: Path) -> tuple[dict[str, Guess[str]], list[Doubt]]:
    """What the quantity needs to be told of; where nobody says it, what is usual, in doubt."""
    found: dict[str, Guess[str]] = {}
    doubts = []
    entry = QUANTITIES[quantity]
    for tag in (*entry.tags, *entry.optional_tags):
        if tag in wishes.tags:
            found[tag] = meant_by(tag, wishes.tags[tag])
        elif tag in entry.tags:
            said = surface_named(name) or surface_named(text) if tag == "surface" else locked_side(text) if tag == "locked" else None
            usual = {"surface": "flank", "locked": "input", "location": "housing_radial", "part": "reducer"}[tag]
            found[tag] = Guess(said or usual, "the file's name or head says so" if said else f"nothing says it; {usual} is usual", said is not None)
            if said is None:
                doubts.append(Doubt(path.name, f"{tag} = {usual} is assumed", f"--tag {tag}=WORD, {words_for(tag)}", so=f"--tag {tag}={usual}"))
    return found, doubts


def repetitions(table: Table, columns: list[Column]) -> tuple[str, tuple[int, ...]] | None:
    """A column that numbers repetitions within the file."""
    for column in columns:
        if column.meaning == "replicate" and column.shape.whole and not column.shape.constant and column.shape.low >= 0.0:
            numbers = np.unique(table.columns[column.name][np.isfinite(table.columns[column.name])])
            if len(numbers) <= MOST_REPETITIONS:
                return column.name, tuple(int(n) for n in numbers)
    return None
