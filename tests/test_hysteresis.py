"""The stiffness test: catalogue figures, symmetry, and what compliance does to them."""

import inspect

import numpy as np
import pytest

import rvwear
from cli.main import main, parser
from discrepancy.figures.key_figures import LOST_MOTION, WIDTH, of_loop
from discrepancy.named_reducer import named_reducer
from orchestrator.settings import parse_setting
from reducers.reducer import load_reducer
from reproduce.context import Context
from reproduce.prototypes import loop
from studies.hysteresis import ANGLES, STEPS, hysteresis, torque_way
from studies.solve import ARCMIN


def run(reducer, *texts):
    return hysteresis(reducer, [parse_setting(t, [reducer.plant]) for t in texts], steps=10, angles=4)


def test_way_goes_up_and_down_both_ways():
    way = torque_way(100.0, 4)
    assert way[0] == way[-1] == 0.0
    assert (way.max(), way.min()) == (100.0, -100.0)
    assert 3.0 in way and -3.0 in way
    assert np.count_nonzero(np.diff(np.sign(np.diff(way)))) >= 2


def test_turning_is_the_same_both_ways(rv20e):
    loop = run(rv20e)
    assert loop.stiffness_Nm_per_arcmin == pytest.approx(loop.stiffness_reverse_Nm_per_arcmin, rel=0.01)
    assert loop.turning.max() == pytest.approx(-loop.turning.min(), rel=0.01)


def test_coarse_steps_of_torque_do_as_well_as_fine_ones_under_friction():
    """What friction can hold follows the torque: by the forces of the step before, four steps a quarter were 19 % off."""
    reducer = load_reducer("RV20E-121")
    coarse, fine = (hysteresis(reducer, [], steps=steps, angles=1) for steps in (4, 60))
    assert coarse.lost_motion_arcmin == pytest.approx(fine.lost_motion_arcmin, rel=0.03)
    assert coarse.stiffness_Nm_per_arcmin == pytest.approx(fine.stiffness_Nm_per_arcmin, rel=0.005)
    assert coarse.loop_area_Nm_arcmin == pytest.approx(fine.loop_area_Nm_arcmin, rel=0.06)


@pytest.mark.parametrize("steps", [4, 9, 64])
def test_lost_motion_hangs_on_no_steps(steps):
    """Beside an error of a lobe the way through the clearances ends above 3 %: the figure was 3 % larger with 16 torques than with 64, 6 % with four."""
    reducer = load_reducer("RV20E-121")
    lobe = [parse_setting("effects.crank_lobe_errors.lobe_throw_error_1=5um", [reducer.plant])]
    own, other = (hysteresis(reducer, lobe, n, locked_at=5.0).lost_motion_arcmin for n in (STEPS, steps))
    assert other == pytest.approx(own, rel=0.001)


def test_clearance_makes_the_lost_motion(rv20e):
    none, some = run(rv20e, "bearing.clearance=0um"), run(rv20e, "bearing.clearance=5um")
    assert none.lost_motion_arcmin < 0.05
    # About 20 arcsec per um at full load, both sides together; a little less at 3 %.
    assert some.lost_motion_arcmin == pytest.approx(5 * 20 / 60, rel=0.2)


def test_frictionless_contacts_without_clearance_enclose_no_area(rv20e):
    loop = run(rv20e, "bearing.clearance=0um")
    assert loop.loop_area_Nm_arcmin < 1e-6 * 167.0


def test_crank_supports_explain_the_catalogue_stiffness(rv20e):
    """Contacts alone are eight times stiffer than 49 N m/arcmin; 1.4e8 N/m per crank in series meets it."""
    assert run(rv20e).stiffness_Nm_per_arcmin > 350.0
    softer = run(rv20e, "effects.support_compliance.crank_support_compliance=7.14e-9m/N")
    assert softer.stiffness_Nm_per_arcmin == pytest.approx(49.0, rel=0.15)


def test_housing_compliance_adds_in_series(rv20e):
    stiff, soft = run(rv20e), run(rv20e, "effects.support_compliance.housing_compliance=1e-6")
    # 1e-6 rad/(N m) of the ring's torque is 1/290.9 arcmin/(N m), as the carrier sees it.
    added = 1.0 / soft.stiffness_Nm_per_arcmin - 1.0 / stiff.stiffness_Nm_per_arcmin
    assert added == pytest.approx(1e-6 * 3437.75, rel=0.05)


