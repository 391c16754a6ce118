"""``rvwear run`` and ``rvwear check``: systems from files, and the pair of a reducer."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from cli.options import SHORTHANDS, add_coupling_options, add_json, add_reducer_options, chosen, folder, number_in, result_path
from cli.written import only_file
from fmu_src.faults import InputFault
from fmu_src.progress import task
from orchestrator.schemes import SCHEMES

if TYPE_CHECKING:
    import numpy as np

    from orchestrator.regression import Comparison, Tolerance
    from orchestrator.system import System


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    drive = sub.add_parser("run", help="co-simulate a system from a file, or the pair of a reducer for some crank turns")
    drive.add_argument("system", nargs="?", help="scenario (.toml), SSP (.ssp, .ssd, folder) or FMU; without it, the pair of --reducer")
    add_reducer_options(drive)
    add_coupling_options(drive, None)
    add_system_options(drive)
    drive.add_argument("--record", action="append", metavar="PATTERN", help="what to record of a system: plant.output.lag, wear.*")
    drive.add_argument("--turns", type=float, default=1.0, help="crank turns to simulate (default 1)")
    drive.add_argument("--acceleration", type=float, default=1.0, help="wear counts this many times (default 1)")
    drive.add_argument("--output", help="result file, .nc or of a system also .csv (default results/NAME_run.nc)")
    add_json(drive)
    drive.set_defaults(run=run)

    judge = sub.add_parser("check", help="run a system and hold it against reference results: for CI")
    judge.add_argument("system", help="scenario (.toml), SSP (.ssp, .ssd, folder) or FMU")
    judge.add_argument("--reference", metavar="FILE", help="results of rvwear run (.nc, .csv); without it, the experiments that an FMU carries"
                       " (FMI-LS-REF)")
    judge.add_argument(
        "--tolerance", action="append", default=[], metavar="[NAME=]REL[,ABS]",
        help="of the largest value of a variable, plus an absolute part; the last that matches (default 1e-6)",
    )  # fmt: skip
    judge.add_argument("--junit", metavar="FILE", help="write the verdicts as JUnit XML")
    judge.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="--set plant.output.load_torque=150N.m")
    judge.add_argument("--scheme", choices=SCHEMES, help="before the file's")
    add_system_options(judge)
    add_json(judge)
    judge.set_defaults(run=check)


def add_system_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--step", type=number_in("s"), metavar="S", help="communication step [s], before the file's")
    command.add_argument("--duration", type=number_in("s"), metavar="S", help="time to simulate [s], before the file's")
    command.add_argument("--extrapolation", type=int, choices=(0, 1, 2), help="order of the polynomial that inputs follow")
    command.add_argument("--step-control", type=float, metavar="TOL", help="divide steps by their error, to this tolerance")
    command.add_argument("--loops", choices=("newton", "fixed-point"), help="how algebraic loops are solved")
    command.add_argument("--isolate", action="store_true", help="every FMU in a process of its own")
    command.add_argument("--wasm", action="store_true", help="every FMU as WebAssembly (needs: pip install \"rvwear[wasm]\")")
    command.add_argument(
        "--call-limit", action="append", default=[], metavar="[CALL=]S",
        help="end an isolated unit that takes longer for a call [s]: 30, or start=, initialise=, step=, values=, state=, end= (default 600)",
    )  # fmt: skip


def run(options: argparse.Namespace) -> int:
    """``rvwear run``: a system from a file, or the pair of a reducer."""
    from cli import screen

    if options.system:
        refuse_pair_options(options)
        name = options.system
        summary, last, units = run_system(options)
    else:
        refuse_system_options(options)
        name, summary, last, units = run_reducer(options)
    ends = {f"{name} (last)": value for name, value in last.items()}
    if options.json:
        screen.json_text(summary | ends)
    else:
        screen.figures(f"{name}: values at the end (largest of an array)", summary | ends, {f"{name} (last)": units[name] for name in last})
    return 0


def at_the_end(series: "dict[str, np.ndarray]") -> dict[str, float]:
    """The last value of each signal, of an array the largest."""
    import numpy as np

    return {name: float(np.max(values[-1])) for name, values in series.items() if name != "time"}


def run_reducer(options: argparse.Namespace) -> tuple[str, dict[str, object], dict[str, float], dict[str, str]]:
    """The pair of a reducer for some crank turns: (title, summary, values at the end, their units)."""
    import numpy as np

    from orchestrator import netcdf
    from studies import results
    from studies.pair import make_pair
    from studies.solve import SERIES, record_turn

    reducer, settings, positions = chosen(options)
    path = result_path(options.output, f"{reducer.name}_run")
    if not 0.0 < options.turns <= 1e5:
        raise InputFault(f"turns = {options.turns}: between one position ({1 / positions:.3g} turns) and 100,000")
    pair = make_pair(reducer, settings, folder(options.fmus), options.scheme or SCHEMES[0], positions)
    pair.wear.set("acceleration", options.acceleration)
    steps = round(options.turns * positions)
    if steps < 1:
        raise InputFault(f"turns = {options.turns}: at least one position ({1 / positions:.3g} turns) is needed")
    with task("steps", total=steps) as stepping:
        recorded = record_turn(pair, steps, stepping.advance).series
    step = pair.master.step_size
    series = {"time": (np.arange(steps) + 1) * step} | {f"plant.{pair.plant.signal(k).name}": v for k, v in recorded.items()}
    units = {f"plant.{s.name}": s.unit for k in SERIES for s in [pair.plant.signal(k)]}
    name = f"{reducer.name}_run"
    inputs = {"reducer": reducer.name, "settings": {s.name: s.value for s in settings},
              "turns": options.turns, "acceleration": options.acceleration, "scheme": options.scheme,
              "parameters": {"plant": results.parameters_of(pair.plant), "wear": results.parameters_of(pair.wear)}}
    pair.master.close()
    netcdf.write(netcdf.series_dataset(series, units, inputs), path)
    only_file(path)
    summary = {"result": str(path), "steps": len(series["time"]), "end_time_s": float(series["time"][-1])}
    return name, summary, at_the_end(series), units


def refuse_pair_options(options: argparse.Namespace) -> None:
    """A system's file says all: options of the pair beside it would be ignored."""
    given = [f"--{name.replace('_', '-')}" for name in (*SHORTHANDS, "fmus") if getattr(options, name)]
    given += [f"--{name}" for name, usual in (("turns", 1.0), ("acceleration", 1.0), ("positions", 72))
              if getattr(options, name) != usual]
    if given:
        raise InputFault(f"{', '.join(given)} with a system's file: use --set component.variable=value, or set it in the file")


