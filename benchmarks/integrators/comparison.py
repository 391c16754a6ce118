"""Error against work of all methods on a stretch."""

import math
from collections.abc import Callable
from typing import Any, get_args

from benchmarks.integrators.methods import OURS
from benchmarks.integrators.runs import REFERENCE, Seen, Solver, errors, with_alpha, with_method, with_scipy
from benchmarks.integrators.stretches import Stretch

Row = dict[str, Any]
LEVELS = (3e-2, 1e-2, 3e-3, 1e-3)


def smallest(run: Callable[[], Seen | None], repeats: int) -> Seen | None:
    """A run's result with the smallest time of several."""
    results = [found for _ in range(repeats) if (found := run()) is not None]
    return min(results, key=lambda x: x[2]) if len(results) == repeats else None


def compare(stretch: Stretch, repeats: int) -> list[Row]:
    found = with_scipy(stretch, "Radau", REFERENCE)
    assert found is not None, "no reference"
    reference = found[0]
    rows: list[Row] = []

    def add(name: str, tolerance: float, run: Callable[[], Seen | None], count: int) -> None:
        result = smallest(run, count)
        if result is None:
            rows.append({"method": name, "tolerance": tolerance, "failed": True})
            return
        seen, counts, spent = result
        force, mean, angle = errors(seen, reference)
        rows.append({
            "method": name, "tolerance": tolerance, "force_error": force, "force_error_rms": mean,
            "angle_error_arcsec": angle, "core_ms": 1e3 * spent,
            "real_time_factor": len(stretch.loads) * stretch.step / spent,
            **dict(zip(("assemblies", "factorisations", "steps", "rejected"), (int(x) for x in counts))),
        })

    ladder = (3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4)
    for radius in (0.0, 0.5, 0.8):
        for tolerance in ladder:
            add(f"generalised-alpha {radius:g}", tolerance, lambda: with_alpha(stretch, tolerance, radius), repeats)
    for name, method in OURS.items():
        for tolerance in ladder:
            add(name, tolerance, lambda: with_method(stretch, method, tolerance), repeats)
    for solver in get_args(Solver):
        for tolerance in (1.0, 1e-1, 1e-2, 1e-3):
            add(f"SciPy {solver}", tolerance, lambda: with_scipy(stretch, solver, tolerance), 2)
    return rows


def work_at(rows: list[Row], method: str, error: float) -> float:
    """Assemblies with which a method's force error comes down to ``error`` for good, read in logarithms.

    Where its loosest run suffices, that run's.  Each assembly costs the same in all methods of
    this file and all but a fifth of the time, and counts do not depend on the machine.
    """
    points = sorted((r["assemblies"], r["force_error"]) for r in rows if r["method"] == method and not r.get("failed"))
    k = max([i + 1 for i, (_, e) in enumerate(points) if e > error], default=0)
    if k == len(points):
        return math.nan
    if k == 0:
        return float(points[0][0])
    (n0, e0), (n1, e1) = points[k - 1 : k + 1]
    return float(n0 * (n1 / n0) ** (math.log(e0 / error) / math.log(e0 / e1)))


def show(rows: list[Row]) -> None:
    print(f"    {'method':22}{'tolerance':>10}{'force':>10}{'rms':>10}{'angle':>10}{'ms':>9}{'x real':>8}"
          f"{'assemb.':>9}{'factor.':>9}{'steps':>8}{'reject.':>8}")
    for r in rows:
        if r.get("failed"):
            print(f"    {r['method']:22}{r['tolerance']:10.0e}    failed")
            continue
        print(f"    {r['method']:22}{r['tolerance']:10.0e}{r['force_error']:10.1e}{r['force_error_rms']:10.1e}"
              f"{r['angle_error_arcsec']:10.1e}{r['core_ms']:9.2f}{r['real_time_factor']:8.2f}"
              f"{r['assemblies']:9d}{r['factorisations']:9d}{r['steps']:8d}{r['rejected']:8d}")
    print("    assemblies at a force error of".ljust(36) + "".join(f"{e:>10.1%}" for e in LEVELS))
    for method in dict.fromkeys(r["method"] for r in rows):
        print(f"    {method:32}" + "".join(f"{work_at(rows, method, e):10.0f}" for e in LEVELS))
