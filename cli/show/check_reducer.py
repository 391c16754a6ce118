"""A checked reducer file on the screen."""

from collections.abc import Mapping, Sequence

from cli.screen import WIDTH, console, dense, styled
from reducers.checking import STATED, Check
from reducers.completion.again import STIFF
from reducers.completion.complete import COMPLETED, LEAST, MEETS
from reducers.completion.known import FROM_OPTIONS
from studies.catalogue_targets import Target
from studies.hysteresis import ANGLES


def show(found: Check, targets: Sequence[Target]) -> None:
    """What nobody stated first, for it is what one may want to; then what does not fit, the catalogue's figures among it."""
    out = console(WIDTH)
    filled = [n for n in found.numbers if n.kind != STATED]
    out.print(f"{found.reducer.name}: {stated_words({n.name: n.source for n in found.numbers if n.kind == STATED})}, {len(filled)} filled in")
    if filled:
        table = dense("not stated in the file")
        for head in ("number", "value", "unit", "range", "from"):
            table.add_column(head, justify="right" if head in ("value", "range") else "left", overflow="fold", no_wrap=head != "from")
        for n in filled:
            span = f"{n.low:.3g} to {n.high:.3g}" if n.low is not None and n.high is not None else ""
            table.add_row(n.name, f"{n.value:.4g}", n.unit, span, n.source)
        out.print(table)
    f = found.figures
    out.print(f"ratio {f['ratio']:.4g}, K1 = {f['K1']:.3f}, K2 = {f['K2']:.3f}, pins of up to {f['largest_pin_mm']:.4g} mm radius without undercut")
    if targets:
        out.print(f"of the catalogue: {'; '.join(target.words for target in targets)}; as rvwear hysteresis reads them, means of {ANGLES} positions")
    for text in found.doubts:
        out.print(styled(("doubtful: ", "yellow"), text))
    for text in found.faults:
        out.print(styled(("cannot be made: ", "bold red"), text))
    if found.outdated:
        out.print("of a number that was measured say so as its source, and it stays; the others are completed anew with what the file gives:")
        out.print(f"  {found.completing}", soft_wrap=True)
    elif found.completing and any(not target.is_met for target in targets):
        out.print(f"to come as near to the catalogue as the rules leave room:\n  {found.completing}", soft_wrap=True)
    elif found.completing:
        out.print(f"to have them completed by design rules, with ranges:\n  {found.completing}", soft_wrap=True)
    if not found.faults:
        out.print(found.outcome)


def stated_words(sources: Mapping[str, str]) -> str:
    """How many numbers a file states, by name, and how many of them by what else than a source of their own; what ratio, torque and speed say
    of a completed file counts as given, as it does where it is completed."""
    own = [source for name, source in sources.items() if name not in FROM_OPTIONS]
    found = [source for source in own if STIFF.match(source) or source.startswith((MEETS, LEAST))]
    own = [source for source in own if source not in found]
    assumed = sum("assumed" in source for source in own)
    by_rule = sum(source.startswith(COMPLETED) and "assumed" not in source for source in own)
    given = len(sources) - len(found) - assumed - by_rule
    counts = ((given, "given or derived"), (len(found), "looked for to meet the catalogue"), (by_rule, "by rule"), (assumed, "assumed"))
    parts = [f"{count} {words}" for count, words in counts if count]
    return f"{len(sources)} numbers in the file" + (f" ({', '.join(parts)})" if len(parts) > 1 else "")
