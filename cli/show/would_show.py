"""What an answer is worth that names nothing, on the screen."""

from rich.console import Console

from cli.screen import dense
from discrepancy.words.would_show import HEAD, WouldShow, rows

# Rows on the screen: the hardest to see.
LONGEST = 12


def show_would_show(found: WouldShow, out: Console) -> None:
    """A sentence, what is hard to see, what is easy, and what the runs cannot show."""
    out.print(f"\n{found.sentence}")
    if found.hard:
        table = dense("hardest to see: from which size on, in 95 of 100 campaigns like this one")
        for name in HEAD:
            table.add_column(name, justify="right" if name in HEAD[2:] else "left", overflow="fold")
        hard = rows(found.hard)
        for cells in hard[:LONGEST]:
            table.add_row(*cells)
        out.print(table)
        if len(hard) > LONGEST:
            out.print(f"and {len(hard) - LONGEST} more: --json lists all")
    for text in found.named:
        out.print(text)
    if found.lacking:
        out.print("what these runs cannot show, and what would")
        for finding in found.lacking:
            out.print(f"  {finding.sentence}")
