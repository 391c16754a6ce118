"""What a page is made of."""

from dataclasses import dataclass, field

from pages.look import Figure, Layout, Trace


@dataclass(frozen=True)
class Choice:
    """One entry of a figure's selector: an update for each trace, and what changes in the layout."""

    label: str
    traces: list[Trace]
    layout: Layout = field(default_factory=dict)


@dataclass(frozen=True)
class Choosable(Figure):
    """A figure with a selector; it starts with the first choice."""

    asks: str = ""
    choices: list[Choice] = field(default_factory=list)


@dataclass(frozen=True)
class Why:
    """What answers "why?" beside a number: by which ``relation``, from which ``data``, with which ``margin``."""

    relation: str
    data: str
    margin: str


@dataclass(frozen=True)
class Card:
    """One number; ``start`` is given where it came from another one.  ``tone``: good, fair, bad or plain."""

    label: str
    value: str
    note: str = ""
    start: str = ""
    unit: str = ""
    tone: str = "plain"
    why: Why | None = None


@dataclass(frozen=True)
class Table:
    """``right`` numbers the columns with numbers in them; ``whys``, if given, answer for each row; ``folded`` stands where it opens."""

    title: str
    head: list[str]
    rows: list[list[str]]
    right: tuple[int, ...] = ()
    note: str = ""
    whys: list[Why] = field(default_factory=list)
    folded: str = ""


@dataclass(frozen=True)
class Section:
    """Figures, then tables; with neither, the lead says why."""

    id: str
    title: str
    lead: str
    figures: list[Figure] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)


@dataclass(frozen=True)
class Page:
    """``finding`` is the result in a sentence; ``notes_behind`` names the section behind which the warnings stand, in place of before all of them."""

    kind: str
    title: str
    conditions: str
    finding: str
    cards: list[Card]
    sections: list[Section]
    warnings: list[str]
    notes_behind: str = ""

    @property
    def figures(self) -> list[Figure]:
        """Of all sections, in the page's order."""
        return [figure for section in self.sections for figure in section.figures]
