"""Output by pins in holes of the disc: balance of the bodies cut free, tangent, play, faults."""

from dataclasses import replace

import numpy as np
import pytest
from stand import gradient, in_equilibrium, only, records_of
from twin import Twin, cross, directions

from fmu_src.faults import InputFault
from reducers.reducer import load_reducer
from rv_plant import faults, plant
from rv_plant.assembly import assemble
from rv_plant.equilibrium import equilibrium
from rv_plant.faults import FAULTS
from rv_plant.topology import Topology
from rv_plant.variables import plant_table

ANGLE, CAGE = 0.0871, 0.4


@pytest.fixture(scope="module")
def drive():
    return load_reducer("cycloidal-actuator")


class PinTwin(Twin):
    """The twin with output pins; a pin touches its hole along the line from hole to pin."""

    def pins_and_holes(self, z):
        arms = self.r.output_circle_radius * directions(self.r.output_pin_force.shape[1])
        pin = self.carrier_shift + arms * np.exp(1j * (self.output + z[self.carrier]))
        return pin, self.disc_centre[:, None] + arms * np.exp(1j * self.disc_turn)[:, None]

    def output_forces(self, z):
        """Of the pins on the disc [disc, pin], complex."""
        pin, hole = self.pins_and_holes(z)
        away = pin - hole
        depth = abs(away) - self.r.eccentricity - self.r.output_clearance
        stiffness = self.r.output_stiffness * 1000.0 ** (10 / 9)
        return stiffness * np.maximum(depth, 0.0) ** (10 / 9) * away / abs(away)

    def balance(self, z, mesh, roller):
        found = super().balance(z, mesh, roller)
        push = self.output_forces(z)
        pin, hole = self.pins_and_holes(z)
        found["disc force"] = found["disc force"] + push.sum(axis=1)
        found["disc moment"] = found["disc moment"] + cross(hole - self.disc_centre[:, None], push).sum(axis=1)
        found["carrier moment"] = found["carrier moment"] - cross(pin, push).sum()
        return found


def balanced(table, **values):
    record = in_equilibrium(table, ANGLE, CAGE, **values)
    twin = PinTwin(record, ANGLE, CAGE)
    return record, twin, twin.balance(record.z, record.mesh_force_now, record.roller_force_now)


@pytest.mark.parametrize("values", [
    {}, {"load_torque": -20.0}, {"load_torque": 0.5}, {"output_clearance": 0.3e-3}, {"output_clearance": -0.01e-3},
    {"main_bearing_compliance": 1e-7}, {"crank_support_compliance": 1e-7, "housing_compliance": 1e-5},
], ids=lambda v: ", ".join(f"{k} {x:g}" for k, x in v.items()) or "as the file")  # fmt: skip
def test_every_body_is_in_balance(drive, values):
    record, twin, left_over = balanced(drive.plant, **values)
    load = abs(twin.load)
    assert np.abs(left_over["disc force"]).max() < 1e-6 * load / record.pin_circle_radius
    assert np.abs(left_over["disc moment"]).max() < 1e-6 * load
    assert abs(left_over["carrier moment"]) < 1e-6 * load
    push = twin.output_forces(record.z)
    assert record.output_pin_force == pytest.approx(abs(push), rel=1e-9, abs=1e-6)
    # The pins carry the whole load, the ring load and input.
    pin, _ = twin.pins_and_holes(record.z)
    assert -cross(pin - twin.carrier_shift, push).sum() == pytest.approx(twin.load, rel=1e-6)
    assert twin.pin_moment.sum() == pytest.approx(record.load_torque - record.drive_torque, rel=1e-6)
    if record.output_clearance >= 0.0:
        # Half of them at most push the same way round.
        assert 1 <= np.count_nonzero(push) <= 4


# A second topology is compiled anew.
@pytest.mark.parametrize("discs", [1, pytest.param(2, marks=pytest.mark.campaign)])
def test_mean_ring_moment_is_the_load_and_a_lobe_more(drive, discs):
    table = plant_table(Topology(discs, 1, 14, 13, 13, 8)).with_starts(drive.starts, drive.sources)
    record = in_equilibrium(table)
    turn = 2.0 * np.pi / 13 / 14 * 13
    moments = []
    for i in range(400):
        assert equilibrium(record, turn * i / 400, 0.0, record.load_torque)
        moments.append(-record.crank_moment.sum())
    # Cranks against the carrier once round; the holes repeat with it.
    assert np.mean(moments) == pytest.approx(-record.load_torque / 13, rel=2e-3)


