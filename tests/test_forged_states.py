"""States with a right checksum and impossible contents: refused with the number that is wrong, or harmless; never a crash."""

import json
import os
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from fmu_src.faults import InputFault, RunFault
from fmu_src.state import HEADER, HEADER_SIZE, SUMS, State, pack, sums
from orchestrator.component import InProcess
from orchestrator.opening import open_fmu

ROOT = Path(__file__).resolve().parents[1]
VALUES = (np.nan, np.inf, -np.inf, 0.0, -1.0, 1e12, -1e12, 1e300, 5e-324)
COUNTS = (-1, 1 << 20, -(1 << 62), (1 << 63) - 1, 7, 0)


def forged(table, cells, chance):
    """A state with one to six other numbers, every second time a whole one among them."""
    cells = cells.copy()
    whole = np.flatnonzero(table.state_bounds[2])
    for _ in range(chance.choice((1, 1, 2, 6))):
        if chance.random() < 0.5:
            cells.view("i8")[chance.choice(whole)] = chance.choice(COUNTS)
        else:
            cells[chance.randrange(len(cells))] = chance.choice(VALUES)
    return cells


SCRIPT = """
import random, signal, sys
import numpy as np
from fmu_src.faults import InputFault, RunFault
from orchestrator.component import InProcess
from reducers.reducer import load_reducer
from test_forged_states import forged

unit = InProcess("a", load_reducer("RV20E-121-rigid").specification(sys.argv[1]))
if "fidelity" in unit.signals:
    unit.set("fidelity", int(sys.argv[2]))
unit.enter_initialisation(0.0)
unit.exit_initialisation()
unit.step(0.0, 1e-3)
good, chance, found = np.frombuffer(unit.save(), "f8"), random.Random(int(sys.argv[3])), [0, 0, 0]
for _ in range(int(sys.argv[4])):
    unit.restore(good.tobytes())
    # The end of this process, if it hangs.
    signal.setitimer(signal.ITIMER_PROF, 10.0)
    try:
        unit.restore(forged(unit.table, good, chance).tobytes())
        unit.step(1e-3, float(sys.argv[5]))
        found[0] += 1
    except InputFault:
        found[1] += 1
    except RunFault:
        found[2] += 1
print(found)
"""


@pytest.mark.parametrize("unit, fidelity", [("rv_plant", 0), ("rv_plant", 1), ("wear_fmu", 0), ("rv_reducer", 0)])
def test_no_forged_state_crashes_or_hangs(unit, fidelity):
    # In motion some go on in steps of some 10 ns until the limit of 100,000, which takes 7 s: a shorter way has fewer of them.
    trials, step = 150, 1e-5 if fidelity else 1e-3
    done = subprocess.run([sys.executable, "-c", SCRIPT, unit, str(fidelity), "1", str(trials), str(step)], capture_output=True, text=True, cwd=ROOT / "tests",
                          env=os.environ | {"PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}"})  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    stepped, refused, failed = json.loads(done.stdout)
    assert stepped + refused + failed == trials and refused > trials // 4


def test_impossible_numbers_are_named(rv20e):
    unit = InProcess("plant", rv20e.specification("rv_plant"))
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    good = unit.save()
    for name, value in (("free", 16), ("free", -1), ("free_count", 17), ("is_free", 2), ("rejected", -1)):
        cells = np.frombuffer(good, "f8").copy()
        cells.view("i8")[unit.table.offset[name]] = value
        with pytest.raises(InputFault, match=rf"plant: the state is impossible: {name.replace('_', '.')}.* = {value}"):
            unit.restore(cells.tobytes())
    for name, value in (("crank_angle", np.nan), ("pin_radius", -1.0), ("q", np.inf)):
        cells = np.frombuffer(good, "f8").copy()
        cells[unit.table.offset[name]] = value
        with pytest.raises(InputFault, match="the state is impossible: " + name.replace("_", ".")):
            unit.restore(cells.tobytes())
    for state in (good[:-8], good + bytes(8), good[:-3], b""):
        with pytest.raises(InputFault, match="plant: "):
            unit.restore(state)
    assert unit.save() == good


@pytest.mark.parametrize("flavour", [".", "fmi2", "fmi3"])
def test_fmus_refuse_forged_states_and_go_on(fmus, native_fmus, flavour):
    """With the checksum made right again."""
    unit = open_fmu("plant", (fmus if flavour == "." else native_fmus / flavour) / "RvPlant.fmu")
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    unit.step(0.0, 1e-3)
    good, table, chance = unit.save(), InProcess("plant", unit.specification()).table, random.Random(2)
    refused = 0
    for _ in range(40):
        cells = forged(table, np.frombuffer(good, "f8", offset=HEADER_SIZE), chance)
        block = good[:HEADER_SIZE] + cells.tobytes()
        block = good[: HEADER.size] + sums(block) + block[HEADER_SIZE:]
        try:
            unit.restore(block)
        except RunFault as fault:
            refused += "the state is impossible" in str(fault)
        unit.restore(good)
    assert refused > 10
    assert unit.save() == good
    unit.step(1e-3, 1e-3)
    unit.close()


def test_good_states_come_back(rv20e, bx40e):
    """Every state that a unit gets to is one that it takes."""
    for reducer in (rv20e, bx40e):
        for name in ("rv_plant", "wear_fmu", "rv_reducer"):
            unit = InProcess("a", reducer.specification(name))
            unit.restore(unit.save())
            unit.enter_initialisation(0.0)
            unit.exit_initialisation()
            for k in range(3):
                unit.restore(unit.save())
                unit.step(1e-3 * k, 1e-3)
            unit.restore(unit.save())


def test_header_is_checked():
    assert len(pack("x", State(np.zeros(2), 2, 0.0))) == HEADER_SIZE + 16 and HEADER.size + SUMS.size == HEADER_SIZE
