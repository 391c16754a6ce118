"""What later commands compute with is compiled before they ask."""

import pytest

from discrepancy.prediction.compiled_ahead import compile_ahead
from fmu_src.compiler import loading
from reducers.reducer import load_reducer
from studies import coupled

RUN = (coupled.sweep, coupled.sweep_beside, coupled.torque_sweep, coupled.run_pair_beside)


def test_runs_of_every_kind_are_compiled(monkeypatch):
    reducer = load_reducer("RV20E-121")
    for kernel in RUN:
        monkeypatch.setattr(kernel, "callers", {})
    compile_ahead(reducer)
    assert all(kernel.callers for kernel in RUN)


@pytest.mark.parametrize("name", ["RV20E-121", "RV20E-121-rigid"])
def test_nothing_is_compiled_again_for_reducers_of_the_same_sizes(name, monkeypatch):
    compile_ahead(load_reducer("RV20E-121"))
    monkeypatch.setattr(loading, "optimised", None)
    for kernel in RUN:
        monkeypatch.setattr(kernel, "callers", {})
    compile_ahead(load_reducer(name))
