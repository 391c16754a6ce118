"""``rvwear completion``: the script by which a shell completes commands, options and names of reducers."""

import argparse

SHELLS = ("bash", "zsh", "fish")


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = sub.add_parser("completion", help='what a shell needs to complete rvwear: source <(rvwear completion bash)')
    command.add_argument("shell", choices=SHELLS, help="fish: rvwear completion fish | source")
    command.set_defaults(run=completion)


def completion(options: argparse.Namespace) -> int:
    from argcomplete.shell_integration import shellcode

    print(shellcode(["rvwear"], shell=options.shell))
    return 0
