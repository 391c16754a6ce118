"""Contacts carried on from a known position: against the whole geometry, and in equilibria along a turn."""

import numpy as np
import pytest
from stand import crank_period, imperfect, in_equilibrium, only, records_of

from rv_plant import plant
from rv_plant.assembly import add_all, assemble
from rv_plant.contact import BESIDE, contact_force, force_beside
from rv_plant.equilibrium import relative_residual
from rv_plant.geometry import centre_curve_curvature, curvature_and_slopes
from rv_plant.near_mesh import EXACT, MISSED, NEAR, missed, way_from_place
from rv_plant.plant import assemble_at_input
from studies import coupled

ANGLE, CAGE = 0.7, 0.2


@pytest.mark.parametrize("reducer", ["rv20e", "bx40e"])
@pytest.mark.parametrize("size, share", [(1e-8, 1e-10), (1e-7, 2e-10), (EXACT, MISSED)])
def test_carried_contacts_are_those_of_the_whole_geometry(request, reducer, size, share):
    """Ring and discs moved any way by ``size`` at the pins: what is out of balance agrees to a share of what residuals are weighed with."""
    table, random = request.getfixturevalue(reducer).plant, np.random.default_rng(4)
    errors = imperfect(table, 5, 2e-6)
    for angle in (0.0, 0.3, 1.9):
        r = in_equilibrium(table, angle, CAGE, housing_compliance=1e-9, **errors)
        for _ in range(5):
            assemble(r, angle, CAGE, r.load_torque)
            known = r.z.copy()
            moves = random.uniform(-1.0, 1.0, r.z.size) * size / 3.0
            turning = [3 * d + 2 for d in range(r.mesh_force.shape[0])] + [r.z.size - 1]
            moves[turning] /= r.pin_circle_radius
            r.z[:] = known + moves
            assert way_from_place(r) < NEAR
            add_all(r, angle, CAGE, r.load_torque, True, False)
            near, tangent = r.residual_vector.copy(), np.triu(r.tangent).copy()
            forces, loaded, phases = r.mesh_force_now.copy(), r.loaded_teeth.copy(), r.mesh_phase.copy()
            assemble(r, angle, CAGE, r.load_torque)
            scale = max(abs(r.load_torque) / r.pin_circle_radius, r.mesh_force_now.max(), r.roller_force_now.max())
            lever = np.where(np.isin(np.arange(near.size), turning), r.pin_circle_radius, 1.0)
            assert np.abs((near - r.residual_vector) / lever)[: r.z.size].max() < share * scale
            assert forces == pytest.approx(r.mesh_force_now, abs=10.0 * share * scale)
            assert np.array_equal(loaded, r.loaded_teeth)
            # Friction and sliding read where on the flank a contact stands.
            assert phases[forces > 0.0] == pytest.approx(r.mesh_phase[forces > 0.0], abs=3e-6)
            assert tangent == pytest.approx(np.triu(r.tangent), rel=1e-3, abs=1e-3 * np.abs(r.tangent).max())
            r.z[:] = known


@pytest.mark.parametrize("reducer", ["rv20e", "bx40e"])
@pytest.mark.parametrize("positions", [18, 72])
def test_equilibria_meet_their_tolerance_with_the_whole_geometry(request, reducer, positions):
    table = request.getfixturevalue(reducer).plant
    random = np.random.default_rng(6)
    records = records_of(table, largest_crank_step=1.0)
    assert plant.initialise(records) == 0
    records["mesh_profile_error"] = random.uniform(0.0, 2e-6, records["mesh_profile_error"].shape)
    step, ways = crank_period(records) / positions, []
    for _ in range(40):
        assert plant.step(records, 0.0, step) == 0
        r = only(records)
        ways.append(way_from_place(r))
        assert r.residual + missed(r) <= r.tolerance
        whole = only(records.copy())
        assemble_at_input(whole)
        assert relative_residual(whole, whole.load_torque) <= r.tolerance
    # That is what it is for: most are found without a second look at the geometry.
    assert np.median(ways) > 1e-8


