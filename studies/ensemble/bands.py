"""What an ensemble leaves for pictures: bands of its figures over the hours, and what scatters, in the units that people read."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from fmu_src.display import display_unit
from fmu_src.units import conversion
from studies.ensemble.ensemble_file import NUMBERS, Ensemble, Scatter
from studies.ensemble.figures import FIGURES, Outcome
from studies.figure_units import figure_unit

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
# Points of a band over the hours, near each other where running-in bends it, and digits of their values.
POINTS, DIGITS = 41, 6


def bands(drawn: Ensemble, found: Mapping[int, Outcome], planned: int) -> dict[str, Any]:
    """Quantiles of each figure over common hours, of the lives that stand for the distributions; no panes where there are less than two."""
    from studies.ensemble.sampling import independent_rows

    rows = [found[n] for n in independent_rows(drawn).tolist() if n in found and "fault" not in found[n]]
    hours = drawn.hours * np.linspace(0.0, 1.0, POINTS) ** 2
    panes = []
    for name, meaning in FIGURES.items() if len(rows) > 1 else ():
        curves = np.array([np.interp(hours, life["hours"], life["figures"][name]) for life in rows])
        panes.append({
            "name": name, "title": name.rpartition("_")[0].replace("_", " "), "meaning": meaning, "unit": figure_unit(name), "limit": drawn.limits.get(name),
            "quantiles": [[float(f"{v:.{DIGITS}g}") for v in row] for row in np.quantile(curves, QUANTILES, axis=0)],
        })  # fmt: skip
    counts = {"lives": len(found), "counted": len(rows), "planned": planned}
    return {"hours": [float(f"{hour:.{DIGITS}g}") for hour in hours], "panes": panes, **counts, "shares": list(QUANTILES)}


def scatters(drawn: Ensemble) -> list[dict[str, Any]]:
    """Each parameter that scatters, by the name that files have and as ``parameter`` of the shares, with the numbers of its distribution."""
    return [told(drawn, scatter) for scatter in drawn.scatters]


def told(drawn: Ensemble, scatter: Scatter) -> dict[str, Any]:
    numbers = dict(zip(NUMBERS[scatter.distribution], scatter.numbers))
    variable = next((t.by_name[scatter.name] for t in (drawn.reducer.plant, drawn.reducer.wear) if scatter.name in t.by_name), None)
    if variable is None:
        # A factor of a duty.
        return {"name": scatter.name, "parameter": scatter.name, "distribution": scatter.distribution, "unit": "1", "numbers": numbers}
    unit = display_unit(variable) or variable.unit
    factor, offset = conversion(variable.unit, unit)
    # A deviation is a difference, a factor has no unit.
    own = {key: value if key == "factor" else factor * value + (0.0 if key == "deviation" else offset) for key, value in numbers.items()}
    rounded = {key: float(f"{value:.12g}") for key, value in own.items()}
    return {"name": variable.path, "parameter": scatter.name, "distribution": scatter.distribution, "unit": unit, "numbers": rounded}


def kept(found: dict[str, Any], drawn: Ensemble, lives: Mapping[int, Outcome], planned: int) -> dict[str, Any]:
    """What ``summarise`` found with all that a picture of it needs, as its file has it."""
    return found | {"scatters": scatters(drawn), "bands": bands(drawn, lives, planned)}
