"""A unit small enough to check a master by hand: a first-order lag dx/dt = (u - x)/T, exact per step."""

import math

from fmu_src.kernel import kernel
from fmu_src.table import Table
from fmu_src.unit import Unit
from fmu_src.variables import Variable

UNSTABLE = 1


@kernel
def initialise(records):
    r = records[0]
    r.x = r.start
    r.steps = 0
    return 0


@kernel
def step(records, time, duration):
    r = records[0]
    if r.time_constant <= 0.0:
        return UNSTABLE
    r.x += (r.u - r.x) * (1.0 - math.exp(-duration / r.time_constant))
    r.last_time = time
    r.steps += 1
    r.hidden += r.x
    return 0


def lag_table(unit_in: str = "m", unit_out: str = "m") -> Table:
    return Table("Lag", "first-order lag", [
        Variable("u", "input", unit_in, "input"),
        Variable("time_constant", "parameter", "s", "time constant", 1.0),
        Variable("start", "parameter", unit_out, "x at the start", 0.0),
        Variable("x", "output", unit_out, "output"),
        Variable("last_time", "output", "s", "start of the last step"),
        Variable("steps", "output", "1", "steps done", integer=True),
        Variable("pair", "output", "m", "an array", shape=(2,), axes=("i",)),
        Variable("hidden", "state", "1", "sum of x: hidden state"),
    ])  # fmt: skip


def make_unit(specification: dict) -> Unit:
    table = lag_table(*specification.get("units", ("m", "m")))
    faults = {UNSTABLE: "time_constant {time_constant} s must be positive"}
    return Unit(table.with_starts(specification.get("starts", {}), {}), initialise, step, faults)
