"""Duty cycles: a table of speeds and torques with their shares of the operating time.

    [[segment]]                                   # a robot's move
    speed = { value = 2000, unit = "rpm" }        # of the input
    torque = { value = 167, unit = "N.m" }        # on the output, positive against positive rotation
    share = 0.5

    [[segment]]                                   # and its return, the load hanging the same way
    speed = { value = -2000, unit = "rpm" }
    torque = { value = 167, unit = "N.m" }
    share = 0.5
"""

from dataclasses import dataclass
from pathlib import Path

from pydantic import Field

from fmu_src.faults import InputFault
from fmu_src.reading import read_toml, reading
from fmu_src.strict_file import Strict, validated
from fmu_src.units import UnitError, conversion

REMEDY = "each [[segment]] takes speed and torque as { value, unit } and a share"


class QuantityEntry(Strict):
    value: float
    unit: str


class SegmentEntry(Strict):
    speed: QuantityEntry
    torque: QuantityEntry
    share: float = Field(gt=0.0, le=1.0)


class DutyFile(Strict):
    segment: list[SegmentEntry] = Field(min_length=1)


@dataclass(frozen=True)
class Segment:
    """Input speed [rad/s], output torque [N m], share of the operating time."""

    speed: float
    torque: float
    share: float


def load_duty(path: str | Path) -> tuple[Segment, ...]:
    """Read a duty file; the shares must add up to 1."""
    path = Path(path)
    with reading(path, "a duty file", REMEDY):
        return segments_of(validated(DutyFile, read_toml(path, "duty file", REMEDY), path, REMEDY), path)


def segments_of(content: DutyFile, path: Path) -> tuple[Segment, ...]:
    segments = []
    for number, entry in enumerate(content.segment, 1):
        place = f"{path}: segment {number}"
        speed = quantity(entry.speed, "rad/s", f"{place} speed")
        if speed == 0.0:
            raise InputFault(f"{place}: speed = 0: standing still wears nothing; leave the segment out")
        segments.append(Segment(speed, quantity(entry.torque, "N.m", f"{place} torque"), entry.share))
    total = sum(segment.share for segment in segments)
    if abs(total - 1.0) > 1e-6:
        raise InputFault(f"{path}: the shares add up to {total:g}; they must add up to 1")
    return tuple(segments)


def quantity(entry: QuantityEntry, unit: str, place: str) -> float:
    try:
        factor, _ = conversion(entry.unit, unit)
    except UnitError as problem:
        raise InputFault(f"{place} = {entry.value:g} {entry.unit}: {problem}") from None
    value = factor * entry.value
    if not abs(value) < float("inf"):
        raise InputFault(f"{place} = {entry.value} {entry.unit}: a finite number is needed")
    return value
