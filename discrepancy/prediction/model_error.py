"""What the model itself gets wrong: part of what a measurement has to be held against.

Surfaces are resolved in some ninety bins, a life runs through cycles that stand for up to 1,000 h, and a cycle has 72 positions: depths
after thousands of hours are right to some parts in a hundred, most of it alike in all runs (docs/decisions.md).  A loop is the mean from some positions of the
cranks, where its output's play differs, and a rig may have it from others.  Such an error is no effect.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.problem import Parameter, Record, is_loop
from fmu_src.arrays import Floats

QUANTITIES = ("wear_profile", "wear_depth", "mass_loss", "debris_iron")
# Standard deviation of the model's error of a worn surface or mass, over what is worn, and of each of a profile's harmonics.
SIZE, PROFILE_SIZE, HARMONICS = 0.02, 0.02, 2
# That of loops, in times ``curves.loop_error``.
LOOPS = "model_error[hysteresis]"
# By how much that differs from one condition to another: changes by a law of wear err by 1 to 3 % of the change (assumed).
APART = 0.01


def place(record: Record) -> str:
    """What has one error in common: a quantity on a surface or of a part."""
    tag = record.tags.get("surface") or record.tags.get("part") or ""
    return f"{record.quantity}:{tag}" if tag else record.quantity


def is_error(name: str) -> bool:
    """Whether a value is one of these errors, and nothing that a reducer knows of."""
    return name.startswith("model_error")


def parameters(records: Sequence[Record]) -> list[Parameter]:
    """Nuisances known beforehand to be small: one of all loops; in wear one per quantity and surface, for profiles two more per harmonic of the
    place on the surface, and one per condition where there are several."""
    found: dict[str, Parameter] = {}
    if any(map(is_loop, records)):
        text = "error of the base model's loops, in times what every other position of the cranks makes of them"
        found[LOOPS] = Parameter(LOOPS, "1", 0.0, -10.0, 10.0, 1.0, 0, 1.0, text, of_base=True)
    worn = [r for r in records if r.quantity in QUANTITIES]
    conditions: dict[str, set[str]] = {}
    for record in worn:
        conditions.setdefault(place(record), set()).add(record.condition)
    for record in worn:
        apart = [(apart_name(record), APART)] if len(conditions[place(record)]) > 1 else []
        for name, size in names(record) + apart:
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


def apart_name(record: Record) -> str:
    """The parameter of a condition's own error."""
    return f"model_error_at[{place(record)}, {record.condition}]"


def with_error(predicted: Floats, record: Record, values: Mapping[str, float]) -> Floats:
    """The prediction with the model's errors of ``values``."""
    if record.quantity not in QUANTITIES:
        return predicted
    shares = [values.get(name, 0.0) for name, _ in names(record)]
    whole = shares[0] + values.get(apart_name(record), 0.0)
    share: Floats = np.full(len(predicted), 1.0 + whole)
    if len(shares) > 1:
        angle = np.asarray(record.axes["depth_angle"], float)
        for k in range(1, HARMONICS + 1):
            share += shares[2 * k - 1] * np.cos(k * angle) + shares[2 * k] * np.sin(k * angle)
    return predicted * share
