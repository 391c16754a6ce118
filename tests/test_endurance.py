"""The short form of ``python -m benchmarks.endurance``: time, angles and figures after many steps, and that it sees what should not be."""

from dataclasses import replace

from benchmarks.endurance import endure


def test_many_steps_gather_no_memory_no_time_and_no_error():
    found = endure(20_000)
    assert found.steps == 20_000 and found.drift == 0.0 and found.angle_off < 1e-12 and found.difference < 1e-7
    assert found.grown < 1 << 20
    worse = replace(found, grown=1e8, drift=5.0, difference=1e-3, costs=(1e-5,) * 5 + (1e-4,) * 5)
    assert len(worse.problems) == 4
