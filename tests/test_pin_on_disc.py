"""Pin-on-disc tests: coefficients, planted laws, errors of the estimates, flags, bad input."""

import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from fmu_src.variables import ValueFault
from wear_fmu.kinematics import sliding_per_crank_angle
from wear_fmu.pin_on_disc import (
    PARAMETERS,
    PinOnDiscTest,
    fit,
    instantaneous_coefficient,
    secant_coefficient,
    smallest_visible_coefficient,
    whitened_differences,
    worn_mass,
)
from wear_fmu.wear_laws import RUN_IN_LOAD, run_in_factor, wear_coefficient

PLANTED = {"wear_coefficient": 1e-4, "run_in_ratio": 5.0, "run_in_distance": 100.0, "load_exponent": 0.3}
BALANCE = 1e-7  # kg
NO_RUN_IN = {"run_in_ratio": 1.0, "run_in_distance": 1.0}


def law_of(k=1e-4, r=5.0, s0=100.0, m=0.3):
    return dict(zip(PARAMETERS, (k, r, s0, m)))


def planted_tests(loads=(20.0, 40.0, 60.0, 80.0), hours=10.0, readings=12, seed=None, law=PLANTED, **more):
    """The document's tests under a known law (reference load 40 N), weighings with noise if there is a seed."""
    times = np.linspace(0.0, 1.0, readings + 1)[1:] ** 2 * hours * 3600.0
    (k, r, s0, m), rng = law.values(), np.random.default_rng(seed)
    options = {"contact_length": 5e-3, "balance_uncertainty": BALANCE} | more
    tests = []
    for load in loads:
        test = PinOnDiscTest(load, 0.025, 0.5, 7e9, 7850.0, times, 0.0 * times, name=f"{load:g} N", **options)
        s = test.distances
        losses = 7850.0 * load / 7e9 * k * (load / 40.0) ** m * (s + (r - 1.0) * s0 * (1.0 - np.exp(-s / s0)))
        if seed is not None:
            weighing = rng.normal(0.0, BALANCE, readings + 1)
            losses = losses + weighing[1:] - weighing[0]
        tests.append(replace(test, mass_losses=losses))
    return tests


def test_the_audits_detectability():
    """kappa = 1e-6 at 80 N takes 25 ug in 1 h (283 m); a balance of 0.1 mg sees 1.1e-5."""
    test = PinOnDiscTest(80.0, 0.025, 0.5, 7e9, 7850.0, (3600.0,), (0.0,))
    assert test.distances[-1] == pytest.approx(283.0, rel=2e-3)
    assert 1e-6 * test.mass_per_distance * test.distances[-1] == pytest.approx(25e-9, rel=0.02)
    assert smallest_visible_coefficient(test, BALANCE) == pytest.approx(1.1e-5, rel=0.02)
    assert smallest_visible_coefficient(replace(test, balance_uncertainty=2e-7), BALANCE) < 1.2e-5
    with pytest.raises(ValueFault, match="balance_uncertainty = None kg.*0.1 mg = 1e-7"):
        smallest_visible_coefficient(test)


def test_secant_is_the_mean_of_the_instantaneous_one_and_lags():
    test = planted_tests((40.0,))[0]
    s, secant = secant_coefficient(test)
    lost = instantaneous_coefficient(test)[1] * np.diff(s, prepend=0.0)
    assert np.cumsum(lost) / s == pytest.approx(secant, rel=1e-12)
    assert secant == pytest.approx(1e-4 * (1.0 + 400.0 / s * (1.0 - np.exp(-s / 100.0))), rel=1e-12)
    law = 1e-4 * np.array([run_in_factor(5.0, x, 100.0) for x in s])
    # 28 s0 after the start the law has settled, the secant still shows (r - 1) s0/s = 14 % of running-in.
    assert np.all(secant > law) and law[-1] == pytest.approx(1e-4, rel=1e-9)
    assert secant[-1] / law[-1] - 1.0 == pytest.approx(400.0 / s[-1], rel=1e-9)
    constant = planted_tests((40.0,), law=law_of(r=1.0))[0]
    for coefficient in (secant_coefficient, instantaneous_coefficient):
        assert coefficient(constant)[1] == pytest.approx(1e-4, rel=1e-12)


