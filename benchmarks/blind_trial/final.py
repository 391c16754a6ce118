"""The final trial: which campaigns it has.  Written before it is run, and not changed after; its levels are in ``targets``."""

from collections.abc import Iterator, Sequence
from itertools import cycle

import numpy as np

from benchmarks.blind_trial.generator.faults import FAULTS
from benchmarks.blind_trial.generator.laws import CATALOGUE
from benchmarks.blind_trial.generator.make import Task
from benchmarks.blind_trial.generator.outside import OUTSIDE
from benchmarks.blind_trial.generator.reducer import RIGID, SOFT
from benchmarks.blind_trial.generator.trouble import BASES, NOISES
from benchmarks.blind_trial.generator.truth import Truth
from benchmarks.blind_trial.plan import Entry, pair_of

SEED = 20_261_227
STRENGTHS, AGAIN = (4.0, 6.0, 8.0, 12.0, 20.0, 40.0), (6.0, 12.0, 20.0)
OUTSIDE_STRENGTHS = (6.0, 10.0, 20.0, 20.0, 40.0)
# In turn; a bench writes what its instruments show, so no lives and no spectra.
SIZES = ("small", "small", "middle", "small", "bench", "small", "middle", "small", "small", "rich", "small", "middle")
# The base model, in turn.
MODELS = (RIGID, SOFT, RIGID, RIGID, SOFT)
BENCH_BLOCKS = ("te", "loops", "speeds", "torque")
POOR_EFFECTS, PAIRS, WRONG_BASES, PER_FAULT, PER_TROUBLE = 40, 80, 40, 10, 25
NULLS = {"small": 60, "middle": 40, "rich": 15, "poor": 20, "bench": 30}
TROUBLE_SIZES = ("small", "small", "middle")


def sized(laws: Sequence[type[Truth]], sizes: Iterator[str]) -> str:
    """The next size in turn; what no bench writes is of middle size there."""
    size = next(sizes)
    return "middle" if size == "bench" and not all(law.blocks[0] in BENCH_BLOCKS for law in laws) else size


def model_for(laws: Sequence[type[Truth]], models: Iterator[str]) -> str:
    """The next base model in turn; a rigid one where a law was made for that, or is about vibration, of which a rigid one has none."""
    model = next(models)
    return RIGID if any(law.rigid_only or law.blocks[0] == "vibration" for law in laws) else model


def reckoned(law: type[Truth], size: str) -> bool:
    """Whether the nearest other effects are looked for: lives are dear, and a rich campaign tells what a small one cannot."""
    return size == "small" or (size == "middle" and law.blocks[0] != "wear")


def entries(rng: np.random.Generator) -> list[Entry]:
    found: list[Entry] = []
    by_name = {law.name: law for law in CATALOGUE}
    # Every kind has its own turn of sizes, so that none of them falls to one size; laws of a strength begin somewhere else each time.
    sizes, models = cycle(SIZES), cycle(MODELS)
    for s in (*STRENGTHS, *AGAIN):
        for i in rng.permutation(len(CATALOGUE)):
            law = CATALOGUE[int(i)]
            size = sized([law], sizes)
            found.append({"kind": "effect", "laws": (law.name,), "strength": s, "size": size, "rivals": s >= 6.0 and reckoned(law, size),
                          "base": model_for([law], models)})
    for _ in range(POOR_EFFECTS):
        law = CATALOGUE[int(rng.integers(len(CATALOGUE)))]
        found.append({"kind": "effect", "laws": (law.name,), "strength": float(rng.choice([8.0, 12.0, 20.0])), "size": "poor", "rivals": True,
                      "base": model_for([law], models)})
    sizes = cycle(SIZES)
    for s in OUTSIDE_STRENGTHS:
        for i in rng.permutation(len(OUTSIDE)):
            law = OUTSIDE[int(i)]
            size = sized([law], sizes)
            found.append({"kind": "outside", "laws": (law.name,), "strength": s, "size": size, "rivals": s >= 10.0 and reckoned(law, size),
                          "base": model_for([law], models)})
    sizes = cycle(SIZES)
    for _ in range(PAIRS):
        names = pair_of(rng)
        laws = [by_name[n] for n in names]
        size = sized(laws, sizes)
        found.append({"kind": "pair", "laws": names, "strength": float(rng.choice([12.0, 20.0])), "size": size, "base": model_for(laws, models),
                      "rivals": all(reckoned(law, size) for law in laws)})
    sizes = cycle(SIZES)
    shown = [law for law in CATALOGUE if law.blocks[0] in ("te", "speeds", "loops")]
    for _ in range(WRONG_BASES):
        law = shown[int(rng.integers(len(shown)))]
        found.append({"kind": "wrong base", "laws": (law.name,), "strength": float(rng.choice([12.0, 20.0])), "size": sized([law], sizes),
                      "base": model_for([law], models)})
    sizes = cycle(SIZES)
    found += [{"kind": "fault", "fault": fault, "size": next(sizes), "base": next(models)} for fault in FAULTS for _ in range(PER_FAULT)]
    found += [{"kind": "null", "size": size, "base": next(models)} for size, count in NULLS.items() for _ in range(count)]
    found += [{"kind": "null", "trouble": trouble, "size": TROUBLE_SIZES[k % 3], "base": next(models)}
              for trouble in (*BASES, *NOISES) for k in range(PER_TROUBLE)]
    return found


def final_plan(seed: int = SEED) -> list[Task]:
    """Its tasks, in random order: wherever it is stopped, what is done is a fair sample."""
    rng = np.random.default_rng(seed)
    every = entries(rng)
    return [Task(k, int(rng.integers(2**31)), **every[int(i)]) for k, i in enumerate(rng.permutation(len(every)))]
