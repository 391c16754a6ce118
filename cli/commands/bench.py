"""``rvwear bench``: the tests of standards and data sheets, on the virtual bench or from a measured file."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from cli.exporting import add_exports, check_exports, write_exports
from cli.options import add_json, add_reducer_options, reducer_of, settings_of
from fmu_src.faults import InputFault
from fmu_src.progress import task

if TYPE_CHECKING:
    from studies.standard.conditions import Grouped

NAMES = ("lost-motion", "dynamic-lost-motion", "stiffness", "transmission-error", "efficiency", "no-load-torque", "starting-torque")


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    bench = sub.add_parser("bench", help="standard tests: lost motion, stiffness, transmission error, efficiency, torques")
    bench.add_argument("--standard", required=True, choices=NAMES, metavar="TEST", help=f"which: {', '.join(NAMES)}")
    add_reducer_options(bench, positions=False)
    bench.add_argument("--measured", metavar="FILE", help="evaluate this file by the same code instead (CSV, MAT, MDF, TDMS, Parquet)")
    bench.add_argument("--column", action="append", default=[], metavar="NAME=HEADER:UNIT",
                       help="where the file has what: --column output_torque='T2:N.m'; condition, torque, speed, temperature, direction=HEADER keep conditions"
                       " apart, position=HEADER curves that are averaged")  # fmt: skip
    add_json(bench)
    add_exports(bench, pictures=False)
    bench.set_defaults(run=bench_test)


def bench_test(options: argparse.Namespace) -> int:
    from cli.show.bench import show_bench
    from studies.standard.evaluation import TESTS
    from studies.standard.procedures import PROCEDURES, rated_of, ratio_of
    from studies.standard.tables import bench_tables

    check_exports(options)
    reducer = reducer_of(options.reducer)
    settings, test = settings_of(options, reducer), TESTS[options.standard]
    rated, ratio = rated_of(reducer, settings)[0], ratio_of(reducer, settings)
    curves: Grouped
    if options.measured:
        from cli.measured_curves import measured

        curves = measured(Path(options.measured), options.column, test, rated)
    else:
        if options.column:
            raise InputFault("--column says where a measured file has what; give --measured FILE with it")
        with task(f"{test.name} on the virtual bench"):
            made = PROCEDURES[test.name](reducer, settings)
        curves = {key: {"": curve} for key, curve in made.items()} if test.own_figures else {"": dict(made)}
    found, unread = {}, {}
    for condition, group in curves.items():
        try:
            found[condition], unread[condition] = test.evaluated([*group.values()], rated, ratio)
        except InputFault as fault:
            raise InputFault(": ".join(filter(None, (options.measured, condition, str(fault))))) from None
    count = sum(len(group) for group in curves.values())
    show_bench(reducer.heading, test, found, rated, ratio, count, options.measured, options.json, unread)
    write_exports(options, lambda: bench_tables(found, curves), list)
    return 0

