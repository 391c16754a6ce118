"""Importers that couple plant and wear unit."""

import csv
import json
import re
import shutil
import sys
import zipfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

from benchmarks.importers.cases import ACCELERATION, STEP, STEPS, WATCHED, Bench, Outcome, agreeing_digits
from benchmarks.importers.tools import ToolFault, Tools, package_version, run, said_by
from fmu_src.link import FMI_HEADERS
from fmu_src.source_hash import ROOT

STRANGERS = ROOT / "tests" / "strangers"
SCHEMES = {"pair, Jacobi": "jacobi", "pair, Gauss-Seidel": "gauss-seidel"}
# By this project's name of a scheme.
MASTERSIM_MODES = {"jacobi": "GAUSS_JACOBI", "gauss-seidel": "GAUSS_SEIDEL"}


def attempt(bench: Bench, tool: str, version: str, flavour: str, what: str, values: Callable[[], dict[str, float]]) -> Outcome:
    """What a tool finds for the watched variables, held against this project's master."""
    try:
        theirs = values()
    except ToolFault as fault:
        return Outcome(tool, version, flavour, what, said=str(fault))
    ours = {name: value for name, value in bench.pair(flavour[4], SCHEMES[what]).items() if name in theirs}
    return Outcome(tool, version, flavour, what, len(ours), agreeing_digits(theirs, ours))


def unpacked(package: Path) -> Path:
    folder = package.with_suffix("")
    shutil.rmtree(folder, ignore_errors=True)
    with zipfile.ZipFile(package) as archive:
        archive.extractall(folder)
    return folder


def stranger(bench: Bench, script: str, package: Path) -> dict[str, float]:
    said = run([sys.executable, STRANGERS / script, package, repr(STEP), str(STEPS), *WATCHED], bench.scratch / script)
    values: dict[str, float] = json.loads(said.strip().splitlines()[-1])["values"]
    return values


def mastersim_project(bench: Bench, folder: Path, lines: list[str]) -> Path:
    """A project of the pair; ``lines`` say how it is stepped."""
    folder.mkdir(parents=True, exist_ok=True)
    units = [f'simulator {i} {i} {name} #ff447cb4 "{bench.fmu("2", f"Rv{name.title()}")}"' for i, name in enumerate(("plant", "wear"))]
    graph = [f"graph {'.'.join(start)} {'.'.join(end)}" for start, end in bench.elements()]
    # Writing a row of all outputs takes it 0.3 s.
    text = ["tStart 0 s", "hOutputMin 1 s", *lines, "", *units, "", *graph, "", f"parameter wear.acceleration {ACCELERATION!r}", ""]
    project = folder / "pair.msim"
    project.write_text("\n".join(text), encoding="utf-8")
    return project


def through_mastersim(bench: Bench, program: Path, scheme: str) -> dict[str, float]:
    lines = [
        f"tEnd {STEP * STEPS!r} s", f"hMax {STEP!r} s", f"hMin {STEP!r} s", f"hStart {STEP!r} s", "adjustStepSize no",
        f"MasterMode {MASTERSIM_MODES[scheme]}", "ErrorControlMode NONE", "maxIterations 1", "preventOversteppingOfEndTime yes",
    ]  # fmt: skip
    folder = bench.scratch / f"mastersim-{scheme}"
    shutil.rmtree(folder, ignore_errors=True)
    run([program, "-x", "--verbosity-level=0", mastersim_project(bench, folder, lines)], folder)
    return last_row(folder / "pair" / "results" / "values.csv", "\t")


def last_row(file: Path, separator: str, before: str = "") -> dict[str, float]:
    """The watched values of a table's last row; units in its head are dropped, and what stands ``before`` the names."""
    with file.open(newline="", encoding="utf-8-sig") as lines:
        rows = [row for row in csv.reader(lines, delimiter=separator) if row]
    names = [re.sub(r"\s+\[[^\]]*\]\s*$", "", name).strip().removeprefix(before) for name in rows[0]]
    found = dict(zip(names, rows[-1]))
    missing = [name for name in WATCHED if name not in found]
    if missing:
        raise ToolFault(f"its results have no {missing[0]}")
    return {name: float(found[name]) for name in WATCHED}


