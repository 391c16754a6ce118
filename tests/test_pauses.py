"""FMI 3: steps of RvReducer that end before their time, and callbacks between their parts."""

import ctypes

import fmpy
import numpy as np
import pytest
from fmpy.fmi3 import FMU3Slave
from shared import made_once

from fmu_src.package import build_native
from orchestrator.opening import open_fmu
from orchestrator.system import connect

# A crank turn takes 0.093 s: one step of all of it wears in 72 places and judges once.
LONG, FAST = 0.4, 1e5


@pytest.fixture(scope="session")
def both(rv20e, native_fmus, tmp_path_factory):
    """The unit of plant and wear as FMI 3; ``native_fmus`` skips where there is no compiler."""
    def make(folder):
        folder.mkdir(exist_ok=True)
        build_native("RvReducer", rv20e.specification("rv_reducer"), 1e-3, "rvwear test", folder)

    return made_once(tmp_path_factory, "both", make) / "fmi3" / "RvReducer.fmu"


class Slave:
    """One instance through fmpy's own class."""

    def __init__(self, path, folder, **options):
        fmpy.extract(str(path), str(folder))
        description = fmpy.read_model_description(str(path))
        self.numbers = {v.name: v.valueReference for v in description.modelVariables}
        self.unit = FMU3Slave(guid=description.instantiationToken, unzipDirectory=str(folder), modelIdentifier="RvReducer",
                              instanceName="one")  # fmt: skip
        self.log = []
        self.unit.instantiate(loggingOn=True, logMessage=lambda *given: self.log.append(given[-1].decode()), **options)
        self.flags, self.reached = (ctypes.c_bool * 3)(), ctypes.c_double()

    def start(self, **values):
        for name, value in values.items():
            self.unit.setFloat64([self.numbers[name]], [value])
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()
        return self

    def get(self, name):
        return self.unit.getFloat64([self.numbers[name]])[0]

    def step(self, time, duration):
        """(early, time reached)."""
        first = ctypes.addressof(self.flags)
        call = self.unit.dll["fmi3DoStep"]
        call.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_bool, *[ctypes.c_void_p] * 4]
        status = call(self.unit.component, time, duration, True, first, first + 1, first + 2, ctypes.addressof(self.reached))
        assert status == 0, self.log
        return bool(self.flags[2]), self.reached.value


def limited(slave):
    return slave.unit.getInt64([slave.numbers["life.limited_by"]])[0]


def test_a_step_ends_where_the_judgement_changes(both, tmp_path):
    """New parts: nothing limits their life until the first turn is judged."""
    slave = Slave(both, tmp_path / "early", earlyReturnAllowed=True).start(acceleration=FAST)
    whole = Slave(both, tmp_path / "whole").start(acceleration=FAST)
    assert whole.step(0.0, LONG) == (False, LONG)
    early, reached = slave.step(0.0, LONG)
    assert early and 0.08 < reached < 0.11
    assert limited(slave) != 0
    ends = [reached]
    while reached < LONG:
        early, reached = slave.step(reached, LONG - reached)
        ends.append(reached)
    assert ends[-1] == LONG and len(ends) <= 5
    # Who does not let it return early gets the same, rounding of the times apart.
    for name in ("life.worst_flank_depth", "life.worst_race_depth", "output.angle", "life.remaining", "wear.operating_time"):
        assert slave.get(name) == pytest.approx(whole.get(name), rel=1e-6), name
    assert limited(slave) == limited(whole)


def test_the_end_of_a_life_is_met_within_a_step(both, tmp_path):
    """The flank's limit is reached within a second's step: the unit says when, to a turn of the cranks."""
    slave = Slave(both, tmp_path / "end", earlyReturnAllowed=True).start(acceleration=1e7, **{"life.flank_depth_limit": 1e-6})
    time, seen = 0.0, []
    while time < 1.0:
        early, time = slave.step(time, 1.0 - time)
        seen.append((slave.get("life.remaining"), slave.get("life.worst_flank_depth"), time))
    over = next(i for i, (life, _, _) in enumerate(seen) if life == 0.0)
    assert seen[over][1] >= 1e-6 and seen[over][2] < 1.0
    assert over == 0 or seen[over - 1][1] < 1e-6


def test_the_importer_is_asked_between_the_parts(both, tmp_path):
    """Outputs may be read there; parts are those that the unit makes anyway, the end is the same."""
    times, depths, held = [], [], {}

    def update(environment, time, may_set, may_get, finished, may_return, requested, until):
        assert (may_set, may_get, finished, may_return) == (False, True, True, False)
        times.append(time)
        depths.append(held["slave"].get("life.worst_flank_depth"))

    slave = held["slave"] = Slave(both, tmp_path / "update", intermediateUpdate=update)
    slave.start(acceleration=FAST)
    whole = Slave(both, tmp_path / "whole").start(acceleration=FAST)
    assert slave.step(0.0, 0.1) == (False, 0.1) and whole.step(0.0, 0.1) == (False, 0.1)
    assert len(times) == 78 and times[-1] == 0.1 and np.diff(times)[:-1] == pytest.approx(times[0], rel=1e-9)
    assert np.all(np.diff(depths) >= 0.0) and depths[-1] > 0.0
    for name in ("life.worst_flank_depth", "life.worst_race_depth", "output.angle", "life.remaining"):
        assert slave.get(name) == pytest.approx(whole.get(name), rel=1e-9), name


@pytest.mark.parametrize("wanted, expected", [(0.0, 0.029), (0.05, 0.05), (9.0, 0.1)], ids=["at once", "later", "beyond the step"])
def test_the_importer_may_end_a_step(both, tmp_path, wanted, expected):
    def update(environment, time, may_set, may_get, finished, may_return, requested, until):
        if time > 0.028 and may_return:
            requested[0] = True
            until[0] = max(wanted, time)

    slave = Slave(both, tmp_path / "end", earlyReturnAllowed=True, intermediateUpdate=update).start()
    early, reached = slave.step(0.0, 0.1)
    assert early == (expected < 0.1) and reached == pytest.approx(expected, abs=1.5e-3)
    assert slave.step(reached, 0.01)[1] > reached


def test_refusals(both, native_fmus, tmp_path):
    with pytest.raises(Exception, match="Failed to instantiate"):
        Slave(both, tmp_path / "a", requiredIntermediateVariables=[1])
    with pytest.raises(Exception, match="Failed to instantiate"):
        Slave(both, tmp_path / "b", eventModeUsed=True)


def test_run_says_what_is_judged_otherwise_and_when(both):
    """What ``rvwear run`` shows at its end; steps, series and times stay those that were asked for."""
    system = connect({"reducer": both}, (), 0.1)
    system["reducer.acceleration"] = FAST
    series = system.run(duration=0.4, record=["reducer.life.worst_flank_depth"])
    assert series["time"] == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.4])
    said = [text for text in system.master.warnings if text.startswith("reducer.life.limited_by became")]
    assert said and "(was none)" in said[0] and " at time 0.09" in said[0]
    system.close()


def test_a_unit_without_judgements_does_not_return_early(native_fmus):
    unit = open_fmu("plant", native_fmus / "fmi3" / "RvPlant.fmu")
    assert not unit.description.coSimulation.mightReturnEarlyFromDoStep
    assert not unit.description.coSimulation.providesIntermediateUpdate
    unit.close()
