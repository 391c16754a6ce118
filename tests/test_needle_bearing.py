"""The needle bearing against a NumPy twin, finite differences and the balance of moments."""

import numpy as np
import pytest
from stand import gradient, only, records_of

from rv_plant.needle_bearing import cage_rate, roller_contacts
from rv_plant.topology import Topology
from rv_plant.variables import plant_table

ROLLERS, STIFFNESS, EXPONENT = 16, 1.1e9, 10.0 / 9.0


def bearing(shift, first_angle, clearance, profile_error, rollers=ROLLERS):
    table = plant_table(Topology(1, 2, 40, 39, rollers))
    record = only(records_of(
        table, bearing_clearance=clearance, roller_constant=STIFFNESS, roller_exponent=EXPONENT
    ))
    record.roller_profile_error[0, 1] = profile_error
    roller_contacts(record, 0, 1, *shift, first_angle, 0.0, 0.0, 0.0, 0.0, False)
    return record.roller_force_now[0, 1].copy(), record.bearing_total.copy(), record.bearing_tangent.copy()


def cases():
    random = np.random.default_rng(11)
    for clearance in (0.0, 2.5e-6, -3e-6):
        for rollers in (16, 5):
            yield pytest.param(
                random.uniform(-8e-6, 8e-6, 2), random.uniform(-20, 20), clearance,
                random.uniform(0.0, 3e-6, rollers), id=f"clearance {clearance * 1e6:g} um, {rollers} rollers",
            )


BEARINGS = pytest.mark.parametrize("shift, first_angle, clearance, profile_error", list(cases()))


@BEARINGS
def test_forces_and_their_sum_against_numpy(shift, first_angle, clearance, profile_error):
    force, total, _ = bearing(shift, first_angle, clearance, profile_error, len(profile_error))
    angle = first_angle + 2 * np.pi * np.arange(len(profile_error)) / len(profile_error)
    outward = np.exp(1j * angle)
    approach = (complex(*shift) * outward.conj()).real - clearance - profile_error
    expected = STIFFNESS * np.maximum(approach, 0.0) ** EXPONENT
    assert (expected > 0.0).any()
    assert force == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert complex(total[0], total[1]) == pytest.approx((expected * outward).sum(), rel=1e-9, abs=0)


@BEARINGS
def test_moment_is_that_of_the_force_line_through_the_lobes_centre(shift, first_angle, clearance, profile_error):
    """What turns the hole about its centre is the pull at the lobe's centre, with opposite sign
    because the third component belongs to the gradient of the energy."""
    _, (fx, fy, moment), _ = bearing(shift, first_angle, clearance, profile_error, len(profile_error))
    assert moment == pytest.approx(-(shift[0] * fy - shift[1] * fx), rel=1e-9, abs=1e-15)


@BEARINGS
def test_force_and_moment_are_the_gradient_of_the_energy(shift, first_angle, clearance, profile_error):
    def energy(place):
        force, *_ = bearing(place[:2], first_angle + place[2], clearance, profile_error, len(profile_error))
        return np.sum((force / STIFFNESS) ** (1 / EXPONENT) * force) / (EXPONENT + 1)

    _, total, _ = bearing(shift, first_angle, clearance, profile_error, len(profile_error))
    found = gradient(energy, np.array([*shift, 0.0]), [1e-9, 1e-9, 1e-4])
    assert found == pytest.approx(total, rel=1e-6, abs=1e-6 * abs(total).max())


@BEARINGS
def test_tangent_against_finite_differences(shift, first_angle, clearance, profile_error):
    def total(place):
        return bearing(place[:2], first_angle + place[2], clearance, profile_error, len(profile_error))[1]

    _, _, tangent = bearing(shift, first_angle, clearance, profile_error, len(profile_error))
    found = gradient(total, np.array([*shift, 0.0]), [1e-10, 1e-10, 1e-5])
    scale = np.sqrt(np.outer(abs(np.diag(tangent)), abs(np.diag(tangent))))
    assert np.max(np.abs(found - tangent) / scale) < 1e-5


def test_no_force_inside_the_clearance():
    force, total, tangent = bearing((1e-6, -1e-6), 0.3, 2.5e-6, np.zeros(ROLLERS))
    assert not force.any() and not total.any() and not tangent.any()


def test_profile_error_takes_a_roller_out_of_contact():
    error = np.zeros(ROLLERS)
    loaded, *_ = bearing((5e-6, 0.0), 0.0, 0.0, error)
    error[0] = 6e-6
    relieved, *_ = bearing((5e-6, 0.0), 0.0, 0.0, error)
    assert loaded[0] > 0.0 and relieved[0] == 0.0
    assert (relieved[1:] == loaded[1:]).all()


def test_cage_turns_with_the_mean_of_the_surface_speeds():
    """A roller that does not slip has the mean of both surfaces' speeds at its centre."""
    crank, disc, inner, outer = -67.5, 1.73, 10.25e-3, 13.25e-3
    centre_speed = 0.5 * (crank * inner + disc * outer)
    cage = centre_speed / (0.5 * (inner + outer))
    assert cage_rate(crank, disc, inner, outer) == pytest.approx(cage - disc, rel=1e-12, abs=0)


def test_literature_roller_passages():
    """RV20E at 2000 rpm: 5965 passages a minute on the inner raceway, 4614 on the outer; cage order 17.4."""
    output = 2000.0 / 121.0
    crank = -39.0 * output
    cage = cage_rate(crank, output, 10.25e-3, 13.25e-3)
    assert abs(cage) * ROLLERS == pytest.approx(4614, abs=1)
    assert abs(crank - output - cage) * ROLLERS == pytest.approx(5965, abs=1)
    assert abs(cage) / output == pytest.approx(17.4, abs=0.05)
