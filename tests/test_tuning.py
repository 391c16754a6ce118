"""Amplitudes of effects set during a run: a slider in a system model.  Through fmpy, as any importer would."""

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from stand import only, records_of

from fmu_src.faults import InputFault, RunFault
from orchestrator.component import InProcess
from rv_plant import plant
from rv_plant.effects import EFFECTS as PLANT
from wear_fmu import accumulator
from wear_fmu.effects import EFFECTS as WEAR

RUNOUT = 5e-6


class Slave:
    """A native plant in fmpy's own classes, scalars in and out."""

    def __init__(self, path, version, folder):
        fmpy.extract(str(path), str(folder))
        description = fmpy.read_model_description(str(path))
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.variability = {v.name: v.variability for v in description.modelVariables}
        kind = FMU2Slave if version == "fmi2" else FMU3Slave
        self.unit = kind(guid=description.guid or description.instantiationToken, unzipDirectory=str(folder),
                         modelIdentifier="RvPlant", instanceName="slider")  # fmt: skip
        self.unit.instantiate()
        if version == "fmi2":
            self.unit.setupExperiment()
        self.read, self.write = (
            (self.unit.getReal, self.unit.setReal) if version == "fmi2" else (self.unit.getFloat64, self.unit.setFloat64)
        )

    def get(self, name):
        return self.read([self.references[name]])[0]

    def set(self, name, value):
        self.write([self.references[name]], [value])

    def start(self):
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()

    def step(self, i):
        self.unit.doStep(i * 1e-3, 1e-3)
        return np.array([self.get("output.lag"), self.get("mesh.largest_force")])


@pytest.mark.parametrize("version", ["fmi2", "fmi3"])
def test_the_pins_runout_is_changed_during_a_run_and_the_forces_follow(native_fmus, version, tmp_path):
    """Ten steps true, ten with runout, ten true again: each as if it had been so from the start."""
    series = {}
    for name, runout in {"true": lambda i: 0.0, "out": lambda i: RUNOUT, "slider": lambda i: RUNOUT * (10 <= i < 20)}.items():
        slave = Slave(native_fmus / version / "RvPlant.fmu", version, tmp_path / name)
        slave.set("effects.pin_position_errors.ring_runout", runout(0))
        slave.start()
        series[name] = []
        for i in range(30):
            slave.set("effects.pin_position_errors.ring_runout", runout(i))
            series[name].append(slave.step(i))
        slave.unit.terminate()
        slave.unit.freeInstance()
    true, out, slider = (np.array(series[name]) for name in ("true", "out", "slider"))
    assert slave.variability["effects.pin_position_errors.ring_runout"] == "tunable" and slave.variability["pin.radius"] == "fixed"
    expected = np.where(((np.arange(30) >= 10) & (np.arange(30) < 20))[:, None], out, true)
    assert slider == pytest.approx(expected, rel=1e-7)
    assert np.abs(out[10:20] - true[10:20]).max(axis=0) == pytest.approx(np.abs(slider - true).max(axis=0))
    assert np.all(np.abs(out[10:20] / true[10:20] - 1.0).max(axis=0) > 0.05)


@pytest.mark.parametrize("effects, unit", [(PLANT, "plant"), (WEAR, "wear")])
def test_every_amplitude_is_tunable_and_no_shape_is(rv20e, effects, unit):
    table = getattr(rv20e, unit)
    for effect in effects.values():
        for p in effect.parameters:
            # Of a third crank, which this reducer has not, none is shown.
            if (v := table.find(p.variable.path)) is not None:
                assert v.variability == ("tunable" if p.kind == "amplitude" else "fixed"), v.path
    assert table.find("effects.crank_lobe_errors.lobe_throw_error_3") is None


AMPLITUDES = sorted({p.variable.name: p for e in PLANT.values() for p in e.amplitudes()}.items())


