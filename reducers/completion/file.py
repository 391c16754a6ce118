"""A completed reducer as the text of a reducer file."""

import json
import shlex
import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from reducers.completion.command import described, words_of
from reducers.completion.complete import NOT_ALONE, Completion, Number, numbers_of
from reducers.completion.given import SUN, Given
from reducers.reducer import Reducer, reducer_of


def text_of(completion: Completion, name: str) -> str:
    """The file; it is read and checked as any other by ``reducers.reducer.reducer_of``."""
    given, title = completion.given, " ".join(name.split())
    lines = [
        f"# {title}: completed from ratio {given.ratio:g},{f' {given.pins} pins,' if given.pins_counted else ''} {given.rated:g} N m rated"
        + (f" and {given.diameter:g} mm outer diameter" if given.diameter is not None else "") + ".",
        '# Every number: value, unit, source. "completed": by a design rule, with the range that the rules leave; "given": known.',
        "# Replace what you measure by value and \"measured\" as source, or complete again with what you know, and all that hangs on it follows:",
        f"#   {shlex.join([*words_of(given), '--name', title])} --known NAME=VALUE",
        "", "[reducer]", f"name = {json.dumps(name)}", f"description = {json.dumps(described(given))}",
        "", "[topology]", "discs = 2", f"cranks = {given.crank_count}" + ("" if given.cranks else "  # completed: three from 1000 N m on (assumed)"),
        f"pins = {given.pins}" + ("" if given.pins_counted else "  # assumed: nobody counted them"), f"lobes = {given.pins - 1}",
        f"rollers = {given.rollers}  # of a bearing; assumed where nobody counted them",
    ]  # fmt: skip
    sections: dict[str, list[str]] = {}
    for number in completion.numbers.values():
        group, _, key = number.name.rpartition(".")
        sections.setdefault(group, ["", f"[{group}]"]).append(f"{key} = {entry(number, given)}")
    lines += [line for section in sections.values() for line in section]
    return "\n".join(lines) + "\n"


def entry(number: Number, given: Given) -> str:
    parts = [f"value = {figure(number.value)}", f"unit = {json.dumps(number.unit)}"]
    note = ""
    if number.name in NOT_ALONE and not number.is_given:
        parts.append(f"range = [{figure(number.value)}, {figure(number.value)}]")
        note = f"  # {not_alone(number, given)}"
    elif number.low < number.high:
        parts.append(f"range = [{figure(number.low)}, {figure(number.high)}]")
    return f"{{ {', '.join([*parts, f'source = {json.dumps(number.source)}'])} }}{note}"


def not_alone(number: Number, given: Given) -> str:
    """What a number may be that moves only with others, and the option that moves them."""
    if number.name == SUN:
        others = [sun for sun in given.suns if number.value < sun <= number.high]
        if not others:
            return "teeth are whole: no other sun of about as many makes the ratio"
        teeth = f"{', '.join(map(str, [int(number.value), *others[:-1]]))} or {others[-1]}"
        return f"may be {teeth}, but not alone, for teeth are whole: complete again with --known {SUN}={others[0]}"
    return (
        f"may be {figure(number.low)} to {figure(number.high)} {number.unit}, but not alone, for races and rollers fit each other:"
        f" complete again with --known {number.name}=...{number.unit}"
    )


def figure(value: float) -> str:
    """Whole digits, always a TOML float."""
    text = repr(float(f"{value:.9g}"))
    return text if any(sign in text for sign in ".en") else f"{text}.0"


def reducer_at(completion: Completion, moved: Mapping[str, float], name: str = "completed") -> Reducer:
    """The reducer that some dials elsewhere than in the middle make, read and checked as any other; without ranges."""
    values = numbers_of(completion.given, {dial.name: dial.value for dial in completion.dials} | dict(moved))
    numbers = {key: replace(number, value=values[key], low=values[key], high=values[key]) for key, number in completion.numbers.items()}
    return reducer_of(tomllib.loads(text_of(replace(completion, numbers=numbers), name)), Path(f"{name}.toml"))
