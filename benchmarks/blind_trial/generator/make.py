"""One campaign from a seed and a kind: drawn, scaled to its d', written, sealed."""

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.blind_trial.generator import trouble
from benchmarks.blind_trial.generator.dense import dense_design
from benchmarks.blind_trial.generator.designs import Design, Run, make_design
from benchmarks.blind_trial.generator.faults import faulty
from benchmarks.blind_trial.generator.folder import seal_of, write_campaign
from benchmarks.blind_trial.generator.laws import CATALOGUE
from benchmarks.blind_trial.generator.noise import round_to
from benchmarks.blind_trial.generator.outside import OUTSIDE
from benchmarks.blind_trial.generator.reducer import RIGID, ROLLER_STIFFNESS, SOFT
from benchmarks.blind_trial.generator.rivals import distances
from benchmarks.blind_trial.generator.strength import Ruler
from benchmarks.blind_trial.generator.truth import Bench, Truth
from fmu_src.arrays import Floats

LAWS: dict[str, type[Truth]] = {law.name: law for law in CATALOGUE + OUTSIDE} | {trouble.SlightlyOff.name: trouble.SlightlyOff}
TRUE_PARAMETERS = {"mesh_wear_coefficient": 5e-9, "roughness": 0.4e-6, "mesh_stiffness": 3.2e5}
# Noise may be this much lower or higher than drawn to meet d'.
NOISE_RANGE = (0.35, 2.8)
ATTEMPTS = 6


@dataclass(frozen=True)
class Task:
    """What to make: ``kind`` null, effect, outside, pair, wrong base, fault; ``laws`` by name; ``size`` of the design.

    ``trouble`` is what a null has that is not ideal; ``rivals`` asks for the nearest other effects; ``base`` is the reducer.
    """

    number: int
    seed: int
    kind: str
    laws: tuple[str, ...] = ()
    strength: float = 0.0
    size: str = "middle"
    fault: str = ""
    trouble: str = ""
    rivals: bool = False
    base: str = RIGID

    @property
    def name(self) -> str:
        return f"campaign_{self.number:05d}"


class CannotMake(Exception):
    """The strength cannot be met within the physical range of law and noise."""


@dataclass(frozen=True)
class Drawn:
    """A campaign before it is measured: hidden laws at their size, design, the true reducer; ``rng`` measures next."""

    rng: np.random.Generator
    truths: list[Truth]
    design: Design
    bench: Bench
    parameters: dict[str, float]
    sizes: list[float]
    rivals: dict[str, float]


def make(task: Task, folder: Path, sealed: Path) -> dict[str, Any]:
    """Writes ``folder``/NAME and ``sealed``/NAME.json; returns the truth with its seal."""
    return written(task, drawn(task), folder, sealed)


def drawn(task: Task) -> Drawn:
    """The first draw that meets the strength; the same for the same task."""
    for attempt in range(ATTEMPTS):
        try:
            return attempt_to_draw(task, np.random.default_rng([task.seed, attempt]))
        except CannotMake:
            continue
    raise CannotMake(f"{task}: d' not met in {ATTEMPTS} attempts")


def attempt_to_draw(task: Task, rng: np.random.Generator) -> Drawn:
    truths = [LAWS[name](rng) for name in task.laws]
    blocks = blocks_for(rng, task, truths)
    design = dense_design(rng, blocks, task.kind == "outside") if task.size == "bench" else make_design(rng, blocks, task.size)
    trouble.spoil(task.trouble, design)
    parameters = true_parameters(rng, task, design)
    bench = Bench(parameters, name=task.base)
    sizes = []
    rivals: dict[str, float] = {}
    if truths:
        ruler = Ruler(design, {**TRUE_PARAMETERS, **parameters}, bench)
        for k, truth in enumerate(truths):
            factor = ruler.set_strength(truth, task.strength)
            if len(truths) == 1 and abs(factor - 1.0) > 0.04:
                if not NOISE_RANGE[0] < factor < NOISE_RANGE[1]:
                    raise CannotMake(task.laws[k])
                for s in design.series:
                    s.noise = s.noise.scaled(factor)
                factor = Ruler(design, {**TRUE_PARAMETERS, **parameters}, bench).size([truth]) / task.strength
            if not 0.9 < factor < 1.1:
                raise CannotMake(task.laws[k])
            sizes.append(factor * task.strength)
        if task.rivals:
            rivals = nearest(Ruler(design, {**TRUE_PARAMETERS, **parameters}, bench), truths, task.seed)
    if task.trouble == trouble.WORN:
        truths = [trouble.SlightlyOff(rng)]
    whole, parameters = trouble.bench_of(task.trouble, parameters, rng, task.base)
    return Drawn(rng, truths, design, whole, parameters, sizes, rivals)


def nearest(ruler: Ruler, truths: Sequence[Truth], seed: int) -> dict[str, float]:
    """d' of the nearest law of every other effect; of two laws, in place of each beside the other."""
    if len(truths) == 1:
        return distances(ruler, truths[0], np.random.default_rng([seed, 41]))
    found: dict[str, float] = {}
    for truth, other in zip(truths, reversed(truths)):
        own = distances(ruler.beside(other), truth, np.random.default_rng([seed, 41]))
        # In place of one, the other once more is no rival.
        found |= {f"{name} for {truth.effect}": d for name, d in own.items() if name != other.effect}
    return found


