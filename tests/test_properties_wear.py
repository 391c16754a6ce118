"""Wear: never negative, never less, linear in the coefficient and in the hours; what is put on a surface is there."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from properties import assert_near, examples
from stand import only, records_of

from wear_fmu import accumulator
from wear_fmu.kinematics import flank_arc_per_phase, sliding_per_crank_angle
from wear_fmu.surfaces import add_flank_pass, add_footprint, add_pass, interpolate_closed, interpolate_open

VOLUMES = ("flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume")
SURFACES = ("disc_wear", "pin_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear")
DEPTHS = ("flank_depth", "pin_depth", "inner_race_depth", "outer_race_depth")
ERRORS = ("mesh_profile_error", "roller_profile_error")

# Volume [m^3] that no figure shows: footprints of next to no force are narrower than a bin by so much that their shares lose digits.
ROUNDED = 1e-24
seeds = st.integers(0, 2**20)
# One communication step: turning of the cranks [rad] either way, of the cages [rad], hours that it stands for.
steps = st.lists(
    st.tuples(st.floats(-3.0, 3.0), st.floats(-1.0, 1.0), st.just(0.0) | st.floats(1.0, 200.0)), min_size=1, max_size=6
)  # fmt: skip
ways = st.fixed_dictionaries({
    "pins": st.integers(0, 1), "mesh_wear_law": st.integers(0, 3), "raceway_wear_law": st.integers(0, 3),
    "temperature": st.floats(250.0, 400.0), "load_exponent": st.floats(-0.5, 1.5), "run_in_ratio": st.floats(0.0, 10.0),
    "sliding_form": st.integers(0, 1),
})  # fmt: skip


def worn(table, moves, seed, **values):
    """The wear unit's record after each step, under forces that are drawn anew for each, a third of them none."""
    records = records_of(table, **values)
    assert accumulator.initialise(records) == 0
    random = np.random.default_rng(seed)
    for turning, rolling, hours in moves:
        for name in ("mesh_force", "roller_force"):
            force = random.uniform(-300.0, 600.0, table.by_name[name].shape)
            records[name] = np.maximum(force, 0.0)
        records["crank_angle"] += turning
        records["output_angle"] -= turning / 39
        records["cage_angle"] += rolling
        records["acceleration"] = hours * 3600.0 / 1e-3
        fault = accumulator.step(records, 0.0, 1e-3)
        # Laws that are not for these temperatures take whole parts away: refused, and nothing to hold a property against.
        assume(fault != accumulator.WORN_THROUGH)
        assert fault == 0
        yield only(records.copy())


@given(steps, seeds, ways)
def test_wear_is_never_negative_and_never_grows_less(rv20e, moves, seed, values):
    before = only(rv20e.wear.new_records())
    for record in worn(rv20e.wear, moves, seed, **values):
        for name in (*SURFACES, *DEPTHS, *VOLUMES, "operating_time", "crank_travel"):
            assert (record[name] >= before[name]).all(), name
            assert np.isfinite(record[name]).all(), name
        for name in ERRORS:
            assert (record[name] >= 0.0).all(), name
        before = record


@given(steps, seeds, ways, st.floats(0.01, 100.0))
def test_depth_goes_with_the_coefficient(rv20e, moves, seed, values, times):
    """By the laws that have one; no effect looks back at the depth."""
    values = {**values, "mesh_wear_law": values["mesh_wear_law"] % 2, "raceway_wear_law": values["raceway_wear_law"] % 2}
    names = ("mesh_wear_coefficient", "raceway_wear_coefficient")
    *_, once = worn(rv20e.wear, moves, seed, **values)
    *_, more = worn(rv20e.wear, moves, seed, **values, **{name: times * rv20e.starts[name] for name in names})
    for name in (*SURFACES, *DEPTHS, *VOLUMES, *ERRORS):
        assert_near(more[name], times * once[name], 1e-9, name)


