"""Importers of one unit: RvReducer through the smoke test that it carries, and from its worn state."""

from pathlib import Path

import fmpy

from benchmarks.importers.cases import WORN, Bench, Outcome, agreeing_digits, ends_of, steps_of
from benchmarks.importers.tools import ToolFault, Tools, package_version, run, said_by
from orchestrator.series import read_series


def at_end(file: Path) -> dict[str, float]:
    return {name: float(values[-1]) for name, values in read_series(file).items()}


def through_fmpy(bench: Bench, version: str) -> list[Outcome]:
    test = bench.smoke_test(version)
    ours, largest = ends_of(test)
    names = list(ours)
    result = fmpy.simulate_fmu(str(bench.fmu(version, "RvReducer")), stop_time=test.stop, step_size=test.step, output_interval=test.step, output=names)
    theirs = {name: float(result[name][-1]) for name in names}
    digits = agreeing_digits(theirs, ours, largest)
    return [Outcome("fmpy simulate_fmu", package_version("fmpy") or "", f"FMI {version}.0", "unit", len(names), digits)]


def through_fmusim(bench: Bench, version: str, program: Path) -> list[Outcome]:
    test, flavour, name = bench.smoke_test(version), f"FMI {version}.0", said_by([program, "--version"]).split()[1]
    ends, largest = ends_of(test)
    common: list[str | Path] = [program, "--interface-type", "cs", "--stop-time", repr(test.stop), "--output-interval", repr(test.step)]
    found = []
    worn: list[str | Path] = ["--initial-fmu-state-file", bench.carried(version, WORN)]
    nothing: list[str | Path] = []
    for what, outputs, more in (("unit", list(ends), nothing), ("worn", ["output.lag", "life.worst_flank_depth"], worn)):
        file = bench.scratch / f"fmusim-{version}-{what}.csv"
        wanted = [part for output in outputs for part in ("--output-variable", output)]
        try:
            run([*common, *more, *wanted, "--output-file", file, bench.fmu(version, "RvReducer")], bench.scratch)
        except ToolFault as fault:
            found.append(Outcome("fmusim", name, flavour, what, said=str(fault)))
            continue
        ours, scale = (ends, largest) if what == "unit" else (bench.worn_lag(version), None)
        found.append(Outcome("fmusim", name, flavour, what, len(ours), agreeing_digits(at_end(file), ours, scale)))
    return found


def through_fmucheck(bench: Bench, program: Path) -> list[Outcome]:
    test = bench.smoke_test("2")
    file = bench.scratch / "fmucheck.csv"
    name = next((word for word in said_by([program]).split() if word[:1].isdigit()), "unknown")
    try:
        run([program, "-k", "cs", "-h", repr(test.step), "-s", repr(test.stop), "-n", str(steps_of(test)), "-o", file, bench.fmu("2", "RvReducer")], bench.scratch)
    except ToolFault as fault:
        return [Outcome("FMUComplianceChecker", name, "FMI 2.0", "unit", said=str(fault))]
    ours, largest = ends_of(test)
    theirs = at_end(file)
    known = {n: v for n, v in ours.items() if n in theirs}
    return [Outcome("FMUComplianceChecker", name, "FMI 2.0", "unit", len(known), agreeing_digits(theirs, known, largest))]


def outcomes(bench: Bench, tools: Tools) -> list[Outcome]:
    found = [outcome for version in ("2", "3") for outcome in through_fmpy(bench, version)]
    program = tools.path("fmusim")
    if program is None:
        found.append(Outcome("fmusim", "", "FMI 2.0, 3.0", "unit", said=tools.missing("fmusim")))
    else:
        found += [outcome for version in ("2", "3") for outcome in through_fmusim(bench, version, program)]
    program = tools.path("fmucheck")
    if program is None:
        return [*found, Outcome("FMUComplianceChecker", "", "FMI 2.0", "unit", said=tools.missing("fmucheck"))]
    return found + through_fmucheck(bench, program)
