"""Tangent of the equilibrium against finite differences, contacts against the complex twin."""

import numpy as np
import pytest
from stand import gradient, imperfect, in_equilibrium
from twin import Twin

from rv_plant.assembly import assemble
from rv_plant.topology import Topology
from rv_plant.variables import plant_table

ANGLE, CAGE, LOAD = 0.123, 0.3, 167.0
SOFT = {
    "crank_support_compliance": 1 / 1.4e8, "main_bearing_compliance": 1 / 3e8, "first_stage_compliance": 1e-8,
    "housing_compliance": 1e-7,
}
TOPOLOGIES = {
    "2 discs, 2 cranks": Topology(2, 2, 40, 39, 16),
    "2 discs, 3 cranks": Topology(2, 3, 40, 39, 16),
    "1 disc, 2 cranks": Topology(1, 2, 40, 39, 16),
    "3 discs, 3 cranks": Topology(3, 3, 40, 39, 16),
}
# Each is compiled: what one disc does, two and three do as well.
EVERY_TOPOLOGY = pytest.mark.parametrize("topology", [
    pytest.param(topology, id=name, marks=pytest.mark.campaign if name.startswith("1 disc") else ()) for name, topology in TOPOLOGIES.items()
])  # fmt: skip


def loaded(topology, supports, seed=3, without=(), **values):
    """A record near its equilibrium under load, every contact clear of the verge of touching."""
    table = plant_table(topology)
    errors = {k: v for k, v in imperfect(table, seed).items() if k not in without}
    values = {"load_torque": LOAD, "bearing_clearance": 2.5e-6, **errors, **supports, **values}
    record = in_equilibrium(table, ANGLE, CAGE, **values)
    move = np.random.default_rng(seed).uniform(-2e-7, 2e-7, len(record.z))
    twin = Twin(record, ANGLE, CAGE)
    free = record.free[: record.free_count].copy()
    record.z[free] += np.where(twin.is_turning(), move / record.pin_circle_radius, move)[free]
    return record, twin, free


@EVERY_TOPOLOGY
@pytest.mark.parametrize("supports", [{}, SOFT], ids=["rigid supports", "compliant supports"])
def test_tangent_is_the_derivative_of_the_residual(topology, supports):
    record, twin, free = loaded(topology, supports)

    def residual(z):
        record.z[:] = z
        assemble(record, ANGLE, CAGE, LOAD)
        return record.residual_vector.copy()

    place = record.z.copy()
    # The force's second derivative has a pole where a contact begins.
    assert min(abs(p).min() for p in twin.penetrations(place)) > 5e-9
    lengths = np.where(twin.is_turning(), 5e-10 / record.pin_circle_radius, 5e-10)
    expected = gradient(residual, place, lengths)[np.ix_(free, free)]
    residual(place)
    tangent = np.triu(record.tangent) + np.triu(record.tangent, 1).T
    tangent = tangent[np.ix_(free, free)]
    assert len(free) == len(place) if supports else len(free) == 3 * topology.discs + 1
    stiffness = np.sqrt(np.diag(tangent))
    assert np.max(np.abs(tangent - expected) / np.outer(stiffness, stiffness)) < 1e-6


@EVERY_TOPOLOGY
@pytest.mark.parametrize("modification", [{}, {"equidistant_modification": 5e-6, "shift_modification": -8e-6}],
                         ids=["ideal profile", "modified profile"])
def test_contact_forces_against_the_twin(topology, modification):
    """Displaced parts with every error.  Pitch errors and the turning of the pin ring are left out:
    the plant takes both along the tangent, 1e-11 m beside the circle."""
    supports = {k: v for k, v in SOFT.items() if k != "housing_compliance"}
    record, twin, _ = loaded(topology, supports, without=("lobe_pitch_error",), **modification)
    assemble(record, ANGLE, CAGE, LOAD)
    mesh, roller = twin.forces(record.z)
    assert (mesh > 0).sum() > 3 * topology.discs and (roller > 0).sum() > 3 * topology.discs
    assert record.mesh_force_now == pytest.approx(mesh, abs=1e-9 * mesh.max())
    assert record.roller_force_now == pytest.approx(roller, abs=1e-9 * roller.max())


def test_residual_is_the_left_over_of_the_twins_free_bodies(rv20e):
    record, twin, free = loaded(TOPOLOGIES["2 discs, 2 cranks"], {}, without=("lobe_pitch_error",))
    assemble(record, ANGLE, CAGE, LOAD)
    left_over = twin.left_over(record.z)
    # The plant writes disc forces in the frame of the eccentric direction and the gradient
    # of the energy in place of the force: signs turn.
    eccentric = np.exp(1j * (2 * np.pi * np.arange(2) / 2 - 39 * ANGLE))
    for d in range(2):
        force = complex(left_over[3 * d], left_over[3 * d + 1]) / eccentric[d]
        assert complex(*record.residual_vector[3 * d : 3 * d + 2]) == pytest.approx(-force, abs=1e-5)
        assert abs(force) > 1.0
        assert record.residual_vector[3 * d + 2] == pytest.approx(-left_over[3 * d + 2], abs=1e-6)
    assert record.residual_vector[6] == pytest.approx(-left_over[6], abs=1e-6)
