"""What an answer is worth that names nothing, as a section of its page."""

from discrepancy.page import amounts
from discrepancy.words.would_show import HEAD, WouldShow, rows
from fmu_src.effect_words import effects_words
from pages.content import Section, Table
from pages.words import capital


def section(found: WouldShow) -> Section:
    """From which size on effects would have been seen, and what the runs cannot show whatever it is."""
    lead = f"{capital(amounts.in_words(found.sentence))}. A size is the one that is seen in 95 of 100 campaigns like this one."
    if found.easy:
        lead += f" Seen at a tenth of its usual size: {effects_words(found.easy)}."
    if found.silent:
        lead += f" Changing nothing here, whatever their size: {effects_words(found.silent)}."
    tables = []
    if found.hard:
        tables.append(Table("Hardest to see", list(HEAD), rows(found.hard), (2, 3)))
    if found.lacking:
        lacking = [[capital(amounts.in_words(plain(f.text))), capital(amounts.in_words(f.remedy))] for f in found.lacking]
        tables.append(Table("What these runs cannot show, whatever it is", ["cannot show", "what would"], lacking))
    return Section("would_show", "What would have been seen", lead, [], tables)


def plain(text: str) -> str:
    """A finding with the words of the quantities that it begins with."""
    quantities, colon, rest = text.partition(":")
    return quantities.replace("_", " ") + colon + rest
