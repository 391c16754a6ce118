"""Wear coefficients against their published formulas and magnitudes."""

import numpy as np
import pytest

from wear_fmu.wear_laws import (
    CONSTANT,
    JANAKIRAMAN,
    JANAKIRAMAN_PRINTED,
    RUN_IN_LOAD,
    janakiraman,
    janakiraman_printed,
    load_factor,
    run_in_factor,
    wear_coefficient,
)

HARDNESS, MODULUS = 7e9, 207e9 / (1 - 0.3**2)
# Roller of 8 mm under 650 N on the inner raceway: 1/R = 1/1.5 mm + 1/10.25 mm.
CASE = {"line_load": 650 / 8e-3, "radius": 1.5e-3 * 10.25e-3 / 11.75e-3, "roughness": 0.4e-6,
        "pressure_viscosity": 1.8e-8, "modulus": MODULUS}


def coefficient(law, run_in=1.0, load_exponent=0.3, line_load=CASE["line_load"], kappa=5e-9):
    return wear_coefficient(law, kappa, HARDNESS, run_in, load_exponent, 5e4, CASE["roughness"],
                            CASE["pressure_viscosity"], MODULUS, line_load, CASE["radius"])


def test_literature_janakiraman_of_a_needle_roller():
    k = janakiraman(*CASE.values())
    assert k == pytest.approx(4.6e-19, rel=0.01, abs=0)
    # As a dimensionless coefficient 3e-9, what 4 um in 10,000 h take.
    assert k * HARDNESS == pytest.approx(3e-9, rel=0.1, abs=0)


@pytest.mark.parametrize("name, exponent", [
    ("line_load", 1.219), ("radius", -1.219 - 1.589), ("roughness", 1.589), ("pressure_viscosity", -7.377),
    ("modulus", -1 - 1.219 - 7.377),
])
def test_exponents_of_janakiraman(name, exponent):
    more = janakiraman(*{**CASE, name: 1.5 * CASE[name]}.values())
    assert np.log(more / janakiraman(*CASE.values())) / np.log(1.5) == pytest.approx(exponent, abs=1e-9)


def test_inner_raceway_wears_more_than_the_outer_by_its_radius():
    """(1.691/1.309)^2.808 = 2.06, published."""
    outer = 1 / (1 / 1.5e-3 - 1 / 13.25e-3)
    ratio = janakiraman(*CASE.values()) / janakiraman(*{**CASE, "radius": outer}.values())
    assert ratio == pytest.approx((1.6915 / 1.3085) ** 2.808, rel=1e-3, abs=0)
    assert ratio == pytest.approx(2.06, rel=0.005, abs=0)


def test_literature_printed_janakiraman():
    """5.6e-22 1/Pa: three orders too small, and it falls with roughness."""
    printed = janakiraman_printed(*CASE.values(), HARDNESS)
    assert printed == pytest.approx(5.6e-22, rel=0.01, abs=0)
    rougher = janakiraman_printed(*{**CASE, "roughness": 0.8e-6}.values(), HARDNESS)
    assert rougher / printed == pytest.approx(2**-1.589, rel=1e-12, abs=0)


def test_laws_are_selected_by_their_number():
    assert coefficient(CONSTANT) == pytest.approx(5e-9 / HARDNESS, rel=1e-15, abs=0)
    loaded = 5e-9 / HARDNESS * (CASE["line_load"] / 5e4) ** 0.3
    assert coefficient(RUN_IN_LOAD) == pytest.approx(loaded, rel=1e-14, abs=0)
    assert coefficient(JANAKIRAMAN) == janakiraman(*CASE.values())
    assert coefficient(JANAKIRAMAN_PRINTED) == janakiraman_printed(*CASE.values(), HARDNESS)


def test_only_the_run_in_law_runs_in():
    assert coefficient(RUN_IN_LOAD, run_in=5.0) == pytest.approx(5.0 * coefficient(RUN_IN_LOAD), rel=1e-14, abs=0)
    for law in (CONSTANT, JANAKIRAMAN, JANAKIRAMAN_PRINTED):
        assert coefficient(law, run_in=5.0) == coefficient(law)


@pytest.mark.parametrize("exponent, factor", [(0.0, 1.0), (0.3, 2**0.3), (1.219, 2**1.219), (-0.5, 2**-0.5)])
def test_load_factor(exponent, factor):
    assert load_factor(1e5, 5e4, exponent) == pytest.approx(factor, rel=1e-14, abs=0)


@pytest.mark.parametrize("ratio", [5.0, 1.0, 0.5])
def test_run_in_decays_with_travel_from_its_ratio_to_one(ratio):
    assert run_in_factor(ratio, 0.0, 3e7) == ratio
    assert run_in_factor(ratio, 3e7, 3e7) == pytest.approx(1 + (ratio - 1) / np.e, rel=1e-14, abs=0)
    assert run_in_factor(ratio, 1e9, 3e7) == pytest.approx(1.0, abs=1e-13)
    # Half-way the excess has the same share of what it had a travel earlier.
    travel = np.linspace(0, 1e8, 11)
    excess = np.array([run_in_factor(ratio, s, 3e7) - 1 for s in travel])
    assert excess == pytest.approx((ratio - 1) * np.exp(-travel / 3e7), rel=1e-12, abs=0)
