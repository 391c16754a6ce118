"""The line in a picture of a profile is where the interval that is stated ends, and a profile that crosses it elsewhere is said to."""

from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.inference.base_fit.fit import fit_of
from discrepancy.inference.refit.profile import Profile, moved
from discrepancy.page.profiles import LIMIT, crossings, figure, limit_of
from discrepancy.problem import Parameter

PLACES = np.array([-3.5, -1.75, 0.0, 1.75, 3.5])
MIDDLE, WIDTH = 6.0e-6, 2.0e-8


def profile(chi2):
    return Profile("proud_pin", "m", MIDDLE + WIDTH * PLACES, np.asarray(chi2, float), WIDTH)


def told(half, dof=1e9, deviation=WIDTH, **more):
    return {"value": MIDDLE, "interval": [MIDDLE - half, MIDDLE + half], "unit": "m", "standard_deviation": deviation, "degrees_of_freedom": dof} | more


def test_the_line_is_where_the_parabola_has_the_interval_that_is_stated():
    """It stood at 3.84 beside every interval: one twice as wide, of few degrees of freedom, ended far above it."""
    drawn = profile(PLACES**2)
    for entry, student in ((told(1.96 * WIDTH), 1.96), (told(2.571 * 1.5 * WIDTH, 5.0, 1.5 * WIDTH), 2.571 * 1.5)):
        level, _ = limit_of(drawn, entry)
        assert level == pytest.approx(student**2, rel=1e-3)
        found = figure(0, drawn, "proud pin", entry)
        line, band = found.layout["shapes"]
        assert line["y0"] == line["y1"] == level == found.layout["annotations"][0]["y"] and found.layout["yaxis"]["range"][1] > level
        assert (band["x0"], band["x1"]) == pytest.approx([1e6 * (MIDDLE - student * WIDTH), 1e6 * (MIDDLE + student * WIDTH)], rel=1e-4)
    assert "(Student's law of 5 degrees of freedom, 1.50 times as wide for the misfit that is left)" in found.caption
    free = told(1.96 * WIDTH, interval_with_base=[MIDDLE - 3.92 * WIDTH, MIDDLE + 3.92 * WIDTH])
    level, why = limit_of(drawn, free)
    assert level == pytest.approx(4 * LIMIT, rel=1e-3) and "2.00 times as wide for the base model's own numbers" in why


def test_a_profile_that_crosses_the_line_elsewhere_says_where():
    """It crossed at 6.008 and 6.042 um, beside an interval of 5.964 to 6.059, and nothing said which of them holds."""
    entry = told(1.96 * WIDTH)
    assert "leaves the parabola" not in figure(0, profile(PLACES**2), "proud pin", entry).caption
    steep = profile(np.where(PLACES < 0.0, 100.0, 2.0) * PLACES**2)
    first, last = crossings(steep, LIMIT)
    assert MIDDLE - first == pytest.approx(0.196 * WIDTH, rel=0.06) and last - MIDDLE == pytest.approx(1.96 / np.sqrt(2.0) * WIDTH, rel=0.02)
    said = figure(0, steep, "proud pin", entry).caption
    assert said.startswith("Band: the 95 % interval stated, 5.961 to 6.039 µm; where the parabola lies below the line, 3.84 above the best")
    assert "The profile leaves the parabola: it lies below the line from 5.996 to 6.028 µm" in said
    flat = profile(np.where(PLACES < 0.0, 0.01, 1.0) * PLACES**2)
    assert "above the best it crosses the line at 6.039 µm, on the other side nowhere" in figure(0, flat, "proud pin", entry).caption


def test_others_that_follow_over_a_kink_stay_where_that_fits_better():
    """With a proud pin's number, whose mark has a kink where it is not between two, the fit got ten times as bad as with the number left alone."""
    parts = (Parameter("height", "1", 0.0, -10.0, 10.0, 1.0), Parameter("number", "1", 0.0, -10.0, 10.0, 1.0))

    def residual(values):
        height, number = values["height"] - 1.0, values["number"]
        # Beside the fit higher and further on is nearly the same; on the other side of the kink all gets worse.
        return np.array([height - number, 0.1 * (height + number), 30.0 * min(number, 0.0)])

    best = {"height": 1.0, "number": 0.0}
    fit = fit_of(parts, best, residual(best), -np.array([[1.0, -1.0], [0.1, 0.1], [0.0, 0.0]]), (), True)
    result = SimpleNamespace(fit=fit)
    space = SimpleNamespace(residual=residual)
    rise = [moved(space, result, np.array([1.0, 0.0]), 0, np.array([1]), value) - fit.chi2 for value in (0.8, 1.2)]
    assert rise[0] == pytest.approx(1.01 * 0.2**2) and rise[1] < 0.1 * rise[0]
