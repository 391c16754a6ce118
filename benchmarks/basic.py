"""Cost of the basic operations: one equilibrium, one meshing cycle, one life.

    python3 benchmarks/basic.py [--reducer NAME]

Run it with the project's environment (.venv/bin/python).  Each figure is the smallest of
several runs, in processor time, which other load on the machine disturbs less; FMUs are native ones of FMI 2.0.
"""

import argparse
import json
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import process_time

from fmu_src.package import build_native
from reducers.reducer import Reducer, load_reducer
from studies.life import Life, LifeSettings, live
from studies.pair import Pair, make_pair


def smallest(function: Callable[[], object], runs: int) -> float:
    """Smallest processor time of several runs [s]."""
    times = []
    for _ in range(runs):
        start = process_time()
        function()
        times.append(process_time() - start)
    return min(times)


def equilibrium_time(pair: Pair) -> float:
    """One warm-started equilibrium with its outputs [s], averaged over a crank turn."""
    plant, step = pair.plant, pair.master.step_size

    def turn() -> None:
        for _ in range(pair.positions):
            plant.step(0.0, step)

    return smallest(turn, 20) / pair.positions


def cycle_time(pair: Pair) -> float:
    """One full meshing cycle of the coupled pair [s]."""
    steps = pair.reducer.topology.lobes * pair.positions
    return smallest(lambda: pair.master.run(steps), 3)


def life_time(reducer: Reducer, folder: Path | None) -> float:
    """10,000 h with error control [s], units already loaded."""
    pair = make_pair(reducer, fmus=folder)
    return smallest(lambda: live(pair, Life(LifeSettings()), lambda _: None, lambda _: None), 1)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reducer", default="RV20E-121")
    reducer = load_reducer(parser.parse_args().reducer)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, unit in (("RvPlant", "rv_plant"), ("RvWear", "wear_fmu")):
            build_native(name, reducer.specification(unit), 1e-3, "benchmark", folder, ("2",))
        inside, outside = make_pair(reducer), make_pair(reducer, fmus=folder / "fmi2")
        cycle, cycle_fmu = cycle_time(inside), cycle_time(outside)
        figures = {
            "reducer": reducer.name,
            "equilibrium_us": 1e6 * equilibrium_time(inside),
            "plant_real_time_factor": inside.master.step_size / equilibrium_time(inside),
            "cycle_in_process_s": cycle,
            "cycle_fmu_s": cycle_fmu,
            "fmu_over_in_process": cycle_fmu / cycle,
            "life_in_process_s": life_time(reducer, None),
            "life_fmu_s": life_time(reducer, folder / "fmi2"),
        }
    print(json.dumps(figures, indent=1))


if __name__ == "__main__":
    main()
