"""``python -m reproduce.wall``: docs/wall.md, every figure of literature and catalogues beside ours; all their claims are computed anew."""

from pathlib import Path

from reproduce.claim import CATALOGUE, LITERATURE, Claim
from reproduce.table import ours_text, range_text, span_text, unit_text

SOURCES = (LITERATURE, CATALOGUE)
PAGE = Path(__file__).resolve().parents[1] / "docs" / "wall.md"
HEAD = """<!-- Made by python -m reproduce.wall: run it instead of editing this page. -->

# Their figures and ours

Every figure of later literature and of catalogues that was found, beside what is computed here: `rvwear reproduce L C` makes them anew, with the numbers
and conditions behind each verdict; [what the sources say](reference/claims.md). *range*: ours over what is not known, each assumed number that matters at
either end of its range, one at a time (`reproduce/unknowns.py`), or parts drawn anew. A dash: nothing here can stand beside it, the cause says why.

| id | figure | ours | range | theirs | unit | verdict | cause |
|---|---|---|---|---|---|---|---|
"""
STATEMENTS = """
## Statements without a figure

| id | claim | verdict | cause |
|---|---|---|---|
"""


def cell(text: str) -> str:
    return text.replace("|", "\\|")


def cause_of(claim: Claim) -> str:
    return f"Condition: {claim.condition}. {claim.why}" if claim.condition else claim.why


def rows_of(claim: Claim) -> list[str]:
    """One Markdown row for each figure of the source; the first says verdict and cause of all."""
    said = [claim.verdict, cell(cause_of(claim))]
    return [
        f"| {' | '.join([claim.id, cell(n.label), ours_text(n), range_text(n), span_text(n.published), unit_text(n), *(said if k == 0 else ('', ''))])} |"
        for k, n in enumerate(claim.held)
    ]


def statement_of(claim: Claim) -> str:
    return f"| {claim.id} | {cell(claim.title)} | {claim.verdict} | {cell(cause_of(claim))} |"


def page_of(claims: list[Claim]) -> str:
    """The whole page as Markdown, of the claims of literature and catalogues among ``claims``."""
    chosen = [claim for claim in claims if claim.source in SOURCES]
    figures = [row for claim in chosen for row in rows_of(claim)]
    statements = [statement_of(claim) for claim in chosen if not claim.held]
    return HEAD + "\n".join(figures) + "\n" + STATEMENTS + "\n".join(statements) + "\n"


if __name__ == "__main__":
    from reproduce.judging import run

    PAGE.write_text(page_of(run(["L", "C"], print)), encoding="utf-8")
