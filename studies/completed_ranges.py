"""Which of the ranges of a completed reducer matter for which signal: every dial to both ends of its range, the bench run at each.

Part errors belong to no reducer file; so that orders of the transmission error have something to show, one throw and the ring of pins
are off by usual amounts (assumed) in all of them alike.
"""

import math
from collections.abc import Callable, Container
from dataclasses import dataclass

import numpy as np

from fmu_src.faults import InputFault, RunFault
from orchestrator.settings import Setting, parse_setting
from reducers.completion.complete import Completion
from reducers.completion.file import reducer_at
from reducers.reducer import Reducer
from studies.hysteresis import hysteresis
from studies.meshing_cycle import run_cycle
from studies.modes import FLOATING, modes
from studies.pair import make_pair
from studies.solve import ARCSEC, record_turn
from studies.standard.evaluation import read_efficiency, read_no_load_torque
from studies.standard.procedures import rated_of, ratio_of, run
from studies.wear_figures import wear_figures

# Equilibria per crank turn; orders of the output up to half of it times the lobes are seen.
POSITIONS = 48
THROW_ERROR, RING_ERROR = 3e-6, 5e-6
HOURS, JUMPS = 1000.0, 4
# Of the natural frequencies so many, the lowest: a bench's sensors see those of the whole train.
FREQUENCIES = 2
# What moves a signal by less than this share of it is no reason to measure anything (assumed).
SMALL = 0.02


@dataclass(frozen=True)
class Influence:
    """A signal in its unit, in the middle and with one dial at either end of its range; NaN where such a reducer cannot be computed."""

    dial: str
    signal: str
    low: float
    middle: float
    high: float

    @property
    def share(self) -> float:
        """Half of what lies between the signal's ends, over the signal in the middle; 0 where nothing is known."""
        known = [value for value in (self.low, self.middle, self.high) if math.isfinite(value)]
        return 0.5 * (max(known) - min(known)) / abs(self.middle) if self.middle else 0.0


def influences(completion: Completion, dials: Container[str] | None = None, advance: Callable[[], None] = lambda: None) -> list[Influence]:
    """One for each dial (of some names) and signal, the strongest first within a signal; ``advance`` is called after each bench."""
    moving = {dial for number in completion.numbers.values() for dial in number.dials}
    middle = signals_of(reducer_at(completion, {}))
    advance()
    found = []
    for dial in completion.dials:
        if dial.name not in moving or (dials is not None and dial.name not in dials):
            continue
        ends = []
        for end in (dial.low, dial.high):
            try:
                ends.append(signals_of(reducer_at(completion, {dial.name: end})))
            except (InputFault, RunFault):
                ends.append(dict.fromkeys(middle, math.nan))
            advance()
        found += [Influence(dial.name, signal, ends[0].get(signal, math.nan), value, ends[1].get(signal, math.nan)) for signal, value in middle.items()]
    order = list(middle)
    return sorted(found, key=lambda one: (order.index(one.signal), -one.share))


def signals_of(reducer: Reducer) -> dict[str, float]:
    """What a bench would show of new parts, and wear after ``HOURS``; names with units.

    Efficiency at rated torque and speed, no-load torque at the input at rated speed; the lowest frequencies, at rated torque with the input held.
    """
    loop = hysteresis(reducer, [])
    lobes, pins = reducer.topology.lobes, reducer.topology.pins
    pair = make_pair(reducer, part_errors(reducer), positions=POSITIONS)
    pair.wear.set("acceleration", 0.0)
    turn = record_turn(pair, POSITIONS * lobes)["transmission_error"].ravel() * ARCSEC
    spectrum = 2.0 * np.abs(np.fft.rfft(turn)) / turn.size
    torque, speed = rated_of(reducer, [])
    ratio = ratio_of(reducer, [])
    loaded, unloaded = (run(reducer, [], 1.0, load, speed) for load in (torque, 0.0))
    sounds = [mode.frequency_Hz for mode in modes(reducer, []) if mode.frequency_Hz >= FLOATING][:FREQUENCIES]
    worn = make_pair(reducer)
    for _ in range(JUMPS):
        run_cycle(worn, HOURS / JUMPS)
    depths = wear_figures(worn.wear.record())
    return {
        "torsional_stiffness_Nm_per_arcmin": loop.stiffness_Nm_per_arcmin,
        "lost_motion_arcmin": loop.lost_motion_arcmin,
        **{f"transmission_error_order_{order}_arcsec": float(spectrum[order]) for order in (pins, 2 * lobes, 2 * pins)},
        "efficiency_percent": read_efficiency(loaded, torque, ratio)["efficiency"][0],
        "no_load_torque_Nm": read_no_load_torque(unloaded, torque, ratio)["no_load_torque"][0],
        **{f"natural_frequency_{k + 1}_Hz": frequency for k, frequency in enumerate(sounds)},
        **{name: depths[name] for name in ("disc_flank_um", "pin_um", "inner_raceway_um", "outer_raceway_um")},
    }


def part_errors(reducer: Reducer) -> list[Setting]:
    """One throw too large, and the ring of pins eccentric: orders of the cranks and of the ring."""
    pins = reducer.topology.pins
    angle = 2.0 * np.pi * np.arange(pins) / pins
    texts = [f"errors.crank.eccentricity[1,1]={THROW_ERROR!r}"]
    for way, row in (("radial", np.cos(angle)), ("tangential", -np.sin(angle))):
        texts += [f"errors.pin.{way}[{j + 1}]={float(RING_ERROR * row[j])!r}" for j in range(pins)]
    return [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]


def what_matters(found: list[Influence], most: int = 4) -> dict[str, list[Influence]]:
    """By signal the dials whose ranges move it, the strongest first."""
    signals = dict.fromkeys(one.signal for one in found)
    return {signal: [one for one in found if one.signal == signal and one.share >= SMALL][:most] for signal in signals}
