"""What ``rvwear effects`` shows on the screen."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from rich.table import Table

from cli.options import IDEAL_REDUCER
from cli.screen import WIDTH, console, dense, styled
from discrepancy.catalogue.catalogue import Entry
from discrepancy.catalogue.examples import CASES
from discrepancy.catalogue.ranges import range_of

if TYPE_CHECKING:
    from discrepancy.catalogue.declared_signals import Change
    from discrepancy.catalogue.signature import Signature



def show_list(entries: list[Entry], word: str | None = None) -> None:
    title = f"effects in which {word!r} stands" if word else "effects; all are off by default"
    table = Table(title=title, title_justify="left", show_lines=True)
    for head in ("", "name", "acts in", "law", "signature"):
        table.add_column(head, overflow="fold")
    for e in entries:
        table.add_row(e.number, e.name, e.part, e.effect.law, e.effect.signature)
    out = console(WIDTH)
    out.print(table)
    out.print("rvwear effects NAME explains one and computes its signature; --html FILE shows all in pictures")


def show_one(entry: Entry, found: "list[Signature]", reducer: str) -> None:
    """The explanation, its parameters, and what the bench shows with a reducer."""
    out, e = console(WIDTH), entry.effect
    numbered = f", number {e.number} of the physics audit" if e.number else ""
    out.print(styled((e.title, "bold"), f"  {entry.name}{numbered}, acts in the {entry.part}"))
    expected = f"{e.signature} (as expected of {IDEAL_REDUCER})"
    for head, text in (("law", e.law), ("source", e.source), ("signature", expected), ("shows in", ", ".join(e.signals) or "every quantity")):
        out.print(f"  {head:<10}{text}")
    table = dense("parameters")
    for head in ("name", "kind", "unit", "off or start", "bounds", "meaning"):
        table.add_column(head, justify="right" if head == "off or start" else "left", overflow="fold", no_wrap=head in ("name", "kind", "unit"))
    for p in e.parameters:
        table.add_row(p.variable.path, p.told_kind, *range_of(p), p.variable.description)
    out.print(table)
    if reducer == IDEAL_REDUCER:
        out.print(f"What follows is of {reducer}, an ideal reducer with rigid supports and without losses, on which an effect shows by itself; on your own"
                  " it may change figures, a lost motion above all, by many times less or more: --reducer takes its name or file, RV20E-121 or my.toml.")
    for signature in found:
        title = f"computed for {reducer}: {signature.case.title}"
        if not signature.shows:
            out.print(f"{title}\n  {unseen(entry, signature)}")
            continue
        table = Table(title=title, title_justify="left")
        for head in ("figure", "condition", "without", "with", "unit"):
            table.add_column(head, justify="right" if head.startswith("with") else "left")
        for row in signature.rows:
            if row.is_visible():
                table.add_row(row.figure, row.condition, *row.texts, "" if row.unit == "1" else row.unit)
        out.print(table)
    if found and not any(signature.shows for signature in found):
        return
    out.print(f"Figures are those of {reducer}. Those that are not listed do not change at the conditions at which they are computed.")


def show_signals(entry: Entry, changes: "Mapping[str, Change]") -> None:
    """What an own effect changes of each signal of a campaign, as ``--check`` judges its file: other conditions, another reducer, and a bench's noise."""
    from discrepancy.catalogue.declared_signals import LEAST_RATIO, STANDS_OUT, doubts_in, not_judged, reducer_for
    from discrepancy.prediction.candidates import shown_by

    declared, out = shown_by(entry.effect), console(WIDTH)
    table = dense(f"by signal, as effects --check judges its file: on {reducer_for(entry.effect)}, where it changes most")
    for head in ("signal", "declared", "changed by", "at", "noise of a usual bench", "times the noise"):
        table.add_column(head, justify="right" if head in ("changed by", "noise of a usual bench", "times the noise") else "left")
    for quantity, change in changes.items():
        said = "yes" if quantity in declared else "" if declared else "all are"
        # What a solver leaves is no change.
        if change.ratio < LEAST_RATIO:
            table.add_row(quantity, said, "nothing", "", "", "")
        else:
            table.add_row(quantity, said, change.size, change.place, change.noise, f"{change.ratio:.2g}")
    unseen_here = not_judged(entry.effect, changes)
    for quantity in unseen_here:
        table.add_row(quantity, "yes", "not judged", "", "", "")
    out.print(table)
    for doubt in doubts_in(entry.effect, changes):
        out.print(f"doubtful: {doubt}")
    but = f", unless it declares what is not judged, as here {', '.join(unseen_here)}" if unseen_here else ""
    out.print(f"Doubtful for --check: what is not declared and changed by more than {STANDS_OUT:g} times the noise, what is declared and changed by nothing,"
              f" and where nothing that is declared is changed by more than the noise{but}. A mean of transmission errors or of a loop is no change here, for"
              " nobody knows the zero of an angle.")


def unseen(entry: Entry, signature: "Signature") -> str:
    """What is said of an effect that changes no figure; one's own is shown at the usual size that its file states, in that file's units."""
    if entry.name in CASES:
        return "nothing changes that could be seen here"
    values = signature.case.values
    sizes = [f"{values[v.name]:g} {'' if v.unit == '1' else v.unit}".rstrip() for v in (p.variable for p in entry.effect.amplitudes()) if v.name in values]
    size = f"size {sizes[0]}" if len(sizes) == 1 else f"sizes {', '.join(sizes)}"
    return f"at its usual {size} nothing changes that could be seen here; is the usual size too small, or does it act on another part?"
