"""Inputs beyond the last sample: the polynomial through the last values.

A co-simulation unit holds its inputs over a step.  It is given the mean over the step of
the polynomial through the last samples, which makes the coupling second order in the step;
a unit that takes input derivatives is given the polynomial itself, and the order is one
above the polynomial's.  With Gauss-Seidel the newest sample is already the one of the
step's end, and the same formula interpolates.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np

from fmu_src.arrays import Floats
from orchestrator.component import Component
from orchestrator.master.connections import Link, Transfer

HIGHEST_ORDER = 2
# Times, newest first, and the values then.
Samples = tuple[list[float], Floats]


class History:
    """The last ``order + 1`` samples of a vector and the polynomial through them."""

    def __init__(self, order: int, size: int):
        self.rows = np.zeros((order + 1, size))
        self.times: list[float] = []

    def add(self, time: float, values: Floats) -> None:
        """Keep a sample; one of the same time replaces the last."""
        if not self.times or time != self.times[0]:
            self.times = [time, *self.times[: len(self.rows) - 1]]
            self.rows[1:] = self.rows[:-1].copy()
        self.rows[0] = values

    def scaled(self, time: float) -> float:
        """Time relative to the newest sample, in units of the last interval."""
        return round((time - self.times[0]) / self.interval, 9)

    @property
    def interval(self) -> float:
        return self.times[0] - self.times[1] if len(self.times) > 1 else 1.0

    def points(self) -> tuple[float, ...]:
        return tuple(self.scaled(time) for time in self.times)

    def combine(self, weights: Floats, out: Floats) -> None:
        np.dot(weights, self.rows[: len(weights)], out=out)

    def mean(self, start: float, end: float, out: Floats) -> None:
        """Mean of the polynomial between two times."""
        self.combine(mean_weights(self.points(), self.scaled(start), self.scaled(end)), out)

    def derivative(self, time: float, order: int, out: Floats) -> None:
        """Derivative of the polynomial, its value with order 0."""
        weights = derivative_weights(self.points(), self.scaled(time), order)
        self.combine(weights / self.interval**order, out)

    def save(self) -> Samples:
        return list(self.times), self.rows.copy()

    def restore(self, saved: Samples) -> None:
        self.times, self.rows[:] = list(saved[0]), saved[1]


@lru_cache(maxsize=4096)
def mean_weights(points: tuple[float, ...], start: float, end: float) -> Floats:
    """Weights of the samples in the mean of their polynomial over [start, end]."""
    powers = np.arange(1, len(points) + 1)
    return solve(points, (end**powers - start**powers) / (powers * (end - start)))


@lru_cache(maxsize=4096)
def derivative_weights(points: tuple[float, ...], at: float, order: int) -> Floats:
    """Weights of the samples in a derivative of their polynomial."""
    basis = [np.polynomial.Polynomial.basis(k).deriv(order)(at) for k in range(len(points))]
    return solve(points, np.array(basis))


def solve(points: tuple[float, ...], moments: Floats) -> Floats:
    return np.linalg.solve(np.vander(points, increasing=True).T, moments)


@dataclass
class ExtrapolatedTransfer(Transfer):
    """A transfer whose target gets the polynomial through the last samples."""

    history: History
    # (order, buffer, function that sets it) of each input derivative that the target takes.
    derivatives: tuple[tuple[int, Floats, Callable[[], None]], ...]

    holds_apart: ClassVar[bool] = True

    def fetch(self, time: float) -> None:
        super().fetch(time)
        self.history.add(time, self.values)

    def deliver(self, start: float, end: float) -> None:
        if self.derivatives:
            self.history.derivative(start, 0, self.held)
        else:
            self.history.mean(start, end, self.held)
        super().deliver(start, end)
        for order, buffer, write in self.derivatives:
            self.history.derivative(start, order, buffer)
            write()

    def deliver_present(self) -> None:
        self.held[:] = self.values
        super().deliver_present()


def extrapolation_options(component: Component, links: list[Link], order: int) -> dict[str, Any]:
    """What an ``ExtrapolatedTransfer`` to a component needs beyond a plain one."""
    references = tuple(r for k in links if k.source.dtype == "f8" for r in k.target.references)
    derivatives = []
    for k in range(1, min(order, component.input_derivatives) + 1) if references else ():
        buffer = np.zeros(len(references))
        derivatives.append((k, buffer, component.derivative_writer(references, k, buffer)))
    return {"history": History(order, len(references)), "derivatives": tuple(derivatives)}
