"""The command line tool ``rvwear``.

Exit codes: 0 done, 1 a run that failed, 2 bad input, 130 interrupted.
"""

import argparse
import os
import sys

from fmu_src.effect_check import EffectFault
from fmu_src.native import NativeFault
from fmu_src.package import PackageFault
from orchestrator import commands, system_commands
from orchestrator.ensemble.options import add_ensemble_command
from orchestrator.faults import InputFault, RunFault
from orchestrator.master import SCHEMES
from orchestrator.reducer import available
from orchestrator.system_commands import add_system_options


def main(arguments: list[str] | None = None) -> int:
    options = parser().parse_args(arguments)
    try:
        return options.run(options)
    except (InputFault, EffectFault) as fault:
        print(f"rvwear {options.command}: {fault}", file=sys.stderr)
        return 2
    except (RunFault, PackageFault, NativeFault) as fault:
        print(f"rvwear {options.command}: {fault}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # The reader has seen enough (rvwear ... | head); keep Python from complaining at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as problem:
        print(f"rvwear {options.command}: {problem}; choose another place for input or output", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"rvwear {options.command}: interrupted", file=sys.stderr)
        return 130


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(prog="rvwear", description="Dynamics and wear of RV reducers.")
    sub = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    solve = sub.add_parser("solve", help="forces, pressure, lag and stiffness over a crank turn")
    add_reducer_options(solve)
    add_json(solve)
    solve.set_defaults(run=commands.solve)

    run = sub.add_parser("run", help="co-simulate a system from a file, or the pair of a reducer for some crank turns")
    run.add_argument("system", nargs="?", help="scenario (.toml), SSP (.ssp, .ssd, folder) or FMU; without it, the pair of --reducer")
    add_reducer_options(run)
    add_coupling_options(run, None)
    add_system_options(run)
    run.add_argument("--record", action="append", metavar="PATTERN", help="what to record of a system: plant.lag, wear.*")
    run.add_argument("--turns", type=float, default=1.0, help="crank turns to simulate (default 1)")
    run.add_argument("--acceleration", type=float, default=1.0, help="wear counts this many times (default 1)")
    run.add_argument("--output", help="result file, .nc or of a system also .csv (default results/NAME_run.nc)")
    add_json(run)
    run.set_defaults(run=commands.run)

    check = sub.add_parser("check", help="run a system and hold it against reference results: for CI")
    check.add_argument("system", help="scenario (.toml), SSP (.ssp, .ssd, folder) or FMU")
    check.add_argument("--reference", required=True, metavar="FILE", help="results of rvwear run (.nc, .csv)")
    check.add_argument(
        "--tolerance", action="append", default=[], metavar="[NAME=]REL[,ABS]",
        help="of the largest value of a variable, plus an absolute part; the last that matches (default 1e-6)",
    )  # fmt: skip
    check.add_argument("--junit", metavar="FILE", help="write the verdicts as JUnit XML")
    check.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="--set plant.load_torque=150N.m")
    check.add_argument("--scheme", choices=SCHEMES, help="before the file's")
    add_system_options(check)
    add_json(check)
    check.set_defaults(run=system_commands.check)

    life = sub.add_parser("life", help="wear over thousands of hours, in error-controlled jumps")
    add_reducer_options(life)
    add_coupling_options(life)
    life.add_argument("--hours", type=float, default=10_000.0, help="operating hours (default 10000)")
    life.add_argument("--duty", metavar="FILE", help="speeds and torques with their shares of the hours (.toml)")
    life.add_argument("--tolerance", type=float, default=0.01,
                      help="error of the depths over those at the end (default 0.01)")
    life.add_argument("--first-jump", type=float, help="hours of the first jump at most (default: as the tolerance needs)")
    life.add_argument("--largest-jump", type=float, help="hours of the longest jump at most (default: as the tolerance needs)")
    life.add_argument("--output", help="result file (default results/NAME_life.nc); the report stands beside it")
    life.add_argument("--no-report", action="store_true", help="write no HTML report")
    start = life.add_mutually_exclusive_group()
    start.add_argument("--resume", action="store_true", help="go on from the checkpoint beside the output")
    start.add_argument("--restart", action="store_true", help="discard a checkpoint and start anew")
    start.add_argument("--reuse", action="store_true", help="show a finished result of the same inputs again, go on from its checkpoint, or start")
    add_json(life)
    life.set_defaults(run=commands.life)

    add_ensemble_command(sub)

    hysteresis = sub.add_parser("hysteresis", help="input locked, torque up and down: lost motion and stiffness")
    add_reducer_options(hysteresis)
    hysteresis.add_argument("--steps", type=int, default=40, help="torques per quarter of the loop (default 40)")
    hysteresis.add_argument("--angles", type=int, default=8, help="input angles averaged (default 8)")
    add_json(hysteresis)
    hysteresis.set_defaults(run=commands.hysteresis)

    modes = sub.add_parser("modes", help="natural frequencies and mode shapes under load, input held")
    add_reducer_options(modes)
    add_json(modes)
    modes.set_defaults(run=commands.modes)

    dynamics = sub.add_parser("dynamics-wear", help="wear of bodies in motion against equilibria: where dynamics matters")
    add_reducer_options(dynamics, positions=False)
    dynamics.add_argument("--speeds", type=float, nargs="+", default=[0.25, 1.0, 2.0], metavar="TIMES",
                          help="multiples of the set input speed (default 0.25 1 2); light load and resonance come along")
    dynamics.add_argument("--hours", type=float, default=200.0, help="operating hours at each point (default 200)")
    dynamics.add_argument("--cycles", type=int, default=4, help="meshing cycles that stand for them (default 4)")
    dynamics.add_argument("--limit", type=float, default=2.0, help="percent that count as a difference (default 2)")
    dynamics.add_argument("--output", help="the page (default results/NAME_dynamics.html)")
    add_json(dynamics)
    dynamics.set_defaults(run=commands.dynamics_wear)

    reproduce = sub.add_parser("reproduce", help="every claim of the sources held against the computation")
    reproduce.add_argument("claims", nargs="*", help="ids or prefixes: T, N16, C (default all)")
    reproduce.add_argument("--output", default="results/reproduce.html", help="the page")
    add_json(reproduce)
    reproduce.set_defaults(run=commands.reproduce)

    build = sub.add_parser("build", help="build and validate RvPlant.fmu, RvWear.fmu and RvReducer.fmu")
    build.add_argument("--reducer", default="RV20E-121", help=REDUCER_HELP)
    build.add_argument("--output", default="dist", help="folder of the FMUs (default dist)")
    build.add_argument("--flavour", choices=("python", "native", "both"), default="both", help="editable FMUs in the"
                       " folder itself, native ones in its folders fmi2 and fmi3, which need no Python (default both)")
    build.add_argument("--fmi", choices=("2", "3", "both"), default="both", help="FMI version of the native FMUs")
    build.add_argument("--all-platforms", action="store_true", help="native FMUs for Linux, Windows and Darwin, not"
                       " for this machine alone; needs zig: pip install rvwear[build]")
    add_json(build)
    build.set_defaults(run=commands.build)

    report = sub.add_parser("report", help="write the HTML report of a life result again")
    report.add_argument("result", help="result file of rvwear life (.nc)")
    report.add_argument("--output", help="report file (default beside the result)")
    report.set_defaults(run=commands.report)
    # The loop of comparison and diagnosis stands above the orchestrator.
    from discrepancy.campaign.commands import add_campaign
    from discrepancy.catalogue.commands import add_effects
    from discrepancy.commands import add_loop

    add_campaign(sub)
    add_effects(sub)
    add_loop(sub)
    return top


