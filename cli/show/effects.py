"""What ``rvwear effects`` shows on the screen."""

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from discrepancy.catalogue.catalogue import Entry
from discrepancy.catalogue.signature import Signature, number


def wide() -> Console:
    """Wide enough for all columns, also where the output goes to a file."""
    return Console(width=max(Console().width, 132))


def show_list(entries: list[Entry]) -> None:
    table = Table(title="effects; all are off by default", title_justify="left", show_lines=True)
    for head in ("", "name", "acts in", "law", "signature"):
        table.add_column(head, overflow="fold")
    for e in entries:
        table.add_row(*map(escape, (e.number, e.name, e.part, e.effect.law, e.effect.signature)))
    console = wide()
    console.print(table)
    console.print("rvwear effects NAME explains one and computes its signature; --html FILE shows all in pictures", highlight=False)


def show_one(entry: Entry, found: list[Signature]) -> None:
    """The explanation, its parameters, and what the bench shows."""
    console, e = wide(), entry.effect
    console.print(f"[bold]{escape(e.title)}[/]  {entry.name}, number {entry.number} of the physics audit, acts in the {entry.part}", highlight=False)
    for head, text in (("law", e.law), ("source", e.source), ("signature", e.signature), ("shows in", ", ".join(e.signals) or "every quantity")):
        console.print(f"  {head:<10}{text}", markup=False, highlight=False)
    table = Table(title="parameters", title_justify="left")
    for head in ("name", "kind", "unit", "off or start", "bounds", "meaning"):
        table.add_column(head, justify="right" if head == "off or start" else "left", overflow="fold")
    for p in e.parameters:
        v = p.variable
        table.add_row(v.name, p.kind, v.unit, f"{float(v.start):g}", f"{v.minimum:g} to {v.maximum:g}", escape(v.description))
    console.print(table)
    for signature in found:
        table = Table(title=f"computed: {signature.case.title}", title_justify="left")
        for head in ("figure", "condition", "without", "with", "unit"):
            table.add_column(head, justify="right" if head.startswith("with") else "left")
        for row in signature.rows:
            if row.is_visible():
                table.add_row(row.figure, row.condition, number(row.without), number(row.present), "" if row.unit == "1" else row.unit)
        console.print(table)
    console.print("Figures that are not listed do not change.", highlight=False)
