"""Columns of sensitivities over thousands of rows, whitened: side by side, squared, and without what others span."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats

# Rows that are worked on at once: with some hundred columns they stay near the processor, and so little memory is touched anew.
ROWS = 4096


@dataclass(frozen=True)
class Projected:
    """``columns`` (N, m) without the span of a ``jacobian`` (N, p), made for the rows that are asked for: of long records all at once are much
    memory, and to touch it takes longer than the products."""

    columns: Floats
    jacobian: Floats
    # By the jacobian's columns, how much of them is taken off: (p, m).
    taken: Floats

    @property
    def shape(self) -> tuple[int, ...]:
        return self.columns.shape

    def __getitem__(self, rows: slice) -> Floats:
        return np.asarray(self.columns[rows] - self.jacobian[rows] @ self.taken, np.float64)

    def gram(self) -> Floats:
        """Products (m, m) with the columns themselves: with priors the inverse covariance is I - J N^-1 J', applied once, not twice."""
        gram = self.columns.T @ self.columns - (self.columns.T @ self.jacobian) @ self.taken
        return np.asarray(0.5 * (gram + gram.T), np.float64)


def projected(columns: Floats, jacobian: Floats, normal: Floats) -> Projected:
    """``columns`` with the span of ``jacobian`` (with its priors, ``normal``) removed."""
    return Projected(columns, jacobian, np.linalg.pinv(normal, hermitian=True) @ (jacobian.T @ columns))


def in_parts(rows: slice) -> Iterator[slice]:
    """``ROWS`` of the rows at a time."""
    return (slice(start, min(start + ROWS, rows.stop)) for start in range(rows.start, rows.stop, ROWS))


def project_out(columns: Floats, jacobian: Floats, normal: Floats) -> Floats:
    """The same of all rows at once."""
    return projected(columns, jacobian, normal)[:]


def side_by_side(blocks: Sequence[Floats], rows: int) -> Floats:
    """Blocks (rows, any) in one array, each column in one piece: blocks are taken out of it again and again."""
    found = np.empty((rows, sum(block.shape[1] for block in blocks)), order="F")
    return np.concatenate([np.empty((rows, 0)), *blocks], axis=1, out=found)


def squares(columns: Floats) -> Floats:
    """Sum of squares of each column, without an array of all squares."""
    found: Floats = np.einsum("ij,ij->j", columns, columns)
    return found
