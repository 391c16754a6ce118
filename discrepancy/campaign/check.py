"""What is missing in a campaign, and which effects it cannot tell apart."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from discrepancy.campaign.design import Design
from discrepancy.campaign.doubts import DOUBTS
from discrepancy.campaign.findings import PROBLEM, SEARCHES, WARNING, Finding
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.pairs import HOLDS_FOR, PAIRS, Verdict, judge


@dataclass(frozen=True)
class Check:
    """The report of a check."""

    campaign: Campaign
    findings: tuple[Finding, ...]
    pairs: tuple[Verdict, ...]
    summary: tuple[dict[str, Any], ...]

    @property
    def problems(self) -> list[Finding]:
        return [finding for finding in self.findings if finding.level == PROBLEM]

    def as_json(self) -> dict[str, Any]:
        return {
            "campaign": self.campaign.name,
            "folder": str(self.campaign.folder),
            "quantities": list(self.summary),
            "problems": [asdict(f) for f in self.findings if f.level == PROBLEM],
            "warnings": [asdict(f) for f in self.findings if f.level == WARNING],
            "pairs_hold_for": HOLDS_FOR,
            "pairs": [
                {"number": v.pair.number, "effects": list(v.pair.effects), "status": v.status,
                 "experiment": v.pair.experiment, "missing": list(v.missing)}
                for v in self.pairs
            ],
        }  # fmt: skip


def check_campaign(campaign: Campaign, more: Sequence[Finding] = ()) -> Check:
    """Judge a loaded campaign; everything is counted on runs that are not held out.  ``more``: what a model finds doubtful."""
    design = Design(campaign)
    findings = [finding for search in (*SEARCHES, *DOUBTS) for finding in search(design)]
    findings += more
    findings.sort(key=lambda finding: finding.level != PROBLEM)
    verdicts = tuple(judge(pair, design) for pair in PAIRS)
    return Check(campaign, tuple(findings), verdicts, tuple(summarise(design, q) for q in campaign.quantities))


def summarise(design: Design, quantity: str) -> dict[str, Any]:
    """One row of the overview."""
    records = design.campaign.of(quantity)
    return {
        "quantity": quantity,
        "runs": len(records),
        "held_out": sum(record.held_out for record in records),
        "conditions": len({record.condition for record in records}),
        "replicates": max(design.replicates(quantity).values(), default=0),
        "values": sum(len(record.values) for record in records),
        **{f: len(design.levels(f, quantity)) for f in ("load", "speed", "temperature", "hours")},
        "directions": len(design.directions(quantity)),
        "mountings": len(design.mountings(quantity)),
    }
