"""Where unused runs refute what fits best, and a rival fits hardly worse, they decide."""

import numpy as np

from discrepancy.inference.diagnose import diagnose
from discrepancy.problem import Candidate, Parameter
from tests.test_inference_fit import LINES, SPEEDS, Shaker, line, shaken


class Fading(Shaker):
    """The shaker with an effect that is another one beyond the speeds of the fitted runs."""

    def predict(self, values, which=None):
        found = super().predict(values, which)
        indices = range(len(self.records)) if which is None else which

        def more(r):
            pattern = line(39.0) + 0.11 * line(117.0)
            return values.get("fading", 0.0) / values.get("mass", 10.0) * (r.factors["speed"] / 200.0) ** 2 * pattern * (r.factors["speed"] < SPEEDS[-1])

        return [y + more(self.records[i]) for i, y in zip(indices, found)]


def fading(seed):
    """An unbalance with a little more at its third order, which the effect that fades fits the better of the two."""
    made = shaken(6.0 * (LINES["unbalance"] + 0.11 * line(117.0)), {"unbalance": LINES["unbalance"]}, seed)
    model = Fading(made.records, made.shapes)
    model.candidates += (Candidate("fading", "fading", (Parameter("fading", "N", 0.0, -1e3, 1e3, 1.0),)),)
    return model


def test_unused_runs_decide_between_rivals_where_they_refute_the_best():
    answer = diagnose(fading(5))
    fits = {r.name: r.fit.chi2 for r in answer.fits.rivals}
    assert 6.0 < fits["unbalance"] - fits["fading"] < 24.0
    assert answer.verdict == "one effect" and answer.effects[0].name == "unbalance"
    assert "fading fits better by" in answer.reason and "runs that were not used refute it" in answer.reason
    assert np.isclose(next(r["chi2_difference"] for r in answer.rejected if r["name"] == "fading"), fits["fading"] - fits["unbalance"])


def test_what_unused_runs_refute_stands_in_no_set():
    """Here the effect that fades fits a little worse."""
    answer = diagnose(fading(1))
    fits = {r.name: r.fit.chi2 for r in answer.fits.rivals}
    assert 0.0 < fits["fading"] - fits["unbalance"] < 6.0
    assert answer.verdict == "one effect" and answer.effects[0].name == "unbalance" and not answer.confusable
