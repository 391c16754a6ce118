"""Which quantity a table holds, and which column is what."""

import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from discrepancy.campaign.guess.column_words import meaning_of
from discrepancy.campaign.guess.header_units import name_of, unit_in
from discrepancy.campaign.guess.magnitudes import speed_role
from discrepancy.campaign.guess.said import Guess
from discrepancy.campaign.guess.shape import Shape, shape_of
from discrepancy.campaign.guess.table import Table
from discrepancy.campaign.guess.wishes import of_column
from discrepancy.campaign.quantities import FACTOR_KEYS, QUANTITIES, VALUE, roles_of
from discrepancy.held_names import LOCKED_AT
from fmu_src import unit_words as u
from fmu_src.unit_words import unit_of

# By the reader's name of a column.
Roles = dict[str, Guess[str]]

# Kind of unit of an axis or value; words that mean it.
KINDS = {
    "angle": u.ANGLE, "input_angle": u.ANGLE, "time": u.TIME, "torque": u.TORQUE, "order": u.SHARE, "depth_angle": u.ANGLE, "load_torque": u.TORQUE,
    "input_speed": u.SPEED, "output_speed": u.SPEED, "temperature": u.TEMPERATURE, "hours": u.TIME, LOCKED_AT: u.ANGLE,
    "transmission_error": u.ANGLE, "hysteresis": u.ANGLE, "lost_motion": u.ANGLE, "torsional_stiffness": u.STIFFNESS, "input_torque": u.TORQUE,
    "no_load_torque": u.TORQUE, "efficiency": u.SHARE, "vibration": u.ACCELERATION, "vibration_order": u.ACCELERATION, "wear_profile": u.LENGTH,
    "wear_depth": u.LENGTH, "mass_loss": u.MASS, "debris_iron": u.SHARE, "cage_speed": u.SPEED,
}  # fmt: skip
MEANT = {
    "angle": ("angle",), "input_angle": ("input_angle",), "time": ("time",), "torque": ("torque",), "order": ("order",), "depth_angle": ("angle",),
    "transmission_error": ("error",), "hysteresis": ("twist", "angle", "input_angle"), "lost_motion": ("lost_motion",),
    "torsional_stiffness": ("stiffness",), "input_torque": ("input_torque", "torque"), "no_load_torque": ("input_torque", "torque"),
    "efficiency": ("efficiency",), "vibration": ("acceleration",), "vibration_order": ("acceleration",), "temperature": ("temperature",),
    "wear_profile": ("wear",), "wear_depth": ("wear",), "mass_loss": ("mass_loss",), "debris_iron": ("iron",), "cage_speed": ("speed",),
}  # fmt: skip
KIND_MEANT = {word: KINDS[role] for role, words in MEANT.items() for word in words} | {
    "hours": u.TIME, "speed": u.SPEED, "input_speed": u.SPEED, "output_speed": u.SPEED,
}  # fmt: skip
# What a unit alone means.
BY_UNIT = {u.TEMPERATURE: "temperature", u.TORQUE: "torque", u.TIME: "time", u.SPEED: "speed"}
# Of numbers that are one column over a number of the condition.
OVER = {"wear_depth": "hours", "lost_motion": "hours", "mass_loss": "hours", "debris_iron": "hours"}
# What a name, a unit, the shape, the file's name and a tag that is given weigh.
NAME, UNIT, SHAPE, FILE_NAME, TAGGED = 3.0, 2.0, 2.0, 3.5, 1.5
MARGIN = 1.0
# And an axis that there may be.
OPTIONAL = 1.0
# Assignments of one quantity whose points are nearer are equally good.
TIE = 0.25
# Columns of which one may be the value without name or unit.
FEW = 3
# Columns of what was asked for, not of what was measured, count less.
ASKED, LESS = re.compile(r"control|command|cmd|target|desired|set.?point|soll|(?:^|[ _.-])(?:ref|set)(?:$|[ _.-])|目标|目標|设定|指令", re.IGNORECASE), 1.0
# What drives call the error of their position against the one that was asked for.
OF_DRIVES = re.compile(r"follow|track|contour|schlepp|regel|poursuite|inseguimento|seguimiento|追従|跟随", re.IGNORECASE)
# What was measured where a temperature was recorded beside it.
BESIDE_TEMPERATURE = ("torque", "input_torque", "angle", "error", "acceleration")
# Signs of a name that is a unit by itself: hours, rpm.
LEAST_UNIT_NAME = 3


@dataclass(frozen=True)
class Column:
    """What is known of one column; ``stated``: (unit, kind, where it stands)."""

    name: str
    meaning: str | None
    stated: tuple[str, str, str] | None
    shape: Shape


