"""Error of worn volumes against the number of communication steps: what the exchange of plant and wear unit converges with.

The pair with Gauss-Seidel and Jacobi at fixed and at controlled steps, each unit alone fed by the recorded signal of
the other, and the unit of both, whose own parts make its error.  Errors are the largest of the four worn volumes against the
finest run of the same scheme; 0.1 s at rated speed, RV20E-121.
"""

from collections.abc import Callable

import numpy as np

from benchmarks.ratios import Curve, Figure, Measured, exponent
from fmu_src.arrays import Floats
from orchestrator.component import InProcess
from orchestrator.master import Master, StepControl
from reducers.reducer import Reducer, load_reducer
from studies.pair import CONNECTIONS

END = 0.1
VOLUMES = ("flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume")
# What a plant without running totals can give.
VALUES = ("crank_angle", "crank_speed", "output_angle", "cage_angle", "mesh_force", "roller_force")
# The package's own steps: 72 a crank turn.
BASE = 78


def pair(reducer: Reducer, steps: int, scheme: str, control: StepControl | None = None) -> Master:
    units = {"plant": InProcess("plant", reducer.specification("rv_plant")), "wear": InProcess("wear", reducer.specification("wear_fmu"))}
    units["plant"].set("largest_crank_step", 1.0)
    master = Master(dict(units), CONNECTIONS, END / steps, scheme=scheme, step_control=control)
    master.initialise()
    master.run(steps)
    return master


def volumes(unit: InProcess) -> Floats:
    return np.array([unit.number(name) for name in VOLUMES])


def worn(master: Master) -> Floats:
    unit = master.components["wear"]
    assert isinstance(unit, InProcess)
    return volumes(unit)


def together(reducer: Reducer, steps: int) -> Floats:
    """Of the unit of both."""
    unit = InProcess("reducer", reducer.specification("rv_reducer"))
    unit.exit_initialisation()
    for i in range(steps):
        unit.step(i * END / steps, END / steps)
    return volumes(unit)


def record(reducer: Reducer, names: tuple[str, ...], sources: tuple[str, ...], finest: int) -> list[dict[str, Floats | float]]:
    """What the wear unit would be given at ``finest`` steps, under its own names."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    plant.exit_initialisation()
    series = []
    for i in range(finest + 1):
        series.append({name: plant.get(source) for name, source in zip(names, sources)})
        if i < finest:
            plant.step(i * END / finest, END / finest)
    return series


def fed(reducer: Reducer, series: list[dict[str, Floats | float]], steps: int) -> Floats:
    """The wear unit alone, given every so many-th point of a recorded signal."""
    unit, stride = InProcess("wear", reducer.specification("wear_fmu")), (len(series) - 1) // steps
    for i, row in enumerate(series[::stride]):
        for name, value in row.items():
            unit.set(name, value)
        if i == 0:
            unit.exit_initialisation()
        else:
            unit.step((i - 1) * END / steps, END / steps)
    return volumes(unit)


def errors(run: Callable[[int], Floats], counts: tuple[int, ...], finest: int) -> list[tuple[float, float]]:
    known = run(finest)
    return [(float(n), float(np.abs(run(n) / known - 1.0).max())) for n in counts]


def controlled(reducer: Reducer, tolerances: tuple[float, ...], finest: int) -> list[tuple[float, float]]:
    """(accepted steps, error) of Gauss-Seidel."""
    known, points = worn(pair(reducer, finest, "gauss-seidel")), []
    for tolerance in tolerances:
        master = pair(reducer, BASE, "gauss-seidel", StepControl(tolerance))
        assert master.controller is not None
        points.append((float(master.controller.accepted), float(np.abs(worn(master) / known - 1.0).max())))
    return points


def measure(quick: bool = False) -> Measured:
    reducer = load_reducer("RV20E-121")
    counts, finest = ((40, 80, 160), 1280) if quick else ((40, 80, 160, 320, 640, 1280, 2560), 10_240)
    of_totals = [pair for pair in CONNECTIONS if pair[0].startswith("plant.")]
    names = tuple(target.partition(".")[2] for _, target in of_totals)
    totals = record(reducer, names, tuple(source.partition(".")[2] for source, _ in of_totals), finest)
    values = record(reducer, (*VALUES, "temperature"), (*VALUES, "reducer_temperature"), finest)
    lines = {
        "Gauss-Seidel": errors(lambda n: worn(pair(reducer, n, "gauss-seidel")), counts, finest),
        "Jacobi": errors(lambda n: worn(pair(reducer, n, "jacobi")), counts, finest),
        "wear unit fed by totals": errors(lambda n: fed(reducer, totals, n), counts, finest),
        "wear unit fed by forces": errors(lambda n: fed(reducer, values, n), counts, finest),
        "unit of both": errors(lambda n: together(reducer, n), counts, finest),
    }
    # The unit of both divides its steps itself: its error stays that of 5 degrees.
    orders = {name: -exponent(points) for name, points in lines.items() if name != "unit of both"}
    tolerances = (1e-2,) if quick else (1e-2, 1e-3, 1e-4, 1e-5)
    lines["Gauss-Seidel, controlled"] = controlled(reducer, tolerances, finest)
    found = Measured(curves=[Curve("error of worn volumes", "communication steps in 0.1 s", "relative error", lines,
                                   {name: -order for name, order in orders.items()})])
    wanted = {"Gauss-Seidel": 1.7, "Jacobi": 0.9, "wear unit fed by totals": 1.7, "wear unit fed by forces": 1.7}
    for name, least in wanted.items():
        found.figures.append(Figure("exchange", f"order of convergence, {name}", orders[name], "1", at_least=least))
    fixed = dict(lines["Gauss-Seidel"])
    for steps, error in lines["Gauss-Seidel, controlled"]:
        at, known = min(fixed.items(), key=lambda point: abs(np.log(point[1] / error)))
        equal = float(at * np.sqrt(known / error))
        found.figures.append(Figure("exchange", f"controlled steps over fixed ones of equal error, {error:.1e}", steps / equal, "1",
                                    at_most=3.0))
    worst = max(error for _, error in lines["unit of both"])
    found.figures.append(Figure("exchange", "error of the unit of both at any step", worst, "1", at_most=2e-3))
    return found