def written(task: Task, made: Drawn, folder: Path, sealed: Path) -> dict[str, Any]:
    rng, truths, design = made.rng, made.truths, made.design
    runs = measure(rng, design, made.bench, truths)
    done = faulty(rng, task.fault, str(rng.choice(sorted(design.quantities()))), runs) if task.fault else ""
    for run in runs:
        run["values"] = round_to(run["values"], run["series"].noise.quantum)
    truth = {
        "campaign": task.name, "kind": task.kind, "effects": [t.effect for t in truths if t.name != trouble.SlightlyOff.name],
        "trouble": task.trouble, "rivals": made.rivals, "laws": [t.facts() for t in truths],
        "strength": task.strength, "d_prime": made.sizes, "fault": done, "reducer": task.base, "base": made.parameters, "size": task.size,
        "acceptable": sorted({name for t in truths for name in t.acceptable}), "seed": task.seed,
        "noise": {s.quantity: vars(s.noise) for s in design.series}, "samples": int(sum(len(r["values"]) for r in runs)),
        "conditions": len(design.conditions), "held_out": sorted(design.held_out),
        # The seal cannot be guessed by trying all truths.
        "salt": rng.bytes(16).hex(),
    }  # fmt: skip
    text, seal = seal_of(truth)
    sealed.mkdir(parents=True, exist_ok=True)
    (sealed / f"{task.name}.json").write_text(text, encoding="utf-8")
    write_campaign(folder / task.name, task.name, design, runs, seal, reducer=task.base)
    return {**truth, "seal": seal}


def blocks_for(rng: np.random.Generator, task: Task, truths: list[Truth]) -> list[str]:
    """Blocks that show the laws, and one that has nothing to do with them."""
    blocks = list(dict.fromkeys(b for t in truths for b in t.blocks))
    if "wear" in blocks and rng.random() < 0.2:
        # Long lives are not those of nulls alone.
        blocks = ["old" if b == "wear" else b for b in blocks]
    if task.trouble in trouble.BLOCKS:
        choices = trouble.BLOCKS[task.trouble]
        return list(choices[int(rng.integers(len(choices)))])
    if task.size == "bench":
        return blocks_of_bench(rng, list(dict.fromkeys(t.blocks[0] for t in truths)))
    # The first block of a law shows it; further ones come by chance, except prints, which need their lives.
    if len(truths) == 1 and len(blocks) > 1 and "prints" not in blocks and (task.size == "tiny" or rng.random() < 0.5):
        blocks = blocks[:1]
    if task.size in ("tiny", "small"):
        cheap = ["loops", "torque", "cage"]
        return blocks or [str(rng.choice(cheap if task.size == "tiny" else ["te", *cheap]))]
    odds = {"te": 0.25, "loops": 0.25, "torque": 0.3, "cage": 0.1, "wear": 0.05 if blocks else 0.15, "vibration": 0.05}
    # The plain reducer's vibration is none at all, which a soft one's is not.
    others = [b for b in odds if b not in blocks and not (b == "wear" and "old" in blocks) and not (b == "vibration" and task.base == SOFT)]
    share = np.array([odds[b] for b in others])
    count = 1 if blocks else int(rng.integers(1, 4))
    extra = [str(b) for b in rng.choice(others, count, replace=False, p=share / share.sum())]
    return blocks + (extra if not blocks or rng.random() < 0.5 else [])


def blocks_of_bench(rng: np.random.Generator, blocks: list[str]) -> list[str]:
    """What shows the laws, and with even odds both of what every bench measures."""
    usual = ["te", "loops"]
    if not blocks or (set(blocks) <= set(usual) and rng.random() < 0.5):
        return usual
    return blocks


def true_parameters(rng: np.random.Generator, task: Task, design: Design) -> dict[str, float]:
    """True values of what may be calibrated; a wrong base also has contacts that nobody declared."""
    found = {}
    for name, entry in design.nuisances.items():
        unit = 1e-6 if entry["unit"] == "um" else 1.0
        found[name] = float(unit * np.clip(entry["start"] + entry["prior"] * rng.normal(0.0, 0.8), 1.1 * entry["lower"], 0.95 * entry["upper"]))
    if task.kind == "wrong base":
        found["roller_stiffness"] = float(ROLLER_STIFFNESS[task.base] * np.exp(rng.choice([-1, 1]) * rng.uniform(0.15, 0.35)))
    return found


def measure(rng: np.random.Generator, design: Design, bench: Bench, truths: list[Truth]) -> list[Run]:
    """Runs with noise; every replicate starts with the cages somewhere else."""
    runs: list[Run] = []
    kept: dict[tuple[int, float, int], Floats] = {}
    for number, s in enumerate(design.series):
        for k in range(s.replicates):
            axes = copy.deepcopy(s.axes)
            cage = float(rng.uniform(0.0, 6.28)) if s.quantity == "transmission_error" else 0.3
            if design.uneven and "angle" in axes:
                step = axes["angle"][1] - axes["angle"][0]
                axes["angle"] = np.sort(axes["angle"] + rng.uniform(-0.35, 0.35, len(axes["angle"])) * step)
            key = (number, cage, design.uneven and k)
            if key not in kept:
                kept[key] = bench.values(s, truths, cage, k, axes)
            y = kept[key]
            zero = design.zeros.get(design.mounting.get(s.condition, ""), 0.0)
            if zero and "angle" in axes:
                axes["angle"] = axes["angle"] - zero
            values = y + s.noise.draw(rng, y)
            # The file's axis is what was measured of it.
            axes = {name: at + design.axis_noise.get(name, 0.0) * rng.standard_normal(len(at)) if name in design.axis_noise else at
                    for name, at in axes.items()}
            tag = "_".join(w for w in (s.tags.get("surface", ""),) if w)
            words = {"transmission_error": "te", "hysteresis": "loop", "input_torque": "torque", "vibration_order": "vib"}
            runs.append({"id": f"{s.condition}_{words.get(s.quantity, s.quantity)}{'_' + tag if tag else ''}_{k + 1}", "series": s,
                         "replicate": k + 1, "axes": axes, "values": values})
    return runs
