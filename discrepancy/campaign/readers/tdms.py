"""TDMS of LabVIEW, through nptdms.

A column is a channel's name, or ``group/channel`` where several groups have it.  ``time`` is
the time of the channels' waveform, unless the file has a channel of that name.
"""

from pathlib import Path

import numpy as np
from nptdms import TdmsChannel, TdmsFile

from discrepancy.campaign.readers import Options, ReadFault, aligned, missing_column

TIME = "time"


def read(path: Path, names: set[str], options: Options) -> dict[str, np.ndarray]:
    with TdmsFile.open(path) as file:
        channels = {
            (group.name, channel.name): channel
            for group in file.groups()
            if options.group in (None, group.name)
            for channel in group.channels()
        }
        if not channels:
            groups = ", ".join(group.name for group in file.groups()) or "none"
            wanted = f"group = {options.group!r}" if options.group else "not readable as tdms"
            raise ReadFault(f"{wanted}: no channels there; the groups are {groups}")
        signals = {}
        for name in sorted(names):
            group, slash, own = name.rpartition("/")
            found = [c for key, c in channels.items() if key[1] == name or (slash and key == (group, own))]
            if len(found) > 1:
                raise ReadFault(f"column {name!r} is in several groups; write group/{name}, or state group = ...")
            if found:
                signals[name] = found[0][:], own_time(found[0])
            elif name != TIME:
                raise missing_column(name, [f"{g}/{c}" for g, c in channels])
    if TIME in names and TIME not in signals:
        timed = {n: t for n, (_, t) in signals.items() if t is not None}
        source = options.align or next(iter(timed), None)
        if source not in timed:
            raise ReadFault("column 'time': no channel of that name, and the channels of this run carry no waveform time")
        signals[TIME] = timed[source], timed[source]
    return aligned(signals, options.align)


def own_time(channel: TdmsChannel) -> np.ndarray | None:
    """Time of a waveform channel; None for plain columns of numbers."""
    track: np.ndarray | None = channel.time_track() if "wf_increment" in channel.properties else None
    return track


def contents(path: Path) -> dict[str, str]:
    """Channels, by ``group/channel`` where several groups have the name, with their units; ``time`` if they have their own."""
    with TdmsFile.open(path) as file:
        channels = [(group.name, channel) for group in file.groups() for channel in group.channels()]
        names = [channel.name for _, channel in channels]
        timed = {TIME: "s"} if any("wf_increment" in channel.properties for _, channel in channels) else {}
        return timed | {
            channel.name if names.count(channel.name) == 1 else f"{group}/{channel.name}": str(channel.properties.get("unit_string", ""))
            for group, channel in channels
        }
