"""The command line tool ``rvwear``.

Exit codes: 0 done, 1 a run that failed, 2 bad input, 130 interrupted.

Help and completion answer at once: a command imports what it computes with when it is called.
"""

import argparse
import os
import sys

from cli.commands import build, campaign, comparison, completion, effects, ensemble, life, reducer, reproduce, system
from cli.completion import answer_shell
from cli.progress import new_screen
from fmu_src.faults import InputFault, RunFault
from fmu_src.progress import told_to

# In the order of the help.
GROUPS = (reducer, system, life, ensemble, reproduce, build, campaign, comparison, effects, completion)


def main(arguments: list[str] | None = None) -> int:
    top = parser()
    answer_shell(top)
    options = top.parse_args(arguments)
    try:
        with told_to(new_screen()):
            return options.run(options)
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
    except KeyboardInterrupt:
        print(f"rvwear {options.command}: interrupted", file=sys.stderr)
        return 130


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(prog="rvwear", description="Dynamics and wear of RV reducers.")
    sub = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for group in GROUPS:
        group.add_commands(sub)
    return top


if __name__ == "__main__":
    sys.exit(main())