def test_instantaneous_is_second_order_in_the_interval():
    errors = []
    for step in (1.0, 0.5, 0.25):  # of 100 m
        s = np.arange(0.0, 500.0, 100.0 * step)[1:]
        losses = 7850.0 * 40.0 / 7e9 * 1e-4 * (s + 400.0 * (1.0 - np.exp(-s / 100.0)))
        test = PinOnDiscTest(40.0, 0.025, 0.5, 7e9, 7850.0, s / (2.0 * math.pi * 0.025 * 0.5), losses)
        middle, kappa = instantaneous_coefficient(test)
        law = 1e-4 * np.array([run_in_factor(5.0, x, 100.0) for x in middle])
        errors.append(np.max(kappa / law - 1.0))
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(2.0, abs=0.1)


def test_worn_mass_is_the_integral_of_the_wear_law():
    """rho F k ds with k [1/Pa] of wear_laws, and the slopes by differences."""
    x, s, hardness = np.array([*np.log([1e-4, 5.0, 100.0]), 0.3]), np.linspace(0.0, 300.0, 3001), 7e9
    conditions = s[-1:], 7850.0 * 80.0 / hardness, math.log(2.0)
    k = [wear_coefficient(RUN_IN_LOAD, 1e-4, hardness, run_in_factor(5.0, a, 100.0), 0.3, 40.0 / 5e-3,
                          0.0, 0.0, 0.0, 80.0 / 5e-3, 1.0) for a in s]
    mass, slopes = worn_mass(x, *conditions)
    assert mass[0] == pytest.approx(7850.0 * 80.0 * np.trapezoid(k, s), rel=1e-6)
    for i, step in enumerate(1e-5 * np.eye(4)):
        difference = worn_mass(x + step, *conditions)[0] - worn_mass(x - step, *conditions)[0]
        assert slopes[:, i] == pytest.approx(difference / 2e-5, rel=1e-8)


def test_whitening_is_generalised_least_squares_on_the_readings():
    """Readings share the first weighing: covariance u^2 (1 + 1 1'); their increments' is u^2 (-1, 2, -1)."""
    whiten = BALANCE * whitened_differences(planted_tests((40.0,), readings=6)[0], BALANCE)
    readings, steps = np.eye(6) + np.ones((6, 6)), np.eye(6) - np.eye(6, k=-1)
    assert whiten.T @ whiten == pytest.approx(np.linalg.inv(readings), abs=1e-12)
    assert steps @ readings @ steps.T == pytest.approx(2.0 * np.eye(6) - np.eye(6, k=1) - np.eye(6, k=-1), abs=1e-12)


@pytest.mark.parametrize("known", [BALANCE, None])
@pytest.mark.parametrize("law", [PLANTED, law_of(3e-6, 10.0, 400.0, 1.219), law_of(2e-5, 3.0, 60.0, 0.0),
                                 law_of(1e-3, 0.4, 200.0, -0.5)])
def test_noise_free_law_is_recovered(law, known):
    result = fit(planted_tests(law=law, balance_uncertainty=known), reference_load=40.0)
    for name in PARAMETERS:
        assert result.estimates[name] == pytest.approx(law[name], rel=1e-6, abs=1e-6 * (law[name] == 0.0)), name
    assert result.degrees_of_freedom == 4 * 12 - 4


def test_noisy_law_is_recovered_with_calibrated_errors():
    """200 sets: within 3 standard errors, 68 % within one, chi square of 4 parameters and of the residuals."""
    errors, distances, chi_squares = [], [], []
    for seed in range(200):
        result = fit(planted_tests((20.0, 80.0), readings=8, seed=seed), reference_load=40.0)
        assert not result.flags and not result.warnings, seed
        found, true = np.array(list(result.estimates.values())), np.array(list(PLANTED.values()))
        off = np.append(found[:3] * np.log(found[:3] / true[:3]), found[3] - true[3])  # errors are relative
        errors.append(np.abs(off) / list(result.standard_errors.values()))
        distances.append(off @ np.linalg.solve(result.covariance, off))
        chi_squares.append(result.reduced_chi_square)
    errors = np.array(errors)
    assert np.all((errors < 3.0).mean(axis=0) >= 0.98)  # 99.7 % expected
    assert np.all(np.abs((errors < 1.0).mean(axis=0) - 0.683) < 0.1)  # three standard errors of a share of 200
    assert np.mean(distances) == pytest.approx(4.0, abs=0.6)  # standard error 0.2
    assert np.mean(chi_squares) == pytest.approx(1.0, abs=0.1)  # 12 degrees of freedom: standard error 0.03


