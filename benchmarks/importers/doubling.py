"""MasterSim's step doubling on the pair: how many steps a tolerance takes.

It compares a step with two of half its size, over all real outputs.  What the units exchange adds up exactly over steps, so the
difference is of second order and steps grow like the square root of one over the tolerance.
"""

import re
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.importers.cases import Bench
from benchmarks.importers.pair import MASTERSIM_MODES, mastersim_project
from benchmarks.importers.tools import ToolFault, run

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
END = 0.2
FIRST, SHORTEST, LONGEST = 1e-3, 1e-7, 0.05
# With Jacobi MasterSim 0.9.8 puts the units back after a refused step and not its own time: the next step begins where no unit is.
SCHEME = "gauss-seidel"
# A collapse is told by its steps, nobody waits for its end.
MOST_SECONDS = 240.0


@dataclass(frozen=True)
class Doubling:
    """``seconds`` are those of the algorithm and the units; steps that were done again are among ``failures``."""

    tolerance: float
    steps: int
    failures: int
    seconds: float
    said: str = ""


def doubling(bench: Bench, program: Path, tolerance: float) -> Doubling:
    lines = [
        f"tEnd {END!r} s", f"hMax {LONGEST!r} s", f"hMin {SHORTEST!r} s", f"hFallBackLimit {SHORTEST!r} s", f"hStart {FIRST!r} s",
        "adjustStepSize yes", f"absTol {tolerance!r}", f"relTol {tolerance!r}", f"MasterMode {MASTERSIM_MODES[SCHEME]}",
        "ErrorControlMode STEP_DOUBLING", "maxIterations 1", "preventOversteppingOfEndTime yes",
    ]  # fmt: skip
    folder = bench.scratch / f"doubling-{tolerance:g}"
    shutil.rmtree(folder, ignore_errors=True)
    try:
        run([program, "-x", "--verbosity-level=1", mastersim_project(bench, folder, lines)], folder, MOST_SECONDS)
    except ToolFault as fault:
        return Doubling(tolerance, 0, 0, 0.0, str(fault))
    said = (folder / "pair" / "log" / "summary.txt").read_text(encoding="utf-8")
    facts = {name: float(value) for name, value in re.findall(r"^([\w\[\]]+)=(\S+)$", said, re.MULTILINE)}
    seconds = facts["WallClockTime"] - facts["FrameworkTimeWriteOutputs"]
    return Doubling(tolerance, int(facts["MasterAlgorithmSteps"]), int(facts["ErrorTestFails"]), seconds)


def measured(bench: Bench, program: Path) -> list[Doubling]:
    return [doubling(bench, program, tolerance) for tolerance in TOLERANCES]


def growth(found: list[Doubling]) -> float | None:
    """Exponent of the steps in one over the tolerance; 0.5 is the square root.  None from fewer than three runs."""
    points = [(d.tolerance, d.steps) for d in found if not d.said]
    if len(points) < 3:
        return None
    tolerance, steps = np.log(np.array(points)).T
    return float(-np.polyfit(tolerance, steps, 1)[0])
