"""What each command of ``rvwear`` does."""

import argparse
import json
import os
import sys
from pathlib import Path

import numpy as np
import xarray as xr

from cli import screen
from cli.commands.system import run_system
from fmu_src.faults import InputFault
from fmu_src.source_hash import source_hash
from orchestrator.component import InProcess
from orchestrator.master import SCHEMES, Master
from orchestrator.settings import Setting, apply, parse_setting
from reducers.reducer import Reducer, load_reducer
from studies import results
from studies.building import Wanted, build_units
from studies.checkpoint import load_checkpoint, save_checkpoint
from studies.coupled_master import CoupledMaster
from studies.duty import load_duty
from studies.dynamics_wear import as_json as dynamics_as_json
from studies.dynamics_wear import compare
from studies.hysteresis import hysteresis as measure_hysteresis
from studies.life import Life, LifeSettings, live
from studies.modes import modes as natural_modes
from studies.pair import Pair, crank_turn_time, make_pair
from studies.solve import SERIES, figures_of, record_turn, require_positions

# Options that are shorthands of settings: option -> (variable, unit).
SHORTHANDS = {
    "torque": ("load_torque", "N.m"),
    "bearing_clearance": ("bearing_clearance", "um"),
    "equidistant": ("equidistant_modification", "um"),
    "shift": ("shift_modification", "um"),
    "stiffness_reading": ("stiffness_reading", ""),
    "contact_law": ("contact_law", ""),
}


def settings_of(options: argparse.Namespace, reducer: Reducer) -> list[Setting]:
    """Settings from the shorthand options and ``--set``, in this order."""
    texts = [
        f"{name}={value if isinstance(value, str) else repr(value)}{unit}"
        for option, (name, unit) in SHORTHANDS.items()
        if (value := getattr(options, option)) is not None
    ]
    return [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts + options.set]


def solve(options: argparse.Namespace) -> int:
    """``rvwear solve``: the plant alone over one crank turn."""
    positions = require_positions(options.positions)
    reducer = load_reducer(options.reducer)
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings_of(options, reducer), {"plant": plant})
    torque = plant.get("load_torque")
    with screen.busy("equilibria of one crank turn"):
        master = Master({"plant": plant}, [], crank_turn_time(reducer, plant) / positions)
        pair = Pair(reducer, master, plant, plant, positions)
        master.initialise()
        full = record_turn(pair, positions)
        plant.set("load_torque", 0.5 * torque)
        half = record_turn(pair, positions)
        figures = figures_of(reducer, plant, full, half, torque)
    if options.json:
        screen.json_text({"reducer": reducer.name, "positions": positions} | figures)
    else:
        screen.figures(f"{reducer.name} over one crank turn", figures)
    return 0


def run(options: argparse.Namespace) -> int:
    """``rvwear run``: a system from a file, or the pair of a reducer."""
    if options.system:
        refuse_pair_options(options)
        name = options.system
        summary, last = run_system(options, result_path)
    else:
        refuse_system_options(options)
        positions = require_positions(options.positions)
        reducer = load_reducer(options.reducer)
        settings = settings_of(options, reducer)
        path = result_path(options.output, f"{reducer.name}_run")
        if not 0.0 < options.turns <= 1e5:
            raise InputFault(f"turns = {options.turns}: between one position ({1 / positions:.3g} turns) and 100,000")
        pair = make_pair(reducer, settings, folder(options.fmus), options.scheme or SCHEMES[0], positions)
        pair.wear.set("acceleration", options.acceleration)
        steps = round(options.turns * positions)
        if steps < 1:
            raise InputFault(f"turns = {options.turns}: at least one position ({1 / positions:.3g} turns) is needed")
        with screen.Progress(steps, "steps") as progress:
            recorded = record_turn(pair, steps, progress.advance).series
        step = pair.master.step_size
        series = {"time": (np.arange(steps) + 1) * step} | {f"plant.{k}": v for k, v in recorded.items()}
        units = {f"plant.{k}": pair.plant.signal(k).unit for k in SERIES}
        name = f"{reducer.name}_run"
        inputs = {"reducer": reducer.name, "settings": {s.name: s.value for s in settings},
                  "turns": options.turns, "acceleration": options.acceleration, "scheme": options.scheme,
                  "parameters": {"plant": results.parameters_of(pair.plant), "wear": results.parameters_of(pair.wear)}}
        pair.master.close()
        results.write(results.series_dataset(series, units, inputs), path)
        summary = {"result": str(path), "steps": len(series["time"]), "end_time_s": float(series["time"][-1])}
        last = {f"{k} (last)": float(np.max(v[-1])) for k, v in series.items() if k != "time"}
    summary |= last
    if options.json:
        screen.json_text(summary)
    else:
        screen.figures(f"{name}: values at the end (largest of an array)", summary)
    return 0


