"""Prototypes as the literature has them: part errors by tolerance, transmission error and lost motion of a reducer with them."""

from collections.abc import Sequence

import numpy as np

from fmu_src.arrays import Floats
from orchestrator.settings import Setting, parse_setting
from reducers.reducer import Reducer
from studies.hysteresis import Hysteresis, hysteresis
from studies.pair import make_pair
from studies.solve import ARCSEC, record_turn

# Standard deviations of good parts (assumed): throw of an eccentric and places of holes and pins [m], phase of an eccentric [rad].
THROW, PLACE, PHASE = 1.5e-6, 2e-6, 2e-4
POSITIONS = 12


def settings_of(reducer: Reducer, texts: Sequence[str]) -> list[Setting]:
    return [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]


def part_errors(reducer: Reducer, seed: int, times: float = 1.0) -> list[str]:
    """Normally distributed errors of lobes, holes and pins, ``times`` those of good parts."""
    random = np.random.default_rng(seed)
    texts = []
    for d in range(reducer.topology.discs):
        for c in range(reducer.topology.cranks):
            for name, size in (("crank.eccentricity", THROW), ("crank.phase", PHASE), ("disc_hole.tangential", PLACE), ("disc_hole.radial", PLACE)):
                texts.append(f"errors.{name}[{d + 1},{c + 1}]={random.normal(0.0, times * size)!r}")
    for j in range(reducer.topology.pins):
        for way in ("radial", "tangential"):
            texts.append(f"errors.pin.{way}[{j + 1}]={random.normal(0.0, times * PLACE)!r}")
    return texts


def transmission_error(reducer: Reducer, texts: Sequence[str] = (), positions: int = POSITIONS) -> Floats:
    """Over one turn of the output [arcsec]."""
    pair = make_pair(reducer, settings_of(reducer, texts), positions=positions)
    pair.wear.set("acceleration", 0.0)
    return ARCSEC * record_turn(pair, positions * reducer.topology.lobes)["transmission_error"].ravel()


def peak_to_peak(reducer: Reducer, texts: Sequence[str] = ()) -> float:
    return float(np.ptp(transmission_error(reducer, texts)))


def span(reducer: Reducer, times: float, seeds: Sequence[int] = (0, 1, 2, 3)) -> tuple[float, float]:
    """(least, largest) peak to peak of some reducers made of such parts [arcsec]."""
    found = [peak_to_peak(reducer, part_errors(reducer, seed, times)) for seed in seeds]
    return min(found), max(found)


def loop(reducer: Reducer, *texts: str) -> Hysteresis:
    """The stiffness test, as the command makes it."""
    return hysteresis(reducer, settings_of(reducer, texts))
