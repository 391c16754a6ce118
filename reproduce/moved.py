"""What other numbers than the sources' move, and what they leave as it was."""

from collections.abc import Sequence
from dataclasses import replace

from reproduce.claim import Claim
from reproduce.context import Context


def altered(claim: Claim, context: Context, theirs: Claim) -> Claim:
    """A claim that was judged with other numbers, and what these moved in it: beside ``theirs``, the same with the sources' numbers.

    What does not depend on a number is the same to the last digit.
    """
    drawn = [figure.data for figure in theirs.figures]
    return replace(
        # The independent solver had the sources' numbers.
        claim, numbers=[replace(number, audited=None) for number in claim.numbers], altered=context.altered,
        drawn_with=tuple(map(context.altered_in, claim.figures)), numbers_moved=claim.numbers != theirs.numbers,
        figures_moved=tuple(figure.data not in drawn for figure in claim.figures),
    )  # fmt: skip


def unmoved_in(claims: Sequence[Claim], changes: Sequence[str]) -> str:
    """In which claims, and figures of others, nothing hangs on the numbers that were set; empty where something does in each."""
    still = [claim.id for claim in claims if not claim.is_moved]
    still += [f"the figure{'s' if len(claim.figures) > 1 else ''} of {claim.id}" for claim in claims
              if claim.numbers_moved and claim.figures and not any(claim.figures_moved)]  # fmt: skip
    if not still or not changes:
        return ""
    return f"{', '.join(changes)} moved nothing in {', '.join(still)}: numbers and curves there are the same without {'it' if len(changes) == 1 else 'them'}"