def test_unknown_balance_uncertainty_is_estimated():
    results = [fit(planted_tests(seed=seed, balance_uncertainty=None)) for seed in range(12)]
    assert np.mean([r.balance_uncertainty for r in results]) == pytest.approx(BALANCE, rel=0.1)
    known = fit(planted_tests(seed=0))
    ratio = results[0].balance_uncertainty / BALANCE
    assert math.isnan(results[0].reduced_chi_square) and known.reduced_chi_square == pytest.approx(ratio**2, rel=1e-3)
    for name in PARAMETERS:
        assert results[0].standard_errors[name] == pytest.approx(known.standard_errors[name] * ratio, rel=1e-3)


def test_reference_load_only_rescales_the_coefficient():
    a, b = fit(planted_tests(seed=1), reference_load=40.0), fit(planted_tests(seed=1))
    assert b.reference_load == pytest.approx((20.0 * 40.0 * 60.0 * 80.0) ** 0.25)
    scale = (b.reference_load / 40.0) ** a.estimates["load_exponent"]
    assert b.estimates["wear_coefficient"] == pytest.approx(scale * a.estimates["wear_coefficient"], rel=1e-5)


def test_one_load_does_not_determine_the_exponent_and_a_bound_is_flagged():
    assert fit(planted_tests(law=law_of(m=-1.0), seed=1)).flags["load_exponent"].startswith("on its bound")
    tests = planted_tests((80.0,), seed=1)
    result = fit(tests)
    assert list(result.flags) == ["load_exponent"] and "two or more loads" in result.flags["load_exponent"]
    assert math.isnan(result.estimates["load_exponent"]) and math.isnan(result.standard_errors["load_exponent"])
    assert result.estimates["wear_coefficient"] == pytest.approx(1e-4 * 2.0**0.3, rel=0.03)
    assert set(fit(tests, reference_load=40.0).flags) == {"load_exponent", "wear_coefficient"}
    held = fit(tests, reference_load=40.0, held={"load_exponent": 0.3})
    assert not held.flags and held.standard_errors["load_exponent"] == 0.0
    assert held.estimates["wear_coefficient"] == pytest.approx(1e-4, rel=0.03)


@pytest.mark.parametrize("seed", range(5))
def test_short_test_does_not_determine_the_running_in(seed):
    """28 m slid, s0 = 100 m: the coefficient when new is known, what it falls to is not."""
    result = fit(planted_tests(hours=0.1, seed=seed), reference_load=40.0)
    assert {"run_in_ratio", "wear_coefficient"} <= set(result.flags)
    assert "beyond 3 s0" in result.flags["run_in_ratio"]
    with pytest.raises(ValueFault, match="wear_coefficient = .* must not be used.*held="):
        result.wear_unit_parameters(61.3, 1e-3)


def test_one_weighing_each_does_not_determine_the_running_in():
    tests = planted_tests(readings=1, seed=1)
    assert set(fit(tests).flags) == {"wear_coefficient", "run_in_ratio", "run_in_distance"}
    assert fit(tests).flags["run_in_distance"].startswith("any value fits")
    assert not fit(tests, held=NO_RUN_IN).flags


@pytest.mark.parametrize("seed", range(5))
def test_no_running_in(seed):
    tests = planted_tests(law=law_of(r=1.0), seed=seed)
    assert "hold run_in_ratio 1" in fit(tests).flags["run_in_distance"]
    result = fit(tests, reference_load=40.0, held=NO_RUN_IN)
    assert not result.flags and result.estimates["wear_coefficient"] == pytest.approx(1e-4, rel=0.02)


def test_warnings():
    """Losses that the balance does not see, scatter that it does not explain, no reading left for the errors."""
    result = fit(planted_tests(hours=1.0, law=law_of(k=1e-6), seed=1))
    assert len(result.warnings) == 4 and "kappa of 1.1e-05 at 80 N, 283 m" in result.warnings[-1]
    result = fit([replace(t, balance_uncertainty=0.3 * BALANCE) for t in planted_tests(seed=1)])
    assert result.reduced_chi_square > 5.0 and result.warnings[0].startswith("reduced chi square")
    unknown = {"readings": 2, "balance_uncertainty": None, "seed": 1}
    result = fit(planted_tests((20.0,), hours=0.5, **unknown) + planted_tests((80.0,), hours=1.0, **unknown))
    assert set(result.flags) == set(PARAMETERS) and "add readings" in result.warnings[0]


