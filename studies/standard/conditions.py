"""Which samples of a measured file belong together: unlike conditions are kept apart, positions of one condition are averaged."""

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from fmu_src.units import conversion
from studies.standard.evaluation import FEWEST, Curve, Test

# Columns that tell conditions apart, and their units; "" for words and numbers that count as they stand.
TELLING = {"condition": "", "direction": "", "torque": "N.m", "speed": "rad/s", "temperature": "degC"}
# As labels show them.
SHOWN = {"N.m": "N.m", "rad/s": "rpm", "degC": "degC"}
# Values nearer than this are one level (assumed: a bench holds its set value better): a share of the largest, and degrees.
NEAR, NEAR_DEGREES = 0.05, 2.0
# A level wider than so many of these steps is a ramp.
RAMP = 3.0

Grouped = dict[str, dict[str, Curve]]


def grouped(test: Test, columns: Mapping[str, npt.NDArray[np.generic]], rated: float) -> Grouped:
    """Curves by condition and position.

    ``columns``: (n,) each, those of ``UNITS`` in its units, ``position`` and those of ``TELLING`` beside them; ``rated`` torque [N m].  InputFault
    for a column that is to tell conditions apart and has no steps, and for several loads or speeds of which some have too few samples.
    """
    samples = {name: np.asarray(values, float) for name, values in columns.items() if name not in TELLING and name != "position"}
    count = len(next(iter(samples.values())))
    labels = np.full(count, "", dtype=object)
    for name, unit in TELLING.items():
        if name in columns:
            labels = joined(labels, steps(name, np.asarray(columns[name], float), unit) if unit else words(columns[name]))
    places = words(columns["position"]) if "position" in columns else np.full(count, "", dtype=object)
    if test.own_figures and not any(name in columns for name in TELLING):
        labels, places = places, np.full(count, "", dtype=object)
    found: Grouped = {}
    for label in dict.fromkeys(labels):
        for place in dict.fromkeys(places[labels == label]):
            rows = np.flatnonzero((labels == label) & (places == place))
            for held, part in told_apart(test, {name: values[rows] for name, values in samples.items()}, rated).items():
                found.setdefault(", ".join(filter(None, (label, held))), {})[place] = {name: values[rows][part] for name, values in samples.items()}
    return found


def words(column: npt.NDArray[np.generic]) -> npt.NDArray[np.object_]:
    return np.array([f"{cell:g}" if isinstance(cell, float) else str(cell).strip() for cell in column.tolist()], dtype=object)


def joined(labels: npt.NDArray[np.object_], more: npt.NDArray[np.object_]) -> npt.NDArray[np.object_]:
    return np.array([", ".join(filter(None, pair)) for pair in zip(labels, more)], dtype=object)


def steps(name: str, values: Floats, unit: str) -> npt.NDArray[np.object_]:
    """Labels (n,) of a column that tells conditions apart by its set values."""
    near = NEAR_DEGREES if unit == "degC" else NEAR * float(np.abs(values).max())
    numbers = levels(values, near)
    factor = conversion(unit, SHOWN[unit])[0] if unit != "degC" else 1.0
    labels = np.empty(len(values), dtype=object)
    for number in range(numbers.max() + 1):
        own = values[numbers == number]
        if np.ptp(own) > RAMP * near:
            raise InputFault(f"{name} goes from {factor * own.min():g} to {factor * own.max():g} {SHOWN[unit]} without steps; give a column of its set values")
        labels[numbers == number] = f"{factor * float(np.mean(own)):.4g} {SHOWN[unit]}"
    return labels


def told_apart(test: Test, curve: Curve, rated: float) -> dict[str, npt.NDArray[np.intp]]:
    """Rows of a curve by the loads and speeds that it holds: "" alone where it holds one of each."""
    count = len(next(iter(curve.values())))
    labels = np.full(count, "", dtype=object)
    for name in test.held:
        if name not in curve:
            continue
        torque = name == "output_torque"
        numbers = levels(curve[name], NEAR * (rated if torque else float(np.abs(curve[name]).max())))
        sizes = np.bincount(numbers)
        if np.count_nonzero(sizes >= FEWEST) < 2:
            continue
        unit, shown = ("N.m", "N.m") if torque else ("rad/s", "rpm")
        means = [conversion(unit, shown)[0] * float(np.mean(curve[name][numbers == k])) for k in range(len(sizes))]
        if sizes.min() < FEWEST:
            raise InputFault(
                f"{name} holds several values ({', '.join(f'{mean:.4g}' for mean in means)} {shown}), some in fewer than {FEWEST} samples:"
                " they are not averaged; tell the conditions apart with --column condition=HEADER"
            )
        labels = joined(labels, np.array([f"{means[k]:.4g} {shown}" for k in numbers], dtype=object))
    return {str(label): np.flatnonzero(labels == label) for label in dict.fromkeys(labels)}


def levels(values: Floats, near: float) -> npt.NDArray[np.intp]:
    """Number (n,) of the level that each value belongs to, the lowest 0: a new one begins where none lies within ``near`` below."""
    if not np.isfinite(values).all():
        return np.zeros(len(values), np.intp)
    order = np.argsort(values, kind="stable")
    numbers = np.zeros(len(values), np.intp)
    numbers[order[1:]] = np.cumsum(np.diff(values[order]) > near)
    return numbers
