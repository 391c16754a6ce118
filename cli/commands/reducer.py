"""``rvwear solve``, ``hysteresis`` and ``modes``: one reducer as it stands."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from cli.exporting import add_exports, check_exports, write_exports
from cli.options import add_json, add_reducer_options, chosen, number_in, reducer_of, settings_of
from cli.overload import told_overload
from fmu_src.progress import task

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    turn = sub.add_parser("solve", help="forces, pressure, lag and stiffness over a crank turn")
    add_reducer_options(turn)
    add_json(turn)
    add_exports(turn)
    turn.set_defaults(run=solve)

    loop = sub.add_parser("hysteresis", help="input locked, torque up and down: lost motion and stiffness")
    add_reducer_options(loop)
    loop.add_argument("--steps", type=int, default=16,
                      help="torques per quarter of the loop, closer near the largest; up to 6 %% of it always every 0.5 %% (default 16)")
    places = loop.add_mutually_exclusive_group()
    places.add_argument("--angles", type=int, default=16, help="positions of the input over a turn of the cranks, averaged (default 16)")
    places.add_argument("--locked-at", type=number_in("deg"), metavar="ANGLE",
                        help="angle of the input at which alone it is locked, in deg unless a unit is given; 0 is where model and FMU begin"
                             " (of a campaign: see the model file that `extend` wrote)")  # fmt: skip
    add_json(loop)
    add_exports(loop)
    loop.set_defaults(run=hysteresis)

    shapes = sub.add_parser("modes", help="natural frequencies and mode shapes, under load or without, input held or free")
    add_reducer_options(shapes)
    add_json(shapes)
    add_exports(shapes, pictures=False)
    shapes.add_argument("--free", action="store_true", help="the input turns freely with its inertia (sun.inertia); otherwise it is held")
    shapes.add_argument("--all", action="store_true", dest="every", help="held and free, under load and without: four tables")
    shapes.set_defaults(run=modes)


def solve(options: argparse.Namespace) -> int:
    """``rvwear solve``: the plant alone over one crank turn."""
    from cli import screen
    from studies.effects_set import effects_set
    from studies.figure_units import RUNNING
    from studies.rigid import rigid_supports
    from studies.turn import crank_turn

    check_exports(options)
    reducer, settings, positions = chosen(options)
    beyond = told_overload(reducer, settings)
    with task("equilibria of one crank turn"):
        found = crank_turn(reducer, settings, positions)
    if options.json:
        screen.json_text({"reducer": reducer.name, "positions": positions} | found.figures | beyond)
    else:
        screen.figures(f"{reducer.heading} over one crank turn{effects_set(reducer, settings)}", found.figures, how=RUNNING)
        say_rigid(rigid_supports(reducer, settings))
    export(options, found.dataset)
    return 0


def hysteresis(options: argparse.Namespace) -> int:
    """``rvwear hysteresis``: the standard stiffness test."""
    import math

    from cli import screen
    from studies.effects_set import effects_set
    from studies.figure_units import HELD, WIDTHS
    from studies.hysteresis import ANGLES
    from studies.hysteresis import hysteresis as measure
    from studies.rigid import rigid_supports
    from studies.turn import loop_dataset, loop_figures

    check_exports(options)
    reducer = reducer_of(options.reducer)
    settings = settings_of(options, reducer)
    beyond = told_overload(reducer, settings)
    with task("loading torques at locked input"):
        at = None if options.locked_at is None else math.radians(options.locked_at)
        loop = measure(reducer, settings, options.steps, options.angles, at)
    figures = loop_figures(loop)
    if options.json:
        curve = {"torque_Nm": loop.torque.tolist(), "turning_arcmin": loop.turning.tolist()}
        screen.json_text({"reducer": reducer.name} | figures | curve | beyond)
    else:
        # A single one is where the model begins.
        where = f"mean of {options.angles} positions" if at is None and options.angles > 1 else f"at {options.locked_at or 0.0:g} deg"
        about = f"{reducer.heading}: torque up and down, input locked, {where}{effects_set(reducer, settings)}"
        few = f"fewer positions, other figures: rvwear reducer check takes the mean of {ANGLES}\n" if at is None and options.angles < ANGLES else ""
        screen.figures(about, figures, how=f"{HELD}\n{WIDTHS}\n{few}{counted_from(options.reducer, options.locked_at)}")
        say_rigid(rigid_supports(reducer, settings))
    export(options, lambda: loop_dataset(reducer, loop))
    return 0


def counted_from(name: str, locked_at: float | None) -> str:
    """Of a reducer or model that a user named, what its positions count from, and what the position [deg] that was asked for is called there."""
    from discrepancy.counted_from import BEGINS, zero_texts
    from discrepancy.model_file import load_model
    from reducers.reducer import is_model_file

    if not is_model_file(Path(name)):
        return BEGINS
    model = load_model(name)
    return "\n".join([BEGINS, *zero_texts(model.reducer, model.steps, locked_at)])


def say_rigid(words: str) -> None:
    """Below a table with a stiffness, where there is something to say."""
    from cli.screen import console

    if words:
        console().print(words)


def export(options: argparse.Namespace, result: "Callable[[], xr.Dataset]") -> None:
    """A turn or a loop as tables and pictures, if they are asked for."""
    if not options.export and not options.picture:
        return
    from exports.tables import tables_of
    from studies.report.turn import loop_figures, turn_figures

    dataset = result()
    write_exports(options, lambda: tables_of(dataset), lambda: (loop_figures if "turning" in dataset else turn_figures)(dataset))


def modes(options: argparse.Namespace) -> int:
    """``rvwear modes``: natural frequencies about the loaded equilibrium."""
    from cli import screen
    from cli.show.modes import show_modes
    from orchestrator.settings import parse_setting
    from studies.effects_set import effects_set
    from studies.modes import modes as natural_modes

    check_exports(options)
    reducer = reducer_of(options.reducer)
    settings = settings_of(options, reducer)
    cases = [(held, loaded) for held in (True, False) for loaded in (True, False)] if options.every else [(not options.free, True)]
    unloaded = parse_setting("output.load_torque=0", [reducer.plant, reducer.wear])
    beyond = told_overload(reducer, settings)
    with task("linearising the plant in motion"):
        found = {(held, loaded): natural_modes(reducer, settings if loaded else [*settings, unloaded], held) for held, loaded in cases}
    if options.json:
        told = [{"input": "held" if held else "free", "loaded": loaded, "modes": [vars(mode) for mode in some]} for (held, loaded), some in found.items()]
        screen.json_text({"reducer": reducer.name} | ({"cases": told} if options.every else told[0]) | beyond)
    else:
        for (held, loaded), some in found.items():
            about = f"{reducer.heading}: {'under load' if loaded else 'no load'}, input {'held' if held else 'free'}{effects_set(reducer, settings)}"
            show_modes(about, some)
    if options.export:
        from studies.turn import mode_table

        write_exports(options, lambda: [mode_table(found)], lambda: ())
    return 0
