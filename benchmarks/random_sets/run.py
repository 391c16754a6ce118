"""One random set after the other: in process and as FMU, through a crank turn at rest of the wear, then worn in great strides."""

import itertools
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.random_sets.balance import Bodies, stored_energy
from benchmarks.random_sets.draw import Drawn, draw
from benchmarks.random_sets.faults import is_found_patiently, is_true, is_worn_through
from fmu_src.faults import InputFault, RunFault
from fmu_src.package import build_native
from fmu_src.state import HEADER_SIZE
from fmu_src.unit import Specification
from orchestrator.component import Component, InProcess, unit_of
from orchestrator.fmu import Fmu
from reducers.reducer import load_reducer
from rv_plant.faults import NO_EQUILIBRIUM, NO_MOTION, NO_START
from rv_reducer.reducer import OF_WEAR
from wear_fmu.accumulator import WORN_THROUGH

REDUCERS = ("RV20E-121-rigid", "BX-40E-rigid", "cycloidal-actuator")
# Of a crank turn and of the worn part behind it.
STEPS, WORN_STEPS = 72, 12
WORN = 3e-6  # depth [m] that the worn part is accelerated to
# Out of balance over the largest force, beside the set's own tolerance; of the power over what was turned over, beside what is stored.
BALANCE, POWER, VOLUME = 1e-7, 5e-3, 1e-9
# The kernels turn flanks by their pitch errors to first order: what that leaves goes with the square of the angle.
TURNED_FLANKS = 300.0
NOT_FINITE = "infinite or not a number"
# Work [J] below which there is nothing to balance.
LEAST_WORK = 1e-9
# Teeth whose ripple the steps of a crank turn can follow.
MOST_TEETH = 24.0
# Beyond what any temperature may be set to [K].
HOTTEST = 500.0
# Of energy in motion the integrator takes a little.
MOTION = 1e-2


@dataclass
class Tally:
    """What became of the sets; ``findings`` is what should not be."""

    outcomes: Counter[str] = field(default_factory=Counter)
    findings: list[str] = field(default_factory=list)
    worst: dict[str, float] = field(default_factory=dict)
    units: int = 0

    def measured(self, name: str, value: float, most: float, drawn: Drawn) -> None:
        """A check's share of what it allows."""
        self.worst[name] = max(self.worst.get(name, 0.0), value / most)
        if not value <= most:
            self.findings.append(f"set {drawn.number}: {name} {value:.3g}, {most:.3g} is allowed ({drawn.astray or 'nothing astray'})")


def fault_code(text: str, faults: dict[int, str]) -> int:
    """The code whose text this is."""
    for code, pattern in faults.items():
        if re.search(".*".join(map(re.escape, re.split(r"\{[^}]*\}", pattern)))[:400], text):
            return code
    return 0


def applied(unit: Component, drawn: Drawn) -> Component:
    for name, value in drawn.values.items():
        unit.set(name, value)
    return unit


def trajectory(unit: Component, drawn: Drawn, step: float) -> Iterator[bytes]:
    """The state after initialisation, after each step, and after each of the worn ones."""
    applied(unit, drawn).enter_initialisation(0.0)
    unit.exit_initialisation()
    yield unit.save()
    if not 0.0 < step < 3600.0:
        return
    for n in range(STEPS):
        unit.step(n * step, step)
        yield unit.save()
    depth = max(float(np.max(unit.get(name))) for name in ("flank_depth", "inner_race_depth", "outer_race_depth"))
    unit.set("acceleration", min(1e15, WORN / depth) if depth > 0.0 else 1.0)
    for n in range(STEPS, STEPS + WORN_STEPS):
        unit.step(n * step, step)
        yield unit.save()


