"""Reducers completed from catalogue numbers alone, against their full files."""

from reducers.completion.compare import Row, against
from reducers.completion.complete import complete
from reducers.completion.given import Given
from reproduce.claim import CATALOGUE, CONDITIONAL, Finding, Number, held, states
from reproduce.context import BX, RV, Context

SAYS = (
    "Design rules of the field (pin circle by torque, K1, K2, width, first stage inside the ring of pins) fix the parts of a reducer"
    " whose ratio, pins and rated torque a catalogue gives."
)


def held_against(context: Context, name: str, rated: float) -> list[Row]:
    """The completed numbers that test a published rule on this reducer."""
    return [row for row in against(complete(Given(121.0, 40, rated)), context.reducer(name)) if row.tests]


def numbers_of(rows: list[Row]) -> list[Number]:
    """Completed, with its range, beside the full file's."""
    return [held(row.name, row.unit, row.completed, row.in_file, (row.low, row.high)) for row in rows]


def outside(rows: list[Row]) -> set[str]:
    return {row.name for row in rows if not row.inside}


@states("C21", CATALOGUE, "An RV-20E from its catalogue numbers alone", SAYS)
def small(context: Context) -> Finding:
    rows = held_against(context, RV, 167.0)
    return Finding(
        CONDITIONAL, f"{sum(row.inside for row in rows)} of {len(rows)} numbers of the document lie in the completed ranges; its pins are 5 % thinner"
        " than the lower end. Ranges are wide, a fifth to a half of the number to either side: rules fix a reducer of this kind, not this one.",
        numbers_of(rows), [("only the pins' radius lies outside, by less than a tenth", outside(rows) == {"pin.radius"}
                            and all(row.in_file > 0.9 * row.low for row in rows)),
                           ("eight numbers are tested", len(rows) == 8)],
        "for a design, within wide ranges; the pins of this one are thinner than the rule has them",
    )  # fmt: skip


@states("C22", CATALOGUE, "An RV-40E from its catalogue numbers alone", SAYS)
def large(context: Context) -> Finding:
    rows = held_against(context, BX, 412.0)
    return Finding(
        CONDITIONAL, f"{sum(row.inside for row in rows)} of {len(rows)} numbers of the document lie in the completed ranges. What else the file has is"
        " assumed there too and tests nothing. Completed dimensions are 13 to 35 % too large, the width too small: the real ring is small for its torque.",
        numbers_of(rows), [("all lie inside", not outside(rows)), ("four numbers are tested", len(rows) == 4),
                           ("the ring is smaller than the middle of the rule", rows[0].in_file < rows[0].completed)],
        "for a design, within wide ranges",
    )  # fmt: skip