def columns_of(table: Table, stated: Mapping[str, str]) -> list[Column]:
    """Columns that hold numbers; ``stated``: units that are given by header."""
    found = []
    for name, values in table.columns.items():
        if (shape := shape_of(values)) is None:
            continue
        header = table.headers.get(name, name)
        unit = unit_in(header)
        if unit is None and len(header) >= LEAST_UNIT_NAME and (own := unit_of(header)) and own[1] == KINDS.get(meaning_of(header) or ""):
            unit = (*own, "its name is a unit")
        if (line := unit_of(table.units.get(name, ""))) and line[0] != "1":
            unit = (*line, f"the file states {table.units[name].strip()}")
        if given := of_column(stated, header, name):
            known = unit_of(given)
            unit = (known[0] if known else given, known[1] if known else "", f"given: {given}")
        found.append(Column(name, meaning_with(meaning_of(name_of(header)), unit), unit, shape))
    return found


def meaning_with(meaning: str | None, stated: tuple[str, str, str] | None) -> str | None:
    """A name's meaning, unless its unit is of another kind: T in degC is no torque."""
    if stated is None or not stated[1] or meaning in (None, "replicate", "acceleration") or KIND_MEANT.get(meaning or "") == stated[1]:
        return meaning
    return BY_UNIT.get(stated[1])


def fit(column: Column, role: str) -> tuple[float, list[str]] | None:
    """How well a column fits a role (an axis, or a quantity's value), and why; None if its unit is of another kind."""
    points, why = 0.0, []
    if column.stated and column.stated[1]:
        if column.stated[1] != KINDS[role]:
            return None
        points, why = points + UNIT, [unit_words(column.stated[0], column.stated[2])]
    meant = MEANT.get(role, (role,))
    if column.meaning in meant:
        points += NAME - 0.5 * meant.index(column.meaning)
        why.insert(0, f"its name says {column.meaning.replace('_', ' ')}")
    elif column.meaning is not None:
        points -= NAME
    points -= LESS if ASKED.search(column.name) else 0.0
    if shape := shape_fits(column.shape, role):
        points, why = points + SHAPE, [*why, shape]
    elif role in ("torque", "angle", "input_angle", "order", "time"):
        points -= SHAPE
    return points, why


def unit_words(unit: str, reason: str) -> str:
    """A unit as a reason for what a column is, with where it stands."""
    return f"unit {unit} ({reason})"


def shape_fits(shape: Shape, role: str) -> str:
    """In words, what of a curve is typical of a role; empty if nothing is."""
    if role == "torque" and shape.loops:
        return f"goes up and down between {shape.low:.4g} and {shape.high:.4g}"
    if role in ("angle", "input_angle", "depth_angle") and shape.span > 0.0 and (shape.steady or shape.jumps):
        return f"runs on from {shape.low:.4g} to {shape.high:.4g}" + (", with jumps of a turn" if shape.jumps else "")
    if role in ("time", "order", "hours") and shape.steady and shape.span > 0.0:
        return f"rises from {shape.low:.4g} to {shape.high:.4g}"
    if role == "hysteresis" and shape.loops:
        return "comes back with the torque"
    if role == "transmission_error" and shape.reversals > 1 and not shape.jumps:
        return f"changes between rising and falling {shape.reversals} times over the file, as a transmission error does"
    return ""


@dataclass(frozen=True)
class Assignment:
    """A quantity and its columns, role -> column, with what speaks for it."""

    quantity: str
    points: float
    roles: Mapping[str, Guess[str]]


def assignments(columns: list[Column], named: list[str], tags: Container[str] = (), numbers: Mapping[str, str] = MappingProxyType({})) -> list[Assignment]:
    """All quantities that the columns could be, the likeliest first; ``named``: those that the file's name speaks of; ``tags`` that are given;
    ``numbers``: role -> column of numbers of the condition that are given, which any quantity takes."""
    found = [a for quantity in QUANTITIES if quantity in KINDS for a in of_quantity(quantity, columns, numbers)]
    # The file's name decides among what the columns allow.
    points = {q: FILE_NAME - 0.5 * named.index(q) for q in named} | dict.fromkeys(QUANTITIES.keys() - {*named}, 0.0)
    # Who says which side was locked speaks of loops.
    points = {q: p + (TAGGED if any(tag in tags for tag in QUANTITIES[q].tags) else 0.0) for q, p in points.items()}
    weighed = [Assignment(a.quantity, a.points + points[a.quantity], a.roles) for a in found]
    best: dict[str, Assignment] = {}
    tied = set()
    for a in sorted(weighed, key=lambda a: -a.points):
        first = best.setdefault(a.quantity, a)
        if first.points - a.points < TIE and {VALUE} <= a.roles.keys() & first.roles.keys() and a.roles[VALUE].value != first.roles[VALUE].value:
            tied.add(a.quantity)
    return [doubtful(a) if a.quantity in tied else a for a in best.values()]


def doubtful(a: Assignment) -> Assignment:
    """The same where another value's column would do as well."""
    roles = {role: Guess(guess.value, f"{guess.reason}; another column would do as well", False) for role, guess in a.roles.items()}
    return Assignment(a.quantity, a.points, roles)


