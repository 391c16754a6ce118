"""``rvwear workbench``: the whole loop in a browser."""

import argparse
import os
import sys
import webbrowser
from pathlib import Path
from typing import NoReturn

from cli.options import all_cores
from fmu_src.faults import MissingPart


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    bench = sub.add_parser("workbench", help="the whole loop in a browser: drop files, look, diagnose, try, add, build")
    bench.add_argument("folder", nargs="?", default=".", metavar="FOLDER", help="campaign folder, old or new: all is read and written there (default: here)")
    bench.add_argument("--port", type=int, default=0, help="port of this machine (default: any that is free)")
    bench.add_argument("--no-browser", action="store_true", help="print the address, open nothing")
    bench.set_defaults(run=run_workbench)


def run_workbench(options: argparse.Namespace) -> NoReturn:
    """Serves until Ctrl-C, and ends the process."""
    try:
        from workbench.folder import opened
        from workbench.server import serve
    except ModuleNotFoundError as missing:
        if missing.name not in ("starlette", "uvicorn", "anyio", "h11"):
            raise
        raise MissingPart("the workbench", missing.name or "", "workbench") from None
    root = Path(options.folder)
    new, folder = not root.exists(), opened(root)

    def ready(address: str) -> None:
        print(f"workbench of {folder.root}{', a new folder' if new else ''}\n{address}\nfor this machine alone; Ctrl-C ends it", flush=True)
        if not options.no_browser and not webbrowser.open(address):
            print("no browser was found: open the address yourself", file=sys.stderr)

    serve(folder, options.port, all_cores(), ready)
    # Kernels that a view has asked for may still be compiled in a thread: Python's own end would take the compiler away under it, which aborts.
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)
