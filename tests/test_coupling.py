"""Extrapolation, step control, algebraic loops and the power residual against known solutions."""

import itertools
import math

import numpy as np
import pytest
from python_units import Fragile, Gain, Motor, Oscillator, Shaft, modes

from fmu_src.faults import InputFault, RunFault
from orchestrator.master import Connection, LoopSettings, Master, StepControl

RING = [("a.x", "b.u"), ("b.x", "a.u")]
END = 4.0


def oscillators(step, derivatives=0, cls=Oscillator, **options):
    units = {"a": cls("a", 1.0, input_derivatives=derivatives), "b": cls("b", 0.0, input_derivatives=derivatives)}
    master = Master(units, RING, step, **options)
    master.initialise()
    return master


def error_at_end(master):
    master.run(round(END / master.step_size))
    return max(abs(master.components[n].get("x") - x) for n, x in zip("ab", modes(END)))


@pytest.mark.parametrize("scheme", ["jacobi", "gauss-seidel"])
@pytest.mark.parametrize("order, derivatives, expected", [(0, 0, 1), (1, 0, 2), (2, 0, 2), (1, 1, 2), (2, 2, 3)])
def test_order_of_extrapolated_coupling(scheme, order, derivatives, expected):
    steps = (0.02, 0.01, 0.005)
    masters = [oscillators(h, derivatives, scheme=scheme, extrapolation=order) for h in steps]
    assert masters[0].coupling_order == expected
    errors = [error_at_end(master) for master in masters]
    orders = [math.log2(a / b) for a, b in itertools.pairwise(errors)]
    assert orders[-1] == pytest.approx(expected, abs=0.2)


def test_extrapolated_master_repeats_itself_after_restore():
    master = oscillators(0.1, extrapolation=2)
    master.run(5)
    saved = master.save()
    master.run(5)
    first = master.components["a"].get("x")
    master.restore(saved)
    master.run(5)
    assert master.components["a"].get("x") == first


@pytest.mark.parametrize("control, extrapolation", [
    ({"method": "doubling", "watch": ("a.v", "b.v")}, 0),
    ({"method": "doubling", "watch": ("a.v", "b.v")}, 1),
    ({"method": "extrapolation"}, 1),
])  # fmt: skip
def test_error_falls_with_the_tolerance(control, extrapolation):
    errors = []
    for tolerance in (1e-2, 1e-3, 1e-4):
        master = oscillators(
            0.5, scheme="jacobi", extrapolation=extrapolation, step_control=StepControl(tolerance, **control)
        )
        errors.append(error_at_end(master))
        assert master.time == END
    assert errors[0] > 4.0 * errors[1] > 16.0 * errors[2]
    # Eight base steps, each with the tolerance.
    assert errors[-1] < 8 * 1e-4


def test_steps_grow_where_nothing_happens():
    """A step's length follows the solution: two oscillators at rest need base steps only."""
    units = {"a": Oscillator("a", 0.0), "b": Oscillator("b", 0.0)}
    master = Master(units, RING, 0.5, step_control=StepControl(1e-4))
    master.initialise()
    master.run(4)
    assert master.controller.accepted == 4
    units["a"].state[0] = 1.0
    master.run(4)
    assert master.controller.rejected > 0 and master.controller.accepted > 50


def test_units_that_cannot_restore_are_never_taken_back():
    class Final(Oscillator):
        can_restore = False

        def save(self):
            raise AssertionError("must not be asked")

        restore = save

    master = oscillators(0.5, cls=Final, step_control=StepControl(1e-3), extrapolation=1)
    assert error_at_end(master) < 2e-2
    assert master.controller.rejected == 0
    assert "no step is taken back" in master.warnings[0]
    with pytest.raises(InputFault, match="a, b cannot restore"):
        oscillators(0.5, cls=Final, step_control=StepControl(1e-3, "doubling"))


def test_failed_step_is_tried_again_with_a_shorter_one():
    master = oscillators(1.0, cls=Fragile, step_control=StepControl(0.5))
    master.run(2)
    assert master.time == 2.0 and master.controller.rejected > 0
    with pytest.raises(RunFault, match="no convergence"):
        oscillators(1.0, cls=Fragile, step_control=StepControl(0.5, halvings=2)).run(1)


def test_smallest_step_that_does_not_do_is_told_once():
    master = oscillators(0.5, step_control=StepControl(1e-6, halvings=2))
    master.run(4)
    assert len(master.warnings) == 1 and "above the" in master.warnings[0]


@pytest.mark.parametrize("bad", [{"tolerance": 0.0}, {"method": "magic"}, {"halvings": 99}])
def test_bad_step_control_is_refused(bad):
    with pytest.raises(InputFault):
        StepControl(**bad)


def test_step_control_needs_variable_steps_and_equal_ratios():
    class Rigid(Oscillator):
        can_vary_step = False

    with pytest.raises(InputFault, match="cannot vary"):
        oscillators(0.1, cls=Rigid, step_control=StepControl())
    with pytest.raises(InputFault, match="ratios"):
        oscillators(0.1, ratios={"a": 2}, step_control=StepControl())


# algebraic loops


