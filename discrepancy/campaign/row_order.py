"""Rows that were written in another order than that in which they were measured."""

import math

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats

# Of the whole range: a step that is a jump; and how many times the usual step it must be.
JUMP, MANY_STEPS = 0.1, 10.0
# Samples below which nothing is said of their order, and torques that a loop may stop at.
FEW, STAIRS = 16, 6
# What is passed in order.
ORDERED = ("angle", "torque", "order", "depth_angle")


def jumps_of(record: Record) -> dict[str, np.ndarray]:
    """By axis that leaps back and forth the steps that do."""
    found = {name: jumps(np.asarray(record.axes.get(name, np.zeros(0)), float), name) for name in ORDERED}
    return {name: at for name, at in found.items() if len(at)}


def is_shuffled(record: Record, name: str) -> bool:
    """Whether an axis leaps back and forth: which way it runs, and how evenly, says nothing then."""
    return len(jumps(np.asarray(record.axes.get(name, np.zeros(0)), float), name)) > 0


def jumps(axis: Floats, name: str) -> np.ndarray:
    """Steps that leap back and forth; empty for an axis that is passed in order, loops and stairs of torque included."""
    steps, size = np.diff(axis), float(np.ptp(axis)) if len(axis) else 0.0
    if len(axis) < FEW or size == 0.0:
        return np.zeros(0, int)
    lengths = np.abs(steps)
    turned = float(np.mean(steps[1:] * steps[:-1] < 0.0))
    if turned > 0.5 and float(lengths.mean()) > JUMP * size:
        return np.flatnonzero(lengths > JUMP * size)
    at = np.flatnonzero(lengths > max(JUMP * size, MANY_STEPS * float(np.median(lengths))))
    # An encoder that starts anew at each turn is another fault, and a bench may hold a few torques in turn.
    wraps = name == "angle" and abs(float(lengths.max()) - 2.0 * math.pi) < 0.05 * math.pi
    levels = len(np.unique(np.round(axis[at + 1] / (0.02 * size))))
    if len(at) < 3 or wraps or (name == "torque" and levels < STAIRS):
        return np.zeros(0, int)
    back_and_forth = np.mean(steps[at][1:] * steps[at][:-1] < 0.0) >= 0.4
    return at if back_and_forth else np.zeros(0, int)
