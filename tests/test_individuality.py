"""Each deviation of a single part leaves its own mark, and the mark goes where the part is."""

import numpy as np
import pytest

from reproduce.context import Context
from reproduce.individuality_claims import marks_of, others, spread
from reproduce.judging import run


@pytest.fixture(scope="module")
def context():
    return Context()


def test_claims_stand():
    claims = run(["I"])
    assert [c.id for c in claims] == ["I01", "I02", "I03", "I04"]
    for claim in claims:
        assert claim.stands, (claim.id, [text for text, holds in claim.grounds if not holds])
        assert claim.figures


def test_another_proud_pin_marks_that_pin(context):
    m = marks_of(context, "errors.pin.radius[17]=3um")
    assert (m.pins.argmax(axis=1) == 16).all()
    assert m.pins[:, 16].min() > 5.0 * others(m.pins, (0, 16), (1, 16))
    assert spread(m.lobes) < 15.0 < m.pins.max()


def test_pitch_error_of_the_other_disc_marks_that_lobe(context):
    m = marks_of(context, "errors.lobe.pitch[2,20]=-3um")
    assert np.unravel_index(m.lobes.argmax(), m.lobes.shape) == (1, 19)
    assert m.lobes.max() > 5.0 * others(m.lobes, (1, 19)) and np.abs(m.pins).max() < 0.1 * m.lobes.max()


def test_errors_of_the_opposite_lobe_leave_the_opposite_mark(context):
    for error in ("crank_eccentricity_error[{},{}]=3um", "crank_phase_error[{},{}]=0.003"):
        first, second = (marks_of(context, error.format(k, k)) for k in (1, 2))
        assert second.races[::-1, ::-1] == pytest.approx(first.races, abs=1.5)
        assert second.lobes.mean(axis=1)[::-1] == pytest.approx(first.lobes.mean(axis=1), abs=1.5)


def test_the_four_marks_tell_the_errors_apart(context):
    """What stands out (pins, lobes, discs, bearings) differs from error to error."""
    def signature(text):
        m = marks_of(context, text)
        discs = np.abs(m.lobes.mean(axis=1))
        return (spread(m.pins[0]) > 50.0, spread(m.lobes[0]) > 50.0, discs.min() > 10.0 and spread(m.races) > 50.0,
                spread(m.races) > 5.0)

    found = [signature(text) for text in ("errors.pin.radius[3]=3um", "errors.lobe.pitch[1,5]=-3um",
             "errors.crank.eccentricity[1,1]=3um", "errors.crank.phase[1,1]=0.003")]
    assert len(set(found)) == 4
