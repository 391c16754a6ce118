"""A command line whose mistakes are told with what was perhaps meant."""

import argparse
import re
from collections.abc import Sequence
from typing import NoReturn

from fmu_src.faults import nearest

CHOICE = re.compile(r"invalid choice: '(.*?)' \(choose from (.*)\)", re.DOTALL)
NUMBER = re.compile(r"invalid (int|float) value: ('.*')$", re.DOTALL)


class Parser(argparse.ArgumentParser):
    """As argparse's, its faults in a line or two."""

    def parsed(self, arguments: Sequence[str] | None = None) -> argparse.Namespace:
        """As ``parse_args``; unknown options are told with the nearest that the command has."""
        options, rest = self.parse_known_args(arguments)
        if not rest:
            return options
        command = [self, *chosen_commands(self, options)][-1]
        known = [text for action in command._actions for text in action.option_strings]
        wrong = next((word for word in rest if word.startswith("-")), rest[0])
        if not wrong.startswith("-"):
            meant = f"; a reducer is given as --reducer {wrong}" if "--reducer" in known else f": see {command.prog} --help"
            return command.error(f"{wrong!r} is too much{meant}")
        word = wrong.partition("=")[0]
        places = [action.dest for action in command._actions if not action.option_strings]
        if word == "--model" and "--reducer" in known:
            meant = "; --reducer takes the name or the file"
        elif word.strip("-") in places:
            meant = f"; it is given without one: {command.prog} {' '.join(map(str.upper, places))}"
        else:
            # Who mistyped an option did not ask for help.
            meant = nearest(word, [name for name in known if name != "--help"], 1)
        return command.error(f"there is no option {word}{meant or '; --help lists those there are'}")

    def error(self, message: str) -> NoReturn:
        """Exit code 2, without the whole usage."""
        if match := CHOICE.search(message):
            known = [word.strip(" '") for word in match[2].split(",")]
            place = message[: match.start()].replace("argument COMMAND: ", "there is no command ")
            place = place if place.startswith("there is") else f"{place}there is no "
            meant = nearest(match[1], known, 1)
            message = f"{place}{match[1]!r}{meant or f'; choose from {chr(44).join(known)}'.replace(',', ', ')}"
        if match := NUMBER.search(message):
            wanted = "a whole number is needed" if match[1] == "int" else "a number is needed, without a unit"
            message = f"{message[: match.start()]}{match[2]}: {wanted}"
        if message.endswith("are required: COMMAND"):
            message = "name a command, like rvwear solve; rvwear --help lists all"
        if message.endswith("are required: ACTION"):
            message = f"say what is to be done; {self.prog} --help lists it"
        self.exit(2, f"{self.prog}: {message}\n")


def chosen_commands(parser: argparse.ArgumentParser, options: argparse.Namespace) -> list[argparse.ArgumentParser]:
    """The parsers of the command, and of the command within it, that were chosen."""
    found = []
    inner = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    for action in inner:
        name = getattr(options, action.dest, None)
        if name in action.choices:
            found += [action.choices[name], *chosen_commands(action.choices[name], options)]
    return found
