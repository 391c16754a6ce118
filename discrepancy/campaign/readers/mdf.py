"""ASAM MDF 3 and 4, through asammdf.

``time`` is the time of the channels themselves, unless the file has a channel of that name.
"""

from pathlib import Path

import numpy as np
from asammdf import MDF

from discrepancy.campaign.readers import Options, ReadFault, aligned, missing_column

TIME = "time"


def read(path: Path, names: set[str], options: Options) -> dict[str, np.ndarray]:
    with MDF(path) as file:
        # The master channel of a group is its time.
        masters = set(file.masters_db.items())
        places = {
            name: [place for place in found if place not in masters and in_group(file, place[0], options.group)]
            for name, found in file.channels_db.items()
        }
        places = {name: found for name, found in places.items() if found}
        signals: dict[str, tuple[np.ndarray, np.ndarray | None]] = {}
        for name in sorted(names - ({TIME} - places.keys())):
            if name not in places:
                raise missing_column(name, [TIME, *places])
            if len(places[name]) > 1:
                groups = ", ".join(f'"{group}"' for group, _ in places[name])
                raise ReadFault(f"column {name!r} is in several channel groups; state group = one of {groups}")
            group, index = places[name][0]
            signal = file.get(group=group, index=index)
            signals[name] = np.asarray(signal.samples), signal.timestamps
    if TIME in names and TIME not in signals:
        source = options.align or next(iter(signals), None)
        own = signals[source][1] if source in signals else None
        if own is None:
            raise missing_column(TIME, places)
        signals[TIME] = own, own
    return aligned(signals, options.align)


def in_group(file: MDF, index: int, wanted: str | None) -> bool:
    """By number or by the name of the acquisition."""
    # Groups of MDF 3 have no name.
    return wanted is None or wanted in (str(index), getattr(file.groups[index].channel_group, "acq_name", None))
