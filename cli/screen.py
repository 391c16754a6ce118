"""Results on the screen."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from exports.plain import plain_json
from fmu_src.unit_words import unit_on_screen
from studies.figure_units import WHICH_ERROR, figure_unit

# Wide enough for all tables, also where the output goes to a file.
WIDTH = 100


class Screen(Console):
    """Whatever is printed has units as the screen has them."""

    def render_str(self, text: str, **options: Any) -> Text:
        return super().render_str(unit_on_screen(text), **options)


def console(width: int = 0) -> Screen:
    """Prints texts as they are: ``[disc=1]`` of a signal's name is no markup, ``:gear:`` no picture.

    ``width``: the least, where the output goes to a file too; what is to stand out is made by ``styled``.
    """
    return Screen(width=max(Console().width, width), markup=False, highlight=False, emoji=False)


def styled(*parts: str | tuple[str, str]) -> Text:
    """A line of texts; those with a style are given with it."""
    return Text.assemble(*(unit_on_screen(part) if isinstance(part, str) else (unit_on_screen(part[0]), part[1]) for part in parts))


# Columns of the line that a table takes beside those of each of its columns: a dense one, edges included, and one with lines, which takes EDGE more.
BETWEEN, BETWEEN_LINES, EDGE = 2, 3, 1


def dense(title: str) -> Table:
    """A table of many columns, without lines between them; words that are too long for theirs go on below."""
    return Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False, collapse_padding=True)


def json_text(content: Mapping[str, object]) -> None:
    """NaN and infinity are not JSON: they become null."""
    print(plain_json(content, indent=1))


def figures(title: str, values: Mapping[str, object], units: Mapping[str, str] = MappingProxyType({}), how: str = "") -> None:
    """What, how much, and the unit: that of ``units``, or what the name ends in; below it ``how`` a figure is read that others read otherwise."""
    table = Table(title=title, title_justify="left", caption=how or None, caption_justify="left")
    table.add_column("figure")
    table.add_column("value", justify="right")
    table.add_column("unit")
    for name, value in values.items():
        text = f"{value:.6g}" if isinstance(value, float) else str(value)
        unit = units.get(name) or figure_unit(name)
        which = f"\n  {WHICH_ERROR[name]}" if name in WHICH_ERROR else ""
        table.add_row(f"{name}{which}", text, "" if unit == "1" else unit)
    console().print(table)
