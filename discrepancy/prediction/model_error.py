"""What the model itself gets wrong in wear: part of what a measurement has to be held against.

Surfaces are resolved in some ninety bins, a life runs through cycles that stand for up to 1,000 h, and a cycle has 72 positions: depths
after thousands of hours are right to some parts in a hundred, alike in all runs (docs/decisions.md).  Such an error is no effect.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.problem import Parameter, Record
from fmu_src.arrays import Floats

QUANTITIES = ("wear_profile", "wear_depth", "mass_loss", "debris_iron")
# Standard deviation of the model's error of a worn surface or mass, over what is worn, and of each of a profile's harmonics.
SIZE, PROFILE_SIZE, HARMONICS = 0.02, 0.02, 2


def place(record: Record) -> str:
    """What has one error in common: a quantity on a surface or of a part."""
    tag = record.tags.get("surface") or record.tags.get("part") or ""
    return f"{record.quantity}:{tag}" if tag else record.quantity


def parameters(records: Sequence[Record]) -> list[Parameter]:
    """One nuisance per quantity and surface, for profiles two more per harmonic of the place on the surface; known beforehand to be small."""
    found: dict[str, Parameter] = {}
    for record in records:
        if record.quantity not in QUANTITIES:
            continue
        for name, size in names(record):
            text = f"error of the base model's {record.quantity.replace('_', ' ')} of {place(record).partition(':')[2] or 'the reducer'}, as a share"
            found.setdefault(name, Parameter(name, "1", 0.0, -0.5, 0.5, size, 0, size, text, of_base=True))
    return list(found.values())


def names(record: Record) -> list[tuple[str, float]]:
    """Parameters that a record shows, with their standard deviations; the order is that of ``columns``."""
    where = place(record)
    whole = [(f"model_error[{where}]", SIZE)]
    if record.quantity != "wear_profile":
        return whole
    return whole + [(f"model_error_{wave}_{k}[{where}]", PROFILE_SIZE) for k in range(1, HARMONICS + 1) for wave in ("cos", "sin")]


def with_error(predicted: Floats, record: Record, values: Mapping[str, float]) -> Floats:
    """The prediction with the model's errors of ``values``."""
    if record.quantity not in QUANTITIES:
        return predicted
    shares = [values.get(name, 0.0) for name, _ in names(record)]
    if not any(shares):
        return predicted
    share: Floats = np.full(len(predicted), 1.0 + shares[0])
    if len(shares) > 1:
        angle = np.asarray(record.axes["depth_angle"], float)
        for k in range(1, HARMONICS + 1):
            share += shares[2 * k - 1] * np.cos(k * angle) + shares[2 * k] * np.sin(k * angle)
    return predicted * share
