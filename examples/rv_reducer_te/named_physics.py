"""The rig's orders by named effects: which numbers are fitted, and how."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from fmu_src.arrays import Floats

ARCSEC = np.pi / 648000.0
# What each number may be off [arcsec], before a fit takes it for a blunder: means by their zeros, waves.  By eye, on training runs.
OF_MEANS, OF_WAVES = 8.0, 0.5
# Residuals beyond so many of these count in proportion to their size, not to its square (Huber): zeros jump, a resonance is narrow.
HUBER = 0.5
WEIGHINGS, ROUNDS = 12, 3


@dataclass(frozen=True)
class Number:
    """A fitted number: where it starts, the step of its derivative, bounds; ``places`` to begin at, if it does not act linearly."""

    name: str
    start: float
    step: float
    lower: float = -np.inf
    upper: float = np.inf
    places: tuple[float, ...] = ()
    # The derivative depends on another number that is fitted.
    anew: bool = False


@dataclass(frozen=True)
class Rung:
    """What is added together: the effect's name in the catalogue, and what it says of the rig."""

    effect: str
    says: str
    numbers: tuple[Number, ...]


ZERO = "sensor_offset"
LADDER = (
    Rung(ZERO, "zero of the encoders", (Number("sensor_offset[transmission_error]", 0.0, 0.01),)),
    Rung("support_compliance", "mean over the torque: all springs that it cannot tell apart", (Number("carrier_compliance", 3e-7, 1e-8, 0.0),)),
    Rung("encoder_eccentricity", "order 1, at any load and speed", (Number("encoder_cos1[1]", 0.0, 1e-5), Number("encoder_sin1[1]", 0.0, 1e-5))),
    Rung("friction_windup", "mean: steeper over the torque at creeping speed", (Number("friction_windup", 3e-8, 5e-9, 0.0),)),
    Rung("pin_seats", "order 78, in proportion to the torque", (Number("pin_seat_cos_2", 0.0, 1e-10), Number("pin_seat_sin_2", 0.0, 1e-10))),
    Rung("encoder_distortion", "order 3, at any load", (Number("distortion_cos[1]", 0.0, 1e-6), Number("distortion_sin[1]", 0.0, 1e-6))),
    Rung("unequal_discs", "order 39, at any load", (Number("disc_offset_x", 0.0, 5e-7), Number("disc_offset_y", 0.0, 5e-7))),
    Rung("tilting_moment", "order 39, with the torque and its sign", (Number("tilting_share_x", 0.0, 0.05), Number("tilting_share_y", 0.0, 0.05))),
    Rung("carrier_stiffness", "order 240, with the torque and its sign", (Number("carrier_crank_cos", 0.0, 1e-9), Number("carrier_crank_sin", 0.0, 1e-9))),
    Rung("crank_lobe_errors", "order 40, at any load", (Number("lobe_throw_error_1", 0.0, 5e-7), Number("lobe_phase_error_1", 0.0, 1e-4))),
    Rung("torque_ripple", "order 156 near its resonance", (
        Number("ripple_cos", 1e-10, 1e-10, anew=True), Number("ripple_sin", 1e-10, 1e-10, anew=True),
        Number("ripple_frequency", 54.0, 0.05, 45.0, 65.0, (52.0, 53.0, 54.0, 55.0, 56.0, 57.0), True))),
)  # fmt: skip


def numbers_of(rungs: Sequence[Rung]) -> list[Number]:
    return [number for rung in rungs for number in rung.numbers]


@dataclass(frozen=True)
class Fitted:
    """Fitted values by name, their covariance (p, p), and predictions [rad] of all records."""

    numbers: tuple[Number, ...]
    values: dict[str, float]
    covariance: Floats
    predicted: list[Floats]


def deviations(record: Record) -> Floats:
    return np.where(np.asarray(record.axes["order"]) == 0.0, OF_MEANS, OF_WAVES) * ARCSEC


