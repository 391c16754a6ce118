"""The HTML page of the catalogue: one file with everything inside, one picture per effect."""

from pathlib import Path

from discrepancy.catalogue.catalogue import Entry
from discrepancy.catalogue.signature import IDEAL, Signature, words
from pages.look import Figure
from pages.render import rendered

TEMPLATE = Path(__file__).with_name("catalogue.html")


def page_of(effects: list[tuple[Entry, list[Signature], Figure]], reducer: str) -> str:
    """The whole page as HTML, with the figures of a reducer; equal content gives equal bytes."""
    return rendered(TEMPLATE, [figure for _, _, figure in effects], effects=effects, words=words, reducer=reducer, ideal=reducer == IDEAL)
