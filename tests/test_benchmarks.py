"""The measurements themselves: what NumPy computes is what the kernels compute, and cost at equal error."""

import math

import numpy as np
import pytest

from benchmarks import equilibrium, exchange, motion
from benchmarks.equilibrium import FREE, compiled, start
from benchmarks.exudyn_peer import ExudynPlant
from benchmarks.integrators import first_order
from benchmarks.integrators.runs import errors, with_alpha
from benchmarks.integrators.stretches import Stretch, rated
from benchmarks.motion import Problem, cheapest, check_right_hand_sides
from benchmarks.numpy_plant import NumpyPlant
from benchmarks.ratios import Curve, Figure, Measured, Ratio, cost_at, exponent, machine
from benchmarks.table import write
from fmu_src.kernel import kernel


@pytest.fixture(params=["ours", pytest.param("numba", marks=pytest.mark.campaign)])
def compiler(request, monkeypatch):
    """What compiles the functions of the benchmarks: here our compiler, for numba, as in the measurements, takes ten times as long."""
    if request.param == "ours":
        monkeypatch.setattr(equilibrium, "assembled", kernel(equilibrium.assembled.py_func))
        monkeypatch.setattr(first_order, "cage_speed", kernel(first_order.cage_speed.py_func))
        monkeypatch.setattr(motion, "rate_of_change", kernel(first_order.rate_of_change.py_func))


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("name", ["RV20E-121-rigid", "BX-40E-rigid"])
def test_residual_in_numpy_is_that_of_the_kernels(name):
    records, _ = start(name)
    r, residual = records[0], compiled(records.copy())[0]
    z = r["z"][:FREE] * (1.0 + 0.1 * np.sin(np.arange(FREE)))
    angle, cage = 0.3, 1.1
    wanted = residual(z, angle, cage)
    assert NumpyPlant(r).out_of_balance(z, angle, cage) == pytest.approx(wanted, abs=1e-8 * np.abs(wanted).max())


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("reducer", ["rv20e", "bx40e"])
def test_right_hand_side_in_numpy_is_that_of_the_kernels(request, reducer):
    assert check_right_hand_sides(Problem(rated(request.getfixturevalue(reducer).plant))) < 1e-7


def test_cost_at_an_error_is_read_in_logarithms():
    points = [(1e-1, 1.0), (1e-2, 2.0), (1e-4, 8.0)]
    assert cost_at(points, 1e-3) == pytest.approx(4.0)
    assert cost_at(points, 0.5) == 1.0 and math.isnan(cost_at(points, 1e-5))
    assert cheapest(points, 1e-2) == 2.0 and math.isnan(cheapest(points, 1e-5))


def test_exponent_of_a_power():
    assert exponent([(n, 3.0 * n**1.5) for n in (1, 2, 4, 8, 16)]) == pytest.approx(1.5)


def test_table_holds_rows_that_could_not_be_measured(tmp_path):
    curve = Curve("cost", "error", "time", {"ours": [(1e-2, 1.0), (1.234e-9, 200.0)], "none": []}, {"ours": -0.5})
    found = {"x": Measured([Ratio("x", "work", "peer", 1.0, math.nan, "1 %", 3.0)], [Figure("x", "what", 2.0, "s", at_most=1.0)], [curve])}
    write(found, machine(), True, tmp_path / "bench")
    assert '"ratio": null' in (tmp_path / "bench.json").read_text()
    page = (tmp_path / "bench.html").read_text()
    assert "not met" in page and "0 of 1 targets are met" in page and "Quick form" in page
    # Points of a logarithmic axis keep their digits, however small.
    assert '"name":"ours ~ x^-0.50","x":[1.234e-9,0.01],"y":[200,1]' in page.replace("1.234e-09", "1.234e-9")


@pytest.mark.parametrize("numpy", [False, True])
def test_exudyn_moves_as_the_plant_does(rv20e, numpy):
    pytest.importorskip("exudyn")
    stretch = rated(rv20e.plant)
    stretch = Stretch(stretch.start, stretch.loads[:2], stretch.step)
    problem = Problem(stretch)
    seen = problem.seen(ExudynPlant(problem, numpy).states((8, 1e-3, True, 0.8)))
    assert errors(seen, with_alpha(stretch, 1e-3)[0])[0] < 3e-3


def test_the_exchange_converges_with_its_orders():
    found = exchange.measure(quick=True)
    assert all(figure.met for figure in found.figures), found.figures
    (curve,) = found.curves
    assert len(curve.lines) == 6 and all(points for points in curve.lines.values())
