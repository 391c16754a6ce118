"""Run the units in the importers that this machine has, and write docs/importers.md.

    python -m benchmarks.importers [--tool NAME=PATH ...] [--schemas DIR] [--units DIR] [--output docs/importers.md] [--doubling]

Programs: fmusim, mastersim, omsimulator, openmcx, fmucheck, also as RVWEAR_FMUSIM and so on or on the search path; packages: fmpy, ecospy, libcosimpy.
What is not there is said, with how to get it.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from benchmarks.importers import pair, schemas, single
from benchmarks.importers.cases import ACCELERATION, STEP, STEPS, WATCHED, Outcome, make_bench
from benchmarks.importers.doubling import END, LONGEST, Doubling, growth, measured
from benchmarks.importers.tools import PROGRAMS, Tools
from fmu_src.faults import InputFault
from reducers.reducer import load_reducer

HEAD = """# Importers

Made by `python -m benchmarks.importers --doubling` with the native units of RV20E-121 on x86-64 Linux. *unit*: RvReducer through the smoke test that it carries, all
scalar outputs at its end. *worn*: the state after 5,000 h that it carries, restored by the importer before the first step, then the same. *pair*: plant and wear unit from
`RvReducer.ssp` (MasterSim and the C program: connected by their own means) through {steps} steps of {step:g} ms, wear counted {acceleration:g} times, {count} values at the end:
{watched}. *Digits* are decimal digits in which the worst of the values agrees with this project's own master; tools that add up time instead of multiplying
find angles that differ in the last ones. OMSimulator 3 knows neither `Float64` nor arrays in a package, so it takes the pair of FMI 2.0 alone; OpenMCx takes the package with values inline.

fmpy's `simulate_ssp` (0.3.32) is no way for the package: it gives every connected input 0 in the first step, whatever the units start with, and the wear unit refuses it
("heat.contact_temperature = 0 K is out of range"). With fmpy alone `simulate_fmu` takes `RvReducer.fmu`, the same joint as one unit; `rvwear run dist/fmi2/RvReducer.ssp` takes the package.

| importer | version | flavour | what | values | agreement |
|---|---|---|---|---|---|
"""
DOUBLING = """
## Step doubling

MasterSim with `ErrorControlMode STEP_DOUBLING`, the pair of FMI 2.0 through {end:g} s at rated speed, wear counted {acceleration:g} times, `absTol` = `relTol`, steps up to {longest:g} ms.
What plant and wear unit exchange adds up exactly over steps: one step and two of half its size differ in second order, and steps grow with one over the tolerance
to the power of {power}. Gauss-Seidel: with Jacobi MasterSim 0.9.8 puts the units back after a refused step and not its own time, and ends.

| tolerance | steps | of these refused | s |
|---|---|---|---|
"""


def page(outcomes: list[Outcome], doublings: list[Doubling]) -> str:
    watched = ", ".join(f"`{name}`" for name in WATCHED)
    text = HEAD.format(steps=STEPS, step=STEP * 1e3, acceleration=ACCELERATION, count=len(WATCHED), watched=watched)
    rows = [f"| {o.tool} | {o.version} | {o.flavour} | {o.what} | {o.compared or ''} | {o.text.replace('|', '/')} |\n" for o in outcomes]
    text += "".join(rows)
    if doublings:
        power = growth(doublings)
        text += DOUBLING.format(end=END, acceleration=ACCELERATION, longest=LONGEST * 1e3, power="?" if power is None else f"{power:.2f}")
        text += "".join(f"| {d.tolerance:g} | {d.said or d.steps} | {'' if d.said else d.failures} | {'' if d.said else f'{d.seconds:.1f}'} |\n" for d in doublings)
    return text


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="benchmarks.importers", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--tool", action="append", default=[], metavar="NAME=PATH", help=f"a program: {', '.join(PROGRAMS)}")
    parser.add_argument("--schemas", metavar="DIR", help="the schemas of SSP 2.0 (folder schema of modelica/ssp-standard): packages are held against them")
    parser.add_argument("--units", default="results/importers", metavar="DIR", help="where the FMUs are, or are built to (default results/importers)")
    parser.add_argument("--output", default="docs/importers.md", metavar="FILE", help="the page (default docs/importers.md)")
    parser.add_argument("--doubling", action="store_true", help="MasterSim's step doubling too: minutes")
    options = parser.parse_args(arguments)
    try:
        tools = Tools.of(options.tool)
    except InputFault as fault:
        print(f"benchmarks.importers: {fault}", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as scratch:
        bench = make_bench(load_reducer("RV20E-121"), Path(options.units).resolve(), Path(scratch))
        found = [*single.outcomes(bench, tools), *pair.outcomes(bench, tools)]
        try:
            found += schemas.outcomes(bench, Path(options.schemas)) if options.schemas else []
        except InputFault as fault:
            print(f"benchmarks.importers: {fault}", file=sys.stderr)
            return 2
        program = tools.path("mastersim")
        doublings = measured(bench, program) if options.doubling and program is not None else []
    for o in found:
        print(f"{o.tool} {o.version}, {o.flavour}, {o.what}: {o.text}")
    Path(options.output).write_text(page(found, doublings), encoding="utf-8")
    print(f"page  {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
