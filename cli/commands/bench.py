"""``rvwear bench``: the tests of standards and data sheets, on the virtual bench or from a measured file."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from cli.exporting import add_exports, check_exports, write_exports
from cli.options import add_json, add_reducer_options, reducer_of, settings_of
from fmu_src.faults import InputFault, nearest
from fmu_src.progress import task

if TYPE_CHECKING:
    from studies.standard.evaluation import Curve

NAMES = ("lost-motion", "dynamic-lost-motion", "stiffness", "transmission-error", "efficiency", "no-load-torque", "starting-torque")


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    bench = sub.add_parser("bench", help="standard tests: lost motion, stiffness, transmission error, efficiency, torques")
    bench.add_argument("--standard", required=True, choices=NAMES, help="which test")
    add_reducer_options(bench, positions=False)
    bench.add_argument("--measured", metavar="FILE", help="evaluate this file by the same code instead (CSV, MAT, MDF, TDMS, Parquet)")
    bench.add_argument("--column", action="append", default=[], metavar="NAME=HEADER:UNIT",
                       help="where the file has what: --column output_torque='T2:N.m'; position=HEADER tells curves apart")  # fmt: skip
    add_json(bench)
    add_exports(bench, pictures=False)
    bench.set_defaults(run=bench_test)


def bench_test(options: argparse.Namespace) -> int:
    from cli.show.bench import show_bench
    from studies.standard.evaluation import TESTS
    from studies.standard.procedures import OWN_FIGURES, PROCEDURES, rated_of, ratio_of
    from studies.standard.tables import bench_tables

    check_exports(options)
    reducer = reducer_of(options.reducer)
    settings, test = settings_of(options, reducer), TESTS[options.standard]
    rated, ratio = rated_of(reducer, settings)[0], ratio_of(reducer, settings)
    curves: dict[str, Curve]
    if options.measured:
        curves = dict(measured(Path(options.measured), options.column, test.columns))
    else:
        if options.column:
            raise InputFault("--column says where a measured file has what; give --measured FILE with it")
        with task(f"{test.name} on the virtual bench"):
            curves = dict(PROCEDURES[test.name](reducer, settings))
    each = not options.measured and test.name in OWN_FIGURES
    groups = {key: [curve] for key, curve in curves.items()} if each else {"": [*curves.values()]}
    try:
        found = {key: test.evaluate(group, rated, ratio) for key, group in groups.items()}
    except InputFault as fault:
        raise InputFault(f"{options.measured}: {fault}" if options.measured else str(fault)) from None
    show_bench(reducer.name, test, found, rated, ratio, len(curves), options.measured, options.json)
    write_exports(options, lambda: bench_tables(found, curves), list)
    return 0


def measured(path: Path, columns: list[str], needed: tuple[str, ...]) -> "dict[str, Curve]":
    """Curves by position of a measured file, in the units of ``UNITS``."""
    import numpy as np

    from discrepancy.campaign.readers import Options, read_columns
    from fmu_src.units import UnitError, conversion
    from studies.standard.evaluation import UNITS

    headers: dict[str, tuple[str, str]] = {}
    for text in columns:
        name, equals, rest = text.partition("=")
        if not equals or name not in (*UNITS, "back_angle", "position"):
            raise InputFault(f"--column {text}: give NAME=HEADER:UNIT with a NAME of {', '.join(needed)} or position{nearest(name, needed)}")
        header, _, unit = rest.rpartition(":") if ":" in rest else (rest, "", "")
        headers[name] = (header, unit)
    for name in needed:
        headers.setdefault(name, (name, ""))
    try:
        read = read_columns(path, {header for header, _ in headers.values()}, Options(), "--measured")
    except InputFault as fault:
        raise InputFault(f"{fault}. Say which column is what: {' '.join(f'--column {name}=HEADER:UNIT' for name in needed)}") from None
    converted = {}
    for name, (header, unit) in headers.items():
        values = np.asarray(read[header])
        if name == "position":
            converted[name] = values
            continue
        try:
            factor, offset = conversion(unit or UNITS.get(name, "rad"), UNITS.get(name, "rad"))
            converted[name] = factor * values.astype(float) + offset
        except (UnitError, ValueError) as problem:
            raise InputFault(f"{path}: column {header!r} as {name} in {unit or UNITS.get(name, 'rad')}: {problem}") from None
    places = converted.pop("position", None)
    if places is None:
        return {"": converted}
    return {str(place): {name: values[places == place] for name, values in converted.items()} for place in np.unique(places)}
