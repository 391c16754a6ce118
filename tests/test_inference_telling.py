"""What is told of a fit: estimates beyond all that was measured are bounds."""

from dataclasses import replace

from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.telling import beyond
from tests.test_base_off import bench


def test_effect_that_changes_more_than_was_measured_is_a_bound():
    doctor = Diagnostician(bench({"play": 4.0}))
    found = doctor.run()
    assert found.effects[0].parameters["play"]["bound"] is False
    # The measured turning goes from 23 to 190 arcsec and its zero is known; a play of 500 is beyond all of it, whatever makes up for it.
    (member,) = found.fits.members
    play = member.candidates[0]
    far = replace(member, fit=replace(member.fit, values={**member.fit.values, "play": 500.0}))
    assert beyond(doctor.space, far, play) and not beyond(doctor.space, member, play)
    near = replace(member, fit=replace(member.fit, values={**member.fit.values, "play": 150.0}))
    assert not beyond(doctor.space, near, play)