def refuse_system_options(options: argparse.Namespace) -> None:
    names = ("step", "duration", "extrapolation", "step_control", "loops", "isolate", "wasm", "record", "call_limit")
    # 0 is given, too.
    unset = dict.fromkeys(names) | {"isolate": False, "wasm": False, "record": None, "call_limit": []}
    given = [f"--{name.replace('_', '-')}" for name in names if (value := getattr(options, name)) is not unset[name] and value != unset[name]]
    if given:
        raise InputFault(f"{', '.join(given)} without a system's file: give one (.toml, .ssp, .fmu)")


def open_system(options: argparse.Namespace) -> "System":
    """The system with the command line's options and settings applied."""
    from orchestrator.call_limits import parse_limits
    from orchestrator.master import LoopSettings, StepControl
    from orchestrator.system import load

    given = {
        "extrapolation": options.extrapolation,
        "step_control": StepControl(options.step_control) if options.step_control is not None else None,
        "loops": LoopSettings(options.loops) if options.loops else None,
        "scheme": options.scheme,
    }
    master = {name: value for name, value in given.items() if value is not None}
    with task("loading the units"):
        system = load(options.system, options.step, options.isolate, parse_limits(options.call_limit), options.duration, options.wasm, **master)
    for setting in options.set:
        path, equals, value = setting.partition("=")
        if not equals:
            raise InputFault(f"--set {setting!r}: write component.variable=value, for instance plant.output.load_torque=150N.m")
        system[path.strip()] = value.strip()
    return system


def simulate(system: "System", record: list[str]) -> "dict[str, np.ndarray]":
    with task("steps", total=system.steps) as stepping:
        return system.run(record=record, each_step=stepping.advance)


def outputs_of(system: "System") -> list[str]:
    """All outputs, for a system whose file does not say what to record."""
    return [f"{n}.{v}" for n, c in system.master.components.items() for v, s in c.signals.items() if s.causality == "output"]


def show_warnings(system: "System") -> None:
    for warning in system.master.warnings:
        print(f"warning: {warning}", file=sys.stderr)


def show_end(options: argparse.Namespace, ran: float, step: float) -> None:
    """A duration that is no multiple of the step is not reached, or gone beyond: results keep their even raster."""
    wanted = options.duration
    if wanted is None or abs(ran - wanted) <= 1e-6 * wanted:
        return
    text = f"{wanted:g} s are no whole steps of {step:.6g} s: the run took the nearest number of them, {ran:.6g} s"
    print(f"warning: {text}; --step {wanted / round(wanted / step):.9g} divides it", file=sys.stderr)


