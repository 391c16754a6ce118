"""What an answer is worth that names nothing, as a section of its page."""

from discrepancy.page import amounts
from discrepancy.words.would_show import HEAD, WouldShow, rows
from pages.content import Section, Table
from pages.words import capital

# Times their usual size up to which effects are seen so easily that they stand folded.
EASIER = 0.5


def section(found: WouldShow) -> Section:
    """From which size on effects would have been seen, and what the runs cannot show whatever it is."""
    lead = "From which size on each effect is seen in 95 of 100 campaigns like this one, beside the size that it usually has."
    lead += "".join(f" {capital(text)}." for text in found.named)
    tables = []
    hard, easier = rows([v for v in found.hard if not v.times <= EASIER]), rows([v for v in found.hard if v.times <= EASIER])
    if hard:
        tables.append(Table("Hardest to see", list(HEAD), hard, (2, 3)))
    if easier:
        tables.append(Table("", list(HEAD), easier, (2, 3), folded=f"{len(easier)} more, seen from a tenth to a half of their usual size"))
    if found.lacking:
        lacking = [[capital(amounts.in_words(plain(f.text))), capital(amounts.in_words(f.remedy))] for f in found.lacking]
        tables.append(Table("What these runs cannot show, whatever it is", ["cannot show", "what would"], lacking))
    return Section("would_show", "What would have been seen", lead, [], tables)


def plain(text: str) -> str:
    """A finding with the words of the quantities that it begins with."""
    quantities, colon, rest = text.partition(":")
    return amounts.signal_title(quantities) + colon + rest