class Fitter:
    """Fits rungs to some of a model's records; derivatives are taken at a start that no measurement has seen, and kept."""

    def __init__(self, model: PhysicalModel):
        self.model, self.records = model, model.records
        self.kept: dict[str, list[Floats]] = {}

    def predict(self, values: dict[str, float], which: Sequence[int] | None = None) -> list[Floats]:
        return self.model.predict(values, which)

    def slopes(self, number: Number, values: dict[str, float], at: Sequence[Floats], which: Sequence[int] | None = None) -> list[Floats]:
        """Derivative of every record by a number at ``values``, where ``at`` is predicted."""
        high = self.predict({**values, number.name: values[number.name] + number.step}, which)
        return [(a - b) / number.step for a, b in zip(high, at)]

    def linear(self, number: Number, starts: dict[str, float]) -> list[Floats]:
        if number.name not in self.kept:
            self.kept[number.name] = self.slopes(number, starts, self.predict(starts))
        return self.kept[number.name]

    def fit(self, rungs: Sequence[Rung], training: Sequence[int]) -> Fitted:
        """Least squares by Huber's weights; from each of a number's places in turn, the best of which goes on."""
        numbers = numbers_of(rungs)
        places: list[dict[str, float]] = [{n.name: place} for n in numbers for place in n.places] or [{}]
        begun = [self.improved(numbers, {n.name: n.start for n in numbers} | place, training, 1) for place in places]
        values, _, covariance = self.improved(numbers, min(begun, key=lambda tried: tried[1])[0], training, ROUNDS)
        sizes = np.array([n.step for n in numbers])
        return Fitted(tuple(numbers), values, covariance * np.outer(sizes, sizes), self.predict(values))

    def improved(self, numbers: Sequence[Number], values: dict[str, float], training: Sequence[int], rounds: int) -> tuple[dict[str, float], float, Floats]:
        """(values, Huber's cost that the last step promised, covariance in steps) after so many Gauss-Newton steps."""
        starts = {n.name: n.start for n in numbers_of(LADDER)}
        scale = np.concatenate([deviations(self.records[i]) for i in training])
        cost, covariance = np.inf, np.zeros((len(numbers), len(numbers)))
        for _ in range(rounds):
            at = self.predict(values, training)
            left = np.concatenate([(self.records[i].values - y) for i, y in zip(training, at)]) / scale
            columns = []
            for n in numbers:
                slopes = self.slopes(n, values, at, training) if n.anew else [self.linear(n, starts)[i] for i in training]
                columns.append(np.concatenate(slopes) / scale * n.step)
            steps, covariance, cost = weighted(np.column_stack(columns), left)
            values = {n.name: float(np.clip(values[n.name] + n.step * limited(n, s), n.lower, n.upper)) for n, s in zip(numbers, steps)}
        return values, cost, covariance


def limited(number: Number, steps: float) -> float:
    """A number that does not act linearly goes by no more than ten of its steps a round."""
    return float(np.clip(steps, -10.0, 10.0)) if number.places else steps


def weighted(jacobian: Floats, left: Floats) -> tuple[Floats, Floats, float]:
    """(step, its covariance, Huber's cost after it) by iteratively reweighted least squares; the covariance by the scatter of what is left (sandwich)."""
    weights = np.ones(len(left))
    step = np.zeros(jacobian.shape[1])
    for _ in range(WEIGHINGS):
        root = np.sqrt(weights)
        step = np.linalg.lstsq(jacobian * root[:, None], left * root, rcond=1e-10)[0]
        weights = np.minimum(1.0, HUBER / np.maximum(np.abs(left - jacobian @ step), 1e-12))
    bread = np.linalg.pinv((jacobian * weights[:, None]).T @ jacobian, rcond=1e-10, hermitian=True)
    pull = jacobian * (weights * (left - jacobian @ step))[:, None]
    size = np.abs(left - jacobian @ step)
    cost = float(np.sum(np.where(size < HUBER, 0.5 * size**2, HUBER * (size - 0.5 * HUBER))))
    return step, bread @ (pull.T @ pull) @ bread, cost

