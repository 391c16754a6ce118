"""The master: coupling schemes and their order, step ratios, units, faults, state."""

import itertools
import math

import lag_unit
import numpy as np
import pytest

from fmu_src.faults import InputFault, RunFault
from orchestrator.component import InProcess
from orchestrator.master import Master


@pytest.fixture
def make_lag(monkeypatch):
    """Components around the lag unit, as the master sees any other."""
    monkeypatch.setattr("orchestrator.component.make_unit", lag_unit.make_unit)

    def make(name, units=("m", "m"), **starts):
        return InProcess(name, {"units": units, "starts": starts})

    return make


RING = [("a.x", "b.u"), ("b.x", "a.u")]


def coupled_error(make_lag, scheme: str, step: float) -> float:
    """Two lags feeding each other decay towards their mean: error of x_a at time 1 s."""
    a, b = make_lag("a", start=1.0), make_lag("b", start=0.0)
    master = Master({"a": a, "b": b}, RING, step, scheme=scheme)
    master.initialise()
    master.run(round(1.0 / step))
    # x_a - x_b decays with rate 2, x_a + x_b stays.
    return abs(a.get("x") - 0.5 * (1.0 + math.exp(-2.0)))


@pytest.mark.parametrize("scheme", ["gauss-seidel", "jacobi"])
def test_coupling_error_is_of_first_order(make_lag, scheme):
    errors = [coupled_error(make_lag, scheme, step) for step in (1e-2, 5e-3, 2.5e-3)]
    orders = [math.log2(coarse / fine) for coarse, fine in itertools.pairwise(errors)]
    assert orders == pytest.approx([1.0, 1.0], abs=0.03)


@pytest.mark.parametrize("scheme", ["gauss-seidel", "jacobi"])
def test_many_steps_at_once_are_those_one_by_one(make_lag, scheme):
    """``run`` calls what ``step`` comes to; units in metres and millimetres take the longer way."""
    ends = []
    for units in (("m", "m"), ("m", "mm")):
        for at_once in (True, False):
            a, b = make_lag("a", start=1.0), make_lag("b", units, start=0.0)
            master = Master({"a": a, "b": b}, RING, 0.1, scheme=scheme)
            master.initialise()
            assert (master.plain_stages() is None) == (units[1] == "mm")
            if at_once:
                master.run(7)
            else:
                for _ in range(7):
                    master.step()
            ends.append((a.get("x"), b.get("x"), master.time))
    assert ends[0] == ends[1] and ends[2] == ends[3]


def test_jacobi_gives_all_units_the_values_of_the_step_start(make_lag):
    a, b = make_lag("a", start=1.0), make_lag("b", start=0.0)
    master = Master({"a": a, "b": b}, RING, 0.1, scheme="jacobi")
    master.initialise()
    master.step()
    gain = 1.0 - math.exp(-0.1)
    assert (a.get("x"), b.get("x")) == (pytest.approx(1.0 - gain), pytest.approx(gain))


def test_gauss_seidel_gives_later_units_the_new_values(make_lag):
    a, b = make_lag("a", start=1.0), make_lag("b", start=0.0)
    master = Master({"a": a, "b": b}, RING, 0.1)
    master.initialise()
    master.step()
    gain = 1.0 - math.exp(-0.1)
    assert b.get("x") == pytest.approx(gain * (1.0 - gain))


def test_time_is_start_plus_n_steps(make_lag):
    lag = make_lag("a")
    master = Master({"a": lag}, [], 0.1, start_time=5.0)
    master.initialise()
    master.run(1000)
    assert master.time == 5.0 + 1000 * 0.1
    assert lag.get("last_time") == 5.0 + 999 * 0.1


def test_unit_with_ratio_steps_rarely_over_longer_steps(make_lag):
    fast, slow = make_lag("fast"), make_lag("slow")
    master = Master({"fast": fast, "slow": slow}, [("fast.x", "slow.u")], 0.1, {"slow": 3})
    master.initialise()
    master.run(9)
    assert (fast.get("steps"), slow.get("steps")) == (9, 3)
    assert slow.get("last_time") == pytest.approx(0.6)


def test_units_are_converted_on_the_way(make_lag):
    source, target = make_lag("source", ("m", "mm"), start=250.0), make_lag("target")
    source.set("u", 0.25)
    master = Master({"source": source, "target": target}, [("source.x", "target.u")], 0.1)
    master.initialise()
    assert target.get("u") == pytest.approx(0.25)


@pytest.mark.parametrize(
    "link, said",
    [
        (("a.x", "b.nothing"), "no variable 'nothing'"),
        (("c.x", "b.u"), "no component 'c'"),
        (("a.x", "b.x"), "not an input"),
        (("a.u", "b.u"), "not an output"),
        (("a.pair", "b.u"), "shapes"),
        (("a.steps", "b.u"), "integer"),
    ],
)
def test_bad_connection_is_named(make_lag, link, said):
    components = {"a": make_lag("a"), "b": make_lag("b")}
    with pytest.raises(InputFault, match=said):
        Master(components, [link], 0.1)


def test_connection_of_unlike_units_is_refused(make_lag):
    components = {"a": make_lag("a", ("m", "N")), "b": make_lag("b")}
    with pytest.raises(InputFault, match=r"a\.x -> b\.u.*'N' does not fit"):
        Master(components, [("a.x", "b.u")], 0.1)


def test_input_driven_twice_is_refused(make_lag):
    components = {name: make_lag(name) for name in "abc"}
    with pytest.raises(InputFault, match="already driven by a.x"):
        Master(components, [("a.x", "c.u"), ("b.x", "c.u")], 0.1)


@pytest.mark.parametrize("bad", [{"step": 0.0}, {"step": math.nan}, {"scheme": "newton"}, {"ratios": {"a": 0}},
                                 {"ratios": {"x": 2}}])
def test_bad_master_options_are_refused(make_lag, bad):
    with pytest.raises(InputFault):
        Master({"a": make_lag("a")}, [], **{"step": 0.1} | bad)


def test_fault_of_a_unit_says_which_when_and_why(make_lag):
    lag = make_lag("valve")
    master = Master({"valve": lag}, [], 0.5)
    master.initialise()
    master.run(2)
    lag.set("time_constant", -1.0)
    with pytest.raises(RunFault, match=r"valve: Lag at time 1 s: time_constant -1.0 s must be positive"):
        master.step()


def test_nan_on_an_input_is_refused_and_changes_nothing(make_lag):
    lag = make_lag("a")
    lag.set("u", 2.0)
    with pytest.raises(InputFault, match="u = nan m is not a finite number"):
        lag.set("u", math.nan)
    assert lag.get("u") == 2.0


def test_restored_master_repeats_itself_hidden_state_included(make_lag):
    a, b = make_lag("a", start=1.0), make_lag("b")
    master = Master({"a": a, "b": b}, RING, 0.1)
    master.initialise()
    master.run(3)
    saved = master.save()
    master.run(4)
    first = a.record()
    master.restore(saved)
    assert master.time == pytest.approx(0.3)
    master.run(4)
    assert first.tobytes() == a.record().tobytes()


def test_array_elements_connect_by_index(make_lag):
    a, b = make_lag("a"), make_lag("b")
    a.records["pair"] = np.array([3.0, 7.0])
    master = Master({"a": a, "b": b}, [("a.pair[2]", "b.u")], 0.1)
    master.initialise()
    assert b.get("u") == 7.0