def of_quantity(quantity: str, columns: list[Column], numbers: Mapping[str, str]) -> Iterator[Assignment]:
    axes = QUANTITIES[quantity].axes
    by_name = {column.name: column for column in columns}
    given = {role: Guess(name, "given") for role, name in numbers.items() if role in roles_of(QUANTITIES[quantity]) and role != quantity}
    others = [c for c in columns if c.name not in {guess.value for guess in given.values()}]
    if quantity == "transmission_error":
        yield from (Assignment(a.quantity, a.points, {**a.roles, **given}) for a in both_encoders(others))
    over = OVER.get(quantity)
    # Where nothing tells them apart the value stands last.
    for value in reversed(others):
        if (own := fit(value, quantity)) is None or value.shape.constant:
            continue
        rest = [c for c in others if c is not value]
        if len(columns) > FEW and value.meaning not in MEANT.get(quantity, ()) and not value.stated:
            # Among many columns a curve alone says nothing.
            continue
        if quantity == "vibration_order" and any(c.meaning == "input_order" for c in rest):
            continue
        points, roles = own[0], {VALUE: Guess(value.name, because(own[1], len(columns)), bool(own[1]) or len(columns) == 2)}
        whole = True
        for axis in axes:
            options = [(f, c, role) for c in rest if (f := fit(c, role := side_of(c, axis))) is not None and f[0] > 0.0]
            if not options:
                whole = False
                break
            best, column, role = max(options, key=lambda o: (o[0][0], o[2] == axis))
            points += best[0]
            rest.remove(column)
            roles[role] = Guess(column.name, because(best[1], len(columns)))
        if not whole:
            continue
        if quantity == "hysteresis" and value.shape.steady and not by_name[roles["torque"].value].shape.steady:
            # What runs on while the torque goes up and down is no twist.
            continue
        factors = ({} if quantity == "hysteresis" else row_factors(rest, quantity, given)) | given
        if quantity == "temperature" and any(c.meaning in BESIDE_TEMPERATURE and not c.shape.constant for c in columns):
            # One of the conditions of something else.
            points -= UNIT + NAME
        if over and over in factors:
            points += SHAPE
        if quantity == "input_torque" and factors.keys() & {"input_speed", "output_speed"}:
            points += SHAPE
        for axis in ("angle", "time"):
            meant = [c for c in rest if c.meaning == axis and c.name not in {g.value for g in factors.values()}]
            if axis in QUANTITIES[quantity].optional_axes and meant and fit(meant[0], axis):
                roles[axis] = Guess(meant[0].name, f"its name says {axis}")
                points += OPTIONAL
        # A column that is left without a role speaks against.
        left = [c for c in rest if c.name not in {g.value for g in (roles | factors).values()} and c.meaning not in ("time", "replicate")]
        yield Assignment(quantity, points - 0.5 * sum(not c.shape.constant for c in left), roles | factors)


def side_of(column: Column, axis: str) -> str:
    """The role in which a column can stand for an axis: an angle of the input is no angle of the output."""
    return "input_angle" if axis == "angle" and column.meaning == "input_angle" else axis


def both_encoders(columns: list[Column]) -> Iterator[Assignment]:
    """Angles of both shafts in place of the error; of a file that has the error itself they are less likely meant."""
    less = LESS if any(is_error(column) for column in columns) else 0.0
    for column in columns:
        one = fit(column, "input_angle")
        if one is None or column.meaning != "input_angle":
            continue
        for other in columns:
            two = fit(other, "angle") if other is not column and other.meaning == "angle" else None
            if two is not None:
                roles = {"angle": Guess(other.name, because(two[1], 2)), "input_angle": Guess(column.name, because(one[1], 2))}
                yield Assignment("transmission_error", one[0] + two[0] - less, roles)


def is_error(column: Column) -> bool:
    """Whether a column is a transmission error by its name, and no other unit or a drive's own error is against it."""
    return column.meaning == "error" and fits_kind(column, "transmission_error") and not column.shape.constant and not OF_DRIVES.search(column.name)


def because(why: list[str], count: int) -> str:
    return ", ".join(why) or ("the column that is left" if count == 2 else "nothing speaks for another")


def row_factors(columns: list[Column], quantity: str, given: Mapping[str, Guess[str]]) -> dict[str, Guess[str]]:
    """Numbers of the condition that change from row to row, beside those that are ``given``."""
    found: dict[str, Guess[str]] = {}
    places = FACTOR_KEYS.keys() & roles_of(QUANTITIES[quantity]).keys()
    for column in sorted(columns, key=lambda c: ASKED.search(c.name) is not None):
        meaning = {"torque": "load_torque"}.get(column.meaning or "", column.meaning)
        if meaning == "time" and column.stated and column.stated[0] == "h":
            meaning = "hours"
        guess = Guess(column.name, f"its name says {(meaning or '').replace('_', ' ')}")
        if meaning == "speed":
            side = speed_role(max(abs(column.shape.low), abs(column.shape.high)))
            meaning, guess = side.value, Guess(column.name, f"its name says speed; {side.reason}", False)
        both_speeds = {meaning, *found, *given} >= {"input_speed", "output_speed"}
        if meaning and meaning in places and meaning not in (quantity, *found, *given) and fits_kind(column, meaning) and not both_speeds:
            found[meaning] = guess
    return found


def fits_kind(column: Column, role: str) -> bool:
    return column.stated is None or not column.stated[1] or column.stated[1] == KINDS[role]