def run_system(options: argparse.Namespace) -> tuple[dict[str, object], dict[str, float], dict[str, str]]:
    """Run and write; (summary, values at the end, units of all variables)."""
    from orchestrator.series import SUFFIXES, write_series

    system = open_system(options)
    path = result_path(options.output, system.name, SUFFIXES)
    record = options.record or ([] if system.recorded else outputs_of(system))
    series = simulate(system, record)
    units = system.units()
    # An element has the unit of its array.
    units |= {name: units[name.partition("[")[0]] for name in series if name not in units and name != "time"}
    write_series(series, units, {"system": system.text}, path)
    only_file(path)
    show_warnings(system)
    show_end(options, float(series["time"][-1] - series["time"][0]), system.master.step_size)
    summary: dict[str, object] = {"result": str(path), "steps": len(series["time"]) - 1, "end_time_s": float(series["time"][-1])}
    if system.master.controller is not None:
        summary |= {"steps accepted": system.master.controller.accepted, "steps rejected": system.master.controller.rejected}
    for bond in system.master.bonds:
        summary[f"power residual, {bond}"] = bond.share
    system.close()
    return summary, at_the_end(series), units


def check(options: argparse.Namespace) -> int:
    """``rvwear check``: 0 if every variable of the reference is met, 1 if not."""
    import numpy as np

    from orchestrator.regression import compare, parse_tolerance, write_junit
    from orchestrator.series import flat, read_series
    from orchestrator.system import whole_steps

    tolerances = [parse_tolerance(text) for text in options.tolerance]
    if options.reference is None:
        return check_experiments(options, tolerances)
    reference = read_series(Path(options.reference))
    started = perf_counter()
    system = open_system(options)
    wanted = sorted({name.partition("[")[0] if "[" in name else name for name in reference if name != "time"})
    system.recorded = [found for name in wanted for found in system.matching(name)]
    if options.duration is None:
        # As far as the reference reaches.
        span = float(reference["time"].max()) - system.master.start_time
        size = system.master.step_size
        system.steps = whole_steps(max(1.0, float(np.ceil(span / size * (1.0 - 1e-12)))) * size, size)
    comparisons = compare(flat(simulate(system, [])), reference, tolerances)
    show_warnings(system)
    if options.junit:
        write_junit(comparisons, system.name, perf_counter() - started, system.master.warnings, Path(options.junit))
    system.close()
    return show_verdicts(options, comparisons, str(options.reference))


def check_experiments(options: argparse.Namespace, tolerances: "list[Tolerance]") -> int:
    """Those that an FMU carries, each in a new instance."""
    from orchestrator.experiments import experiments_in, judged
    from orchestrator.fmu import Fmu
    from orchestrator.regression import write_junit

    path, started = Path(options.system), perf_counter()
    if path.suffix != ".fmu":
        raise InputFault(f"{path}: only an FMU carries experiments; give --reference, results of an earlier run of the system")
    given = ("step", "duration", "extrapolation", "step_control", "loops", "isolate", "set", "scheme")
    if ignored := [f"--{name.replace('_', '-')}" for name in given if getattr(options, name)]:
        raise InputFault(f"{', '.join(ignored)} without --reference: an experiment that the FMU carries says itself how it is done")
    unit = Fmu(path.stem, path)
    comparisons, done = [], []
    try:
        for experiment in experiments_in(unit.folder):
            fresh = Fmu(path.stem, path)
            try:
                comparisons += [replace(c, variable=f"{experiment.name}: {c.variable}") for c in judged(fresh, experiment, tolerances)]
            finally:
                fresh.close()
            done.append(experiment.name)
    finally:
        unit.close()
    if options.junit:
        write_junit(comparisons, path.stem, perf_counter() - started, [], Path(options.junit))
    return show_verdicts(options, comparisons, f"the FMU's experiments {', '.join(done)}")


def show_verdicts(options: argparse.Namespace, comparisons: "list[Comparison]", reference: str) -> int:
    """1 if one failed."""
    from cli import screen

    failed = [c for c in comparisons if not c.passed]
    if options.json:
        screen.json_text({
            "system": options.system, "variables": len(comparisons), "failed": [vars(c) for c in failed],
        })  # fmt: skip
    else:
        for comparison in failed:
            print(comparison)
        print(f"{len(comparisons) - len(failed)} of {len(comparisons)} variables agree with {reference}")
    return 1 if failed else 0
