"""Pages of results as data that the browser draws: cards, sections, tables, figures."""

import re
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

from exports.plain import plain_json
from fmu_src.checked_file import write_text
from fmu_src.unit_words import unit_on_screen
from pages.content import Page, Table
from pages.look import Figure
from pages.render import described
from pages.words import in_print
from workbench.page_words import on_page


def page_data(page: Page) -> dict[str, Any]:
    """The same content as the page's file has, in words of the workbench."""
    return {
        "kind": page.kind, "title": page.title, "conditions": page.conditions, "finding": in_print(on_page(page.finding)),
        "warnings": [in_print(on_page(text)) for text in page.warnings],
        "cards": [in_print(asdict(card) | {"note": on_page(card.note)}) for card in page.cards],
        "sections": [
            {"id": s.id, "title": s.title, "lead": in_print(on_page(s.lead)), "figures": [*map(figure_data, s.figures)], "tables": [*map(table_data, s.tables)]}
            for s in page.sections
        ],
    }  # fmt: skip


def figure_data(figure: Figure) -> dict[str, Any]:
    data = described(figure)
    asks = {"asks": getattr(figure, "asks", ""), "labels": [choice.label for choice in getattr(figure, "choices", [])]}
    return data | asks | {"title": str(figure.title), "caption": str(figure.caption), "aspect": figure.aspect,
                          "keys": [[str(text), colour, dash] for text, colour, dash in figure.keys], "columns": figure.columns}  # fmt: skip


def table_data(table: Table) -> dict[str, Any]:
    rows = in_print([[on_page(cell) for cell in row] for row in table.rows])
    return {"title": table.title, "head": table.head, "rows": rows, "right": list(table.right), "note": table.note,
            "whys": [asdict(w) for w in table.whys], "folded": table.folded}


def write_json(place: Path, content: object) -> None:
    """Whole or not at all; numbers that JSON has no sign for become null."""
    write_text(place, plain_json(content))


@cache
def names() -> re.Pattern[str]:
    """Names of quantities; not where they are part of a longer name or of a key."""
    from discrepancy.campaign.quantities import QUANTITIES

    return re.compile(rf"(?<![\w.])(?:{'|'.join(sorted(QUANTITIES, key=len, reverse=True))})(?!\w)")


def in_words(text: str) -> str:
    """What is told on the way, its effects and signals called as the page calls them elsewhere."""
    from discrepancy.page import amounts

    return names().sub(lambda name: amounts.signal_title(name[0]), amounts.in_words(unit_on_screen(text)))
