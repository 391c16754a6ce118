"""Scales of numbers that no reducer has: what ``rvwear campaign check`` computes beside what it reads, asked for once a page stands, and kept."""

from typing import Any

from discrepancy.campaign.load import load_campaign
from discrepancy.doubts.plausible import scale_doubts
from fmu_src.faults import InputFault
from workbench.doubts import as_told
from workbench.folder import Folder

KEPT = "scales"


def scales(folder: Folder) -> dict[str, Any]:
    """``findings`` of the campaign as it stands; none where there is none that can be read."""
    stamp = folder.stamp()
    kept = folder.recall(KEPT)
    if kept.get("of") != stamp:
        try:
            found = [as_told(finding) for finding in scale_doubts(load_campaign(folder.root))]
        except InputFault:
            # What cannot be read is said where it is read.
            return {"findings": []}
        kept = {"of": stamp, "findings": found}
        folder.remember(KEPT, kept)
    return {"findings": kept["findings"]}
