"""What is tried with each importer, and what this project's own master gets.

``unit``: RvReducer alone through its smoke test, ``worn``: its state after 5,000 h restored at the start, ``pair``: plant and wear unit, values exchanged at
the beginning of each step (Jacobi) or one unit after the other (Gauss-Seidel), while wear counts a million times.
"""

import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, log10
from pathlib import Path

import numpy as np

from fmu_src.references import FOLDER
from orchestrator.experiments import Carried, experiments_in
from orchestrator.fmu import Fmu
from orchestrator.ssp.exporter import Experiment, Pair, Unit, element_pairs, export_ssp
from orchestrator.system import load
from reducers.reducer import Reducer
from studies.building import Wanted, build_units
from studies.pair import CONNECTIONS

ACCELERATION = 1e6
# 0.1 s at rated speed, a crank turn and a bit; a whole number of nanoseconds, which is what libcosim counts in.
STEP, STEPS = 1.25e-3, 80
WORN = "worn-5000h.state"
# Values at the end, by unit and element.
WATCHED = (
    "plant.output.lag", "plant.output.angle", "plant.input.drive_torque", "wear.flank.volume", "wear.inner_race.volume", "wear.flank.depth[1]",
    "wear.flank.depth[2]", "wear.inner_race.depth[1,1]",
)  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """One cell of the table: ``digits`` that agree in the worst variable of ``compared`` ones, or why there are none."""

    tool: str
    version: str
    flavour: str
    what: str
    compared: int = 0
    digits: float = 0.0
    said: str = ""

    @property
    def text(self) -> str:
        if self.said:
            return self.said
        return "all digits" if self.digits == inf else f"{self.digits:.0f} digits"


@dataclass(frozen=True)
class Bench:
    """The units that importers get: folders ``fmi2`` and ``fmi3`` in ``folder``; ``scratch`` is for what they leave."""

    folder: Path
    scratch: Path

    def fmu(self, version: str, name: str) -> Path:
        return self.folder / f"fmi{version}" / f"{name}.fmu"

    def package(self, version: str, inline: bool = False) -> Path:
        """The pair as a package, wear counted a million times."""
        target = self.scratch / f"fmi{version}{'-inline' if inline else ''}.ssp"
        fmus = {"plant": self.fmu(version, "RvPlant"), "wear": self.fmu(version, "RvWear")}
        experiment = Experiment(STEP, STEP * STEPS)
        return export_ssp(target, "RvReducer", fmus, CONNECTIONS, experiment, {"wear": {"acceleration": ACCELERATION}}, inline=inline)

    def smoke_test(self, version: str) -> Carried:
        """Of RvReducer, as the FMU carries it."""
        unit = Fmu("reducer", self.fmu(version, "RvReducer"))
        try:
            return next(e for e in experiments_in(unit.folder) if e.name == "smoke-test")
        finally:
            unit.close()

    def carried(self, version: str, name: str) -> Path:
        """A file that RvReducer carries, unpacked."""
        target = self.scratch / f"fmi{version}-{name}"
        with zipfile.ZipFile(self.fmu(version, "RvReducer")) as archive:
            target.write_bytes(archive.read(f"{FOLDER}/{name}"))
        return target

    def worn_lag(self, version: str) -> dict[str, float]:
        unit, test = Fmu("reducer", self.fmu(version, "RvReducer")), self.smoke_test(version)
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        unit.restore(self.carried(version, WORN).read_bytes())
        for n in range(steps_of(test)):
            unit.step(n * test.step, test.step)
        values = {name: unit.number(name) for name in ("output.lag", "life.worst_flank_depth")}
        unit.close()
        return values

    def pair(self, version: str, scheme: str) -> dict[str, float]:
        """The watched values after ``STEPS`` steps."""
        system = load(self.package(version), scheme=scheme)
        system.run()
        values = {path: float(system[path]) for path in WATCHED}
        system.close()
        return values

    def elements(self) -> list[Pair]:
        """Every connection of the FMI 2 pair."""
        units = {name: Unit(name, self.fmu("2", f"Rv{name.title()}")) for name in ("plant", "wear")}
        return [pair for start, end in CONNECTIONS for pair in element_pairs(units, start, end)]


def make_bench(reducer: Reducer, folder: Path, scratch: Path) -> Bench:
    """Build what is not there."""
    build_units(reducer, folder, Wanted("native"))
    return Bench(folder, scratch)


def ends_of(experiment: Carried) -> tuple[dict[str, float], dict[str, float]]:
    """(values at the end, largest in the run) of its results."""
    results = {name: values for name, values in experiment.references.items() if name != "time"}
    return {n: float(v[-1]) for n, v in results.items()}, {n: float(np.abs(v).max()) for n, v in results.items()}


def steps_of(experiment: Carried) -> int:
    return round(experiment.stop / experiment.step)


def agreeing_digits(theirs: Mapping[str, float], ours: Mapping[str, float], largest: Mapping[str, float] | None = None) -> float:
    """Decimal digits in which the worst variable agrees; inf if all are equal to the bit.

    They are counted from a variable's ``largest`` value in the run, or else from the value itself.
    """
    scale = largest or ours
    apart = max(abs(theirs[name] - value) / max(abs(scale[name]), 1e-300) for name, value in ours.items())
    return inf if apart == 0.0 else float(np.floor(-log10(apart))) if apart < 1.0 else 0.0
