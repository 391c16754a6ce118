"""From what the file states to the records' SI numbers: units, the reducer's ratio, shares of the rated torque."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from discrepancy.campaign.amount import amount, split, to_si
from discrepancy.campaign.file_format import Head
from discrepancy.campaign.quantities import FACTOR_KEYS, Key
from fmu_src.faults import InputFault
from reducers.reducer import Reducer, load_reducer
from rv_plant.gear_stage import total_ratio


@dataclass(frozen=True)
class Scales:
    """The reducer's part in the conversions; None where neither reducer nor campaign states it."""

    reducer: Reducer | None
    ratio: float | None
    rated_torque: float | None

    def conversion(self, key: Key, unit: str, place: str) -> tuple[float, float]:
        """(factor, offset) from a number stated under ``key`` in ``unit`` to the record's."""
        if key.name == "load" and unit.strip() in ("%", "percent"):
            if self.rated_torque is None:
                raise InputFault(
                    f"{place}: a share of the rated torque needs one: state [campaign] reducer or rated_torque,"
                    " or give the load in N.m"
                )
            return 0.01 * self.rated_torque, 0.0
        factor, offset = to_si(unit, key.unit, place)
        if key.per_ratio:
            if self.ratio is None:
                raise InputFault(f"{place}: {key.key} needs the ratio: state [campaign] reducer or ratio")
            scale = self.ratio**key.per_ratio
            factor, offset = scale * factor, scale * offset
        return factor, offset

    def number(self, key: Key, given: object, place: str) -> float:
        """One stated number; checked against what physics allows."""
        example_unit = key.example.split()[-1]
        number, unit = split(given, example_unit, place)
        factor, offset = self.conversion(key, unit, f"{place} = {number:g} {unit}")
        value = factor * number + offset
        if not abs(value) < float("inf") or (key.minimum is not None and value < key.minimum):
            lowest = f" from {key.minimum:g} {key.unit} on" if key.minimum is not None else ""
            hint = '; a sense of rotation is stated by direction = "reverse"' if key.name == "speed" else ""
            raise InputFault(f"{place} = {number:g} {unit}: a finite number{lowest} is needed{hint}")
        return value

    def factors(self, stated: Mapping[str, object], place: str) -> dict[str, float]:
        """The factors that a condition or a run states, by name."""
        found: dict[str, float] = {}
        for name, given in stated.items():
            if name not in FACTOR_KEYS:
                raise InputFault(
                    f"{place}.{name} = {given!r} is not a number of a condition; possible: {', '.join(FACTOR_KEYS)}"
                )
            key = FACTOR_KEYS[name]
            if key.name in found:
                raise InputFault(
                    f"{place}.{name} = {given!r}: the {key.name} is given twice, at input and output; keep one"
                )
            found[key.name] = self.number(key, given, f"{place}.{name}")
        return found


def make_scales(head: Head, folder: Path, path: Path) -> Scales:
    """Of the campaign's reducer, unless the file states ratio or torque itself."""
    reducer = None
    if head.reducer is not None:
        try:
            reducer = load_reducer(folder / head.reducer if head.reducer.endswith(".toml") else head.reducer)
        except InputFault as problem:
            raise InputFault(f"{path}: campaign.reducer = {head.reducer!r}: {problem}") from None
    ratio, torque = head.ratio, None
    if reducer is not None and ratio is None:
        # Without a first stage input and output turn opposite ways; records refer all signs to the output.
        topology = reducer.topology
        first_stage = reducer.plant.by_name["first_stage_ratio"].start
        ratio = abs(total_ratio(float(first_stage), topology.pins, topology.lobes))
    if head.rated_torque is not None:
        torque = amount(head.rated_torque, "N.m", f"{path}: campaign.rated_torque")
        if not torque > 0.0:
            raise InputFault(f"{path}: campaign.rated_torque = {torque:g} N.m: must be positive")
    elif reducer is not None:
        torque = reducer.starts.get("load_torque")
    return Scales(reducer, ratio, torque)
