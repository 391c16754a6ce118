"""``rvwear schema``: what editors complete the files from."""

import argparse
from pathlib import Path

from cli.written import say_file
from fmu_src.faults import InputFault

# The keys of cli.schemas.KINDS; a schema is made when it is asked for.
KINDS = ("reducer", "model", "campaign", "scenario", "duty", "ensemble")


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = sub.add_parser("schema", help="the JSON schema of a kind of file, from which editors complete it")
    command.add_argument("kind", choices=KINDS, help="kind of file")
    command.add_argument("--output", metavar="FILE", help="where it goes (default: on the screen)")
    command.set_defaults(run=schema)


def schema(options: argparse.Namespace) -> int:
    import json

    from cli.schemas import schema_of
    from fmu_src.checked_file import write_text

    text = json.dumps(schema_of(options.kind), indent=1) + "\n"
    if not options.output:
        print(text, end="")
        return 0
    path = Path(options.output)
    if path.suffix != ".json":
        raise InputFault(f"--output {path}: the name must end in .json")
    write_text(path, text)
    say_file(path, more=f'; first line of the TOML file: "#:schema ./{path.name}"')
    return 0
