"""Positions of locked inputs that count from a zero that was found: told by comparison and diagnosis alike, with a number where the model fits."""

import pytest
from zero_campaign import NAME, REDUCER, written

from discrepancy.campaign.load import load_campaign
from discrepancy.compare import compare
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.verdict import diagnose

COUNTED = "where the input was locked is counted from the zero of the transmission errors of mounting 1"
# 0.01 rad of the output, of a ratio of 121.
FOUND = f"{COUNTED}, found 69 deg of the input from the model's"


def told(result):
    [text] = [text for text in result.warnings if text.startswith(COUNTED)]
    return text


@pytest.fixture(scope="module")
def file():
    return load_model(REDUCER)


@pytest.fixture(scope="module")
def off_centre(tmp_path_factory):
    return load_campaign(written(tmp_path_factory.mktemp("off"), loop=True))


def test_a_model_that_does_not_fit_gives_no_number(file, off_centre):
    text = told(compare(file, off_centre))
    assert "does not fit yet" in text and "may move when what is missing is found" in text and "deg" not in text


def test_one_that_fits_says_how_far(file, tmp_path):
    assert told(compare(file, load_campaign(written(tmp_path, {}, loop=True)))).startswith(FOUND)


def test_a_diagnosis_tells_it_beside_what_it_names(file, off_centre):
    model = PhysicalModel(file, off_centre)
    model.candidates = tuple(c for c in model.candidates if c.name == NAME)
    assert told(diagnose(file, off_centre, model=model)).startswith(FOUND)