def result_path(text: str | None, name: str, endings: tuple[str, ...] = (".nc",)) -> Path:
    """Where a result goes; checked before the work, so that none is lost."""
    path = Path(text or f"results/{name}.nc")
    if path.suffix not in endings:
        if len(endings) > 1:
            raise InputFault(f"--output {path}: the name must end in {' or '.join(endings)}")
        raise InputFault(f"--output {path}: a result is a NetCDF file; give a name that ends in .nc")
    if path.is_dir():
        raise InputFault(f"--output {path} is a folder; give a file name in it that ends in .nc")
    path.parent.mkdir(parents=True, exist_ok=True)
    if not os.access(path.parent, os.W_OK):
        raise InputFault(f"--output {path}: the folder {path.parent} cannot be written to")
    return path


def refuse_pair_options(options: argparse.Namespace) -> None:
    """A system's file says all: options of the pair beside it would be ignored."""
    given = [f"--{name.replace('_', '-')}" for name in (*SHORTHANDS, "fmus") if getattr(options, name)]
    given += [f"--{name}" for name, usual in (("turns", 1.0), ("acceleration", 1.0), ("positions", 72))
              if getattr(options, name) != usual]
    if given:
        raise InputFault(f"{', '.join(given)} with a system's file: use --set component.variable=value, or set it in the file")


def refuse_system_options(options: argparse.Namespace) -> None:
    names = ("step", "duration", "extrapolation", "step_control", "loops", "isolate", "record")
    given = [f"--{name.replace('_', '-')}" for name in names if getattr(options, name)]
    if given:
        raise InputFault(f"{', '.join(given)} without a system's file: give one (.toml, .ssp, .fmu)")


def folder(text: str | None) -> Path | None:
    return Path(text) if text else None


def life(options: argparse.Namespace) -> int:
    """``rvwear life``: jumps over the hours, with checkpoint, result file and report."""
    positions = require_positions(options.positions)
    reducer = load_reducer(options.reducer)
    settings = settings_of(options, reducer)
    life_settings = LifeSettings(options.hours, options.tolerance, options.first_jump, options.largest_jump)
    life_settings.check()
    duty = load_duty(options.duty) if options.duty else ()
    inputs = {
        "reducer": reducer.name, "starts": reducer.starts, "settings": {s.name: s.value for s in settings},
        "life": vars(life_settings).copy(), "duty": [vars(s) for s in duty], "scheme": options.scheme, "positions": positions,
        "units": "fmu" if options.fmus else "in process", "source_hash": source_hash(),
    }  # fmt: skip
    path = result_path(options.output, f"{reducer.name}_life")
    if any(setting.name == "acceleration" for setting in settings):
        raise InputFault("acceleration is chosen by the life run itself; give --hours and --tolerance")
    checkpoint = path.with_suffix(".checkpoint")
    if options.reuse and (known := known_result(path, inputs)) is not None:
        return show_life(options, known, path)
    resume = options.resume or options.reuse and checkpoint.exists() and belongs_to(checkpoint, inputs)
    if checkpoint.exists() and not (resume or options.restart or options.reuse):
        raise InputFault(f"{checkpoint} holds an unfinished run: give --resume to go on, --restart to start anew")
    with screen.busy("loading and compiling the units (the first time takes ten seconds)"):
        pair = make_pair(reducer, settings, folder(options.fmus), options.scheme, positions, duty,
                         # In this process many steps go into one compiled call.
                         Master if options.fmus else CoupledMaster)
    lived = Life(life_settings)
    first_orders = results.order_spectrum(pair, 0.0)
    if resume:
        lived, saved = load_checkpoint(checkpoint, inputs)
        pair.master.restore(saved)

    def keep(state: Life) -> None:
        save_checkpoint(checkpoint, state, pair.master.save(), inputs)

    try:
        with screen.LifeProgress(lived) as progress:
            live(pair, lived, progress.show, keep)
    except KeyboardInterrupt:
        print(f"interrupted at {lived.hours[-1] if lived.hours else 0:g} h; go on with --resume", file=sys.stderr)
        return 130
    orders = [first_orders, results.order_spectrum(pair, lived.hours[-1])]
    dataset = results.life_dataset(pair, lived, orders, inputs)
    results.write(dataset, path)
    checkpoint.unlink()
    pair.master.close()
    return show_life(options, dataset, path)


def belongs_to(checkpoint: Path, inputs: dict) -> bool:
    """Whether a run of these inputs left the checkpoint."""
    try:
        load_checkpoint(checkpoint, inputs)
    except InputFault:
        return False
    return True


def known_result(path: Path, inputs: dict) -> xr.Dataset | None:
    """A finished result with the same inputs, or None."""
    if not path.exists():
        return None
    dataset = results.read(path)
    stored = json.loads(dataset.attrs["inputs"])
    same = all(stored.get(k) == json.loads(json.dumps(v)) for k, v in inputs.items())
    return dataset if same else None