REDUCER_HELP = f"{', '.join(available())}, or a reducer file (default RV20E-121)"


def add_json(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="print figures as JSON, nothing else")


def add_reducer_options(command: argparse.ArgumentParser, positions: bool = True) -> None:
    command.add_argument("--reducer", default="RV20E-121", help=REDUCER_HELP)
    command.add_argument("--torque", type=float, metavar="NM", help="output torque [N m], opposing the motion")
    command.add_argument("--bearing-clearance", type=float, metavar="UM", help="radial needle clearance [um]")
    command.add_argument("--equidistant", type=float, metavar="UM", help="equidistant modification [um], > 0 is a gap")
    command.add_argument("--shift", type=float, metavar="UM", help="shift modification [um], < 0 is a gap")
    command.add_argument("--stiffness-reading", metavar="SI|literal", help="how the printed stiffnesses are read")
    command.add_argument("--contact-law", metavar="LAW", help="line, lankarani-nikravesh or palmgren")
    command.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE",
        help="any parameter or input, with a unit if it is not SI: --set pin_radius_error[3]=2um",
    )  # fmt: skip
    if positions:
        command.add_argument("--positions", type=int, default=72, help="equilibria per crank turn (default 72)")


def add_coupling_options(command: argparse.ArgumentParser, scheme: str | None = SCHEMES[0]) -> None:
    command.add_argument("--fmus", metavar="FOLDER", help="step the FMUs of this folder instead of the kernels")
    command.add_argument("--scheme", default=scheme, help="gauss-seidel (default) or jacobi")


if __name__ == "__main__":
    sys.exit(main())