def test_parameters_of_the_wear_unit_give_the_same_law():
    result = fit(planted_tests(), reference_load=40.0)
    phases = np.linspace(0.0, 2.0 * math.pi, 361)[1:]
    slide = np.mean([sliding_per_crank_angle(p, 39, 69.5e-3, 3e-3, 1.3 * 40 / 69.5) for p in phases])  # BX-40E
    unit = result.wear_unit_parameters(61.3, slide)
    assert unit["reference_line_load"] == pytest.approx(40.0 / 5e-3)
    assert unit["mesh_wear_coefficient"] == pytest.approx(1e-4) and unit["load_exponent"] == pytest.approx(0.3)
    travel = 150.0 / slide  # rad that the cranks turn while the contact slides 150 m
    factor = run_in_factor(unit["run_in_ratio"], travel, unit["run_in_time"] * unit["run_in_crank_speed"])
    assert factor == pytest.approx(1.0 + 4.0 * math.exp(-1.5), rel=1e-6)
    assert result.wear_unit_parameters(122.6, slide)["run_in_time"] == pytest.approx(0.5 * unit["run_in_time"])
    with pytest.raises(ValueFault, match="per_crank_radian = 0.0 m/rad"):
        result.wear_unit_parameters(61.3, 0.0)
    with pytest.raises(ValueFault, match="contact_length = None m"):
        fit(planted_tests(contact_length=None)).wear_unit_parameters(61.3, slide)


@pytest.mark.parametrize("change, message", [
    ({"normal_force": -20.0}, "80 N: normal_force = -20.0 N: it must be a number in .* N; give"),
    ({"rotational_speed": math.nan}, "rotational_speed = nan rev/s.*30 rpm = 0.5"),
    ({"hardness": 61.0}, "hardness = 61.0 Pa.*60 to 62 HRC"),
    ({"density": None}, "density = None kg/m.3.*steel 7850"),
    ({"balance_uncertainty": 0.1}, "balance_uncertainty = 0.1 kg.*0.1 mg = 1e-7"),
    ({"times": (0.0, 60.0)}, "reading 1: times = 0.0 s.*leave out time 0"),
    ({"times": (60.0, 60.0)}, "times = .60.0, 60.0. s.*each time once and in order"),
    ({"times": (60.0,)}, "times = .60.0,. s and 2 mass_losses .kg.*one loss per time"),
    ({"times": (), "mass_losses": ()}, "at least one reading"),
    ({"mass_losses": (1e-6, "lost")}, "reading 2: mass_losses = lost kg: it must be a number"),
])
def test_bad_test(change, message):
    good = PinOnDiscTest(80.0, 0.025, 0.5, 7e9, 7850.0, (60.0, 120.0), (1e-6, 2e-6), name="80 N")
    with pytest.raises(ValueFault, match=message):
        replace(good, **change)


@pytest.mark.parametrize("arguments, message", [
    ({"tests": []}, "tests: 0.*one test or more"),
    ({"reference_load": 0.0}, "reference_load = 0.0 N"),
    ({"held": {"exponent": 0.3}}, "held = .'exponent': 0.3.: hold some, but not all, of wear_coefficient"),
    ({"held": {"run_in_ratio": 0.0}}, "held: run_in_ratio = 0.0 1: it must be a number"),
    ({"tests": planted_tests((20.0,)) + planted_tests((80.0,), contact_length=4e-3)}, "length .'0.004', '0.005'. m"),
    ({"tests": planted_tests((20.0,)) + planted_tests((80.0,), balance_uncertainty=None)}, "in all or in none"),
    ({"tests": [replace(t, mass_losses=0.0 * t.distances) for t in planted_tests()]}, "nothing is worn; slide further"),
])
def test_bad_fit(arguments, message):
    with pytest.raises(ValueFault, match=message):
        fit(**{"tests": planted_tests()} | arguments)


def test_wear_unit_does_not_import_the_plant():
    code = "import sys, wear_fmu.pin_on_disc; sys.exit(any(m.split('.')[0] == 'rv_plant' for m in sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
