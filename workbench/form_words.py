"""Faults of ``rvwear reducer new`` in the words of the form: its fields and its table of numbers in place of options."""

import re
from collections.abc import Mapping

from workbench.page_words import on_page

# The box of the form.
BOX = "'refuse where no gap, clearance and play within their ranges make the lost motion the catalogue's'"
TABLE = "in 'Every number of its file' below"
# Longer ones first.
SAID = [
    (re.compile(r"--meet-lost-motion and --known (\S+):"), rf"{BOX} is ticked and \1 is typed {TABLE}:"),
    (re.compile(r"--meet-lost-motion:"), f"{BOX}:"),
    (re.compile(r"give --known (\S+)=\.\.\."), rf"type \1 {TABLE}"),
    (re.compile(r", for instance --known \S+?=(\S+)"), r", for instance \1"),
    (re.compile(r"--known (\S+?)=(\S*[^\s:])(?=[:;, ]|$)"), rf"\1 = \2 {TABLE}"),
]


def in_form(text: str, labels: Mapping[str, str]) -> str:
    """``labels`` of the fields by the options that they stand for; a value that a fault begins with is its field's."""
    # A line to type has options of its own.
    if "rvwear " in text:
        return on_page(text)
    for pattern, told in SAID:
        text = pattern.sub(told, text)
    for name, label in labels.items():
        # What begins as its label does is known by it.
        told = name if label.startswith(f"{name},") else f"'{label}'"
        option, plain = name.replace("_", "-"), name.replace("_", " ")
        text = re.sub(rf"^{plain} (?=[-+\d])", f"{told} ", text)
        text = re.sub(rf"--{option}(?![\w-])", told, text)
    return on_page(text)
