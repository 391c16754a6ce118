"""Negative control: flank wear of a milling cutter, to which no effect may be added.

    python examples/milling_wear/milling.py FOLDER        FOLDER holds tool_wear.csv

The machine is no reducer; the statistics are the same.  Base model: wear linear in cycles, level and rate of each
edge free.  Candidates: running-in and a quadratic term.  The last third of the cycles is held out.
Data: GitHub wwz456/QIT-CEMC-dataset, MIT licence.
"""

import csv
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from discrepancy.inference.diagnose import Diagnostician
from discrepancy.problem import Candidate, Parameter, Record

FILE = "tool_wear.csv"
# Columns of the largest flank wear (mm) of the four side edges.
EDGES = (1, 4, 7, 10)
FITTED_SHARE = 2 / 3


def readings(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Cycles (n,) and flank wear [mm] (edges, n); cells that are no numbers are NaN."""

    def number(text: str) -> float:
        try:
            return float(text)
        except ValueError:
            return float("nan")

    with open(folder / FILE, encoding="utf-8-sig", newline="") as file:
        rows = [row for row in csv.reader(file) if row and row[0].strip().isdigit()]
    return np.array([float(row[0]) for row in rows]), np.array([[number(row[c]) for row in rows] for c in EDGES])


class CutterWear:
    """Flank wear of an edge over cycles, as ``problem.Model``."""

    def __init__(self, folder: Path):
        cycles, wear = readings(folder)
        self.span = float(cycles.max())
        last = FITTED_SHARE * self.span
        self.records = [
            Record(f"edge {e + 1} {part}", "flank_wear", "mm", "milling", e + 1, wear[e][rows], {"time": cycles[rows]}, {},
                   mounting=str(e + 1), held_out=part == "late")
            for part, chosen in (("early", cycles <= last), ("late", cycles > last))
            for e in range(len(EDGES)) for rows in [chosen & np.isfinite(wear[e])]
        ]  # fmt: skip
        self.nuisances = tuple(
            Parameter(f"{name}[{e + 1}]", "mm", start, -2.0, 5.0, 0.1, 0, None, text)
            for e in range(len(EDGES))
            for name, start, text in (("level", 0.1, "wear at the start"), ("rate", 0.3, "wear over all cycles"))
        )
        shape = Parameter("run_in_cycles", "1", 10.0, 1.0, 100.0, 10.0)
        self.candidates = (
            Candidate("running_in", "running-in", (Parameter("run_in_wear", "mm", 0.0, 0.0, 2.0, 0.1, 1),), (shape,),
                      ({"run_in_cycles": 5.0}, {"run_in_cycles": 15.0})),
            Candidate("quadratic", "wear that accelerates or slows", (Parameter("curvature", "mm", 0.0, -5.0, 5.0, 0.2),)),
        )  # fmt: skip

    def predict(self, values: Mapping[str, float], which: Sequence[int] | None = None) -> list[np.ndarray]:
        return [self.one(self.records[i], values) for i in (range(len(self.records)) if which is None else which)]

    def one(self, record: Record, values: Mapping[str, float]) -> np.ndarray:
        n = np.asarray(record.axes["time"])
        share = n / self.span
        level, rate = (values.get(f"{name}[{record.mounting}]", start) for name, start in (("level", 0.1), ("rate", 0.3)))
        fast = values.get("run_in_wear", 0.0) * -np.expm1(-n / values.get("run_in_cycles", 10.0))
        return level + rate * share + fast + values.get("curvature", 0.0) * share**2


def errors(model: CutterWear, values: Mapping[str, float]) -> tuple[float, float]:
    """Rms error [mm] on the fitted cycles and on those held out."""
    found = []
    for held_out in (False, True):
        which = [i for i, r in enumerate(model.records) if r.held_out == held_out]
        left = np.concatenate([model.records[i].values - p for i, p in zip(which, model.predict(values, which))])
        found.append(float(np.sqrt(np.mean(left**2))))
    return found[0], found[1]


def outcome(folder: Path) -> dict:
    """Verdict of the diagnosis, and errors (fitted, held out) without an effect and with each candidate."""
    model = CutterWear(folder)
    diagnostician = Diagnostician(model)
    diagnosis = diagnostician.run()
    table = {"none": errors(model, diagnostician.space.base.values)}
    for candidate in model.candidates:
        table[candidate.name] = errors(model, diagnostician.fit([candidate.name]).fit.values)
    return {"verdict": diagnosis.verdict, "effects": [e.name for e in diagnosis.effects], "errors": table}


if __name__ == "__main__":
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / FILE).is_file():
        sys.exit(f"usage: milling.py FOLDER, with {FILE} in it")
    result = outcome(Path(sys.argv[1]))
    print(f"verdict: {result['verdict']}; effects: {', '.join(result['effects']) or 'none'}")
    for name, (fitted, held) in result["errors"].items():
        print(f"{name:12} error on fitted cycles {fitted:.3f} mm, on held-out cycles {held:.3f} mm")
