"""Orders of a real RV reducer over its load: python examples/rv_reducer_te/orders.py CLONE_OR_TABLE [FOLDER]"""

import sys
from pathlib import Path

import numpy as np

from discrepancy.campaign.from_rv_te import measured_in
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.write_rv_te import write_campaign

ARCSEC = np.pi / 648000.0


def main(source: Path, folder: Path) -> None:
    """Writes the campaign into ``folder`` and prints each order's amplitude [arcsec] at least and most load, by sense of rotation."""
    runs, wrong = measured_in(source)
    write_campaign(folder, runs, None, 1600.0, None, 0.2)
    campaign = load_campaign(folder)
    print(f"{folder}: {len(campaign.training)} runs to fit, {len(campaign.held_out)} held out, {len(wrong)} files left out")
    for direction, word in ((1.0, "forward"), (-1.0, "backward")):
        records = sorted((r for r in campaign.training if r.factors["direction"] == direction), key=lambda r: r.factors["load"])
        if not records:
            continue
        least, most = records[0], records[-1]
        print(f"{word}: order, arcsec at {least.factors['load']:.0f} N m, arcsec at {most.factors['load']:.0f} N m")
        for order in np.unique(least.axes["order"]):
            print(f"{order:6g}" + "".join(f"{np.linalg.norm(r.values[r.axes['order'] == order]) / ARCSEC:10.2f}" for r in (least, most)))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) > 2 else Path("rv_reducer_te_campaign"))
