"""The wear unit: balance of material, kinematics over many turns, run-in, convergence."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad
from stand import exchange, only, records_of, run_coupled

from wear_fmu import accumulator
from wear_fmu.kinematics import sliding_per_crank_angle

LOBES, PINS, TURNS = 39, 40, 39
DEPTHS = ("flank_depth", "pin_depth", "inner_race_depth", "outer_race_depth")
VOLUMES = ("flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume")
SURFACES = ("disc_wear", "pin_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear")
TURNING, STANDING = 0, 1
CONSTANT = {"mesh_wear_law": 0, "raceway_wear_law": 0}


def cage_angle(record, crank):
    """Of ideal kinematics: rollers roll between a crank and a disc that turns by -1/z_c of it."""
    inner, outer = record.inner_race_radius, record.outer_race_radius
    return crank * (1 + 1 / LOBES) * inner / (inner + outer)


def turned(reducer, path, duration=1.0, mesh_force=0.0, roller_force=0.0, start=0.0, **values):
    """The wear unit driven along crank angles by ideal kinematics under constant forces."""
    records = records_of(reducer.wear, crank_angle=start, **values)
    record = only(records)
    record.output_angle, record.cage_angle = -start / LOBES, cage_angle(record, start)
    assert accumulator.initialise(records) == 0
    record.mesh_force, record.roller_force = mesh_force, roller_force
    for i, angle in enumerate(path):
        record.crank_angle, record.output_angle, record.cage_angle = angle, -angle / LOBES, cage_angle(record, angle)
        assert accumulator.step(records, i * duration, duration) == 0
    return record


def one_pin(force=1.0, disc=0, pin=0):
    forces = np.zeros((2, PINS))
    forces[disc, pin] = force
    return forces


@pytest.fixture(scope="module")
def coupled(rv20e):
    """Machine and surface after 200 h in one meshing cycle, with either kind of pins."""
    return {pins: run_coupled(rv20e, 200.0, pins=pins) for pins in (TURNING, STANDING)}


@pytest.mark.parametrize("pins", [TURNING, STANDING], ids=["turning pins", "standing pins"])
def test_volumes_are_the_sums_over_the_bins(coupled, pins):
    _, r = coupled[pins]
    flanks = np.sum(r.disc_wear.reshape(2, LOBES, -1) * r.arc) * r.mesh_width
    assert r.flank_volume == pytest.approx(flanks, rel=1e-11, abs=0)
    bin_arc = np.pi * r.pin_radius / r.pin_wear.shape[2]
    round_about = np.sum(r.pin_even_wear) * 2 * np.pi * r.pin_radius * r.mesh_width
    facing = np.sum(r.pin_wear) * bin_arc * r.mesh_width
    assert r.pin_volume == pytest.approx(round_about + facing, rel=1e-11, abs=0)
    assert (round_about == 0.0) == (pins == STANDING) and (facing == 0.0) == (pins == TURNING)
    # Flank and pin lose the same: the coefficient is that of the pair.
    assert r.pin_volume == pytest.approx(r.flank_volume, rel=1e-12, abs=0)
    for race in ("inner", "outer"):
        bin_arc = 2 * np.pi * r[f"{race}_race_radius"] / r.inner_race_wear.shape[2]
        sum_of_bins = np.sum(r[f"{race}_race_wear"]) * bin_arc * r.roller_length
        assert r[f"{race}_race_volume"] == pytest.approx(sum_of_bins, rel=1e-11, abs=0)


@pytest.mark.parametrize("pins", [TURNING, STANDING], ids=["turning pins", "standing pins"])
def test_depths_are_nowhere_negative_and_the_outputs_name_the_deepest(coupled, pins):
    machine, r = coupled[pins]
    assert all(r[name].min() >= 0.0 for name in SURFACES)
    assert machine.mesh_profile_error.min() >= 0.0 and machine.roller_profile_error.min() >= 0.0
    assert r.flank_depth == pytest.approx(r.disc_wear.max(axis=1), rel=1e-15, abs=0)
    place = np.argmax(r.disc_wear, axis=1)
    assert (r.flank_lobe == place // 180 + 1).all()
    assert r.flank_phase == pytest.approx((place % 180 + 0.5) * np.pi / 90, rel=1e-12, abs=0)
    assert r.pin_depth == pytest.approx(np.maximum(r.pin_wear.max(axis=2), r.pin_even_wear), rel=1e-15, abs=0)
    for race in ("inner", "outer"):
        assert r[f"{race}_race_depth"] == pytest.approx(r[f"{race}_race_wear"].max(axis=2), rel=1e-15, abs=0)


def test_flank_volume_is_the_integral_of_archards_law(rv20e):
    """V = sum over steps of K/H F m(phi) d(phi), integrated adaptively over the phases swept."""
    force, path = 300.0, np.cumsum([0.3, 0.5, -0.2, 0.7])
    r = turned(rv20e, path, mesh_force=one_pin(force), **CONSTANT)
    profile = (LOBES, r.pin_circle_radius, r.pin_radius, r.eccentricity * PINS / r.pin_circle_radius)
    edges = np.concatenate([[0.0], path])
    slid = sum(abs(quad(sliding_per_crank_angle, a, b, args=profile)[0]) for a, b in itertools.pairwise(edges))
    # Sliding within a bin counts as even: second order in the bin.
    assert r.flank_volume == pytest.approx(r.mesh_wear_coefficient / r.hardness * force * slid, rel=1e-4, abs=0)


def test_a_meshing_cycle_takes_a_pin_once_over_every_lobe(rv20e):
    """After z_c turns of the cranks one pin has worn each bin of the disc once: k q m/arc."""
    path = np.arange(1, TURNS * 36 + 1) * 2 * np.pi / 36
    r = turned(rv20e, path, mesh_force=one_pin(300.0, 1, 7), **CONSTANT)
    once = r.mesh_wear_coefficient / r.hardness * 300.0 / r.mesh_width * r.slide / r.arc
    assert r.disc_wear[1].reshape(LOBES, -1) == pytest.approx(np.tile(once, (LOBES, 1)), rel=1e-9, abs=0)
    assert not r.disc_wear[0].any()
    assert np.count_nonzero(r.pin_even_wear) == 1 and r.pin_even_wear[1, 7] > 0.0


def test_raceways_wear_by_the_number_of_passing_rollers(rv20e):
    """depth = k q slip per pass; rollers pass a place 16 times a turn of the cage against it."""
    path = -np.arange(1, TURNS * 36 + 1) * 2 * np.pi / 36
    r = turned(rv20e, path, roller_force=500.0, **CONSTANT)
    per_pass = r.raceway_wear_coefficient / r.hardness * 500.0 / r.roller_length * r.slip_ratio_inner
    against_disc = abs(cage_angle(r, path[-1])) / (2 * np.pi)
    against_crank = TURNS * (1 + 1 / LOBES) - against_disc
    assert r.outer_race_wear.mean() == pytest.approx(16 * against_disc * per_pass, rel=1e-9, abs=0)
    assert r.inner_race_wear.mean() == pytest.approx(16 * against_crank * per_pass, rel=1e-9, abs=0)
    assert np.ptp(r.inner_race_wear) <= 1.001 * per_pass


@pytest.mark.parametrize("pins", [TURNING, STANDING], ids=["turning pins", "standing pins"])
def test_depth_does_not_depend_on_the_hertz_width(rv20e, pins):
    """A modulus 16 times lower makes contacts 4 times wider; only the edges of a pin's wear blur."""
    path = np.arange(1, 361) * np.pi / 180
    stiff, soft = (
        turned(rv20e, path, mesh_force=300.0, pins=pins, elastic_modulus=e, **CONSTANT) for e in (207e9, 207e9 / 16)
    )
    assert (stiff.disc_wear == soft.disc_wear).all() and (stiff.pin_even_wear == soft.pin_even_wear).all()
    assert soft.pin_wear.sum() == pytest.approx(stiff.pin_wear.sum(), rel=1e-12, abs=0)
    if pins == STANDING:
        # About the pin's middle the contact sweeps evenly over several widths.
        middle = slice(80, 100)
        assert soft.pin_wear[:, :, middle].mean() == pytest.approx(stiff.pin_wear[:, :, middle].mean(), rel=0.01, abs=0)


