"""What is doubted of a campaign's columns and numbers, in words of the page: at the file's row, above numbers and before a verdict, mended by a click."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from discrepancy.campaign.angle_doubts import angle_doubts
from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.mending import TITLES
from discrepancy.campaign.repetition_words import words
from discrepancy.campaign.unplaced import QUESTION, unplaced_in
from discrepancy.doubts.calibrated_doubts import OF_INPUT
from discrepancy.held_names import LOCKED_AT
from discrepancy.page.amounts import with_titles
from discrepancy.repetitions import outlying
from workbench.page_words import on_page

if TYPE_CHECKING:
    from discrepancy.campaign.findings import Finding
    from discrepancy.campaign.model import Campaign

# Findings of numbers that cannot be, or hardly: they stand open above whatever is made of the numbers, all others are a list to be opened.
OF_NUMBERS = ("implausible scale", "impossible torque", "outlying samples", "outlying repetition", "interchanged runs", "rows out of order",
              "loop against the torque", "loop the wrong way round", "angle jumps", "time runs back")  # fmt: skip
# In place of a cell, the view where one goes first; static/to_cell.js knows it by this name.
FIRST = "diagnose"


def as_told(finding: "Finding") -> dict[str, Any]:
    """With the column that it is about and, where a click mends it, the role that the column takes then and that role's title; ``open``: see ``OF_NUMBERS``."""
    of = finding.of
    told = {"level": finding.level, "text": with_titles(finding.text), "remedy": of.remedy(on_page=True) if of and of.role else on_page(finding.remedy),
            "open": finding.code in OF_NUMBERS}  # fmt: skip
    return told | ({"column": of.column, "role": of.role, "title": TITLES.get(of.role, "")} if of else {})


def doubts(campaign: "Campaign") -> list[dict[str, Any]]:
    """Of its angles, as ``as_told``."""
    return [as_told(finding) for finding in angle_doubts(campaign)]


def apart(warnings: Sequence[str], campaign: "Campaign", more: "Sequence[Finding]" = ()) -> tuple[list[dict[str, Any]], list[str]]:
    """What is doubted of angles and numbers, ``more`` among it, and the warnings of a result less those that it tells."""
    found = [*more, *(finding for finding in check_campaign(campaign).findings if finding.of or finding.code in OF_NUMBERS)]
    told = {text for finding in found for text in (finding.sentence, f"{finding.text}; {finding.remedy}")}
    # Of a repetition a result says besides what the model makes of it.
    repetitions = tuple(words(repetition) for repetition in outlying(campaign.records))
    return [as_told(finding) for finding in found], [in_page_words(text) for text in warnings if text not in told and not text.startswith(repetitions)]


def in_page_words(text: str) -> str:
    return on_page(with_titles(text))


def cells_of(warnings: Sequence[str], campaign: "Campaign", diagnosed: bool = True) -> dict[str, list[str]]:
    """By warning in words of the page, as ``apart`` has it, what of In answers it: a condition and the key that it lacks, or the role of a column alone.

    Whose an angle was is asked of a model that was ``diagnosed`` alone: before that an effect may be what is missing, and FIRST leads there.
    """
    found = {}
    for text in warnings:
        if QUESTION in text and (names := unplaced_in(campaign.records)):
            # Those of another condition may be known.
            of = re.match(rf"loops in (.+?): {QUESTION}", text)
            told = of[1].split(", ") if of else names
            found[in_page_words(text)] = [next((name for name in names if name in told), names[0]), LOCKED_AT]
        elif OF_INPUT in text:
            found[in_page_words(text)] = ["angle"] if diagnosed else [FIRST]
    return found
