"""The page: all claims put into the template."""

from collections.abc import Sequence
from pathlib import Path

from pages.render import rendered, written
from pages.words import counted
from reproduce.claim import CONDITIONAL, CONTRADICTED, FALLEN, NOT_TESTABLE, REPRODUCED, SOURCES, Claim, counts_of
from reproduce.table import audited_text, off_text, ours_text, range_text, span_text, unit_text, value_text

TEMPLATE = Path(__file__).with_name("claims.html")
TONES = {REPRODUCED: "good", CONDITIONAL: "fair", CONTRADICTED: "bad", NOT_TESTABLE: "open", FALLEN: "plain"}


def page_of(claims: list[Claim], changes: Sequence[str] = (), still: str = "") -> str:
    """The whole page as HTML; equal claims give equal bytes.  ``still``: what the changes did not move, in words."""
    groups = [(source, [c for c in claims if c.source == source]) for source in SOURCES]
    numbers = [n for c in claims for n in c.numbers if n.agrees is not None]
    return rendered(
        TEMPLATE, [figure for claim in claims for figure in claim.figures],
        groups=[(source, found) for source, found in groups if found], tones=TONES, number=value_text, audited=audited_text,
        ours=ours_text, off=off_text, range=range_text, span=span_text, unit=unit_text, held=[(c, n) for c in claims for n in c.held],
        counts=[(v, TONES[v], count) for v, count in counts_of(claims).items()], total=counted(len(claims), "claim"),
        changes=changes, still=still, confirmed=sum(n.agrees is True for n in numbers), compared=len(numbers), fallen=[c for c in claims if not c.stands],
        discrepancies=[(c, n) for c in claims for n in c.discrepancies],
    )  # fmt: skip


def write_page(claims: list[Claim], path: Path, changes: Sequence[str] = (), still: str = "") -> Path:
    """Write the claims as one HTML file that opens offline."""
    return written(page_of(claims, changes, still), path)
