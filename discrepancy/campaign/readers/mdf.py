"""ASAM MDF 3 and 4, through asammdf.

``time`` is the time of the channels themselves, unless the file has a channel of that name.
"""

from pathlib import Path

import numpy as np
from asammdf import MDF, Signal
from asammdf.blocks.v2_v3_constants import CONVERSION_TYPE_FORMULA
from asammdf.blocks.v4_blocks import ChannelConversion
from asammdf.blocks.v4_constants import CONVERSION_TYPE_ALG

from discrepancy.campaign.readers import Options, ReadFault, aligned, missing_column
from discrepancy.campaign.readers.formula import FormulaFault, computed

TIME = "time"
# Conversions that refer to conversions.
DEEPEST = 10


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
            require_plain_time(file, group)
            # asammdf would run a formula of the file as code.
            signal = file.get(group=group, index=index, raw=True)
            signals[name] = physical(signal, name), signal.timestamps
    if TIME in names and TIME not in signals:
        source = options.align or next(iter(signals), None)
        own = signals[source][1] if source in signals else None
        if own is None:
            raise missing_column(TIME, places)
        signals[TIME] = own, own
    return aligned(signals, options.align)


def physical(signal: Signal, name: str) -> np.ndarray:
    """A signal's samples as its conversion has them."""
    conversion = signal.conversion
    if conversion is None:
        return np.asarray(signal.samples)
    try:
        if is_formula(conversion):
            return computed(conversion.formula, np.asarray(signal.samples))
        if has_formula(conversion, 0):
            raise FormulaFault("its table of conversions holds formulas")
    except FormulaFault as fault:
        raise ReadFault(f"column {name!r}: {fault}; export it with physical values") from None
    return np.asarray(signal.physical().samples)


def is_formula(conversion: ChannelConversion) -> bool:
    """Types 3 of MDF 4 and 10 of MDF 3; some writers leave the text of a formula in conversions of other types."""
    return bool(conversion.conversion_type == (CONVERSION_TYPE_ALG if conversion.id == b"##CC" else CONVERSION_TYPE_FORMULA))


def has_formula(conversion: object, depth: int) -> bool:
    """Whether it, or one that it refers to, is a formula."""
    if not hasattr(conversion, "conversion_type"):
        return False
    if depth > DEEPEST:
        raise FormulaFault("its conversions refer to each other without end")
    inner = getattr(conversion, "referenced_blocks", None) or {}
    return is_formula(conversion) or any(has_formula(block, depth + 1) for block in inner.values())


def require_plain_time(file: MDF, group: int) -> None:
    index = file.masters_db.get(group)
    conversion = None if index is None else file.groups[group].channels[index].conversion
    if conversion is not None and has_formula(conversion, 0):
        raise ReadFault(f"the time of channel group {group} is given by a formula; export it with physical values")


def in_group(file: MDF, index: int, wanted: str | None) -> bool:
    """By number or by the name of the acquisition."""
    # Groups of MDF 3 have no name.
    return wanted is None or wanted in (str(index), getattr(file.groups[index].channel_group, "acq_name", None))


def contents(path: Path) -> dict[str, str]:
    """Channels that stand in one group, with their units; ``time`` if they have their own."""
    with MDF(path) as file:
        masters = set(file.masters_db.items())
        places = {name: [place for place in found if place not in masters] for name, found in file.channels_db.items()}
        alone = {name: found[0] for name, found in places.items() if len(found) == 1}
        found = {name: str(file.groups[group].channels[index].unit or "") for name, (group, index) in alone.items()}
        return ({TIME: "s"} if masters else {}) | found
