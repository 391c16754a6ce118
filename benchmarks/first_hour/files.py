"""Files as a bench of some country writes them, of a reducer that has an effect which its model lacks: what a new user is given.

    python3 -m benchmarks.first_hour.files pt KIT pin_ring_ovality=5e-6 pin_ring_ovality_angle=2.3
    python3 -m benchmarks.first_hour.files de KIT               # a sound reducer

Twelve transmission errors (three loads, two speeds, two repetitions each) of an encoder on the output, and four loops of a locked
input.  What is hidden is printed and stands in no file of the folder.
"""

import argparse
import math
from pathlib import Path

import numpy as np
import pandas as pd

from benchmarks.first_hour.styles import STYLES, Style
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.torque_way import way
from discrepancy.prediction.units import Condition
from fmu_src.arrays import Floats
from reducers.reducer import load_reducer

ARCSEC, RPM = math.pi / 648000.0, math.pi / 30.0
SHARES, SPEEDS, REPETITIONS = (0.3, 0.6, 0.9), (900, 1450), (1, 2)
PLACES = (90, 210)
SAMPLES, STEPS = 1800, 60
# Noise of a sample [arcsec]; what the encoder's angles differ by from run to run [rad]; where its 0 is in the model's angle [rad].
ERROR_NOISE, LOOP_NOISE, ENCODER_STEP, ZERO = 0.4, 0.6, 0.3 * ARCSEC, math.radians(23.7)


def saved(path: Path, above: str, heads: tuple[str, str], columns: tuple[Floats, Floats], digits: tuple[int, int], style: Style) -> None:
    table = pd.DataFrame({head: [f"{value:.{n}f}".replace(".", style.decimal) for value in column] for head, column, n in zip(heads, columns, digits)})
    path.write_bytes((above + table.to_csv(index=False, sep=style.delimiter, lineterminator="\n", quoting=3)).encode(style.encoding))


def shown_by_output(bench: Bench, condition: Condition, values: dict[str, float], angles: Floats) -> Floats:
    """Transmission error [rad] where the output, which lags and turns unevenly behind its input, stands at ``angles`` [rad]."""
    error = np.full_like(angles, bench.average("transmission_error", condition, values))
    for _ in range(3):
        error = bench.column("transmission_error", condition, values, angles - error)
    return error


def errors(bench: Bench, values: dict[str, float], folder: Path, style: Style, rng: np.random.Generator) -> None:
    for share in SHARES:
        load = round(share * bench.rated_load)
        for speed in SPEEDS:
            for k in REPETITIONS:
                shown = np.linspace(0.0, 2.0 * math.pi, SAMPLES, endpoint=False) + ENCODER_STEP * rng.standard_normal()
                condition = Condition(speed * RPM, float(load))
                error = shown_by_output(bench, condition, values, shown + ZERO) / ARCSEC
                error += -error.mean() + ERROR_NOISE * rng.standard_normal(len(shown))
                stated = {"load": load, "speed": speed, "k": k}
                saved(folder / style.error.format(**stated), style.above.format(**stated), style.error_heads, (np.degrees(shown), error), (5, 3), style)


def loops(bench: Bench, values: dict[str, float], folder: Path, style: Style, rng: np.random.Generator) -> None:
    up = (np.arange(STEPS) + 0.5) / (STEPS - 0.5) * bench.rated_load
    torque = np.concatenate([up, up[-2::-1], -up, -up[-2::-1], up])
    path, places = way(bench, values, torque)
    for degrees in PLACES:
        held = Condition(bench.rated_speed, bench.rated_load, locked_at=ZERO + math.radians(degrees) / abs(bench.ratio))
        turning = bench.held(held, values, path)[places] / ARCSEC
        for k in REPETITIONS:
            stated = {"degrees": degrees, "k": k}
            noisy = (turning + LOOP_NOISE * rng.standard_normal(len(torque))) / 60.0
            saved(folder / style.loop.format(**stated), style.loop_above.format(**stated), style.loop_heads, (torque, noisy), (3, 5), style)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("style", choices=STYLES)
    parser.add_argument("folder", type=Path)
    parser.add_argument("values", nargs="*", metavar="PARAMETER=VALUE", help="variables of effects, in SI units")
    parser.add_argument("--reducer", default="RV20E-121")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_intermixed_args()
    values = {name: float(value) for name, value in (entry.split("=") for entry in options.values)}
    bench, rng = Bench(load_reducer(options.reducer), {}), np.random.default_rng(options.seed)
    if unknown := set(values) - set(bench.starts[0]):
        parser.error(f"no variable of {options.reducer}: {', '.join(sorted(unknown))}; python -m cli.main effects NAME lists those of an effect")
    options.folder.mkdir(parents=True)
    errors(bench, values, options.folder, STYLES[options.style], rng)
    loops(bench, values, options.folder, STYLES[options.style], rng)
    print(f"{len(list(options.folder.iterdir()))} files in {options.folder}; hidden: {values or 'nothing'}")


if __name__ == "__main__":
    main()
