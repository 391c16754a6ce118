"""Campaigns as a bench writes them: thousands of samples a run, axes that are measured too, its own units and decimal signs."""

import math

import numpy as np

from benchmarks.blind_trial.generator.designs import BLOCKS, RPM, TURN, Design, Series, there_and_back
from benchmarks.blind_trial.generator.noise import noise_for
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.style import Style

SAMPLES, STEPS = 9000, 400
# What an encoder and a torque meter err by from sample to sample (assumed).
ANGLE_NOISE, TORQUE_NOISE = math.radians(0.005), 0.3
DENSE = ("te", "loops", "speeds")
# Loads [N m] and temperatures [K]; the last of several is held out.
CONDITIONS = ([(167.0, 303.15)], [(60.0, 293.15), (167.0, 313.15), (120.0, 303.15)])
STYLES = (
    Style(";", ",", {"transmission_error": "arcmin", "hysteresis": "deg", "input_torque": "N.cm", "torque": "N.m", "angle": "deg"}, "output", True),
    Style("\t", ".", {"transmission_error": "mrad", "hysteresis": "mrad", "input_torque": "mN.m", "torque": "kgf.cm", "angle": "rad"}, "input", False),
    Style(";", ",", {"transmission_error": "deg", "hysteresis": "arcmin", "input_torque": "kgf.cm", "torque": "N.cm", "angle": "turn",
                     "wear_depth": "nm", "wear_profile": "mm"}, "output", False),
)  # fmt: skip


def dense_design(rng: np.random.Generator, blocks: list[str], several: bool = False) -> Design:
    """Transmission error and loops as dense as a bench samples them, the rest as in a small campaign; ``several`` conditions for sure."""
    design = Design("bench", style=STYLES[int(rng.integers(len(STYLES)))])
    design.axis_noise = {"angle": ANGLE_NOISE, "torque": TORQUE_NOISE}
    for block in blocks:
        if block not in DENSE:
            BLOCKS[block](design, rng, "small")
    dense = [b for b in blocks if b in DENSE]
    if not dense:
        return design
    rows = CONDITIONS[-1 if several else int(rng.integers(len(CONDITIONS)))]
    speeds = [8.0] * len(rows)
    if "speeds" in dense:
        # What shows at several speeds only.
        rows, speeds = CONDITIONS[0] * 3, [6.0, 10.0, 14.0]
    noises = {q: noise_for(rng, q) for q in ("transmission_error", "hysteresis")}
    for k, ((load, temperature), speed) in enumerate(zip(rows, speeds)):
        name = f"bench{k + 1}"
        setting = Setting(121.0 * speed * RPM, load, temperature)
        design.conditions[name] = setting
        if k and k == len(rows) - 1:
            design.held_out.add(name)
        if {"te", "speeds"} & set(dense):
            axes = {"angle": np.linspace(0.0, TURN, SAMPLES, endpoint=False)}
            design.series.append(Series("transmission_error", name, setting, noises["transmission_error"], axes))
        if "loops" in dense:
            axes = {"torque": there_and_back(167.0, STEPS)}
            design.series.append(Series("hysteresis", name, setting, noises["hysteresis"], axes, tags={"locked": "input"}))
    return design
