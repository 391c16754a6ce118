"""A repetition that is left out stands in its figure, apart from the runs that count."""

from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.page import panels, series
from discrepancy.page.runs import runs_of
from discrepancy.problem import Record
from discrepancy.scales import AXES

TORQUE = np.linspace(-100.0, 100.0, 50)


@pytest.mark.parametrize(("times", "visible"), [(1.5, True), (30.0, "legendonly")])
def test_it_is_dashed_in_grey_at_its_condition(times, visible):
    """It was named in the text and drawn nowhere; one that would press the others flat waits for a click."""
    records = [Record(f"{condition}{k}", "hysteresis", "rad", condition, k, TORQUE * (times if (condition, k) == ("b", 3) else 1.0), {"torque": TORQUE}, {},
                      zero_known=True, left_out=(condition, k) == ("b", 3)) for condition in "ab" for k in (1, 2, 3)]  # fmt: skip
    whitener = SimpleNamespace(kept=np.ones(50, bool), scale=np.full(50, 0.1), between=0.0)
    space = SimpleNamespace(records=records, noise=SimpleNamespace(whiteners=[whitener] * 6))
    runs, gone = (runs_of(space, [0.9 * TORQUE] * 6, AXES["speed"], left_out=left_out) for left_out in (False, True))
    assert [run.record.name for run in runs] == ["a1", "a2", "a3", "b1", "b2"] and [run.record.name for run in gone] == ["b3"]
    plain, found = (series.figure("p", "hysteresis", runs, gone=apart) for apart in ((), gone))
    trace = found.data[-1]
    assert (trace["name"], trace["line"]["dash"], trace["line"]["color"]) == ("left out", "dash", panels.FAINT) and "Dashed in grey" in found.caption
    assert [choice.label for choice in found.choices] == ["a", "b"]
    at_a, at_b = (choice.traces[-1] for choice in found.choices)
    assert at_a["x"] == [] and not at_a["showlegend"]
    assert at_b["visible"] == visible and set(at_b["text"]) == {"b3"} and np.ptp([y for y in at_b["y"] if y is not None]) == pytest.approx(
        times * np.ptp([y for y in found.choices[1].traces[2]["y"] if y is not None]), rel=1e-3)  # fmt: skip
    # The others are drawn as without it.
    assert [choice.traces[:-1] for choice in found.choices] == [choice.traces for choice in plain.choices] and "left out" not in plain.caption