def gains(slopes, method="newton", offsets=(1.0, 0.0)):
    units = {n: Gain(n, s, o) for n, s, o in zip("abc", slopes, offsets)}
    return Master(units, [("a.y", "b.u"), ("b.y", "a.u")], 0.1, loops=LoopSettings(method))


@pytest.mark.parametrize("method", ["newton", "fixed-point"])
@pytest.mark.parametrize("slopes", [(0.5, 0.5), (-0.9, 0.9), (3.0, -2.0), (2.0, 2.0)])
def test_linear_loop_is_solved_also_where_plain_iteration_diverges(method, slopes):
    master = gains(slopes, method)
    assert len(master.loops) == 1
    master.initialise()
    a, b = slopes
    assert master.components["a"].get("y") == pytest.approx(1.0 / (1.0 - a * b), rel=1e-8)
    master.step()
    assert master.loops[0].evaluations <= 2


def test_nonlinear_loop_follows_its_inputs():
    """y = cos(y) has the fixed point 0.739085."""
    units = {"a": Gain("a", function=math.cos), "b": Gain("b")}
    master = Master(units, [("a.y", "b.u"), ("b.y", "a.u")], 0.1)
    master.initialise()
    assert units["a"].get("y") == pytest.approx(0.7390851332151607, abs=1e-9)
    units["a"].function = lambda u: 0.5 * math.cos(u)
    master.step()
    assert units["a"].get("y") == pytest.approx(0.4501836112948736, abs=1e-9)


def test_loop_without_solution_is_named():
    master = gains((1.0, 1.0))
    with pytest.raises(RunFault, match=r"a.y -> b.u.*b.y -> a.u found no solution at time 0 s"):
        master.initialise()


def test_feedthrough_chain_is_no_loop_and_is_not_late():
    """Oscillator -> gain -> gain -> oscillator gives what a direct connection gives."""
    direct = oscillators(0.1, scheme="jacobi")
    units = {"b": Oscillator("b", 0.0), "g": Gain("g", 2.0), "h": Gain("h", 0.5), "a": Oscillator("a", 1.0)}
    links = [("h.y", "b.u"), ("g.y", "h.u"), ("a.x", "g.u"), ("b.x", "a.u")]
    chain = Master(units, links, 0.1, scheme="jacobi")
    assert chain.loops == []
    chain.initialise()
    for master in (direct, chain):
        master.run(20)
    assert units["a"].get("x") == pytest.approx(direct.components["a"].get("x"), abs=1e-14)
    assert units["h"].get("y") == pytest.approx(units["a"].get("x"), abs=1e-14)


def test_unknown_loop_method_is_refused():
    with pytest.raises(InputFault, match="newton or fixed-point|newton, fixed-point"):
        LoopSettings("magic")


# power residual


def drive(step, back=1.0, **options):
    units = {"motor": Motor("motor"), "shaft": Shaft("shaft")}
    links = [("motor.torque", "shaft.torque"), Connection("shaft.speed", "motor.speed", factor=back)]
    master = Master(units, links, step, scheme="jacobi", **options)
    master.initialise()
    master.run(round(6.0 / step))
    return master


def test_torque_and_speed_are_found_as_a_bond_and_its_residual_falls_with_the_step():
    shares = [drive(step).bonds[0].share for step in (0.2, 0.1, 0.05)]
    assert shares[0] / shares[1] == pytest.approx(2.0, rel=0.2)
    assert shares[1] / shares[2] == pytest.approx(2.0, rel=0.2)
    # Extrapolated inputs leave less.
    assert drive(0.1, extrapolation=1).bonds[0].share < 0.3 * shares[1]


def test_coarse_coupling_is_told_and_a_fine_one_is_not():
    (text,) = drive(0.3).warnings
    assert "motor.torque -> shaft.torque" in text and "the coupling, not the model" in text
    assert drive(0.005).warnings == []


def test_lossy_connection_shows_its_loss():
    """A tenth of the speed is lost on the way: a tenth of the power is missing, whatever the step."""
    assert drive(0.001, back=0.9).bonds[0].share == pytest.approx(0.1 / 0.95, rel=0.01)


def test_reaction_torque_of_other_sign_is_no_loss():
    units = {"motor": Motor("motor"), "shaft": Shaft("shaft", -1.0)}
    links = [Connection("motor.torque", "shaft.torque", factor=-1.0), ("shaft.speed", "motor.speed")]
    master = Master(units, links, 0.005, scheme="jacobi")
    master.initialise()
    master.run(1000)
    assert master.warnings == []


def test_named_bond_of_other_units():
    master = oscillators(0.1, power_bonds=[("a.x", "b.x")])
    master.run(10)
    assert master.bonds[0].exchanged_energy > 0.0
    for bad, said in ((("a.x", "a.x"), "both directions"), (("a.v", "b.x"), "0 connections")):
        with pytest.raises(InputFault, match=said):
            oscillators(0.1, power_bonds=[bad])


def test_power_account_forgets_steps_that_were_taken_back():
    master = drive(0.5, step_control=StepControl(1e-3))
    assert master.controller.rejected > 0
    assert np.isclose(master.bonds[0].exchanged_energy, drive(0.001).bonds[0].exchanged_energy, rtol=0.02)