def test_running_in_goes_by_turns_of_the_cranks_and_not_by_time(rv20e):
    path, travel = np.arange(1, 73) * np.pi / 36, 2 * np.pi
    values = {"mesh_force": 300.0, "run_in_time": 1.0, "run_in_crank_speed": travel / 2, "run_in_ratio": 5.0}
    fast, slow = (turned(rv20e, path, duration, **values) for duration in (1e-3, 10.0))
    assert (fast.disc_wear == slow.disc_wear).all()
    assert slow.operating_time == pytest.approx(1e4 * fast.operating_time)
    assert fast.crank_travel == slow.crank_travel == pytest.approx(travel)
    # Mean of 1 + 4 exp(-s/s0) over two decay lengths, against the same without running-in;
    # a step has the factor of its start, which is half a step's decay (1.4 %) too much.
    run_in = turned(rv20e, path, **{**values, "run_in_ratio": 1.0})
    expected = 1 + 4 * (1 - np.exp(-2.0)) / 2.0
    assert fast.flank_volume / run_in.flank_volume == pytest.approx(expected, rel=0.02, abs=0)


def test_wear_goes_with_acceleration_and_does_not_mind_the_direction(rv20e):
    path = np.arange(1, 73) * np.pi / 36
    values = {"mesh_force": 300.0, "roller_force": 400.0, **CONSTANT}
    plain, fast = (turned(rv20e, path, acceleration=a, **values) for a in (1.0, 7.0))
    back = turned(rv20e, [*path[::-1][1:].tolist(), 0.0], start=path[-1], **values)
    for name in SURFACES:
        assert fast[name] == pytest.approx(7 * plain[name], rel=1e-12, abs=0)
        assert back[name] == pytest.approx(plain[name], rel=1e-9, abs=1e-9 * max(plain[name].max(), 1e-30))
    assert fast.operating_time == 7 * plain.operating_time
    assert fast.crank_travel == pytest.approx(7 * plain.crank_travel, rel=1e-12, abs=0)


