"""The rig between reducer and encoder."""

import math

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import cont2discrete, lfilter, resample, ss2tf

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.laws.shared import RATIO
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats

# Samples that are put between two, and turns until nothing is left of the start.
FINER, SETTLING = 16, 3


class SoftCoupling(Truth):
    """A flywheel behind a soft coupling, stepped through time; its damping stands half between the two, half to the ground."""

    name, effect, blocks, quantities = "flywheel behind a soft coupling", "torsional_resonance", ("speeds",), ("transmission_error",)
    typical, low, high = 0.3, 0.002, 1.0

    def draw(self, rng: np.random.Generator) -> None:
        self.frequency = float(np.exp(rng.uniform(math.log(7.0), math.log(35.0))))
        self.damping = float(rng.uniform(0.03, 0.12))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        angle, n, turn = series.axes["angle"], len(y), 2.0 * math.pi
        order = np.argsort(angle)
        way, values = angle[order], y[order]
        places = way[0] + turn * np.arange(n) / n
        if not np.allclose(way, places, atol=1e-9):
            values = CubicSpline(np.append(way, way[0] + turn), np.append(values, values[0]), bc_type="periodic")(places)
        fine = resample(values, FINER * n)[:: rows[0].direction]
        omega, step = turn * self.frequency, turn * RATIO / (rows[0].speed * FINER * n)
        loss = 2.0 * self.damping * omega
        # State space of y'' + loss y' + omega^2 y = loss/2 x' + omega^2 x.
        system = np.array([[0.0, 1.0], [-(omega**2), -loss]]), np.array([[0.0], [1.0]]), np.array([[omega**2, 0.5 * loss]]), np.zeros((1, 1))
        top, bottom = ss2tf(*cont2discrete(system, step, "foh")[:4])
        moved = lfilter(np.ravel(top), bottom, np.tile(fine - fine.mean(), SETTLING))[-FINER * n :][:: rows[0].direction]
        change = np.empty(n)
        change[order] = CubicSpline(way[0] + turn * np.arange(FINER * n + 1) / (FINER * n), np.append(moved, moved[0]), bc_type="periodic")(way)
        return y + self.a * (change - (y - float(y.mean())))

    def parameters(self) -> dict[str, float]:
        return {"resonance_share": self.a, "resonance_frequency": self.frequency, "resonance_damping": self.damping, "resonance_grounded": 0.5}