@pytest.mark.parametrize("name", ["RV20E-121", "BX-40E"])
def test_lost_motion_of_the_command_has_converged(name):
    """To half a percent, as four times as many torques at twice as many places have it; even torques, as many, were 2 to 3 % off."""
    reducer = load_reducer(name)
    own, fine = hysteresis(reducer, []), hysteresis(reducer, [], 4 * STEPS, 2 * ANGLES)
    assert own.lost_motion_arcmin == pytest.approx(fine.lost_motion_arcmin, rel=0.005)
    assert own.stiffness_Nm_per_arcmin == pytest.approx(fine.stiffness_Nm_per_arcmin, rel=0.001)


def test_command_library_and_claims_read_lost_motion_by_one_setting():
    options = parser().parse_args(["hysteresis"])
    assert (options.steps, options.angles) == (STEPS, ANGLES)
    default = inspect.signature(rvwear.hysteresis).parameters
    assert (default["steps"].default, default["angles"].default) == (STEPS, ANGLES)
    reducer = load_reducer("RV20E-121")
    assert loop(reducer).lost_motion_arcmin == Context().stiffness("RV20E-121").lost_motion_arcmin == hysteresis(reducer, []).lost_motion_arcmin


def test_key_figures_of_a_campaign_read_the_same_mean_width_and_lost_motion():
    """Of the same loop to the last digit, and of a bench's few torques within some per cent; the width at no torque is another figure."""
    found = hysteresis(load_reducer("RV20E-121"), [], locked_at=0.0)
    # What is read begins on the loop, not on the way to it.
    way, turning = np.append(found.torque, found.torque[1]), np.append(found.turning, found.turning[1])
    read = of_loop(way, 167.0)(turning / ARCMIN)
    assert read[WIDTH] * ARCMIN == pytest.approx(found.mean_width_arcmin, rel=1e-3)
    assert read[LOST_MOTION] * ARCMIN == pytest.approx(found.lost_motion_arcmin, rel=1e-3)
    few = slice(None, None, 3)
    assert of_loop(way[few], 167.0)(turning[few] / ARCMIN)[WIDTH] * ARCMIN == pytest.approx(found.mean_width_arcmin, rel=0.05)
    assert found.mean_width_arcmin < 0.7 * found.width_arcmin


def test_the_command_says_which_width_is_which(capsys):
    assert main(["hysteresis", "--reducer", "RV20E-121", "--steps", "4", "--angles", "1"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "loop_mean_width_arcmin" in said and "loop width: at no torque" in said and "between 3 % and half of the torque is what rvwear compare shows" in said


def test_a_stiffness_of_rigid_supports_says_so(capsys):
    """2,465 N m/arcmin of a file without compliances stood there without a word."""
    from cli.main import main
    from orchestrator.settings import parse_setting
    from reducers.reducer import load_reducer
    from studies.rigid import rigid_supports

    rigid = load_reducer("RV20E-121-rigid")
    assert "crank.support_compliance, first_stage.compliance, carrier.compliance" in rigid_supports(rigid) and "reducer new" in rigid_supports(rigid)
    assert not rigid_supports(load_reducer("RV20E-121")) and "reducer new" not in rigid_supports(load_reducer("cycloidal-actuator"))
    for text in ("housing.compliance=1e-8", "effects.support_compliance.carrier_compliance=1e-8"):
        assert not rigid_supports(rigid, [parse_setting(text, [rigid.plant, rigid.wear])])
    for words in (["hysteresis", "--steps", "4", "--angles", "1"], ["solve", "--positions", "8"]):
        assert main([*words, "--reducer", "RV20E-121-rigid"]) == 0
        assert " ".join(rigid_supports(rigid).split()) in " ".join(capsys.readouterr().out.split())
    assert main(["solve", "--positions", "8", "--reducer", "RV20E-121"]) == 0
    assert "no support yields" not in capsys.readouterr().out


def test_results_of_a_model_are_headed_as_a_comparison_with_it_is(tmp_path, capsys):
    """One thing was "RV20E-121-better" on the screen and better.toml (RV20E-121) in compare; files keep names that are fit for files."""
    path = tmp_path / "better.toml"
    path.write_text('[model]\nname = "RV20E-121"\nreducer = "RV20E-121"\n[effects.needle_clearance]\nadded = "2.1 um"\n', encoding="utf-8")
    assert main(["hysteresis", "--reducer", str(path), "--steps", "4", "--angles", "1"]) == 0
    assert capsys.readouterr().out.startswith("better.toml (RV20E-121): torque up and down")
    reducer = named_reducer(path)
    assert (reducer.name, reducer.heading) == ("RV20E-121-better", "better.toml (RV20E-121)") and named_reducer("BX-40E").heading == "BX-40E"
