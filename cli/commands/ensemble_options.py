"""Options of ``rvwear ensemble``; what it needs is loaded when it runs."""

import argparse


def run(options: argparse.Namespace) -> int:
    from cli.commands.ensemble import ensemble_command
    from fmu_src.faults import InputFault

    try:
        return ensemble_command(options)
    except ModuleNotFoundError as missing:
        raise InputFault(f"{missing.name} is missing: pip install rvwear[ensembles]") from None


def add_ensemble_command(sub) -> None:
    command = sub.add_parser("ensemble", help="lives of many reducers: scatter of parts, duty and parameters")
    command.add_argument("file", help="what scatters and how, and the limits (.toml, examples/ensemble.toml)")
    command.add_argument("--samples", type=int, help="base samples, a power of two, before the file's")
    command.add_argument("--jobs", type=int, default=-1, help="processes (default: one per core)")
    command.add_argument("--backend", choices=("joblib", "dask"), default="joblib", help="this machine (default), or a Dask cluster")
    command.add_argument("--scheduler", metavar="ADDRESS", help="of the Dask cluster: tcp://host:8786; its workers need this package")
    command.add_argument("--output", help="result (default results/NAME_ensemble.json); finished lives are kept beside it")
    command.add_argument("--restart", action="store_true", help="discard the lives that are there")
    command.add_argument("--json", action="store_true", help="result as JSON on stdout")
    command.set_defaults(run=run)
