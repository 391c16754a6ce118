"""A long sentence in short lines."""


def clauses(text: str) -> list[str]:
    """Its parts between semicolons; those within brackets part nothing."""
    found, depth = [""], 0
    for k, letter in enumerate(text):
        depth += (letter in "([") - (letter in ")]")
        if letter == ";" and depth == 0 and text[k + 1 : k + 2] == " ":
            found.append("")
        else:
            found[-1] += letter
    return [part.strip() for part in found]