class Sets:
    """A reducer's unit in process and as native FMU, taken through one set after the other."""

    def __init__(self, name: str, folder: Path | None):
        self.specification = load_reducer(name).specification("rv_reducer")
        self.reducer, self.unit = load_reducer(name), unit_of(self.specification)
        self.fmu = None
        if folder is not None:
            self.fmu = Fmu("fmu", build_native("RvReducer", self.specification, 1e-3, "random sets", folder / name, ("3",))[0])

    def close(self) -> None:
        if self.fmu is not None:
            self.fmu.close()

    def step_of(self, drawn: Drawn) -> float:
        """A 72nd of a crank turn [s], in motion a fiftieth of that."""
        start = {v.name: v.start for v in self.unit.table.variables}
        lobes, pins = start_sizes(self.specification)
        ratio = float(drawn.values.get("first_stage_ratio", start["first_stage_ratio"]))
        speed = abs(float(drawn.values.get("input_speed", start["input_speed"])))
        speed *= 1.0 / (1.0 + ratio * pins) * lobes if ratio > 0.0 else 1.0
        whole = 2.0 * np.pi / speed / STEPS if speed > 0.0 else 0.0
        return whole / 50.0 if drawn.values.get("fidelity", 0) == 1 else whole

    def run(self, number: int, tally: Tally) -> None:
        drawn = draw(self.reducer, self.unit.table, number)
        unit, step = InProcess("unit", self.specification), self.step_of(drawn)
        states: list[bytes] = []
        said, audit = "", Audit(self, unit, drawn, tally)
        try:
            for state in trajectory(unit, drawn, step):
                states.append(state)
                audit.look(len(states))
        except (InputFault, RunFault) as fault:
            said = str(fault)
        tally.units += 1
        if said:
            audit.refused(said, len(states))
        else:
            motion, hot = drawn.values.get("fidelity") == 1, audit.is_hot
            tally.outcomes[f"converged{' in motion' if motion else ''}{', run hot' if hot else ''}"] += 1
            audit.end()
        if self.fmu is not None:
            self.compare(drawn, step, states, said, tally)

    def compare(self, drawn: Drawn, step: float, states: list[bytes], said: str, tally: Tally) -> None:
        """The FMU goes the same way, state by state, and says the same at its end."""
        assert self.fmu is not None
        self.fmu.slave.reset()
        found, count = "", 0
        try:
            for state, right in itertools.zip_longest(trajectory(self.fmu, drawn, step), states):
                if state is None or right is None or state[HEADER_SIZE:] != right:
                    tally.findings.append(f"set {drawn.number}: state {count} of the FMU is another than in process")
                    return
                count += 1
        except (InputFault, RunFault) as fault:
            found = str(fault)
        if NOT_FINITE in found and said:
            # An FMU looks at every output after a step, the unit in process does not.
            return
        if count != len(states) or bool(found) != bool(said) or (said and said.partition("at time")[2][-60:] not in found):
            tally.findings.append(f"set {drawn.number}: the FMU says {found[-200:]!r} after {count} states, in process {said[-200:]!r} after {len(states)}")


def start_sizes(specification: Specification) -> tuple[int, int]:
    topology = specification["sizes"]["topology"]
    return topology["lobes"], topology["pins"]


