"""Cost per communication step of the pair, all contacts exchanged: this master and others, on the same FMUs.

    python benchmarks/master.py [--reducer NAME] [--steps N] [--rounds N]

Run it with the project's environment and the extra ``strangers``.  The tools take turns, round after
round; each figure is that of the fastest burst of a hundred steps, in processor time (all threads),
which other load on the machine disturbs less.  "exchange" is a step without the
units' own time in fmi2DoStep, which is the same for all: what master and transfer cost.
Native FMUs of FMI 2.0.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from time import process_time

import numpy as np
from fmpy.ssp.simulation import simulate_ssp

from fmu_src.package import build_native
from orchestrator.component import InProcess
from orchestrator.ssp.exporter import Experiment, export_ssp
from orchestrator.system import load
from reducers.reducer import Reducer, load_reducer
from studies.pair import CONNECTIONS, crank_turn_time

STRANGERS = Path(__file__).resolve().parents[1] / "tests" / "strangers"
# Steps of a burst.
BURST = 100
# simulate_ssp sends zero before the first step, and no reducer runs at 0 K.
EXCHANGED = [pair for pair in CONNECTIONS if not pair[1].startswith("wear.heat.")]


def ours(package: Path, h: float, steps: int) -> tuple[float, float]:
    """Of the fastest burst: a step, and the part of it that the units need for their own."""
    system = load(package, step=h)
    system.initialise()
    inside = [0.0]
    for component in system.master.components.values():
        step = timed(component.step, inside)
        vars(component).update(step=step, begin_step=step)
    fastest = (np.inf, np.inf)
    for _ in range(steps // BURST):
        inside[0], started = 0.0, process_time()
        system.master.run(BURST)
        fastest = min(fastest, ((process_time() - started) / BURST, inside[0] / BURST))
    system.close()
    return fastest


def timed(function: Callable[[float, float], object], total: list[float]) -> Callable[[float, float], None]:
    def call(time: float, duration: float) -> None:
        started = process_time()
        function(time, duration)
        total[0] += process_time() - started

    return call


def stranger(script: str, source: Path, h: float, steps: int) -> float | None:
    command = [sys.executable, STRANGERS / script, source, repr(h), str(steps), "plant.output.angle"]
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        print(f"{script}: {done.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
        return None
    seconds: float = json.loads(done.stdout.splitlines()[-1])["seconds_per_step"]
    return seconds


def simulated(package: Path, h: float, steps: int) -> float:
    """Difference of a long and a short run, so that loading does not count."""
    times = []
    for count in (1, steps + 1):
        started = process_time()
        simulate_ssp(str(package), stop_time=(count - 0.5) * h, step_size=h)
        times.append(process_time() - started)
    return (times[1] - times[0]) / steps


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reducer", default="RV20E-121")
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    reducer = load_reducer(options.reducer)
    h = round(crank_turn_time(reducer, InProcess("plant", reducer.specification("rv_plant"))) / 72, 9)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, unit in (("RvPlant", "rv_plant"), ("RvWear", "wear_fmu")):
            build_native(name, reducer.specification(unit), h, "benchmark", folder, ("2",))
        fmus = {"plant": folder / "fmi2" / "RvPlant.fmu", "wear": folder / "fmi2" / "RvWear.fmu"}
        package = export_ssp(folder / "pair.ssp", "pair", fmus, EXCHANGED, Experiment(h, 1.0), {})
        with zipfile.ZipFile(package) as archive:
            archive.extractall(folder / "pair")
        tools: dict[str, Callable[[], float | None]] = {
            "libcosim": lambda: stranger("libcosim.py", folder / "pair", h, options.steps),
            "ecos": lambda: stranger("ecos.py", package, h, options.steps),
            "fmpy simulate_ssp": lambda: simulated(package, h, 20),
        }
        own: list[tuple[float, float]] = []
        measured: dict[str, list[float]] = {name: [] for name in tools}
        for _ in range(options.rounds):
            own.append(ours(package, h, options.steps))
            for name, tool in tools.items():
                if (seconds := tool()) is not None:
                    measured[name].append(seconds)
    mine, units = min(own)
    best = {"rvwear": mine} | {name: min(times) for name, times in measured.items() if times}
    exchange = {name: seconds - units for name, seconds in best.items()}
    others = [name for name in best if name != "rvwear"]
    figures = {
        "reducer": reducer.name, "values_exchanged": int(sum(np.prod(s) for s in sizes(reducer))),
        "units_us": 1e6 * units,
        "step_us": {name: 1e6 * seconds for name, seconds in best.items()},
        "exchange_us": {name: 1e6 * seconds for name, seconds in exchange.items()},
        "step_over_rvwear": {name: best[name] / best["rvwear"] for name in others},
        "exchange_over_rvwear": {name: exchange[name] / exchange["rvwear"] for name in others},
    }
    print(json.dumps(figures, indent=1))


def sizes(reducer: Reducer) -> list[tuple[int, ...]]:
    tables = {"plant": reducer.plant, "wear": reducer.wear}
    return [tables[a.partition(".")[0]].by_path[a.partition(".")[2]].shape for a, _ in EXCHANGED]


if __name__ == "__main__":
    main()
