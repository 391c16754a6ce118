"""Faults of single runs: values of one replicate that no other shares."""

import numpy as np

from benchmarks.blind_trial.generator.designs import Run

FAULTS = ("dropout", "missing", "spikes", "quantised", "swapped", "gain", "offset", "drift", "clock")


def faulty(rng: np.random.Generator, fault: str, quantity: str, runs: list[Run]) -> str:
    """Spoils ``runs`` (with ``axes`` and ``values``) of one quantity; says what was done."""
    mine = [r for r in runs if r["series"].quantity == quantity]
    size = float(np.std(np.concatenate([r["values"] for r in mine]))) or 1.0
    victim = mine[int(rng.integers(len(mine)))]
    y = victim["values"]
    n = len(y)
    if fault == "dropout":
        start = int(rng.integers(0, max(1, n - n // 12)))
        y[start : start + max(1, n // 15)] = 0.0
    elif fault == "missing":
        y[rng.random(n) < 0.1] = np.nan
    elif fault == "spikes":
        y[rng.integers(0, n, max(1, n // 100))] += 8.0 * size * rng.standard_normal(max(1, n // 100))
    elif fault == "quantised":
        for r in mine:
            r["values"] = np.round(r["values"] / (0.3 * size)) * 0.3 * size
    elif fault == "swapped":
        other = next((r for r in mine if r is not victim and len(r["values"]) == n and r["series"].condition != victim["series"].condition), None)
        if other is None:
            victim["values"] = -y
        else:
            victim["values"], other["values"] = other["values"], y
    elif fault == "gain":
        victim["values"] = y * 1.08
    elif fault == "offset":
        victim["values"] = y + 0.5 * size
    elif fault == "drift":
        victim["values"] = y + 0.7 * size * (np.linspace(0.0, 1.0, n) ** 1.5 - 0.4)
    elif fault == "clock" and "angle" in victim["axes"]:
        victim["axes"]["angle"] = victim["axes"]["angle"] * 1.0006
    return f"{fault} in {victim['id']}"
