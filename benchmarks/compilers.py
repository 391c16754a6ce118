"""The project's compiler against numba: the same kernels, time to machine code and speed of what comes out.

    python -m benchmarks.compilers [--reducer NAME]

Both compile the plant's ``initialise`` and ``step`` for one reducer's record from nothing, then take the same
steps through equilibria and in motion.  Their results must be the same to the last bit.
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

from benchmarks.numba_peer import by_numba
from fmu_src.compiler import loading
from fmu_src.compiler.module import Module, emit_object, host_triple, optimised
from fmu_src.compiler.types import Layout, Records
from reducers.reducer import Reducer, load_reducer
from rv_plant.plant import initialise, step

STEPS, STEP = 2000, {"quasi-static": 2e-4, "dynamic": 2e-5}
ROUNDS = 5


def compile_ours(layout: Layout) -> bytes:
    """From Python's syntax trees to object code, nothing kept."""
    module = Module()
    for kernel in (initialise, step):
        module.unit_entry(kernel, (Records(layout), *loading.ENTRY_POINTS[kernel.name]))
    return emit_object(optimised(module.text(host_triple()), list(loading.ENTRY_POINTS)), host_triple())


def compile_with_numba(records: np.ndarray) -> None:
    from numba import float64, typeof

    by_numba(initialise).compile((typeof(records),))
    by_numba(step).compile((typeof(records), float64, float64))


def seconds(work: Callable[[], object]) -> float:
    """CPU time."""
    begun = time.process_time()
    work()
    return time.process_time() - begun


def run(first: Callable[..., int], following: Callable[..., int], records: np.ndarray, size: float) -> float:
    """CPU time [s] of the steps."""
    assert first(records) == 0

    def steps() -> None:
        for _ in range(STEPS):
            assert following(records, 0.0, size) == 0

    return seconds(steps)


def compare(reducer: Reducer) -> dict[str, float]:
    """Figures of both, in seconds and us."""
    records = reducer.plant.new_records()
    # Imports are not what is compared.
    compile_ours(Layout(records.dtype))
    figures = {"ours: compile s": seconds(lambda: compile_ours(Layout(records.dtype)))}
    figures["numba: compile s"] = seconds(lambda: compile_with_numba(records))
    for fidelity, (name, size) in enumerate(STEP.items()):
        best = {"ours": np.inf, "numba": np.inf}
        for _ in range(ROUNDS):
            ends = []
            for who, (first, following) in {"ours": (initialise, step), "numba": (by_numba(initialise), by_numba(step))}.items():
                moved = reducer.plant.new_records()
                moved["fidelity"] = fidelity
                best[who] = min(best[who], run(first, following, moved, size))
                ends.append(moved.view("u8")[: reducer.plant.state_cells].tobytes())
            assert ends[0] == ends[1], f"{name}: not the same bits"
        for who, spent in best.items():
            figures[f"{who}: {name} us a step"] = 1e6 * spent / STEPS
    return figures


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--reducer", default="RV20E-121")
    figures = compare(load_reducer(parser.parse_args().reducer))
    for name, value in figures.items():
        print(f"{name:32} {value:9.3f}")
    for name in ("compile s", *(f"{fidelity} us a step" for fidelity in STEP)):
        print(f"{'numba over ours: ' + name:32} {figures[f'numba: {name}'] / figures[f'ours: {name}']:9.2f}")


if __name__ == "__main__":
    main()
