"""Sensitivities that follow what is seen, after Broyden 1965: those of a point are dear."""

from collections.abc import Callable

import numpy as np

from discrepancy.inference.base_fit.fit import Box
from fmu_src.arrays import Floats


class Secants:
    """Columns that follow the residuals that were seen (Broyden), and are taken anew at every few places."""

    def __init__(self, box: Box, exactly: Callable[[Floats], Floats], exact_every: int):
        self.box, self.exactly, self.exact_every = box, exactly, exact_every
        self.residuals: dict[bytes, Floats] = {}
        self.last: tuple[Floats, Floats] | None = None
        self.since = 0

    @property
    def exact(self) -> bool:
        """Whether the last columns were no estimate."""
        return self.since == 0

    def seen(self, x: Floats, residual: Floats) -> None:
        self.residuals[x.tobytes()] = residual

    def forget(self) -> None:
        """The next columns are taken anew."""
        self.last = None

    def columns(self, x: Floats) -> Floats:
        """Minus the derivatives (N, p) of the residual at ``x`` (p,), whose residual was seen."""
        if self.last is not None and np.array_equal(self.last[0], x):
            return self.last[1]
        if self.last is None or self.since >= self.exact_every - 1:
            self.since, found = 0, self.exactly(x)
        else:
            before, known = self.last
            move = (x - before) / self.box.scale
            missed = self.residuals[before.tobytes()] - self.residuals[x.tobytes()] - known @ (x - before)
            self.since, found = self.since + 1, known + np.outer(missed, move / (move @ move) / self.box.scale)
        self.last = x.copy(), found
        return found
