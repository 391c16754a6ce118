"""Shares in percent: no power of ten where a share is near all, or more."""

from types import SimpleNamespace

from discrepancy.inference.diagnose import Diagnostician
from fmu_src.percent import percent
from reproduce.table import off_text


def test_a_share_is_told_with_its_digits_and_never_with_a_power_of_ten():
    assert [percent(share) for share in (0.998, 1.0, 0.996, 0.94, 0.0471, 0.002, 0.0, 12.34)] == [
        "100 %", "100 %", "100 %", "94 %", "4.7 %", "0.2 %", "0 %", "1200 %"
    ]  # fmt: skip
    assert percent(12.34, 3, "+") == "+1230 %" and percent(-0.005, 3, "+") == "-0.5 %"


def test_an_effect_that_could_explain_all_of_it_explains_100_percent():
    """``1e+02 %`` stood there."""
    score = SimpleNamespace(statistic=999.0, p_adjusted=1e-9)
    doctor = SimpleNamespace(space=SimpleNamespace(base=SimpleNamespace(chi2=1100.0, residual=SimpleNamespace(size=100))), screening=SimpleNamespace(scores=[score]))
    assert Diagnostician.explained(doctor, score) == "100 % of the misfit"


def test_what_is_far_off_a_check_is_told_in_plain_percent():
    assert off_text(SimpleNamespace(off=12.34, tolerance=1.0)) == "+1230 % (100 %)"
