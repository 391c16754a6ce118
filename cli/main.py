"""The command line tool ``rvwear``.

Exit codes: 0 done, 1 a run that failed or a campaign that lacks something, 2 bad input, 3 an effect that did not help on unused runs
(``extend``), 130 interrupted (Ctrl-C), 143 terminated (SIGTERM).

Help and completion answer at once: a command imports what it computes with when it is called.
"""

import argparse
import contextlib
import io
import sys
import warnings
from typing import Any

from cli.commands import (
    bench,
    build,
    campaign,
    comparison,
    completion,
    doctor,
    effects,
    ensemble,
    example,
    family,
    fmu,
    forecast,
    life,
    new_reducer,
    reducer,
    reproduce,
    schema,
    system,
    workbench,
)  # fmt: skip
from cli.completion import answer_shell
from cli.ending import INTERRUPTED, exit_code, reader_is_gone, silence, termination_heard
from cli.parser import Parser
from cli.progress import new_screen
from cli.written import files_alone
from fmu_src.checked_file import OF_THE_DISK
from fmu_src.faults import InputFault, OldName, RunFault
from fmu_src.progress import told_to
from fmu_src.unit_words import unit_on_screen

# In the order of the help.
GROUPS = (
    reducer,
    bench,
    new_reducer,
    family,
    system,
    life,
    ensemble,
    reproduce,
    build,
    fmu,
    campaign,
    comparison,
    forecast,
    workbench,
    effects,
    example,
    schema,
    doctor,
    completion,
)


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
    options = top.parsed(arguments)
    try:
        with termination_heard(), contextlib.ExitStack() as around, warnings.catch_warnings():
            say_old_names()
            if not options.quiet:
                around.enter_context(told_to(new_screen(sys.argv[1:] if arguments is None else arguments)))
            elif not getattr(options, "json", False):
                around.enter_context(files_alone())
            code = int(options.run(options))
        sys.stdout.flush()
        return code
    except (InputFault, RunFault) as fault:
        print(unit_on_screen(f"rvwear {options.command}: {fault}"), file=sys.stderr)
        return 2 if isinstance(fault, InputFault) else 1
    except OSError as problem:
        if isinstance(problem, BrokenPipeError) and reader_is_gone():
            # The reader has seen enough (rvwear ... | head).
            silence()
            return 0
        return ended_by(problem, options.command)
    except KeyboardInterrupt as interruption:
        code = exit_code(interruption)
        how = "interrupted" if code == INTERRUPTED else "terminated"
        print(f"rvwear {options.command}: {how}" + (f" ({interruption})" if str(interruption) else ""), file=sys.stderr)
        return code


def ended_by(problem: OSError, command: str) -> int:
    """Says what the system refused; a full disk or a process that is gone is a failed run, a wrong place is bad input."""
    if isinstance(problem, BrokenPipeError):
        print(f"rvwear {command}: a process that computed for this one is gone ({problem}); run it again, with more memory", file=sys.stderr)
        return 1
    print(f"rvwear {command}: {problem}; choose another place for input or output", file=sys.stderr)
    if problem.errno not in OF_THE_DISK:
        return 2
    # What could not be printed cannot be printed at the end either.
    silence()
    return 1


def say_old_names() -> None:
    """Each old name that a file or setting still has, once, in a line of its own."""
    others = warnings.showwarning

    def say(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        if issubclass(category, OldName):
            print(f"warning: {message}", file=sys.stderr)
        else:
            others(message, category, *where, **more)

    warnings.filterwarnings("once", category=OldName)
    warnings.showwarning = say


def print_whatever_the_console_can() -> None:
    """A sign that the console's encoding lacks becomes a question mark and ends nothing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def parser() -> Parser:
    top = Parser(prog="rvwear", description="Dynamics and wear of RV reducers.")
    top.add_argument("--version", action=PrintVersion)
    sub = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for group in GROUPS:
        group.add_commands(sub)
    add_quiet(top)
    return top


def add_quiet(parser: argparse.ArgumentParser) -> None:
    """To every command: those of commands of commands too."""
    parser.set_defaults(quiet=False)
    inner = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    for action in inner:
        for command in {id(c): c for c in action.choices.values()}.values():
            add_quiet(command)
    if not inner:
        parser.add_argument(
            "-q", "--quiet", action="store_true",
            help="no tables, notes or progress: paths of files that are written, one a line, errors, the exit code and JSON alone",
        )  # fmt: skip


if __name__ == "__main__":
    sys.exit(main())
