"""Symmetries of plant and wear: a mirror, turning by a pin pitch, other units of measurement."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mirror import Measures, backwards, between_backwards, mirrored_contacts, mirrored_parts, turned_parts
from properties import assert_near
from stand import crank_period, imperfect, only, pair_of, steps_together

from rv_plant import plant

# Some 50 h a step.
ACCELERATION = 1e8
# What the tolerance of the equilibrium leaves.
SHARE = 1e-6

sizes = st.floats(0.0, 4e-6)
seeds = st.integers(0, 2**20)
cages = st.floats(-3.0, 3.0)
# Of the output: no pin stands at a root, where the errors of one lobe give way to those of the next.  A step leads to
# such a place again, and over one halfway.
ROOTS = 39 * 40
angles = st.builds(lambda root, beyond: 2.0 * np.pi * (root + beyond) / ROOTS, st.integers(-ROOTS // 2, ROOTS // 2), st.floats(0.05, 0.45))
loads = st.one_of(st.floats(20.0, 400.0), st.floats(-400.0, -20.0))
# Of the reducer: what holds for all of its parts.
settings = st.fixed_dictionaries(
    {"bearing_clearance": st.floats(-3e-6, 1e-5), "load_torque": loads},
    optional={
        "crank_support_compliance": st.floats(1e-9, 1e-8), "main_bearing_compliance": st.floats(1e-9, 1e-8),
        "first_stage_compliance": st.floats(1e-9, 3e-8), "housing_compliance": st.floats(1e-8, 1e-7),
        "angle_modification": st.floats(0.0, 2e-5), "equidistant_modification": st.floats(0.0, 5e-6),
        "shift_modification": st.floats(-5e-6, 0.0), "contact_law": st.integers(0, 2), "carrier_compliance": st.floats(0.0, 1e-6),
    },
)  # fmt: skip


def run(reducer, steps=3, **values):
    """Records of plant and wear after some coupled steps."""
    machine, surface = pair_of(reducer, **values)
    assert plant.initialise(machine) == 0
    surface["acceleration"] = ACCELERATION
    for _ in steps_together(machine, surface, crank_period(machine) / 40, steps):
        pass
    return only(machine), only(surface)


@given(settings, seeds, sizes, angles, cages)
def test_mirrored_parts_turned_the_other_way_carry_mirrored_forces_and_wear_as_deep(rv20e, values, seed, size, angle, cage):
    parts = imperfect(rv20e.plant, seed, size)
    ahead = run(rv20e, ideal_output=angle, cage=cage, **values, **parts)
    speed = rv20e.starts["input_speed"]
    reversed_run = {**values, "load_torque": -values["load_torque"], "input_speed": -speed}
    back = run(rv20e, ideal_output=-angle, cage=-cage, **reversed_run, **mirrored_parts(parts, rv20e))
    (machine, surface), (other, other_surface) = ahead, back
    for name in ("mesh_force", "roller_force", "mesh_profile_error", "roller_profile_error"):
        assert_near(other[name], mirrored_contacts(machine[name]), SHARE, name)
    for name in ("lag", "drive_torque", "reaction_torque", "transmission_error", "crank_angle", "output_angle", "housing_force_y"):
        assert_near(other[name], -machine[name], SHARE, name, machine.largest_pin_force if name == "housing_force_y" else 0.0)
    for name in ("contact_pressure", "largest_pin_force", "housing_force_x"):
        assert_near(other[name], machine[name], SHARE, name, machine.largest_pin_force)
    discs, bins = surface.disc_wear.shape
    lobes = between_backwards(discs, bins)(bins // rv20e.topology.lobes)
    flanks = np.take_along_axis(surface.disc_wear[backwards(discs)], lobes, 1)
    assert_near(other_surface.disc_wear, flanks, SHARE)
    assert_near(other_surface.pin_even_wear, mirrored_contacts(surface.pin_even_wear), SHARE)
    for name in ("inner_race_wear", "outer_race_wear"):
        races = surface[name][backwards(discs)][:, backwards(rv20e.topology.cranks)][:, :, ::-1]
        assert_near(other_surface[name], races, SHARE, name)
    for name in ("flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume"):
        assert_near(other_surface[name], surface[name], SHARE, name)


@given(settings, seeds, sizes, angles, cages, st.integers(1, 40))
def test_turned_by_whole_pin_pitches_the_next_pins_carry_the_same_forces(rv20e, values, seed, size, angle, cage, pitches):
    pins, lobes = rv20e.topology.pins, rv20e.topology.lobes
    parts = imperfect(rv20e.plant, seed, size)
    first = run(rv20e, ideal_output=angle, cage=cage, **values, **parts)
    turned = angle + 2.0 * np.pi * pitches / pins
    later = run(rv20e, ideal_output=turned, cage=cage, **values, **turned_parts(parts, rv20e, pitches))
    (machine, surface), (other, other_surface) = first, later
    for name in ("mesh_force", "mesh_profile_error"):
        assert_near(other[name], np.roll(machine[name], pitches, axis=1), SHARE, name)
    for name in ("roller_force", "lag", "drive_torque", "transmission_error", "contact_pressure", "loaded_teeth", "tooth_force"):
        assert_near(other[name], machine[name], SHARE, name)
    force, turn = machine.housing_force_x + 1j * machine.housing_force_y, np.exp(2j * np.pi * pitches / pins)
    assert_near(other.housing_force_x + 1j * other.housing_force_y, force * turn, SHARE, scale=machine.largest_pin_force)
    assert other.crank_angle == pytest.approx(machine.crank_angle - lobes * (turned - angle), abs=1e-9)
    for name in ("disc_wear", "inner_race_wear", "outer_race_wear", "flank_volume", "pin_volume"):
        assert_near(other_surface[name], surface[name], SHARE, name)
    assert_near(other_surface.pin_even_wear, np.roll(surface.pin_even_wear, pitches, axis=1), SHARE)


factors = st.floats(0.6, 1.6)
# Forces at 1 mm, by the exponent of their law.
AT_1_MM = {"mesh_stiffness": 10 / 9, "roller_stiffness": 10 / 9, "mesh_stiffness_lankarani": 1.5, "roller_stiffness_lankarani": 1.5}
# What tells how often something was done, and where of several places as deep the deepest is.
UNSTEADY = ("residual", "iterations", "substeps", "flank_phase", "flank_lobe", "inner_race_angle", "outer_race_angle")


def measured(reducer, values, measures):
    """All parameters and inputs of both units, with ``values`` in place of their starts, as other units measure them."""
    result = {}
    for table in (reducer.plant, reducer.wear):
        start = only(table.new_records())
        for v in table.of_role("parameter", "input"):
            factor = measures.at_1_mm(AT_1_MM[v.name]) if v.name in AT_1_MM else measures.factor(v.unit)
            result[v.name] = values.get(v.name, start[v.name]) * (1 if v.is_integer else factor)
    # Where the plant starts is no parameter.
    return {**result, "ideal_output": values["ideal_output"]}


@given(settings, seeds, sizes, angles, factors, factors, factors)
def test_lengths_masses_and_times_measured_otherwise_give_the_same_reducer(rv20e, values, seed, size, angle, length, mass, time):
    """Every formula of both units is consistent in its dimensions, and every variable is in the unit that it says."""
    measures = Measures(length, mass, time)
    # Palmgren's constant is one of steel in newtons and millimetres.
    values = {**values, **imperfect(rv20e.plant, seed, size), "contact_law": seed % 2, "pins": seed // 2 % 2, "ideal_output": angle}
    plain, scaled = run(rv20e, **values), run(rv20e, **measured(rv20e, values, measures))
    for table, before, after in zip((rv20e.plant, rv20e.wear), plain, scaled):
        for v in table.of_role("output", "state"):
            if (v.role == "output" or v.profile) and v.name not in UNSTEADY:
                expected = before[v.name] * measures.factor(v.unit)
                assert_near(after[v.name], expected, SHARE, v.name, after.largest_pin_force if v.unit == "N" else 0.0)