def test_what_may_be_missed_goes_with_the_third_power(rv20e):
    r = in_equilibrium(rv20e.plant, ANGLE, CAGE)
    assemble(r, ANGLE, CAGE, r.load_torque)
    assert missed(r) == 0.0
    r.z[0] += EXACT
    assert missed(r) == pytest.approx(MISSED, rel=1e-6)
    r.z[0] += EXACT
    assert missed(r) == pytest.approx(8.0 * MISSED, rel=1e-6)


@pytest.mark.parametrize("phase", [0.05, 0.4, 1.1, 2.6, -0.7])
def test_curvature_and_its_derivatives(phase):
    lobes, circle, k1 = 39, 52e-3, 0.9 * 40 / 52
    along = lambda p: circle * np.sqrt(1.0 + k1**2 - 2.0 * k1 * np.cos(p)) / lobes
    curvature = lambda p: centre_curve_curvature(p, lobes, circle, k1)
    slope = lambda p, h=1e-4: (curvature(p + h) - curvature(p - h)) / (2.0 * h * along(p))
    found = curvature_and_slopes(np.cos(phase), np.sin(phase), lobes, circle, k1)
    assert found[0] == pytest.approx(curvature(phase), rel=1e-12)
    assert found[1] == pytest.approx(slope(phase), rel=1e-5)
    assert found[2] == pytest.approx((slope(phase + 1e-4) - slope(phase - 1e-4)) / (2e-4 * along(phase)), rel=1e-4)


@pytest.mark.parametrize("exponent", [1.0, 10 / 9, 1.5, 2.0])
def test_a_force_beside_a_known_one_is_that_of_the_law(exponent):
    stiffness, known = 7e11, 1.3e-6
    force, _ = contact_force(known, stiffness, exponent)
    for share in (-5.0, -1.0, -0.99, -0.02, -1e-4, 0.0, 3e-3, 0.0199, 0.3):
        penetration = known * (1.0 + share)
        expected = contact_force(penetration, stiffness, exponent)
        assert force_beside(penetration, known, force, stiffness, exponent) == pytest.approx(expected, rel=1e-12, abs=0)
    assert force_beside(1e-7, 0.0, 0.0, stiffness, exponent) == contact_force(1e-7, stiffness, exponent)
    assert BESIDE < 0.05


def held(records, torques, carried):
    """Transmission error under ``torques`` with the input held, the geometry carried on from one to the next or reckoned anew."""
    found, places = np.zeros(len(torques)), np.zeros((len(torques), records["z"].shape[1]))
    if carried:
        assert coupled.torque_sweep(records, torques, found, places, places, False) == 0
        return -found
    for k, torque in enumerate(torques):
        records["load_torque"] = torque
        assert plant.step(records, 0.0, 1.0) == 0
        found[k] = records["transmission_error"][0]
    return found


@pytest.mark.parametrize(
    "effects",
    [{}, {"tilting_share_x": 0.5, "tilting_share_y": -0.3}, {"pin_seat_compliance": 2e-9}, {"thermal_expansion": 1e-5}, {"housing_compliance": 2e-8}],
    ids=lambda e: ", ".join(e) or "none",
)  # fmt: skip
def test_a_loop_whose_geometry_is_carried_on_is_that_reckoned_anew(rv20e, effects):
    """Small steps, of which several are carried on, and large ones; with what moves the ring by the torque, or all along."""
    up = np.concatenate([np.linspace(2.0, 160.0, 120), [80.0, 20.0]])
    torques = np.concatenate([up, -up])
    found = []
    for carried in (True, False):
        records = records_of(rv20e.plant, load_torque=2.0, temperature=313.15, tolerance=1e-9, **imperfect(rv20e.plant, 5, 2e-6), **effects)
        assert plant.initialise(records) == 0
        records["input_speed"] = 0.0
        found.append(held(records, torques, carried))
    assert np.ptp(found[0]) > 1e-5 and found[0] == pytest.approx(found[1], abs=1e-12)
