"""What ``rvwear campaign`` shows on the screen."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table

from cli.columns import fill
from cli.screen import BETWEEN, WIDTH, console, dense, styled
from discrepancy.campaign.check import Check
from discrepancy.campaign.findings import PROBLEM
from discrepancy.campaign.pairs import HOLDS_FOR, Verdict
from discrepancy.experiment.separability import Separability

# How a campaign leaves two effects that look alike.
SEPARABLE, ALIKE, UNSEEN = "separable", "not separable", "not visible"
# Columns of the overview by their keys; long words are divided, so that each head is whole where all of them stand beside one another.
HEADS = {
    "quantity": "quantity", "runs": "runs", "held_out": "held\nout", "conditions": "condi-\ntions", "replicates": "repli-\ncates", "values": "values",
    "load": "loads", "speed": "speeds", "temperature": "tempe-\nratures", "hours": "hours", "directions": "direc-\ntions", "mountings": "moun-\ntings",
}  # fmt: skip
# What a campaign has levels of: one of them, and how it is called where it is stated nowhere.
LEVELS = {
    "load": ("load", "loads"), "speed": ("speed", "speeds"), "temperature": ("temperature", "temperatures"), "hours": ("number of hours", "hours"),
    "directions": ("direction", "directions"), "mountings": ("mounting", "mountings"),
}  # fmt: skip


def show(check: Check) -> None:
    """Overview, findings, pairs."""
    out = console(WIDTH)
    show_overview(check.campaign.name, check.summary, out)
    for finding in check.findings:
        out.print(styled((finding.level, "red" if finding.level == PROBLEM else "yellow"), f" {finding.text}; {finding.remedy}"))
    show_pairs(check.pairs)
    problems = len(check.problems)
    outcome = f"{problems} problem{'s' * (problems != 1)}, {len(check.findings) - problems} warnings"
    impossible = "no diagnosis can be relied on yet" if check.campaign.training else "no diagnosis is possible yet"
    out.print(f"{outcome}; {impossible if problems else 'a diagnosis is possible'}")


def show_overview(name: str, summary: Sequence[Mapping[str, Any]], out: Console) -> None:
    """A row for each quantity; factors of one level, or of none, have no column but stand once above the table."""
    title = f"{name}: what is measured (levels without held-out runs)"
    table = dense("\n".join(filter(None, (title, alike_text(summary)))))
    kept = [key for key in summary[0] if key not in LEVELS or most(summary, key) > 1]
    columns = {HEADS[key]: [str(row[key]) for row in summary] for key in kept}
    fill(table, columns, out.width - BETWEEN * len(columns), [HEADS["quantity"]], right=[HEADS[key] for key in kept if key != "quantity"])
    out.print(table)


def most(summary: Sequence[Mapping[str, Any]], key: str) -> int:
    """The most levels of a factor that any quantity is measured at."""
    return max(int(row[key]) for row in summary)


def alike_text(summary: Sequence[Mapping[str, Any]]) -> str:
    """What no quantity is measured at several levels of: ``one temperature, one direction, one mounting at most; no hours stated``."""
    single = [f"one {one}" for key, (one, _) in LEVELS.items() if most(summary, key) == 1]
    none = [many for key, (_, many) in LEVELS.items() if most(summary, key) == 0]
    stated = f"no {' and no '.join(none)} stated" if none else ""
    return "; ".join(filter(None, (f"{', '.join(single)} at most" if single else "", stated)))


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
