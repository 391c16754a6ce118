"""Curves of a measured file for ``rvwear bench --measured``: which column is what, and in which unit."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fmu_src.faults import InputFault, nearest

if TYPE_CHECKING:
    from discrepancy.campaign.guess.table import Table
    from studies.standard.conditions import Grouped
    from studies.standard.evaluation import Test

# What an export of the bench brings along; all else that tells conditions apart is asked for by --column.
BROUGHT = ("condition", "direction", "position")
# What heads mean, in the words of ``rvwear campaign from``, of the tests' columns; what twists under a torque is the output.
MEANT = {
    "output_torque": ("torque",), "output_angle": ("twist", "angle"), "input_torque": ("input_torque", "torque"), "input_angle": ("input_angle",),
    "input_speed": ("input_speed",), "output_speed": ("output_speed",),
}  # fmt: skip


def measured(path: Path, columns: list[str], test: "Test", rated: float) -> "Grouped":
    """Curves by condition and position, in the units of ``UNITS``; ``columns`` as ``NAME=HEADER:UNIT``, ``rated`` torque [N m].

    A head ``output_angle [deg]`` is taken for ``output_angle`` in degrees: a file that ``rvwear bench --export`` wrote needs no ``--column``.  Others
    are read as ``rvwear campaign from`` reads them, where they say their unit and one column alone means it.
    """
    from discrepancy.campaign.readers import Options, read_columns
    from fmu_src.units import UnitError, conversion
    from studies.standard.conditions import TELLING, grouped
    from studies.standard.evaluation import UNITS

    known = (*UNITS, "back_angle", "position", *TELLING)
    wanted: dict[str, tuple[str, str]] = {}
    for text in columns:
        name, equals, rest = text.partition("=")
        if not equals or name not in known:
            raise InputFault(f"--column {text}: give NAME=HEADER:UNIT with a NAME of {', '.join((*test.columns, 'position', *TELLING))}{nearest(name, known)}")
        header, _, unit = rest.rpartition(":") if ":" in rest else (rest, "", "")
        wanted[name] = (header, unit)
    heads, keys = heads_of(path, test)
    for name in (*test.columns, *test.held, *BROUGHT):
        if name not in wanted and (name in heads or name in test.columns):
            wanted[name] = heads.get(name, (name, ""))
    headers = {header for header, _ in wanted.values()}
    # What was looked at to find the heads says how the file is read; thousands it would take on a doubt.
    seen = headers <= {header for header, _ in heads.values()}
    options = Options(**{name: value for name, value in keys.items() if seen and name in Options.__dataclass_fields__ and name != "thousands"})
    try:
        read = read_columns(path, headers, options, "--measured")
    except InputFault as fault:
        raise InputFault(f"{fault}. Say which column is what: {' '.join(f'--column {name}=HEADER:UNIT' for name in test.columns)}") from None
    stated = dict(heads.values())
    converted: dict[str, Any] = {}
    for name, (header, unit) in wanted.items():
        values, own = np.asarray(read[header]), TELLING.get(name, "" if name == "position" else UNITS.get(name, "rad"))
        if not own:
            converted[name] = values
            continue
        taken = unit or stated.get(header) or own
        try:
            factor, offset = conversion(taken, own)
            converted[name] = factor * values.astype(float) + offset
        except (UnitError, ValueError) as problem:
            raise InputFault(f"{path}: column {header!r} as {name} in {taken}: {problem}") from None
    try:
        return grouped(test, converted, rated)
    except InputFault as fault:
        raise InputFault(f"{path}: {fault}") from None


def heads_of(path: Path, test: "Test") -> tuple[dict[str, tuple[str, str]], dict[str, Any]]:
    """(name -> (head, unit that it states), keys that read the file); nothing of a file that only the reader can say what is wrong with."""
    from discrepancy.campaign.guess.header_units import IN_BRACKETS
    from discrepancy.campaign.guess.table import table_of
    from fmu_src.unit_words import unit_of

    try:
        table = table_of(path)
    except InputFault:
        return {}, {}
    found: dict[str, tuple[str, str]] = {}
    for reader_name, head in table.headers.items():
        text = (IN_BRACKETS.findall(head) or [table.units.get(reader_name) or ""])[0]
        known = unit_of(text)
        found.setdefault(IN_BRACKETS.sub(" ", head).strip(), (reader_name, known[0] if known else text))
    return meant_by(table, test) | found, dict(table.reading)


def meant_by(table: "Table", test: "Test") -> dict[str, tuple[str, str]]:
    """Name of a column of the test -> (head, unit), of heads that mean it in the words of benches."""
    from discrepancy.campaign.guess.assign import ASKED, columns_of

    # A set point was not measured; a unit that nobody wrote is not guessed here, where nothing could say that it is in doubt.
    columns = [c for c in columns_of(table, {}) if c.stated and c.stated[1] and not ASKED.search(table.headers.get(c.name, c.name))]
    found = {}
    for name in (*test.columns, *test.held):
        for meaning in MEANT.get(name, ()):
            # At an input that is not asked for a torque without a side is the input's.
            if meaning == "torque" and name == "input_torque" and "output_torque" in (*test.columns, *test.held):
                continue
            own = [c for c in columns if c.meaning == meaning]
            if len(own) == 1 and own[0].stated:
                found[name] = (own[0].name, own[0].stated[0])
            if own:
                break
    return found
