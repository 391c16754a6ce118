"""Whether chance alone makes a key figure as far off as one stands, among as many figures as there are."""

from collections.abc import Sequence
from math import expm1, log1p

from scipy.special import ndtr, stdtr

from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.chance import chance

# Below this a figure is said to be off (of all figures together).
RARE = 0.01


def alone(figure: KeyFigure) -> float:
    """How often chance makes one figure as far off; few repetitions tell its noise badly, so that many times of it are less rare."""
    return float(2.0 * (stdtr(figure.dof, -abs(figure.off)) if figure.dof else ndtr(-abs(figure.off))))


def rarest(figures: Sequence[KeyFigure]) -> tuple[KeyFigure, float]:
    """The figure that chance makes least often, and how often it makes one so rare among all."""
    least = min(figures, key=lambda f: (alone(f), -abs(f.off)))
    p = alone(least)
    return least, -expm1(len(figures) * log1p(-p)) if p < 1.0 else 1.0


def chance_text(figures: Sequence[KeyFigure]) -> str:
    """One line for below a table beside which nothing is significant; empty without figures."""
    if not figures:
        return ""
    figure, p = rarest(figures)
    known = f", its noise known from {figure.dof} degrees of freedom" if figure.dof else ""
    which = f"{figure.name} of {figure.signal} at {figure.condition}"
    if p < RARE:
        return f"{which} is off: {abs(figure.off):.1f} times its noise{known}; that chance makes one so rare among {len(figures)} figures is {chance(p)}"
    return (
        f"the least likely of {len(figures)} figures is {which}, {abs(figure.off):.1f} times its noise{known};"
        f" that chance makes one so rare among {len(figures)} is {chance(p)}"
    )
