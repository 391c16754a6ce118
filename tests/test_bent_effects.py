"""Two numbers of a profile do nearly the same, and which teeth bear hangs on them: a fit finds the place that explains the data, and says how little they tell."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.inference.base_fit.fit import Box
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.refit.bent import exchange
from discrepancy.inference.refit.joint import total_cost
from discrepancy.inference.refit.refit import estimates
from discrepancy.inference.screening.screen import SMALL, TYPICAL, Block, Columns
from discrepancy.inference.verdict import ONE
from discrepancy.model_file import ModelFile
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.units import Condition
from discrepancy.problem import Candidate, Parameter, Record
from reducers.reducer import load_reducer
from tests.test_other_places import campaign

RPM, ARCSEC = np.pi / 30.0, np.pi / 648000.0
NOISE = 0.3 * ARCSEC
# What the discs were ground to beyond the file's [m].
GROUND = {"equidistant_added": -13e-6, "shift_added": -20e-6}


def measured():
    """Transmission errors at two loads, twice each, of an encoder whose zero nobody knows."""
    bench, rng = Bench(load_reducer("RV20E-121-rigid"), {}), np.random.default_rng(11)
    angles = np.linspace(0.0, 2.0 * np.pi, 300, endpoint=False)
    records = []
    for load in (40.0, 160.0):
        curve = bench.column("transmission_error", Condition(1000.0 * RPM, load, 293.15), GROUND, angles)
        factors = {"speed": 1000.0 * RPM, "load": load, "temperature": 293.15, "direction": 1.0}
        records += [Record(f"{load:g} {k}", "transmission_error", "rad", f"{load:g}", k, curve - curve.mean() + NOISE * rng.standard_normal(len(angles)),
                           {"angle": angles}, factors, stated_noise=NOISE) for k in (1, 2)]  # fmt: skip
    return tuple(records)


def test_relief_of_a_profile_is_found_beyond_the_next_optimum():
    """A descent from the base model ended at 90 above the truth in chi-square, with the wrong sign of one number and an interval without the truth."""
    reducer = load_reducer("RV20E-121-rigid")
    model = PhysicalModel(ModelFile(reducer.name, reducer), replace(campaign(), reducer=reducer, records=measured()))
    model.candidates = [c for c in model.candidates if c.name in ("profile_modification", "disc_tooth_errors.ovality", "hole_position_errors.carrier")]
    doctor = Diagnostician(model)
    found = doctor.run()
    final = found.fits.members[0]
    assert (found.verdict, final.name) == (ONE, "profile_modification")
    truth = total_cost(doctor.space, Box(final.fit.parameters), {**dict.fromkeys(model.zeros, 0.0), **GROUND})[0]
    # No more than the noise of its three parameters above it.
    assert final.fit.chi2 < truth + 3.0
    intervals = {e.name: e.interval for e in estimates(doctor.space, final)}
    assert all(low < GROUND[name] < high for name, (low, high) in intervals.items())


def test_only_amplitudes_that_do_nearly_the_same_have_a_valley():
    rng = np.random.default_rng(3)
    first, second, third = rng.standard_normal((3, 50))
    two = Candidate("two", "", (Parameter("a", "m", 0.0, -1.0, 1.0, 1.0), Parameter("b", "m", 0.0, -1.0, 1.0, 1.0)))
    alike, apart = np.column_stack([first, -2.0 * first + 0.1 * second]), np.column_stack([first, second])

    def rate(*blocks):
        """``blocks`` with the size that each is made over."""
        made = tuple(Block(0, {}, slice(2 * k, 2 * k + 2), (0, 0), size) for k, (_, size) in enumerate(blocks))
        return exchange(Columns(np.hstack([columns for columns, _ in blocks]), made), 0, two)

    assert rate((alike, TYPICAL)) == pytest.approx(0.5, rel=0.02)
    assert rate((apart, TYPICAL)) is None
    # Straight ones have no other optimum.
    assert rate((alike, SMALL)) is None
    # What jams on one side and loosens on the other is seen between the two.
    assert rate((np.column_stack([first, second]), TYPICAL), (np.column_stack([third, -first]), -TYPICAL)) == pytest.approx(1.0)
