"""Two ways to say how far the output stays behind: behind the cranks (``output.lag``), and behind the input (the transmission error)."""

import numpy as np
import pytest
from stand import in_equilibrium

from discrepancy.catalogue import signature

ARCSEC = 3600.0 * 180.0 / np.pi


def test_what_turns_the_cranks_along_is_in_the_transmission_error_and_not_in_the_lag(rv20e):
    """A user's effect left ``output.lag`` at 225.0 arcsec, where ``rvwear effects`` had a "mean lag" that it moved."""
    without, present = (in_equilibrium(rv20e.plant, 0.0, load_torque=167.0, carrier_turn_cos=size) for size in (0.0, 3e-7))
    fallen = -(present.transmission_error - without.transmission_error)
    assert fallen * ARCSEC == pytest.approx(167.0 * 3e-7 * ARCSEC, rel=0.05)
    assert abs(present.lag - without.lag) < 0.1 * fallen


def test_the_catalogue_names_the_mean_of_the_transmission_error_by_what_it_is(monkeypatch):
    turn = np.full(signature.SAMPLES, -2.0 / ARCSEC)
    monkeypatch.setattr(signature, "turn", lambda bench, condition, values, what="": turn)
    monkeypatch.setattr(signature, "conditions", lambda bench: dict.fromkeys((*signature.SPECTRUM_AT, "rated", "load 25 %", "speed 200 %")))
    rows = {row.figure: row for row in signature.spectrum_rows(None, {}, {})}
    assert rows["mean TE (behind)"].without == pytest.approx(2.0) and not any("lag" in name for name in rows)