@pytest.mark.parametrize("sense", [1, -1])
def test_the_line_of_a_profile_error_meets_the_surface_where_a_step_like_the_last_leads(rv20e, coupled, sense):
    _, worn = coupled[STANDING]
    step, angles = 2e-3, ("crank_angle", "output_angle", "cage_angle")
    both = [records_of(rv20e.wear, pins=STANDING) for _ in range(2)]
    for records in both:
        exchange(worn, records, (*SURFACES, *angles, *(f"{a}_before" for a in angles), "crank_speed", "lateness"))
        only(records).crank_speed *= sense
    ahead, there = (only(records) for records in both)
    advance = ahead.crank_speed * step
    there.crank_angle += advance
    there.output_angle -= advance / LOBES
    there.cage_angle += cage_angle(there, advance)
    there.crank_speed = 0.0
    assert [accumulator.step(records, 0.0, step) for records in both] == [0, 0]
    assert there.profile_angle == there.crank_angle and not there.mesh_profile_slope.any()
    for name in ("mesh_profile", "roller_profile"):
        line = ahead[f"{name}_error"] + ahead[f"{name}_slope"] * (there.crank_angle - ahead.profile_angle)
        assert there[f"{name}_error"].max() > 1e-8
        assert line == pytest.approx(there[f"{name}_error"], abs=1e-15)