@given(steps, seeds, ways, st.floats(0.01, 100.0))
def test_depth_goes_with_the_hours_once_run_in(rv20e, moves, seed, values, times):
    values = {**values, "run_in_ratio": 1.0}
    *_, once = worn(rv20e.wear, moves, seed, **values)
    *_, more = worn(rv20e.wear, [(turning, rolling, times * hours) for turning, rolling, hours in moves], seed, **values)
    for name in (*SURFACES, *DEPTHS, *VOLUMES, *ERRORS, "operating_time", "crank_travel"):
        assert_near(more[name], times * once[name], 1e-9, name)


@given(steps, seeds, ways)
def test_what_a_surface_lost_is_its_volume(rv20e, moves, seed, values):
    *_, record = worn(rv20e.wear, moves, seed, **values)
    width, arc = record.mesh_width, np.tile(record.arc, rv20e.topology.lobes)
    assert (record.disc_wear * arc).sum() * width == pytest.approx(record.flank_volume, rel=1e-9, abs=ROUNDED)
    bin_arc = np.pi * record.pin_radius / record.pin_wear.shape[2]
    pins = record.pin_wear.sum() * bin_arc + record.pin_even_wear.sum() * 2.0 * np.pi * record.pin_radius
    assert pins * width == pytest.approx(record.pin_volume, rel=1e-9, abs=ROUNDED)
    # Flank and pin lose as much.
    assert record.pin_volume == pytest.approx(record.flank_volume, rel=1e-9, abs=ROUNDED)
    for race in ("inner_race", "outer_race"):
        bin_arc = 2.0 * np.pi * record[f"{race}_radius"] / record[f"{race}_wear"].shape[2]
        lost = record[f"{race}_wear"].sum() * bin_arc * record.roller_length
        assert lost == pytest.approx(record[f"{race}_volume"], rel=1e-9, abs=ROUNDED)


places, amounts = st.floats(-300.0, 300.0), st.floats(1e-12, 1e-3)


@examples(4)
@given(st.integers(3, 200), places, places, amounts)
def test_a_pass_adds_what_it_was_given(bins, start, end, amount):
    depth = np.zeros(bins)
    deepest, place = add_pass(depth, start, end, amount)
    assert depth.sum() == pytest.approx(amount * abs(end - start), rel=1e-9, abs=1e-12 * amount)
    assert (depth >= 0.0).all()
    assert deepest == depth.max() and (deepest == 0.0 or depth[place] == deepest)


@examples(4)
@given(st.integers(3, 200), places, places, st.floats(1e-3, 50.0), amounts)
def test_a_footprint_adds_what_it_was_given_beyond_the_ends_too(bins, start, end, half_width, amount):
    depth = np.zeros(bins)
    deepest, place = add_footprint(depth, start, end, half_width, amount)
    assert depth.sum() == pytest.approx(amount, rel=1e-9, abs=0)
    assert depth.min() >= -1e-12 * amount
    assert deepest == depth.max() == depth[place]


@examples(4)
@given(st.integers(3, 60), st.integers(2, 9), places, places, amounts)
def test_a_flank_pass_adds_the_area_that_it_accounts_for(bins, lobes, start, end, amount):
    phases = 2.0 * np.pi * (np.arange(bins) + 0.5) / bins
    profile = (lobes, 52e-3, 2e-3, 0.5)
    slide, arc = (np.array([f(p, *profile) for p in phases]) for f in (sliding_per_crank_angle, flank_arc_per_phase))
    depth = np.zeros(bins * lobes)
    _, _, slid = add_flank_pass(depth, start, end, amount, slide, np.concatenate([[0.0], np.cumsum(slide)[:-1]]), arc)
    assert (depth * np.tile(arc, lobes)).sum() == pytest.approx(amount * slid, rel=1e-7, abs=1e-12 * amount)


@examples(4)
@given(st.lists(st.floats(0.0, 1e-4), min_size=2, max_size=40).map(np.array), places)
def test_a_depth_between_bins_lies_between_theirs(depth, place):
    for interpolate in (interpolate_closed, interpolate_open):
        assert depth.min() <= interpolate(depth, place) * (1 + 1e-12) and interpolate(depth, place) <= depth.max() * (1 + 1e-12)
    assert interpolate_closed(depth, place + len(depth)) == pytest.approx(interpolate_closed(depth, place), rel=1e-7, abs=1e-15)
