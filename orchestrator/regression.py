"""A run against reference results: which variable is off, by how much, and where.

A value may differ from its reference by ``relative`` times the largest value that the reference
has in the run, plus ``absolute``.  Each variable is a test case of the JUnit file.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from fmu_src.checked_file import write_text
from fmu_src.faults import InputFault

USUAL_RELATIVE = 1e-6
# Two times are the same if they differ by less than this part of the run.
SAME_TIME = 1e-9


@dataclass(frozen=True)
class Tolerance:
    """For the variables that match ``pattern``."""

    pattern: str
    relative: float
    absolute: float = 0.0


@dataclass(frozen=True)
class Comparison:
    """The worst place of one variable."""

    variable: str
    difference: float
    allowed: float
    time: float
    value: float
    reference: float

    @property
    def passed(self) -> bool:
        # A NaN is no agreement.
        return self.difference <= self.allowed

    def __str__(self) -> str:
        return (
            f"{self.variable} = {self.value:.9g} at time {self.time:.6g} s, the reference has {self.reference:.9g}:"
            f" off by {self.difference:.3g}, allowed {self.allowed:.3g}"
        )


def parse_tolerance(text: str) -> Tolerance:
    """``1e-6``, ``plant.output.lag=1e-6`` or ``wear.*=1e-6,1e-12`` (relative, absolute)."""
    pattern, equals, numbers = text.rpartition("=")
    try:
        values = [float(number) for number in numbers.split(",")]
        tolerance = Tolerance(pattern if equals else "*", *values)
    except (ValueError, TypeError):
        raise InputFault(f"tolerance {text!r}: write 1e-6, plant.output.lag=1e-6 or wear.*=1e-6,1e-12 (relative, absolute)") from None
    if not all(0.0 <= value < math.inf for value in values):
        raise InputFault(f"tolerance {text!r}: finite numbers are needed that are not negative")
    return tolerance


def tolerance_of(variable: str, tolerances: Sequence[Tolerance]) -> Tolerance:
    """The last one that matches: particular ones follow general ones."""
    whole = variable.partition("[")[0]
    for tolerance in reversed(tolerances):
        if tolerance.pattern in (variable, whole) or fnmatchcase(whole, tolerance.pattern):
            return tolerance
    return Tolerance("*", USUAL_RELATIVE)


def compare(
    series: dict[str, np.ndarray], reference: dict[str, np.ndarray], tolerances: Sequence[Tolerance]
) -> list[Comparison]:
    """All variables of the reference, at its times; between two rows the run is taken as straight."""
    time, at = series["time"], reference["time"]
    if len(reference) < 2:
        raise InputFault("the reference holds nothing but the time: nothing can be compared")
    slack = SAME_TIME * max(abs(time[-1]), abs(time[0]))
    if at.min() < time[0] - slack or at.max() > time[-1] + slack:
        raise InputFault(
            f"the reference reaches from {at.min():g} to {at.max():g} s, the run from {time[0]:g} to {time[-1]:g} s:"
            " give --duration, or another reference"
        )
    missing = [name for name in reference if name not in series]
    if missing:
        raise InputFault(f"the run has no {', '.join(missing[:5])}, which the reference holds")
    return [
        compare_one(name, at, np.interp(at, time, series[name]), expected, tolerance_of(name, tolerances))
        for name, expected in reference.items() if name != "time"
    ]  # fmt: skip


def compare_one(name: str, at: np.ndarray, values: np.ndarray, expected: np.ndarray, tolerance: Tolerance) -> Comparison:
    difference = np.abs(values - expected)
    worst = int(np.argmax(np.where(np.isnan(difference), np.inf, difference)))
    allowed = tolerance.relative * float(np.abs(expected).max()) + tolerance.absolute
    return Comparison(name, float(difference[worst]), allowed, float(at[worst]), float(values[worst]), float(expected[worst]))


def write_junit(comparisons: Sequence[Comparison], suite: str, seconds: float, warnings: Sequence[str], path: Path) -> None:
    """JUnit XML as CI servers read it: one test case per variable."""
    failed = [c for c in comparisons if not c.passed]
    counts = {"tests": str(len(comparisons)), "failures": str(len(failed)), "errors": "0"}
    root = ElementTree.Element("testsuites", counts)
    element = ElementTree.SubElement(root, "testsuite", {"name": suite, "time": f"{seconds:.3f}", "skipped": "0"} | counts)
    for comparison in comparisons:
        case = ElementTree.SubElement(element, "testcase", classname=suite, name=comparison.variable, time="0")
        if not comparison.passed:
            ElementTree.SubElement(case, "failure", message=str(comparison), type="difference").text = str(comparison)
    if warnings:
        ElementTree.SubElement(element, "system-err").text = "\n".join(warnings)
    ElementTree.indent(root)
    write_text(path, '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(root, "unicode"))
