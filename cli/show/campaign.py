"""What ``rvwear campaign`` shows on the screen."""

from collections.abc import Sequence

from rich.table import Table

from cli.screen import WIDTH, console, dense, styled
from discrepancy.campaign.check import Check
from discrepancy.campaign.findings import PROBLEM
from discrepancy.campaign.pairs import HOLDS_FOR, Verdict
from discrepancy.separability import Separability

# How a campaign leaves two effects that look alike.
SEPARABLE, ALIKE, UNSEEN = "separable", "not separable", "not visible"


def show(check: Check) -> None:
    """Overview, findings, pairs."""
    out = console(WIDTH)
    table = dense(f"{check.campaign.name}: what is measured (levels without held-out runs)")
    for name in check.summary[0]:
        first = name == "quantity"
        table.add_column(name.replace("_", "\n"), justify="left" if first else "right", no_wrap=first)
    for row in check.summary:
        table.add_row(*map(str, row.values()))
    out.print(table)
    for finding in check.findings:
        out.print(styled((finding.level, "red" if finding.level == PROBLEM else "yellow"), f" {finding.text}; {finding.remedy}"))
    show_pairs(check.pairs)
    problems = len(check.problems)
    outcome = f"{problems} problem{'s' * (problems != 1)}, {len(check.findings) - problems} warnings"
    impossible = "no diagnosis can be relied on yet" if check.campaign.training else "no diagnosis is possible yet"
    out.print(f"{outcome}; {impossible if problems else 'a diagnosis is possible'}")


def show_pairs(pairs: Sequence[Verdict]) -> None:
    """What to measure, for those that the campaign's conditions leave alike while they are small (nothing is said of effects far above the noise);
    in a line each what these tell apart, and what does not show at all."""
    out = console(WIDTH)
    told: dict[str, list[Verdict]] = {}
    for verdict in pairs:
        told.setdefault(verdict.status, []).append(verdict)
    out.print(f"pairs of effects that look alike, {HOLDS_FOR}")
    table = Table()
    for name in ("", "not separable while small", "what is missing"):
        table.add_column(name)
    for verdict in told.get(ALIKE, []):
        table.add_row(str(verdict.pair.number), between([verdict]), "; ".join(verdict.missing))
    if table.rows:
        out.print(table)
    if SEPARABLE in told:
        out.print(styled((SEPARABLE, "bold"), f": {between(told[SEPARABLE])}"))
    unseen: dict[str, list[Verdict]] = {}
    for verdict in told.get(UNSEEN, []):
        unseen.setdefault("; ".join(verdict.missing), []).append(verdict)
    for missing, which in unseen.items():
        out.print(styled((f"{UNSEEN}: {between(which)} ({missing})", "dim")))


def between(verdicts: Sequence[Verdict]) -> str:
    return "; ".join(" / ".join(verdict.pair.effects) for verdict in verdicts)


def show_separability(found: Separability) -> None:
    """What the best possible test could not tell apart, one row for each effect that might be hidden."""
    out = console(WIDTH)
    title = f"what no test could tell apart here, hidden with {found.strength:g} times the noise (d' below {found.apart:g} between the two); larger ones it may"
    table = Table(title=title, title_justify="left")
    for name in ("if this is what is missing", "it could be taken for (d', and how often the best test errs)"):
        table.add_column(name)
    for hidden, rivals in found.groups():
        pairs = [p for p in found.alike if p.hidden == hidden and p.rival in rivals]
        table.add_row(hidden, ", ".join(f"{p.rival} ({p.typical:.1f}, {100.0 * p.error:.0f} %)" for p in pairs))
    if found.alike:
        out.print(table)
    else:
        out.print(f"the best test could tell every effect from every other, hidden with {found.strength:g} times the noise; smaller ones it may not")
    if found.sometimes:
        out.print("with the worst of their parameters also: " + ", ".join(f"{p.hidden} / {p.rival}" for p in found.sometimes))
    if found.invisible:
        out.print(f"without a trace here: {', '.join(found.invisible)}")
    if found.planned:
        out.print(f"not measured yet, taken as the model foretells them with the noise of a usual bench: {', '.join(found.planned)}")
