"""What ``rvwear campaign`` shows on the screen."""

from rich.table import Table

from cli.screen import console, styled
from discrepancy.campaign.check import Check
from discrepancy.campaign.findings import PROBLEM

# Nothing here is proven by a measurement: no green.
STATUS_STYLE = {"separable": "bold", "not separable": "yellow", "not visible": "dim"}
# Wide enough for all columns.
WIDTH = 132


def show(check: Check) -> None:
    """Overview, findings, pairs."""
    out = console(WIDTH)
    table = Table(title=f"{check.campaign.name}: what is measured (levels without held-out runs)", title_justify="left")
    for name in check.summary[0]:
        first = name == "quantity"
        table.add_column(name.replace("_", "\n"), justify="left" if first else "right", no_wrap=first)
    for row in check.summary:
        table.add_row(*map(str, row.values()))
    out.print(table)
    for finding in check.findings:
        out.print(styled((finding.level, "red" if finding.level == PROBLEM else "yellow"), f" {finding.text}; {finding.remedy}"))
    pairs = Table(title="pairs of effects that look alike", title_justify="left")
    for name in ("", "effects", "this campaign", "what is missing"):
        pairs.add_column(name)
    for verdict in check.pairs:
        pairs.add_row(
            str(verdict.pair.number), " / ".join(verdict.pair.effects), styled((verdict.status, STATUS_STYLE[verdict.status])),
            "; ".join(verdict.missing),
        )  # fmt: skip
    out.print(pairs)
    problems = len(check.problems)
    outcome = f"{problems} problem{'s' * (problems != 1)}, {len(check.findings) - problems} warnings"
    out.print(f"{outcome}; " + ("no diagnosis is possible yet" if problems else "a diagnosis is possible"))