def through_omsimulator(bench: Bench, program: Path, version: str) -> dict[str, float]:
    file = bench.scratch / f"omsimulator-{version}.csv"
    file.unlink(missing_ok=True)
    folder = bench.scratch / f"omsimulator-{version}"
    run([program, f"--stopTime={STEP * STEPS!r}", f"--resultFile={file}", bench.package(version)], folder)
    if not file.is_file():
        raise ToolFault("it wrote no results")
    # Model and system stand before the units.
    return last_row(file, ",", "RvReducer.RvReducer.")


def through_openmcx(bench: Bench, program: Path) -> dict[str, float]:
    folder = unpacked(bench.package("2", inline=True))
    run([program, "SystemStructure.ssd"], folder)
    found: dict[str, float] = {}
    for name in ("plant", "wear"):
        file = folder / "results" / f"{name}_res.csv"
        if not file.is_file():
            raise ToolFault(f"it wrote no results of {name}")
        with file.open(newline="", encoding="utf-8") as lines:
            rows = [row for row in csv.reader(lines) if row]
        heads = next(row for row in rows if row[0] == "Time")
        found |= {path: float(value) for head, value in zip(heads, rows[-1]) if (path := f"{name}.{head}") in WATCHED}
    return found


def through_c(bench: Bench, scheme: str) -> dict[str, float]:
    """examples/pair_master.c with the FMI 3 units."""
    folder = bench.scratch / "pair_master"
    for name in ("plant", "wear"):
        with zipfile.ZipFile(bench.fmu("3", f"Rv{name.title()}")) as archive:
            archive.extractall(folder / name)
    run(["cc", "-std=c99", f"-I{FMI_HEADERS}", ROOT / "examples" / "pair_master.c", "-o", "pair_master", "-ldl"], folder)
    said = run(["./pair_master", "plant", "wear", scheme, repr(STEP), str(STEPS), repr(ACCELERATION)], folder)
    depths = {name: float(value) for name, value in re.findall(r"(wear\.[\w.]+\[\d+\]) = (\S+) m", said)}
    return {name: depths[name] for name in WATCHED if name in depths}


def outcomes(bench: Bench, tools: Tools) -> list[Outcome]:
    found = []
    for name, script in (("ecos", "ecos.py"), ("libcosim", "libcosim.py")):
        version = package_version(name)
        if version is None:
            found.append(Outcome(name, "", "FMI 2.0", "pair, Jacobi", said=tools.missing(name)))
            continue
        package = bench.package("2")
        target = unpacked(package) if name == "libcosim" else package
        found.append(attempt(bench, name, version, "FMI 2.0", "pair, Jacobi", partial(stranger, bench, script, target)))
    for name, title, flavour, what, values in PROGRAMS:
        program = tools.path(name)
        if program is None:
            found.append(Outcome(title, "", flavour, what, said=tools.missing(name)))
        else:
            found.append(attempt(bench, title, version_of(name, program), flavour, what, partial(values, bench, program)))
    if shutil.which("cc"):
        found += [attempt(bench, "examples/pair_master.c", "", "FMI 3.0", what, partial(through_c, bench, s)) for what, s in SCHEMES.items()]
    return found


def version_of(name: str, program: Path) -> str:
    if name == "openmcx":
        return "says none"
    said = said_by([program, "--version"])
    match = re.search(r"v?(\d+\.\d+[\w.+-]*)", said)
    return match[1] if match else said[:40]


# Option, title, flavour, what, how.
PROGRAMS: tuple[tuple[str, str, str, str, Callable[[Bench, Path], dict[str, float]]], ...] = (
    ("mastersim", "MasterSim", "FMI 2.0", "pair, Jacobi", partial(through_mastersim, scheme="jacobi")),
    ("mastersim", "MasterSim", "FMI 2.0", "pair, Gauss-Seidel", partial(through_mastersim, scheme="gauss-seidel")),
    ("omsimulator", "OMSimulator", "FMI 2.0", "pair, Jacobi", partial(through_omsimulator, version="2")),
    ("omsimulator", "OMSimulator", "FMI 3.0", "pair, Jacobi", partial(through_omsimulator, version="3")),
    ("openmcx", "OpenMCx", "FMI 2.0", "pair, Jacobi", through_openmcx),
)
