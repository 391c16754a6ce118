"""What a file says of the condition of its run: in its name, or in the lines above its table."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from discrepancy.campaign.guess.entry import Entry
from discrepancy.campaign.guess.file_names import Parsed
from discrepancy.campaign.guess.lines_above import stated_above
from discrepancy.campaign.guess.magnitudes import SIZES, speed_role
from discrepancy.campaign.guess.name_and_head import contradiction, is_measured
from discrepancy.campaign.guess.said import Doubt, Guess, SpeedBySize
from discrepancy.campaign.guess.table import Table
from discrepancy.campaign.guess.wishes import NAMED
from fmu_src.units import UnitError, conversion

# A speed that is stated and one that was measured are the same within this share.
SAME_SPEED = 0.05
ABOVE = "a line above the table"


def factors_of(name: Parsed, table: Table, path: Path, entries: Mapping[str, Entry],
               speeds_of: str | None = None) -> tuple[dict[str, Guess[str]], dict[str, str], list[Doubt]]:  # fmt: skip
    """Key of a condition -> "15 rpm", from the file's name, else from the lines above its table; of those that the name says what such a line has
    measured; doubts.  ``speeds_of``: the shaft of which speeds are that nothing else tells, as it was given."""
    found: dict[str, Guess[str]] = {}
    actual: dict[str, str] = {}
    doubts = []
    above = stated_above(table.above)
    sources = [(name.numbers, f"the file's name, by {name.pattern!r}"), (above, ABOVE)]
    for numbers, where in sources:
        for field, (number, unit) in numbers.items():
            key, reason, sure = {"load": "load_torque"}.get(field, field), where, True
            if field == "speed":
                rpm = conversion(unit, "rpm")[0] * number
                side = speed_above(rpm, above) or speed_column(rpm, table, entries) or (Guess(speeds_of, "given") if speeds_of else speed_role(rpm))
                key, reason, sure = side.value, f"{where}; {side.reason}", side.sure
            text = f"{number:g} {unit}"
            if key in found:
                named = found[key].value
                actual |= {key: text} if is_measured(key, named, text) else {}
                doubts += [doubt] if (doubt := contradiction(path, key, named, text)) else []
                continue
            if key.endswith("speed") and any(k.endswith("speed") for k in found):
                continue
            found[key] = Guess(text, reason, sure)
            if not sure:
                other = "output_speed" if key == "input_speed" else "input_speed"
                remedy = f"--names with {{{other}}} in its place, or correct the condition"
                told = f"{text} is taken for the {key}: {side.reason}"
                doubts.append(SpeedBySize(path.name, told, remedy, text, key, SIZES[key], so=f"--condition {key}={NAMED}"))
    if name.direction:
        found["direction"] = Guess(name.direction, f"the file's name, by {name.pattern!r}")
    if name.mounting:
        found["mounting"] = Guess(name.mounting, f"the file's name, by {name.pattern!r}")
    return found, actual, doubts


def speed_above(rpm: float, above: Mapping[str, tuple[float, str]]) -> Guess[str] | None:
    """The side of which the lines above the table say the same speed."""
    for role in ("input_speed", "output_speed"):
        if role in above:
            number, unit = above[role]
            if abs(conversion(unit, "rpm")[0] * number - rpm) < SAME_SPEED * rpm:
                return Guess(role, f"{ABOVE} says whose it is")
    return None


def speed_column(rpm: float, table: Table, entries: Mapping[str, Entry]) -> Guess[str] | None:
    """The side at which the file's own column has a stated speed."""
    for role in ("input_speed", "output_speed"):
        if role in entries:
            entry = entries[role]
            measured = float(np.nanmedian(np.abs(table.columns[entry.column.value]))) * abs(float(entry.keys.get("scale", 1.0)))
            try:
                measured *= conversion(entry.unit.value, "rpm")[0]
            except UnitError:
                continue
            if abs(measured - rpm) <= SAME_SPEED * rpm:
                return Guess(role, f"column {entry.header!r} has it")
    return None
