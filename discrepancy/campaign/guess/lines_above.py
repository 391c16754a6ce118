"""What lines above a table say of the condition: "Drehzahl: 15 1/min", "# Temperature = 40 °C"."""

import re

from discrepancy.campaign.guess.column_words import meaning_of
from discrepancy.campaign.guess.header_units import name_of, unit_in
from fmu_src import unit_words as u
from fmu_src.unit_words import unit_of

STATED = re.compile(r"^[#%\"\s]*([^:：=;\t,\d]{1,60}?)\s*[:：=;\t,]\s*[;\t,]*\s*([+-]?\d+(?:[.,]\d+)?)\s*[;\t,]?\s*([^;\t,\"]*)[;\t,\"\s]*$")
# Several on one line: "torque = 100 N.m, speed = 15 rpm; temperature: 40 °C".
ONE = r"[^:：=;\t,|\d]{1,60}?\s*[:：=]\s*[+-]?\d"
EACH = re.compile(rf"([^:：=;\t,|\d]{{1,60}}?)\s*[:：=]\s*([+-]?\d+(?:[.,]\d+)?)\s*([^;\t,|:：=\"]*?)\s*(?:[;\t,|\"]|\s(?={ONE})|$)")
# Signs of a line that may state a number; what is longer is looked at in vain, and for long.
LONGEST = 200
FACTORS = {
    "torque": ("load", u.TORQUE), "speed": ("speed", u.SPEED), "input_speed": ("input_speed", u.SPEED), "output_speed": ("output_speed", u.SPEED),
    "temperature": ("temperature", u.TEMPERATURE), "hours": ("hours", u.TIME),
}  # fmt: skip


def stated_above(lines: tuple[str, ...]) -> dict[str, tuple[float, str]]:
    """Field as of a file name's pattern -> (number, unit); only what has a unit of its kind."""
    found: dict[str, tuple[float, str]] = {}
    for line in map(str.strip, lines):
        if len(line) > LONGEST:
            continue
        one = STATED.match(line)
        for name, number, unit in [one.groups()] if one and not re.search(r"[:：=]", one[3]) else EACH.findall(line):
            field = FACTORS.get(meaning_of(name_of(name.strip(' #%"'))) or "")
            known = unit_of(unit) or ((inside[0], inside[1]) if (inside := unit_in(name)) else None)
            if field and known and (known[1] == field[1] or (known[0] == "%" and field[0] == "load")):
                found.setdefault(field[0], (float(number.replace(",", ".")), known[0]))
    return found