def test_tangent_is_the_derivative_of_the_residual(drive):
    record = in_equilibrium(drive.plant, ANGLE, CAGE, main_bearing_compliance=1e-7, crank_support_compliance=1e-7,
                            housing_compliance=1e-5)  # fmt: skip
    free = record.free[: record.free_count].copy()
    twin = Twin(record, ANGLE, CAGE)
    lengths = np.where(twin.is_turning(), 1e-9 / record.pin_circle_radius, 1e-9)
    place = record.z.copy()

    def residual(z):
        record.z[:] = z
        assemble(record, ANGLE, CAGE, record.load_torque)
        return record.residual_vector.copy()

    expected = gradient(residual, place, lengths)[np.ix_(free, free)]
    residual(place)
    tangent = (np.triu(record.tangent) + np.triu(record.tangent, 1).T)[np.ix_(free, free)]
    stiffness = np.sqrt(np.diag(tangent))
    assert np.max(np.abs(tangent - expected) / np.outer(stiffness, stiffness)) < 1e-6


def turning(drive, torque, **values):
    """Turning of the output under a torque [rad], mean over 32 positions of the crank."""
    found = []
    for k in range(32):
        record = in_equilibrium(drive.plant, 2.0 * np.pi * k / 32 / 13, load_torque=torque, input_speed=0.0, **values)
        found.append(record.z[3])
    return -np.mean(found)


def test_play_of_the_pins_is_their_clearance_over_their_circle(drive):
    stiff = {"mesh_stiffness": 1e7, "roller_stiffness": 1e7, "output_stiffness": 1e7, "bearing_clearance": 0.0,
             "equidistant_modification": 0.0}  # fmt: skip
    play = [turning(drive, 1.0, output_clearance=c, **stiff) - turning(drive, -1.0, output_clearance=c, **stiff)
            for c in (0.0, 0.1e-3, 0.2e-3)]  # fmt: skip
    assert play[0] < 1e-4
    # The pin nearest to the line across the eccentric touches first; of 8 none is further off than 22.5 degrees.
    least = 2 * 0.1e-3 / 20e-3
    nearest = [np.abs(((np.arange(8) / 8 - 14 * k / 32 / 13 + 0.25) * 360 + 22.5) % 45 - 22.5).min() for k in range(32)]
    expected = least * np.mean(1.0 / np.cos(np.radians(nearest)))
    assert play[1] == pytest.approx(expected, rel=0.02)
    assert play[2] == pytest.approx(2 * expected, rel=0.02)


@pytest.mark.parametrize("values, fault", [
    ({"output_pin_radius": 9e-3}, faults.OUTPUT_HOLES_OVERLAP), ({"output_circle_radius": 24e-3}, faults.OUTPUT_HOLES_OPEN),
    ({"fidelity": 1}, faults.OUTPUT_PINS_AT_REST),
])  # fmt: skip
def test_impossible_holes_are_refused(drive, values, fault):
    assert plant.initialise(records_of(drive.plant, **values)) == fault
    assert FAULTS[fault].format(**{n: only(records_of(drive.plant, **values))[n] for n in (
        "output_pin_radius", "output_circle_radius", "eccentricity", "outer_race_radius")})  # fmt: skip


def test_cranks_on_the_axis_need_output_pins(rv20e):
    assert plant.initialise(records_of(rv20e.plant, crank_circle_radius=0.0)) == faults.CRANKS_ON_AXIS


@pytest.mark.parametrize("old, new, text", [
    ("output_pins = 8", "output_pins = 2", "at least 3"), ("output_pins = 8", "", "one crank cannot turn"),
    ("cranks = 1 ", "cranks = 2 ", "set cranks = 1"),
])  # fmt: skip
def test_reducer_file_says_what_is_wrong(tmp_path, drive, old, new, text):
    path = tmp_path / "other.toml"
    path.write_text(drive.path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    with pytest.raises(InputFault, match=text):
        load_reducer(path)


def test_an_rv_reducer_has_no_output_pins(rv20e):
    record = in_equilibrium(rv20e.plant)
    assert record.output_pin_force.shape == (2, 1) and not record.output_pin_force.any()
    assert replace(rv20e.topology).output_pins == 0
