"""The page of a reducer file that was checked: the parts to scale, and every number with where it is from."""

from collections.abc import Sequence

from pages.content import Card, Page, Section, Table
from pages.look import Figure
from pages.words import capital
from reducers.checking import STATED, Check, Stated
from reducers.completion.again import given_again
from studies.catalogue_targets import Target
from studies.report.not_made import drawings
from studies.report.target_card import target_card


def parts(found: Check) -> list[Figure]:
    """The whole and its most loaded tooth, or where it cannot be made."""
    return drawn(found)[0]


def drawn(found: Check) -> tuple[list[Figure], str]:
    """Also what keeps its forces from being drawn, if anything does.  A completed file tells its housing by the ring that follows from it."""
    given = given_again(found.reducer)
    return drawings(found.reducer, found.place if found.faults else None, given.diameter if given else None)


def page_of(found: Check, targets: Sequence[Target] = ()) -> Page:
    """``targets``: what the file was made for."""
    t, filled = found.reducer.topology, [n for n in found.numbers if n.kind != STATED]
    cards = [
        Card("ratio", f"{found.figures['ratio']:.4g}"), Card("K1 = e z_p / R_p", f"{found.figures['K1']:.3f}", "below 1; 0.65 to 0.9 is usual"),
        Card("largest radius of pins", f"{found.figures['largest_pin_mm']:.4g}", "without undercut", unit="mm"),
        Card("filled in", str(len(filled)), f"of {len(found.numbers)} numbers"), *map(target_card, targets),
    ]  # fmt: skip
    figures, without = drawn(found)
    sections = [
        Section("parts", "Parts", "Drawn from the file, with the forces at its torque." if not found.faults else found.faults[0], figures),
        Section("numbers", "Numbers", "What follows from other numbers is reckoned at each reading; what is usual may be stated better.", tables=[
            table("Not stated", [n for n in found.numbers if n.kind != STATED]), table("Stated", [n for n in found.numbers if n.kind == STATED]),
        ]),
    ]  # fmt: skip
    counts = f"{t.discs} discs, {t.cranks} cranks, {t.pins} pins, {t.lobes} lobes"
    return Page("reducer file", found.reducer.name, counts, f"{capital(found.outcome)}.", cards, sections, [*found.doubts, *filter(None, [without])])


def table(title: str, numbers: list[Stated]) -> Table:
    rows = [
        [n.name, f"{n.value:.5g}", n.unit, f"{n.low:.4g} to {n.high:.4g}" if n.low is not None and n.high is not None else "", n.source] for n in numbers
    ]
    return Table(title, ["number", "value", "unit", "range", "from"], rows, (1, 3))
