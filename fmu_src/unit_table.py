"""A unit's table as C source: what ``shell/unit.h`` declares.

The shell checks, names and describes values by this table alone; a new variable needs
no change in the shell.
"""

import re
from itertools import groupby
from string import Formatter

from fmu_src.table import Table
from fmu_src.unit import LOG_CATEGORIES, LONGEST_STEP, Unit
from fmu_src.variables import Variable

MOST_DIMENSIONS = 4


class TableFault(ValueError):
    """A table or fault text that the shell cannot express."""


def c_source(unit: Unit, identity: str) -> str:
    """The C file of one unit."""
    table = unit.table
    variables = [v for v in table.variables if table.is_visible(v)]
    faults = [fault_pieces(table, code, text) for code, text in sorted(unit.faults.items())]
    runs = [f"{{{sum(1 for _ in same)}, 0x{bits:x}u}}" for bits, same in groupby(table.new_records().view("u8").tolist())]
    parts = [
        '#include "unit.h"',
        c_array("struct variable", "VARIABLES", [c_variable(table, v) for v in variables]),
        c_array("struct run", "STARTS", runs),
        *(c_array("struct piece", f"FAULT_{i}", pieces) for i, pieces in enumerate(faults)),
        c_array("struct fault", "FAULTS", [f"{{{code}, FAULT_{i}, {len(faults[i])}}}" for i, code in enumerate(sorted(unit.faults))]),
        c_array("struct caution", "CAUTIONS", [f"{{{table.offset[name]}, {c_string(text)}}}" for name, text in unit.cautions.items()]),
        c_array("struct range", "RANGES", [
            f"{{{c_string(v.name)}, {table.offset[v.name]}, {v.size}, {int(v.is_integer)}, {float(lowest)!r}, {float(highest)!r}}}"
            for v, lowest, highest in table.state_ranges
        ]),
        c_array("char *const", "CATEGORIES", [c_string(name) for name in LOG_CATEGORIES]),
        f"""DEFINED const struct unit unit = {{
    {c_string(table.name)}, {c_string(identity)}, {table.cell_count}, {table.state_cells}, {table.interface_cells},
    VARIABLES, {len(variables)}, STARTS, {len(runs)}, FAULTS, {len(faults)}, CAUTIONS, {len(unit.cautions)},
    CATEGORIES, {len(LOG_CATEGORIES)},
    {unit.guarded_cells}, {LONGEST_STEP!r}, {", ".join(str(table.offset[name]) for name in unit.pause or ()) or "-1, -1"},
    RANGES, {len(table.state_ranges)},
}};""",
    ]
    return "\n\n".join(parts) + "\n"


def c_string(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if " " <= c <= "~" else "".join(f"\\{b:03o}" for b in c.encode()) for c in escaped) + '"'


def c_array(kind: str, name: str, items: list[str]) -> str:
    # C has no empty arrays; the counts beside them say how many items there are.
    return f"static const {kind} {name}[] = {{\n    " + ",\n    ".join(items or ["{0}"]) + ",\n};"


def c_variable(table: Table, v: Variable) -> str:
    sizes = [length for _, length in v.seen_axes]
    if len(sizes) > MOST_DIMENSIONS:
        raise TableFault(f"{v.path} has {len(sizes)} dimensions; the shell takes {MOST_DIMENSIONS}")
    role = {"input": "INPUT", "output": "OUTPUT", "local": "OUTPUT", "state": "PROFILE"}.get(
        v.role, "TUNABLE_PARAMETER" if v.tunable else "FIXED_PARAMETER"
    )
    unit = "" if v.unit == "1" else f" {v.unit}"
    choices = c_string(", ".join(f"{i} ({c})" for i, c in enumerate(v.choices))) if v.choices else "NULL"
    shape = ", ".join(map(str, sizes)) or "0"
    return (
        f"{{{c_string(v.path)}, {c_string(unit)}, {choices}, {role}, {int(v.is_integer)}, {table.offset[v.name]},"
        f" {v.size}, {len(sizes)}, {{{shape}}}, {float(v.minimum)!r}, {float(v.maximum)!r}, {float(v.nominal)!r}}}"
    )


def fault_pieces(table: Table, code: int, text: str) -> list[str]:
    """A fault's format text as literals and cells; the numbers come out as Python's ``format`` gives them."""
    pieces = []
    for literal, name, spec, conversion in Formatter().parse(text):
        if name is None or spec is None:
            pieces.append(f"{{{c_string(literal)}, -1, 0, NULL}}")
            continue
        v = table.by_name.get(name)
        if v is None or v.shape or conversion or not re.fullmatch(r"(\.\d+)?[gef]|d|", spec):
            raise TableFault(f"{table.name}: fault {code}: {{{name}:{spec}}} must be a scalar variable with a format like .6g")
        if v.is_integer and spec not in ("", "d"):
            raise TableFault(f"{table.name}: fault {code}: {name} is an integer; give it no format")
        c_format = "%lld" if v.is_integer else f"%{spec or '.15g'}"
        pieces.append(f'{{{c_string(literal)}, {table.offset[name]}, {int(v.is_integer)}, "{c_format}"}}')
    return pieces