def test_every_amplitude_of_the_plant_acts_from_the_next_step_on(rv20e):
    """As in a plant that had it from the start, at the same place; what an effect remembers is not forgotten."""
    remembered = {"support_slip_compliance", "thermal_resistance"}
    for name, p in AMPLITUDES:
        if name in remembered:
            continue
        size = p.variable.start + (p.scale if p.scale > 0.0 else -p.scale) * 0.3
        late, early = records_of(rv20e.plant), records_of(rv20e.plant, **{name: size})
        assert plant.initialise(late) == 0 and plant.initialise(early) == 0, name
        for i in range(4):
            if i == 2:
                late[name] = size
            assert plant.step(late, 0.0, 1e-3) == 0 and plant.step(early, 0.0, 1e-3) == 0, name
        for output in ("lag", "largest_pin_force", "largest_roller_force", "drive_torque"):
            assert only(late)[output] == pytest.approx(only(early)[output], rel=1e-5, abs=1e-9), (name, output)


def test_what_an_effect_remembers_outlives_a_slider(rv20e):
    """A seat that has slipped keeps its friction, a warm housing its temperature."""
    records = records_of(rv20e.plant, support_slip_compliance=1e-7, thermal_time=10.0, thermal_resistance=0.5, friction_coefficient=0.02)
    assert plant.initialise(records) == 0
    for _ in range(3):
        assert plant.step(records, 0.0, 1e-2) == 0
    force, warm = only(records).support_force, only(records).housing_temperature
    assert force != 0.0 and warm > only(records).temperature
    records["pin_ring_runout"] = 1e-6
    assert plant.step(records, 0.0, 1e-12) == 0
    assert only(records).support_force == pytest.approx(force, rel=0.05)
    assert only(records).housing_temperature == pytest.approx(warm, rel=1e-9)


def test_an_amplitude_of_wear_is_set_during_a_run(rv20e):
    volumes = {}
    for when in (0, 5, 99):
        records = records_of(rv20e.wear, mesh_force=300.0, crank_speed=100.0)
        assert accumulator.initialise(records) == 0
        for i in range(10):
            if i == when:
                records["load_exponent_added"] = 0.4
            records["crank_angle"] += 0.05
            assert accumulator.step(records, 0.0, 5e-4) == 0
        volumes[when] = float(only(records).flank_volume)
    early, half, never = (volumes[when] for when in (0, 5, 99))
    assert abs(early / never - 1.0) > 0.01
    assert half == pytest.approx(0.5 * (early + never), rel=2e-3)


def test_a_support_that_becomes_rigid_leaves_nothing_behind(rv20e):
    records = records_of(rv20e.plant, main_bearing_compliance=1e-8)
    assert plant.initialise(records) == 0
    records["main_bearing_compliance"] = 0.0
    assert plant.step(records, 0.0, 1e-3) == 0
    rigid = records_of(rv20e.plant)
    assert plant.initialise(rigid) == 0 and plant.step(rigid, 0.0, 1e-3) == 0
    assert only(records).lag == pytest.approx(only(rigid).lag, rel=1e-8)


def test_a_bad_value_is_refused_with_a_message_and_a_fixed_parameter_too(rv20e, native_fmus):
    from orchestrator.opening import open_fmu

    unit = open_fmu("plant", native_fmus / "fmi3" / "RvPlant.fmu")
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    with pytest.raises(RunFault, match=r"effects.pin_position_errors.ring_runout = 1 m is out of range: it must lie in \["):
        unit.set("effects.pin_position_errors.ring_runout", 1.0)
    with pytest.raises(RunFault, match="pin.radius is fixed once the unit is initialised; reset the unit to change it"):
        unit.set("pin.radius", 2e-3)
    unit.close()
    with pytest.raises(InputFault, match="effects.pin_position_errors.ring_runout = 1 m is out of range"):
        InProcess("plant", rv20e.specification("rv_plant")).set("effects.pin_position_errors.ring_runout", 1.0)
