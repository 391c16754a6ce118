"""``rvwear doctor``: whether this installation is sound, and what it lacks."""

import argparse

from cli.options import add_json
from fmu_src.progress import task


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = sub.add_parser("doctor", help="environment, compiler, cache, versions: what is there, what is optional and missing, what to do")
    add_json(command, "print as JSON, nothing else")
    command.set_defaults(run=doctor)


def doctor(options: argparse.Namespace) -> int:
    """Exit code 1 if something that is needed is wrong."""
    from cli.doctor import WRONG, findings
    from cli.screen import json_text
    from cli.show.doctor import show

    with task("looking around"):
        found = findings()
    if options.json:
        json_text({"findings": [finding.as_json() for finding in found]})
    else:
        show(found)
    return 1 if any(finding.state == WRONG for finding in found) else 0
