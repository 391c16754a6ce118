"""What carries the mesh: ring and its seat, discs against each other, moment on the flange, play that goes round."""

import math

import numpy as np
import numpy.typing as npt

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.laws.shared import ARCSEC, CIRCLE, ECCENTRICITY, LEVER, LOBES, PINS, RATIO, UM
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats

Complex = npt.NDArray[np.complex128]
ETA = 2.0 * math.pi * np.arange(PINS) / PINS
SEEN = ("transmission_error", "vibration_order")


def missed(angle: Floats, offset: Complex) -> Floats:
    """Gaps (steps, discs, pins) [m] of pins displaced by ``offset`` (steps, discs) [m], by Camus' theorem.

    The normal of every contact runs through the pitch point, e z_p from the ring's centre in the direction of the disc's eccentric.
    """
    eccentric = np.exp(1j * (-LOBES * angle[:, None] + math.pi * np.arange(2)))
    normal = CIRCLE * np.exp(1j * ETA) - ECCENTRICITY * PINS * eccentric[..., None]
    return np.asarray((normal.conj() * offset[..., None]).real / np.abs(normal), np.float64)


class SoftSeat(Truth):
    """Pins on linear springs that are softer on two sides of the ring and stiffer on the other two."""

    name, effect, blocks, quantities = "seat of the ring softer on two sides", "ring_stiffness", ("te",), SEEN
    typical, low, high = 3e-10, 3e-12, 2.5e-9

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.fourth = float(rng.uniform(0.0, 0.1))

    def gaps(self, setting: Setting, angle: Floats, force: Floats) -> Floats:
        return self.a * (np.cos(2.0 * ETA - self.phase) + self.fourth * np.cos(4.0 * ETA)) * force


class AskewRing(Truth):
    """Ring bored at an angle: the discs see it off centre in opposite directions, and a little oval."""

    name, effect, blocks, quantities = "ring askew to the discs", "unequal_discs", ("te",), SEEN
    typical, low, high = 0.2 * UM, 0.002 * UM, 20 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.oval = float(rng.uniform(0.0, 0.06))

    def gaps(self, setting: Setting, angle: Floats, force: Floats) -> Floats:
        offset = self.a * np.exp(1j * self.phase) * np.array([-0.5, 0.5]) * np.ones((len(angle), 1))
        return missed(angle, offset) + self.oval * self.a * np.cos(2.0 * ETA)


class HangingWeight(Truth):
    """Load torque by a weight on an arm that stands off the flange: it tilts the carrier and loads its bearings."""

    name, effect, blocks, quantities = "weight on an arm off the flange", "tilting_moment", ("te", "torque"), (*SEEN, "input_torque")
    typical, low, high = 0.1, 0.001, 8.0

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.rigidity = 370.0 * 60.0 * 180.0 / math.pi * float(np.exp(rng.uniform(-0.2, 0.2)))
        self.half = 5e-3 * float(np.exp(rng.uniform(-0.2, 0.2)))
        self.friction = 4e-3 * float(np.exp(rng.uniform(-0.5, 0.5)))

    def gaps(self, setting: Setting, angle: Floats, force: Floats) -> Floats:
        # The bearings stiffen a little under load.
        moment = self.a * setting.direction * setting.load
        tilt = moment / self.rigidity * (1.0 - 0.05 * abs(setting.load) / 167.0)
        return missed(angle, tilt * self.half * np.exp(1j * self.phase) * np.array([1.0, -1.0]) * np.ones((len(angle), 1)))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        if series.quantity != "input_torque":
            return y
        return y + self.friction * self.a * np.array([abs(s.load) for s in rows]) / RATIO


class PlayTurn(Truth):
    """A planet's seat off centre: the teeth come nearer and go, and the flank that drives stands back by half of it."""

    name, effect, blocks, quantities = "play that goes round with a planet", "first_stage_play", ("te",), ("transmission_error",)
    typical, low, high = 3 * UM, 0.05 * UM, 120 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.second = float(rng.uniform(0.0, 0.06))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        angle = 40.0 * series.axes["angle"] + self.phase
        size = 0.5 * self.a / (2.0 * LEVER * (LOBES + 1.0 + 1.0 / 3.0))
        return y - rows[0].direction * size * (np.cos(angle) + self.second * np.cos(2.0 * angle))


class SlippingSeat(Truth):
    """Housing in a clamped seat after Bouc and Wen: T = psi/c + z, dz/dpsi = rho/c (1 - |z/F|^n sign) with n from 1 to 1.5."""

    name, effect, blocks, quantities = "seat that slips after Bouc and Wen", "support_hysteresis", ("loops",), ("hysteresis",)
    typical, low, high = 5 * ARCSEC / 167.0, 0.02 * ARCSEC / 167.0, 300 * ARCSEC / 167.0

    def draw(self, rng: np.random.Generator) -> None:
        self.most = float(np.exp(rng.uniform(math.log(6.0), math.log(45.0))))
        self.stuck = float(rng.uniform(2.0, 8.0))
        self.power = float(rng.uniform(1.0, 1.5))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        # In turns of c, so that psi is a torque; the loop is entered from no torque.
        psi = force = total = 0.0
        found = np.zeros(len(y))
        for i, target in enumerate(series.axes["torque"]):
            step = (float(target) - total) / 40.0
            for _ in range(40):
                held = abs(force / self.most) ** self.power * math.copysign(1.0, force * step)
                slope = self.stuck * (1.0 - held)
                psi += step / (1.0 + slope)
                force += slope * step / (1.0 + slope)
            total = float(target)
            found[i] = self.a * psi
        return y + found - float(found.mean())
