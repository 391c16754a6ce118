"""Tables with names that users gave, of conditions and runs: they have the width that they need before columns whose words may go on below."""

import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import zip_longest

from rich.cells import cell_len, chop_cells
from rich.table import Table

# What of a name stays together: up to where a word of it ends or a bracket begins, and one sign of those that are written without spaces between words.
PIECES = re.compile(r"\[?[^\s_\[⺀-鿿가-퟿豈-﫿＀-￯]+[\s_]*|.[\s_]*", re.DOTALL)
# A name in less width cannot be read.
LEAST = 8


def fill(table: Table, columns: Mapping[str, Sequence[str]], room: int, names: Sequence[str], texts: Sequence[str] = (), right: Sequence[str] = ()) -> None:
    """Columns by their heads, each with its cells, in ``room`` beside what lies between them; all but ``names`` and ``texts`` are never broken."""
    found = widths(columns, room, names, texts)
    for head in columns:
        whole = None if head in names or head in texts else found[head]
        table.add_column(head, justify="right" if head in right else "left", overflow="fold", max_width=found[head], min_width=whole)
    cells = [[in_lines(cell, found[head]) for cell in column] if head in names else column for head, column in columns.items()]
    for row in zip_longest(*cells):
        table.add_row(*row)


def widths(columns: Mapping[str, Sequence[str]], room: int, names: Sequence[str], texts: Sequence[str]) -> dict[str, int]:
    """Names give way after texts, and neither breaks a word while there is another way."""
    found = {head: widest(line for cell in (head, *column) for line in cell.splitlines()) for head, column in columns.items()}
    left = room - sum(width for head, width in found.items() if head not in names and head not in texts)
    words = {head: widest(word for cell in (head, *columns[head]) for word in cell.split()) for head in texts}
    narrow(found, left - sum(words.values()), {head: widest((head, *(piece for cell in columns[head] for piece in pieces(cell)))) for head in names})
    for head in names:
        # Broken they need less than what there is.
        found[head] = widest((head, *(line for cell in columns[head] for line in in_lines(cell, found[head]).splitlines())))
    narrow(found, left - sum(found[head] for head in names), words)
    narrow(found, left - sum(found[head] for head in texts), dict.fromkeys(names, LEAST))
    return found


def narrow(found: dict[str, int], room: int, least: Mapping[str, int]) -> None:
    """Takes from the widest of the columns in ``least`` until they fit, or are as narrow as that."""
    while sum(found[head] for head in least) > room and (wide := [head for head in least if found[head] > least[head]]):
        found[max(wide, key=lambda head: found[head])] -= 1


def widest(texts: Iterable[str]) -> int:
    """In columns of the terminal, of which a sign of Chinese, Japanese or Korean takes two."""
    return max(map(cell_len, texts), default=0)


def pieces(name: str) -> list[str]:
    return [piece.rstrip() for piece in PIECES.findall(name)]


def in_lines(name: str, width: int) -> str:
    """A name in as few lines as it can be, of about one width: no letter is left alone in the last, and no piece is broken that has room in one."""
    lines = broken(name, width)
    least = widest(pieces(name))
    narrower = next((width for width in range(least if least <= width else 1, width) if len(broken(name, width)) == len(lines)), width)
    return "\n".join(line.rstrip() for line in broken(name, narrower))


def broken(name: str, width: int) -> list[str]:
    """Lines that end where a piece does; a piece that is too long for one is cut anywhere."""
    lines = [""]
    for piece in PIECES.findall(name):
        if cell_len(lines[-1] + piece.rstrip()) <= width:
            lines[-1] += piece
        else:
            lines += chop_cells(piece, width)
    return [line for line in lines if line]
