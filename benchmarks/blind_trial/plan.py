"""Which campaigns a trial has: kinds, laws, strengths and sizes in fixed shares, in random order."""

from typing import Required, TypedDict

import numpy as np

from benchmarks.blind_trial.generator.faults import FAULTS
from benchmarks.blind_trial.generator.laws import CATALOGUE
from benchmarks.blind_trial.generator.make import Task
from benchmarks.blind_trial.generator.outside import OUTSIDE

STRENGTHS = (4.0, 6.0, 8.0, 12.0, 20.0, 40.0)
OUTSIDE_STRENGTHS = (6.0, 10.0, 20.0, 40.0)
# Mostly small: a rich campaign costs as much as ten small ones and tells no more about the rates.
SIZE_ODDS = {"small": 0.94, "middle": 0.05, "rich": 0.01}
# One round; a trial repeats rounds with other seeds.
NULLS, PAIRS, WRONG_BASES, POOR_EFFECTS, POOR_NULLS = 90, 40, 24, 30, 12


class Entry(TypedDict, total=False):
    """What of a ``Task`` the plan decides."""

    kind: Required[str]
    laws: tuple[str, ...]
    strength: float
    size: str
    fault: str
    trouble: str
    rivals: bool
    base: str


def one_round(rng: np.random.Generator) -> list[Entry]:
    found: list[Entry] = [{"kind": "null"} for _ in range(NULLS)]
    found += [{"kind": "null", "size": "poor"} for _ in range(POOR_NULLS)]
    found += [{"kind": "effect", "laws": (law.name,), "strength": s} for law in CATALOGUE for s in STRENGTHS]
    found += [{"kind": "outside", "laws": (law.name,), "strength": s} for law in OUTSIDE for s in OUTSIDE_STRENGTHS]
    for _ in range(PAIRS):
        names = pair_of(rng)
        found.append({"kind": "pair", "laws": names, "strength": float(rng.choice([12.0, 20.0]))})
    for _ in range(WRONG_BASES):
        laws = [law for law in CATALOGUE if law.blocks[0] in ("te", "speeds", "loops")]
        found.append({"kind": "wrong base", "laws": (laws[int(rng.integers(len(laws)))].name,), "strength": float(rng.choice([12.0, 20.0]))})
    for _ in range(POOR_EFFECTS):
        law = CATALOGUE[int(rng.integers(len(CATALOGUE)))]
        found.append({"kind": "effect", "laws": (law.name,), "strength": float(rng.choice([8.0, 12.0, 20.0])), "size": "poor"})
    found += [{"kind": "fault", "fault": fault} for fault in FAULTS for _ in range(6)]
    return found


def pair_of(rng: np.random.Generator) -> tuple[str, str]:
    """Two laws of different effects, not both of wear, whose rates would only multiply."""
    while True:
        first, second = (CATALOGUE[i] for i in rng.choice(len(CATALOGUE), 2, replace=False))
        if first.effect != second.effect and {first.blocks[0], second.blocks[0]} != {"wear"}:
            return first.name, second.name


def plan(count: int, seed: int, sizes: dict[str, float] = SIZE_ODDS) -> list[Task]:
    """``count`` tasks; the first ones of a longer plan with the same seed."""
    rng = np.random.default_rng(seed)
    tasks: list[Task] = []
    while len(tasks) < count:
        entries = one_round(rng)
        for i in rng.permutation(len(entries)):
            entry = entries[i].copy()
            entry.setdefault("size", str(rng.choice(list(sizes), p=list(sizes.values()))))
            tasks.append(Task(len(tasks), int(rng.integers(2**31)), **entry))
    return tasks[:count]


REDUCED_LAWS = (
    "friction with a velocity minimum", "drag of seals and grease", "wrong gain", "skidding rollers", "soft flange", "play of the first stage",
    "thermal gap of ring and discs",
)  # fmt: skip
REDUCED_OUTSIDE = ("friction bump in speed and temperature", "humidity", "cage ahead with the speed", "periodic play over the temperature",
                   "drag with speed^2.5")  # fmt: skip


def reduced_plan(seed: int, nulls: int = 26) -> list[Task]:
    """At least 60 campaigns that are cheap to make and to diagnose."""
    rng = np.random.default_rng(seed)
    entries: list[Entry] = [{"kind": "null"} for _ in range(nulls)]
    entries += [{"kind": "effect", "laws": (law,), "strength": s} for law in REDUCED_LAWS for s in (12.0, 16.0, 20.0)]
    entries.append({"kind": "effect", "laws": ("Dahl friction in the loop",), "strength": 12.0})
    entries += [{"kind": "outside", "laws": (law,), "strength": 20.0} for law in REDUCED_OUTSIDE]
    entries += [{"kind": "fault", "fault": fault} for fault in FAULTS if fault != "clock"]
    # One that costs little to diagnose, in another campaign.
    entries.append({"kind": "outside", "laws": ("cage ahead with the speed",), "strength": 20.0})
    return [Task(k, int(rng.integers(2**31)), **(entry | {"size": "tiny"})) for k, entry in enumerate(entries)]
