"""``rvwear run SYSTEM`` and ``rvwear check SYSTEM``: systems from files."""

import argparse
import sys
from pathlib import Path
from time import perf_counter

import numpy as np

from cli import screen
from fmu_src.faults import InputFault
from orchestrator.master import LoopSettings, StepControl
from orchestrator.regression import compare, parse_tolerance, write_junit
from orchestrator.series import SUFFIXES, flat, read_series, write_series
from orchestrator.system import System, load, whole_steps


def add_system_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--step", type=float, metavar="S", help="communication step [s], before the file's")
    command.add_argument("--duration", type=float, metavar="S", help="time to simulate [s], before the file's")
    command.add_argument("--extrapolation", type=int, choices=(0, 1, 2), help="order of the polynomial that inputs follow")
    command.add_argument("--step-control", type=float, metavar="TOL", help="divide steps by their error, to this tolerance")
    command.add_argument("--loops", choices=("newton", "fixed-point"), help="how algebraic loops are solved")
    command.add_argument("--isolate", action="store_true", help="every FMU in a process of its own")


def open_system(options: argparse.Namespace) -> System:
    """The system with the command line's options and settings applied."""
    given = {
        "extrapolation": options.extrapolation,
        "step_control": StepControl(options.step_control) if options.step_control is not None else None,
        "loops": LoopSettings(options.loops) if options.loops else None,
        "scheme": options.scheme,
    }
    master = {name: value for name, value in given.items() if value is not None}
    with screen.busy("loading the units"):
        system = load(options.system, options.step, options.isolate, **master)
    for setting in options.set:
        path, equals, value = setting.partition("=")
        if not equals:
            raise InputFault(f"--set {setting!r}: write component.variable=value, for instance plant.load_torque=150N.m")
        system[path.strip()] = value.strip()
    if options.duration is not None:
        system.steps = whole_steps(options.duration, system.master.step_size)
    return system


def simulate(system: System, record: list[str]) -> dict[str, np.ndarray]:
    with screen.Progress(system.steps, "steps") as progress:
        return system.run(record=record, each_step=progress.advance)


def outputs_of(system: System) -> list[str]:
    """All outputs, for a system whose file does not say what to record."""
    return [f"{n}.{v}" for n, c in system.master.components.items() for v, s in c.signals.items() if s.causality == "output"]


def show_warnings(system: System) -> None:
    for warning in system.master.warnings:
        print(f"warning: {warning}", file=sys.stderr)


def run_system(options: argparse.Namespace, path_of) -> tuple[dict, dict[str, float]]:
    """Run and write; (summary, values at the end)."""
    system = open_system(options)
    path = path_of(options.output, system.name, SUFFIXES)
    record = options.record or ([] if system.recorded else outputs_of(system))
    series = simulate(system, record)
    write_series(series, system.units(), {"system": system.text}, path)
    show_warnings(system)
    summary = {"result": str(path), "steps": len(series["time"]) - 1, "end_time_s": float(series["time"][-1])}
    if system.master.controller is not None:
        summary |= {"steps accepted": system.master.controller.accepted, "steps rejected": system.master.controller.rejected}
    for bond in system.master.bonds:
        summary[f"power residual, {bond}"] = bond.share
    system.close()
    return summary, {f"{k} (last)": float(np.max(v[-1])) for k, v in series.items() if k != "time"}


def check(options: argparse.Namespace) -> int:
    """``rvwear check``: 0 if every variable of the reference is met, 1 if not."""
    tolerances = [parse_tolerance(text) for text in options.tolerance]
    reference = read_series(Path(options.reference))
    started = perf_counter()
    system = open_system(options)
    wanted = sorted({name.partition("[")[0] if "[" in name else name for name in reference if name != "time"})
    system.recorded = [found for name in wanted for found in system.matching(name)]
    if options.duration is None:
        # As far as the reference reaches.
        span = float(reference["time"].max()) - system.master.start_time
        system.steps = max(1, int(np.ceil(span / system.master.step_size * (1.0 - 1e-12))))
    comparisons = compare(flat(simulate(system, [])), reference, tolerances)
    show_warnings(system)
    if options.junit:
        write_junit(comparisons, system.name, perf_counter() - started, system.master.warnings, Path(options.junit))
    system.close()
    failed = [c for c in comparisons if not c.passed]
    if options.json:
        screen.json_text({
            "system": options.system, "variables": len(comparisons), "failed": [vars(c) for c in failed],
        })  # fmt: skip
    else:
        for comparison in failed:
            print(comparison)
        print(f"{len(comparisons) - len(failed)} of {len(comparisons)} variables agree with {options.reference}")
    return 1 if failed else 0
