"""What a diagnosis makes of loops that were measured at one position of the input, stated or not: a table of docs/standard_tests.md.

    python3 -m benchmarks.unplaced_loops [REDUCER]          half an hour with RV20E-121, whose friction remembers its way

Two loops each to 50, 75 and 100 % of the rated torque, with noise; all candidates.
"""

import argparse
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Campaign
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.torque_way import way
from discrepancy.prediction.units import Condition
from discrepancy.verdict import Answer, diagnose
from fmu_src.arrays import Floats
from reducers.reducer import load_reducer

ARCSEC = float(np.radians(1.0 / 3600.0))
SHARES, STEPS = (0.5, 0.75, 1.0), 10


@dataclass(frozen=True)
class Case:
    """Loops at input angles [deg] by condition (None: the mean), noise [arcsec]; ``stated`` is what the campaign says of it."""

    text: str
    degrees: tuple[float | None, ...]
    stated: str = ""
    noise: float = 0.5
    values: dict[str, float] = field(default_factory=dict)


def at(degrees: float | None) -> tuple[float | None, ...]:
    return (degrees,) * len(SHARES)


CLEARANCE = "needle_clearance_added"
CASES = (
    *(Case(f"at {degrees:g} deg", at(degrees)) for degrees in (0.0, 140.0, 600.0)),
    Case("at 0 deg, stated", at(0.0), 'locked_at = "0 deg"'),
    Case("mean, stated", at(None), 'locked_at = "mean"'),
    Case("at 0 deg, noise 2 arcsec", at(0.0), noise=2.0),
    Case("turned between conditions: at 0, 272, 600 deg", (0.0, 272.0, 600.0)),
    Case("clearance +2 um, at 140 deg, stated", at(140.0), 'locked_at = "140 deg"', values={CLEARANCE: 2e-6}),
    Case("clearance +2 um, at 140 deg", at(140.0), values={CLEARANCE: 2e-6}),
    Case("clearance +0.2 um, at 140 deg", at(140.0), values={CLEARANCE: 2e-7}),
    Case("clearance +0.2 um, at 140 deg, noise 2 arcsec", at(140.0), noise=2.0, values={CLEARANCE: 2e-7}),
    Case("friction of the flanks 0.05, at 140 deg", at(140.0), values={"friction_coefficient": 0.05}),
)


def there_and_back(peak: float) -> Floats:
    """Torques [N m] of a loop to either side, none at no torque, where the output floats."""
    up = (np.arange(STEPS) + 0.5) / (STEPS - 0.5) * peak
    return np.concatenate([up, up[-2::-1], -up, -up[-2::-1], up])


def measured(case: Case, folder: Path, reducer: str, shares: tuple[float, ...] = SHARES) -> Campaign:
    """The case's campaign, in a new ``folder``."""
    bench, rng = Bench(load_reducer(reducer), {}), np.random.default_rng(3)
    lines = [f'[campaign]\nname = "loops"\nreducer = "{reducer}"']
    for k, (share, degrees) in enumerate(zip(shares, case.degrees)):
        torque = there_and_back(share * bench.rated_load)
        path, places = way(bench, case.values, torque)
        angle = None if degrees is None else float(np.radians(degrees)) / abs(bench.ratio)
        turning = bench.held(Condition(bench.rated_speed, bench.rated_load, locked_at=angle), case.values, path)[places] / ARCSEC
        lines += [f"[conditions.c{k}]", 'temperature = "20 degC"', case.stated]
        for replicate in (1, 2):
            shown = (turning + case.noise * rng.standard_normal(len(torque))).tolist()
            lines += ["[[runs]]", f'id = "c{k}_{replicate}"', 'quantity = "hysteresis"', f'condition = "c{k}"', f"replicate = {replicate}",
                      'tags.locked = "input"', f'table.torque = {{ values = {torque.tolist()}, unit = "N.m" }}',
                      f'table.value = {{ values = {shown}, unit = "arcsec" }}']  # fmt: skip
    folder.mkdir()
    (folder / "campaign.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return load_campaign(folder)


def told(answer: Answer) -> str:
    """What is named, with the interval of a clearance."""
    named = []
    for effect in answer.effects:
        clearance = effect["parameters"].get(CLEARANCE)
        interval = " ({:.3g} to {:.3g} um)".format(*(1e6 * end for end in clearance["interval"])) if clearance else ""
        named.append(f"`{effect['name']}`{interval}")
    others = [f"or {', '.join(f'`{name}`' for name in names)}" for names in answer.diagnosis.alternatives.values()]
    base = [f"base's `{e.name}`" for e in answer.diagnosis.base_off]
    return "; ".join([f"{answer.verdict}: {', '.join([*named, *base])}" if named or base else answer.verdict, *others])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("reducer", nargs="?", default="RV20E-121")
    options = parser.parse_args()
    print("| loops | answer |\n|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for k, case in enumerate(CASES):
            print(f"| {case.text} | {told(diagnose(load_model(options.reducer), measured(case, Path(folder) / str(k), options.reducer)))} |", flush=True)


if __name__ == "__main__":
    main()
