"""``rvwear build``: the FMUs of a reducer."""

import argparse
from pathlib import Path

from cli.options import add_json, add_reducer, reducer_of
from cli.written import say_file


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    fmus = sub.add_parser("build", help="build and validate RvPlant.fmu, RvWear.fmu and RvReducer.fmu")
    add_reducer(fmus)
    fmus.add_argument("--output", default="dist", help="folder of the FMUs (default dist)")
    fmus.add_argument("--flavour", choices=("python", "native", "both", "source"), default="both", help="editable FMUs in"
                      " the folder itself, native ones in its folders fmi2 and fmi3, which need no Python (default both); source: C99 and"
                      " no binaries, in its folder source")
    fmus.add_argument("--fmi", choices=("2", "3", "both"), default="both", help="FMI version of native FMUs and those of sources")
    fmus.add_argument("--all-platforms", action="store_true", help="native FMUs for Linux, Windows and Darwin, not"
                      " for this machine alone; needs zig: pip install \"rvwear[build]\"")
    fmus.add_argument("--wasm", action="store_true", help="native FMUs of FMI 3.0 have a WebAssembly component besides, which runs"
                      " on any machine and in a sandbox; needs zig: pip install \"rvwear[build]\"")
    fmus.add_argument("--worn", metavar="TIME", help="units of a reducer that is delivered worn: --worn 5000h at rated speed and torque")
    fmus.add_argument("--inline", action="store_true", help="RvReducer.ssp with its values in the system's description, for"
                      " tools that read no parameter files (OpenMCx)")
    add_json(fmus)
    fmus.set_defaults(run=build)


def build(options: argparse.Namespace) -> int:
    """``rvwear build``: FMUs of both units and of the unit of both, validated; those that are up to date stay."""
    from cli import screen
    from studies.building import Wanted, build_units
    from studies.which_unit import which_to_take

    reducer = reducer_of(options.reducer)
    if options.worn is not None:
        from fmu_src.progress import task
        from studies.worn import hours_of, worn_reducer

        hours = hours_of(options.worn)
        with task(f"life of {hours:g} h"):
            reducer = worn_reducer(reducer, hours)
    wanted = Wanted(options.flavour, options.fmi, options.all_platforms, options.inline, options.wasm)
    built, packages = build_units(reducer, Path(options.output), wanted)
    if options.json:
        screen.json_text({"reducer": reducer.name, "fmus": built, "packages": [str(path) for path in packages]})
    else:
        for entry in built:
            state = "built" if entry["built"] else "up to date"
            say_file(entry["fmu"], more=f"  {entry['flavour']}  {entry['bytes'] / 1e3:.0f} kB  {state}, validated")
        for package in packages:
            say_file(package, more="  plant and wear, connected")
        for line in which_to_take(Path(options.output), [*(Path(entry["fmu"]) for entry in built), *packages]):
            print(line)
    return 0
