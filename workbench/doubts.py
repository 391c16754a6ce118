"""What is doubted of a campaign's columns, in words of the page: told at the file's row, above the chart and before a verdict, where a click mends it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from discrepancy.campaign.angle_doubts import angle_doubts
from discrepancy.campaign.mending import TITLES

if TYPE_CHECKING:
    from discrepancy.campaign.findings import Finding
    from discrepancy.campaign.model import Campaign


def as_told(finding: "Finding") -> dict[str, Any]:
    """With the column that it is about and, where a click mends it, the role that the column takes then and that role's title."""
    of = finding.of
    told = {"level": finding.level, "text": finding.text, "remedy": of.remedy(on_page=True) if of and of.role else finding.remedy}
    return told | ({"column": of.column, "role": of.role, "title": TITLES.get(of.role, "")} if of else {})


def doubts(campaign: "Campaign") -> list[dict[str, Any]]:
    """Of its angles, as ``as_told``."""
    return [as_told(finding) for finding in angle_doubts(campaign)]


def apart(warnings: Sequence[str], campaign: "Campaign") -> tuple[list[dict[str, Any]], list[str]]:
    """``doubts``, and the warnings of a result less those that they tell."""
    found = angle_doubts(campaign)
    told = {finding.sentence for finding in found}
    return [as_told(finding) for finding in found], [text for text in warnings if text not in told]
