"""The command line tool ``rvwear``.

Exit codes: 0 done, 1 a run that failed, 2 bad input, 3 an effect that did not help on unused runs (``extend``), 130 interrupted.

Help and completion answer at once: a command imports what it computes with when it is called.
"""

import argparse
import io
import os
import sys

from cli.commands import build, campaign, comparison, completion, effects, ensemble, example, life, reducer, reproduce, system
from cli.completion import answer_shell
from cli.progress import new_screen
from fmu_src.faults import InputFault, RunFault
from fmu_src.progress import told_to

# In the order of the help.
GROUPS = (reducer, system, life, ensemble, reproduce, build, campaign, comparison, effects, example, completion)


class PrintVersion(argparse.Action):
    """Prints the version and ends; it is looked up only then."""

    def __init__(self, option_strings: list[str], dest: str, **others: object):
        super().__init__(option_strings, dest, nargs=0, help="print the version and end")

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from fmu_src.project import NAME, project

        print(NAME, project().version)
        parser.exit()


def main(arguments: list[str] | None = None) -> int:
    print_whatever_the_console_can()
    top = parser()
    answer_shell(top)
    options = top.parse_args(arguments)
    try:
        with told_to(new_screen()):
            return int(options.run(options))
    except InputFault as fault:
        print(f"rvwear {options.command}: {fault}", file=sys.stderr)
        return 2
    except RunFault as fault:
        print(f"rvwear {options.command}: {fault}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # The reader has seen enough (rvwear ... | head); keep Python from complaining at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as problem:
        print(f"rvwear {options.command}: {problem}; choose another place for input or output", file=sys.stderr)
        return 2
    except KeyboardInterrupt as stop:
        print(f"rvwear {options.command}: interrupted" + (f" ({stop})" if str(stop) else ""), file=sys.stderr)
        return 130


def print_whatever_the_console_can() -> None:
    """A sign that the console's encoding lacks becomes a question mark and ends nothing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(prog="rvwear", description="Dynamics and wear of RV reducers.")
    top.add_argument("--version", action=PrintVersion)
    sub = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for group in GROUPS:
        group.add_commands(sub)
    return top


if __name__ == "__main__":
    sys.exit(main())
