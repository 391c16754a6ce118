"""Texts that commands and the page share, in the words of the page: its buttons and views in place of commands, its fields in place of options."""

import re

from fmu_src.unit_words import unit_on_screen
from workbench.file_words import in_fields

# What does on the page what a command does; what nothing there does keeps its command.
BUTTONS = {
    "next": "'Propose the next experiment'", "extend": "'Add it'", "compare": "Look", "diagnose": "Diagnose", "life": "Life",
    "reducer new": "'Complete one from a few numbers' under Reducer", "reducer check": "Reducer", "campaign from": "In", "campaign check": "In",
}  # fmt: skip
# A command with what it is given is a line to type, and stays.
COMMAND = re.compile(rf"`?\brvwear ({'|'.join(sorted(BUTTONS, key=len, reverse=True))})\b(?! (?:--|\S*[./'A-Z]))`?")
OPTION = re.compile(r"--(?P<name>[a-z][a-z-]*)")
# The remedy for a scale is an option of one command, or a line of the file.
SCALE = re.compile(r"with --scale (?P<quote>'?)(?P<column>.*?)=[\d.e+-]+(?P=quote) of rvwear campaign from, or of this column")


def on_page(text: str) -> str:
    """With what an option is called, in place of the option."""
    text = unit_on_screen(text)
    text = in_fields(SCALE.sub(lambda m: f"typed under In as the scale of column {m['column']}, or", text))
    text = COMMAND.sub(lambda m: BUTTONS[m[1]], text)
    # A line to type has options of its own.
    return text if "rvwear " in text else OPTION.sub(lambda m: m["name"].replace("-", " "), text)
