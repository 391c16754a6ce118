"""How much a loop depends on where the input is locked: the table of docs/standard_tests.md.

    python3 -m benchmarks.locked_position                   RV20E-121 and BX-40E, 32 positions over a turn of the cranks

``mean`` is that of ``rvwear hysteresis``; ``least`` and ``largest`` are over positions, ``at 0`` is where an FMU begins.
"""

import argparse
import math

import numpy as np

from orchestrator.component import InProcess
from reducers.reducer import load_reducer
from rv_plant.gear_stage import total_ratio
from studies.hysteresis import Hysteresis, hysteresis
from studies.turn import loop_figures

REDUCERS = ("RV20E-121", "BX-40E")
FIGURES = ("lost_motion_arcmin", "loop_width_arcmin", "torsional_stiffness_Nm_per_arcmin")
HEADS = ("lost motion", "width at no torque", "torsional stiffness")


def period(name: str) -> float:
    """Angle of the input [rad] in which the cranks turn once against the carrier."""
    reducer = load_reducer(name)
    first = InProcess("plant", reducer.specification("rv_plant")).number("first_stage_ratio")
    return 2.0 * math.pi * abs(float(total_ratio(first, reducer.topology.pins, reducer.topology.lobes))) / reducer.topology.pins


def loops(name: str, positions: int) -> tuple[Hysteresis, list[Hysteresis]]:
    """The mean, and those at positions evenly over a turn of the cranks against the carrier, the first at 0."""
    reducer, turn = load_reducer(name), period(name)
    return hysteresis(reducer, []), [hysteresis(reducer, [], locked_at=turn * k / positions) for k in range(positions)]


def departure(found: list[Hysteresis]) -> tuple[float, float]:
    """Of the turning at one position from the mean of all, each about its own: root mean square and largest [arcsec]."""
    turning = np.array([loop.turning for loop in found])
    off = turning - turning.mean(axis=0)
    off -= off.mean(axis=1, keepdims=True)
    return 60.0 * float(np.sqrt(np.mean(off**2))), 60.0 * float(np.abs(off).max())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--positions", type=int, default=32)
    options = parser.parse_args()
    print("| | mean | least | largest | at 0 |\n|---|---|---|---|---|")
    off = []
    for name in REDUCERS:
        mean, found = loops(name, options.positions)
        for key, head in zip(FIGURES, HEADS):
            middle = loop_figures(mean)[key]
            shares = np.array([loop_figures(loop)[key] for loop in found]) / middle - 1.0
            unit = "N m/arcmin" if "Nm" in key else "arcmin"
            least, largest, first = (f"{100.0 * share:+.1f} %" for share in (shares.min(), shares.max(), shares[0]))
            print(f"| {name}: {head} | {middle:.3g} {unit} | {least} | {largest} | {first} |")
        off.append("{}: one position departs from the mean by {:.1f} arcsec (root mean square), {:.1f} at most".format(name, *departure(found)))
        off.append(f"{name}: a turn of the cranks against the carrier is {math.degrees(period(name)):.5g} deg of the input")
    print("\n" + "\n".join(off))


if __name__ == "__main__":
    main()
