"""An interval is written so that its ends differ, wherever it is written."""

import math

import pytest

from cli.show.ensemble import cell
from discrepancy.campaign.amount import readable
from discrepancy.inference.law.closed_forms import Form
from discrepancy.page import amounts
from discrepancy.scales import Scale, estimate_texts
from discrepancy.words.intervals import UNDETERMINED, digits_of, estimate_text, general, interval_text
from discrepancy.words.wording import with_base_text
from pages.words import number

NARROW = {"value": 3.9996e-6, "interval": (3.99817e-6, 4.00131e-6), "interval_with_base": (3.99702e-6, 4.00244e-6), "unit": "m"}


@pytest.mark.parametrize(("low", "high", "written"), [
    (3.99817, 4.00131, "3.9982 to 4.0013"), (5.9996, 6.0004, "5.9996 to 6.0004"), (0.5156, 0.5796, "0.516 to 0.58"), (110.2, 541.8, "110 to 542"),
    (3.9999996, 4.0000004, "3.9999996 to 4.0000004"), (-6.0004, -5.9996, "-6.0004 to -5.9996"), (0.0, 1.2345, "0 to 1.23"), (2.0, 2.0, "2 to 2"),
    (1.0, math.inf, "1 to inf"),
])  # fmt: skip
def test_the_width_says_how_many_digits(low, high, written):
    assert interval_text(low, high) == written


@pytest.mark.parametrize("write", [general, readable, number])
@pytest.mark.parametrize("middle", [1e-9, 0.0123, 4.0, 99.9999, 1000.0, 123456.7, 3.2e8])
@pytest.mark.parametrize("share", [1.0, 1e-2, 1e-5, 1e-8])
def test_ends_differ_in_every_way_of_writing(write, middle, share):
    """"4 to 4 with each free within its range" stood below "95 %: 3.998 to 4.001"."""
    low, _, high = interval_text(middle * (1.0 - share), middle * (1.0 + share), 3, write).partition(" to ")
    assert low != high


def test_a_value_has_the_digits_of_its_interval():
    assert estimate_text(3.99961, (3.99817, 4.00131), 4, readable) == ("3.9996", "3.9982 to 4.0013")
    assert estimate_text(2.0, (2.0, 2.0), 4, readable) == ("2", UNDETERMINED)
    # Six digits at most, unless ends would look alike.
    assert digits_of(1.0, 1.0 + 1e-5) == 6 and digits_of(1.0, 1.0 + 1e-7) == 8


def test_screen_page_and_what_stands_below_tell_the_ends_apart():
    assert estimate_texts(NARROW) == ("3.9996", "3.997 to 4.0024", "um")
    assert amounts.estimate(NARROW) == ("3.9996", "3.9970 to 4.0024", "µm")
    assert with_base_text(NARROW) == "with each of the base model's numbers free within its range; 3.9982 to 4.0013 with them as its file has them"
    assert Scale(1e6, "um").span(5.9996e-6, 6.0004e-6) == "5.9996 um to 6.0004 um"


def test_laws_and_ensembles_tell_the_ends_apart():
    form = Form("linear", "y = a + b x", {"a": 0.0, "b": 5.99991}, {"a": (0.0, 0.0), "b": (5.9996, 6.0003)}, 1.0, 1.0)
    assert form.numbers(3, general) == ["b = 5.99991 (5.9996 to 6.0003)"]
    assert cell({"value": 4.0001, "low": 3.9982, "high": 4.0013}) == "4.0001 (3.9982 .. 4.0013)"
    assert cell({"value": 900.0, "low": 850.2, "high": None}, 1000.0) == "900 (850 .. > 1000)"