def show_life(options: argparse.Namespace, dataset: xr.Dataset, path: Path) -> int:
    """Table or JSON on the screen, and the report."""
    page = path.with_suffix(".html")
    if not options.no_report:
        from studies.report import write_report

        write_report(dataset, page)
    if options.json:
        screen.json_text({"reducer": options.reducer, "result": str(path)} | results.figure_arrays(dataset))
    else:
        screen.life_table(dataset)
        print(f"result  {path}")
        if not options.no_report:
            print(f"report  {page}")
    return 0


def hysteresis(options: argparse.Namespace) -> int:
    """``rvwear hysteresis``: the standard stiffness test."""
    if options.steps < 4 or options.angles < 1:
        raise InputFault(f"steps = {options.steps}, angles = {options.angles}: at least 4 and 1 are needed")
    reducer = load_reducer(options.reducer)
    with screen.busy("loading torques at locked input"):
        loop = measure_hysteresis(reducer, settings_of(options, reducer), options.steps, options.angles)
    figures = {
        "rated_torque_Nm": float(loop.torque.max()),
        "lost_motion_arcmin": loop.lost_motion_arcmin,
        "torsional_stiffness_Nm_per_arcmin": loop.stiffness_Nm_per_arcmin,
        "torsional_stiffness_reverse_Nm_per_arcmin": loop.stiffness_reverse_Nm_per_arcmin,
        "loop_area_Nm_arcmin": loop.loop_area_Nm_arcmin,
    }
    if options.json:
        curve = {"torque_Nm": loop.torque.tolist(), "turning_arcmin": loop.turning.tolist()}
        screen.json_text({"reducer": reducer.name} | figures | curve)
    else:
        screen.figures(f"{reducer.name}: torque up and down, input locked", figures)
    return 0


def modes(options: argparse.Namespace) -> int:
    """``rvwear modes``: natural frequencies about the loaded equilibrium."""
    reducer = load_reducer(options.reducer)
    with screen.busy("linearising the plant in motion"):
        found = natural_modes(reducer, settings_of(options, reducer))
    if options.json:
        screen.json_text({"reducer": reducer.name, "modes": [vars(mode) for mode in found]})
    else:
        screen.modes(f"{reducer.name}: modes under load, input held", found)
    return 0


def dynamics_wear(options: argparse.Namespace) -> int:
    """``rvwear dynamics-wear``: wear of both fidelities, and where they differ."""
    from studies.report.dynamics import write_dynamics_page

    reducer = load_reducer(options.reducer)
    page = Path(options.output or f"results/{reducer.name}_dynamics.html")
    found = compare(reducer, settings_of(options, reducer), options.speeds, options.hours, options.cycles, options.limit,
                    lambda text: print(text, file=sys.stderr, flush=True))  # fmt: skip
    write_dynamics_page(found, page)
    if options.json:
        screen.json_text(dynamics_as_json(found) | {"page": str(page)})
    else:
        screen.dynamics(found)
        print(f"page  {page}")
    return 0


def reproduce(options: argparse.Namespace) -> int:
    """``rvwear reproduce``: the sources' claims, judged."""
    from reproduce import as_json, print_table, write_page
    from reproduce import run as judge

    claims = judge(options.claims or None, lambda text: print(text, file=sys.stderr, flush=True))
    page = write_page(claims, Path(options.output))
    if options.json:
        screen.json_text(as_json(claims) | {"page": str(page)})
    else:
        print_table(claims)
        print(f"page  {page}")
    return 0 if all(claim.stands for claim in claims) else 1


def build(options: argparse.Namespace) -> int:
    """``rvwear build``: FMUs of both units and of the unit of both, validated; those that are up to date stay."""
    reducer = load_reducer(options.reducer)
    wanted = Wanted(options.flavour, options.fmi, options.all_platforms)
    built, packages = build_units(reducer, Path(options.output), wanted, screen.busy)
    if options.json:
        screen.json_text({"reducer": reducer.name, "fmus": built, "packages": [str(path) for path in packages]})
    else:
        for entry in built:
            state = "built" if entry["built"] else "up to date"
            print(f"{entry['fmu']}  {entry['flavour']}  {entry['bytes'] / 1e3:.0f} kB  {state}, validated")
        for package in packages:
            print(f"{package}  plant and wear, connected")
    return 0


def report(options: argparse.Namespace) -> int:
    """``rvwear report``: the page of a result file."""
    from studies.report import write_report

    path = Path(options.result)
    if not path.is_file():
        raise InputFault(f"no result file at {path}; rvwear life writes one")
    page = Path(options.output) if options.output else path.with_suffix(".html")
    try:
        dataset = results.read(path)
    except (OSError, ValueError) as problem:
        raise InputFault(f"{path} is not a result of rvwear life: {problem}") from None
    write_report(dataset, page)
    print(page)
    return 0


