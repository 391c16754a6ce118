"""Orders on the pages of results: of curves with samples missing, of more than whole turns, and why there are none."""

import numpy as np
import pytest

from discrepancy.page.comparison import order_figures
from discrepancy.page.runs import Run
from discrepancy.page.spectra import none_text, sizes, spectra_of, spectrum
from discrepancy.problem import Record


def over(angle, name="r", mounting="1", predicted=0.0):
    """A run of orders 7 and 12 at these angles."""
    values = 3.0 * np.cos(7 * angle) + np.sin(12 * angle)
    record = Record(name, "transmission_error", "rad", "c", 1, values, {"angle": angle}, {}, mounting=mounting)
    every = np.ones(len(angle), bool)
    return Run(record, every, values, predicted * values, np.ones(len(angle)), ~every)


TWO_TURNS = np.linspace(0.0, 4.0 * np.pi, 800, endpoint=False)


@pytest.mark.parametrize(
    "angle, missing",
    [
        (TWO_TURNS, 0), (TWO_TURNS[::-1], 0), (np.delete(TWO_TURNS, [300]), 1), (np.delete(TWO_TURNS, [0, 100, 101, 799]), 4),
        (np.append(TWO_TURNS, 4.0 * np.pi), 0), (np.linspace(0.0, 5.0 * np.pi, 1000), 0),
    ],
)  # fmt: skip
def test_orders_have_their_amplitudes_where_samples_are_missing(angle, missing):
    """One blank cell in each file, and all orders were gone without a word."""
    found = spectrum([over(angle, predicted=0.5)])
    measured, left = sizes(found.measured), sizes(found.residual)
    assert (found.turns, found.bridged) == (2, missing)
    assert measured[7] == pytest.approx(3.0, rel=1e-3) and measured[12] == pytest.approx(1.0, rel=1e-3) and measured[0] == 0.0
    assert measured[8] < 1e-2 and left[7] == pytest.approx(1.5, rel=1e-3) and sizes(found.predicted)[7] == pytest.approx(1.5, rel=1e-3)


def test_repetitions_that_miss_other_samples_are_one_mean():
    found = spectrum([over(np.delete(TWO_TURNS, [30 * k])) for k in range(3)] + [over(TWO_TURNS + 0.1, mounting="2"), over(TWO_TURNS[:500])])
    assert (found.repetitions, found.bridged) == (3, 3) and sizes(found.measured)[7] == pytest.approx(3.0, rel=1e-3)


@pytest.mark.parametrize(
    "angle, why",
    [
        (TWO_TURNS[:300], "r: the angle spans 269.1 deg in one sense: orders need at least one whole turn"),
        (np.delete(TWO_TURNS, slice(100, 120)), "r: after 89.1 deg the angle leaps by 18.9 deg, 21 times the usual step"),
        (np.delete(TWO_TURNS, np.arange(10, 800, 10)), "r: 79 of 800 samples are missing; orders need 95 % of them"),
        (TWO_TURNS[::40], "r: 20 samples; orders need 32"),
    ],
)
def test_why_a_run_has_no_orders_is_said(angle, why):
    found, said = spectra_of({"cold": [over(angle)], "warm": [over(TWO_TURNS)]})
    assert list(found) == ["warm"] and said["cold"].startswith(why) and none_text(said).startswith(f"no orders at cold ({why}")
    assert none_text(said | {"hot": "x"}).startswith("no orders at cold and 1 other condition (") and not none_text({})


def test_a_page_bridges_what_is_missing_or_says_why_there_are_no_orders():
    figures, said = order_figures([over(np.delete(TWO_TURNS, [7]))])
    assert figures[0].name == "orders_transmission_error" and figures[0].caption.endswith("1 sample missing or far off is bridged.") and not said
    figures, [said] = order_figures([over(TWO_TURNS[:300])])
    assert not figures and said.startswith("Transmission error: no orders at c (r: the angle spans 269.1 deg")