def test_a_warmer_grease_wears_the_raceways_by_its_pressure_viscosity(rv20e):
    """k ~ alpha^-7.377 and alpha falls by 0.5 % per kelvin."""
    path = np.arange(1, 37) * np.pi / 18
    cold, warm = (turned(rv20e, path, roller_force=500.0, temperature=293.15 + d) for d in (0.0, 20.0))
    expected = np.exp(7.377 * 0.005 * 20.0)
    assert warm.inner_race_volume / cold.inner_race_volume == pytest.approx(expected, rel=1e-9, abs=0)


def largest_difference(one, other):
    return max(np.abs(one[n] - other[n]).max() / np.abs(other[n]).max() for n in DEPTHS + VOLUMES)


def test_halving_the_communication_step_changes_coupled_wear_by_less_than_half_a_percent(rv20e, coupled):
    _, fine = run_coupled(rv20e, 200.0, steps_per_turn=144)
    assert largest_difference(coupled[TURNING][1], fine) < 0.005


def test_coupled_wear_converges_with_the_square_of_the_communication_step(rv20e):
    """One equilibrium a step: the forces' means, the exchange and the sweeps together."""
    runs = [run_coupled(rv20e, 200.0, steps_per_turn=n, largest_crank_step=1.0)[1] for n in (18, 72, 576)]
    for name in VOLUMES:
        coarse, fine = (abs(r[name] / runs[-1][name] - 1) for r in runs[:2])
        assert np.log(coarse / fine) / np.log(4) > 1.7, name


@pytest.mark.parametrize("fault, values", [
    (accumulator.PRIMED, {"eccentricity": 1.31e-3}), (accumulator.UNDERCUT, {"pin_radius": 4.7e-3}),
])
def test_impossible_geometry_gives_its_fault(rv20e, fault, values):
    status = accumulator.initialise(records_of(rv20e.wear, **values))
    assert status == fault


@pytest.mark.parametrize("name", ["crank_angle", "output_angle", "cage_angle"])
def test_angles_that_are_none_or_not_of_one_reducer_are_a_fault(rv20e, name):
    for angle in (np.nan, 1e6, 4.0):
        # In the first step in which the cranks turn it is decided whether inputs are late: not by one that is refused.
        records = records_of(rv20e.wear, crank_speed=1.0)
        assert accumulator.initialise(records) == 0
        before = records.tobytes()
        records[name] = angle
        status = accumulator.step(records, 0.0, 1.0)
        if name == "crank_angle":
            assert status == (accumulator.LONG_STEP if angle != 4.0 else 0)
        else:
            assert status == accumulator.CAGE_ASTRAY
        if status:
            records[name] = 0.0
            assert records.tobytes() == before


@pytest.mark.parametrize("name, place, depth", [("flank_depth", 1, 2e-3), ("inner_race_depth", (0, 1), 1.5e-3), ("outer_race_depth", (1, 0), np.inf)])
def test_who_is_worn_through_wears_no_further(rv20e, name, place, depth):
    """Deeper than what rolls or slides there is thick."""
    records = records_of(rv20e.wear)
    assert accumulator.initialise(records) == 0
    records["crank_angle"] = 0.1
    records[name][0][place] = 0.99 * min(depth, 1e-3)
    assert accumulator.step(records, 0.0, 1.0) == 0
    records[name][0][place] = depth
    before = records.tobytes()
    assert accumulator.step(records, 1.0, 1.0) == accumulator.WORN_THROUGH
    assert records.tobytes() == before


@pytest.mark.parametrize("sweep", [np.pi / 36, 1.0])
def test_a_step_in_one_sweep_or_in_parts_takes_the_same_off(rv20e, sweep):
    path = np.arange(1, 10) * np.pi / 9
    whole, parts = (turned(rv20e, path, mesh_force=one_pin(300.0), largest_sweep=s, **CONSTANT) for s in (sweep, np.pi / 180))
    assert whole.flank_volume == pytest.approx(parts.flank_volume, rel=1e-9, abs=0)
    assert whole.disc_wear == pytest.approx(parts.disc_wear, rel=1e-9, abs=1e-20)