class Audit:
    """What is held against one set's run in process."""

    def __init__(self, sets: Sets, unit: InProcess, drawn: Drawn, tally: Tally):
        self.sets, self.unit, self.drawn, self.tally = sets, unit, drawn, tally
        self.given = self.taken = self.lost = 0.0
        self.before: dict[str, float] | None = None
        self.most_stored = 0.0
        self.is_hot = False

    @property
    def record(self) -> Any:
        return self.unit.records["plant"][0]

    def look(self, count: int) -> None:
        r = self.record
        if float(r["reducer_temperature"]) > HOTTEST:
            # Forces of meganewtons, of which no balance has digits.
            self.is_hot = True
        now = {name: float(r[name]) for name in ("drive_torque", "input_angle", "output_angle", "power_loss", "load_torque")}
        if r["fidelity"] == 0 and not self.is_hot:
            pitch = float(np.abs(r["lobe_pitch_error"] + r["lobe_pitch_added"]).max() / r["pin_circle_radius"] + abs(r["angle_modification"]))
            allowed = BALANCE + 30.0 * float(r["tolerance"]) + TURNED_FLANKS * pitch**2
            if count % 7 == 1:
                for name, share in Bodies(r).left_over().items():
                    self.tally.measured(name, share, allowed, self.drawn)
            self.most_stored = max(self.most_stored, stored_energy(r))
        if self.before is not None and count <= STEPS + 1:
            turned = now["input_angle"] - self.before["input_angle"]
            self.given += 0.5 * (now["drive_torque"] + self.before["drive_torque"]) * turned
            self.taken += 0.5 * (now["load_torque"] + self.before["load_torque"]) * (now["output_angle"] - self.before["output_angle"])
            speed = abs(float(r["input_speed"]))
            self.lost += 0.5 * (now["power_loss"] + self.before["power_loss"]) * abs(turned) / speed if speed > 0.0 else 0.0
        self.before = now

    def end(self) -> None:
        r = self.record
        self.volumes()
        if self.is_hot:
            return
        if r["fidelity"] == 0:
            over = max(abs(self.given), abs(self.taken), self.lost)
            if float(r["sun_teeth"]) > MOST_TEETH:
                return
            self.tally.measured("power", abs(self.given - self.taken - self.lost), POWER * over + 2.0 * self.most_stored + LEAST_WORK, self.drawn)
        else:
            # Heat that makes the parts grow against each other does work that no account of mechanics knows,
            # and where lobes are not alike a pin jumps from one to the next.
            unlike = np.ptp(r["lobe_profile_error"] + r["lobe_gap_added"]) + np.ptp(r["lobe_pitch_error"] + r["lobe_pitch_added"])
            if r["thermal_expansion"] == 0.0 and unlike == 0.0:
                held = float(r["potential"]) + 0.5 * float(np.sum(r["mass"] * r["v"] ** 2))
                turned_over = abs(float(r["input_energy"])) + abs(float(r["output_energy"])) + abs(held - float(r["stored_energy"]))
                self.tally.measured("energy in motion", 0.5 * abs(float(r["energy_error"])) * turned_over, MOTION * (turned_over + held), self.drawn)

    def volumes(self) -> None:
        """What was worn off is what is missing on the surfaces."""
        r = self.unit.records[0]
        discs = r["disc_wear"].shape[0]
        flank = float(np.sum(r["disc_wear"].reshape(discs, -1, len(r["arc"])) * r["arc"]) * r["mesh_width"])
        pin = float(np.sum(r["pin_even_wear"]) * 2 * np.pi + np.sum(r["pin_wear"]) * np.pi / r["pin_wear"].shape[2]) * float(r["pin_radius"] * r["mesh_width"])
        found = {"flank_volume": flank, "pin_volume": pin}
        for race in ("inner", "outer"):
            worn = r[f"{race}_race_wear"]
            found[f"{race}_race_volume"] = float(np.sum(worn) * 2 * np.pi / worn.shape[2] * r[f"{race}_race_radius"] * r["roller_length"])
        for name, volume in found.items():
            own = float(r[name])
            self.tally.measured(f"volume: {name}", abs(volume - own), VOLUME * max(abs(own), abs(volume)) + 1e-30, self.drawn)

    def refused(self, said: str, states: int) -> None:
        code, when = fault_code(said, self.sets.unit.faults), "at the start" if states == 0 else "on the way"
        kind = self.sets.unit.faults[code].partition(":")[0].split("{")[0].strip() if code else "?"
        if code in (NO_EQUILIBRIUM, NO_MOTION, NO_START):
            # The message says how hot: friction, resistance and expansion drive each other.
            hot = float(self.record["reducer_temperature"]) > HOTTEST
            self.tally.outcomes[f"{kind}, {when}{', run hot' if hot else ''}"] += 1
            if code == NO_START and not self.drawn.astray:
                self.tally.findings.append(f"set {self.drawn.number}: no start of an ordinary motion: {said[-420:]}")
            if not hot and code == NO_EQUILIBRIUM and is_found_patiently(self.unit.unit, self.unit.records, states == 0):
                self.tally.findings.append(f"set {self.drawn.number}: refused {when}, yet there is an equilibrium: {said[-420:]} ({self.drawn.astray or 'nothing astray'})")
        else:
            self.tally.outcomes[f"refused with cause: {kind}"] += 1
            worn = code == OF_WEAR + WORN_THROUGH
            if not code or not (is_worn_through(self.unit.records[0]) if worn else is_true(code % OF_WEAR, self.record)):
                self.tally.findings.append(f"set {self.drawn.number}: an untrue fault: {said[-250:]} ({self.drawn.astray or 'nothing astray'})")
