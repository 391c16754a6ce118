"""What ``rvwear campaign`` shows on the screen."""

from rich.console import Console
from rich.table import Table

from discrepancy.campaign.check import Check
from discrepancy.campaign.findings import PROBLEM

STATUS_STYLE = {"separable": "green", "not separable": "yellow", "not visible": "dim"}


def show(check: Check) -> None:
    """Overview, findings, pairs."""
    # Wide enough for all columns, also where the output goes to a file.
    console = Console(width=max(Console().width, 132))
    table = Table(title=f"{check.campaign.name}: what is measured (levels without held-out runs)", title_justify="left")
    for name in check.summary[0]:
        first = name == "quantity"
        table.add_column(name.replace("_", "\n"), justify="left" if first else "right", no_wrap=first)
    for row in check.summary:
        table.add_row(*map(str, row.values()))
    console.print(table)
    for finding in check.findings:
        colour = "red" if finding.level == PROBLEM else "yellow"
        console.print(f"[{colour}]{finding.level}[/] ", end="")
        console.print(f"{finding.text}; {finding.remedy}", markup=False, highlight=False)
    pairs = Table(title="pairs of effects that look alike", title_justify="left")
    for name in ("", "effects", "this campaign", "what is missing"):
        pairs.add_column(name)
    for verdict in check.pairs:
        pairs.add_row(
            str(verdict.pair.number), " / ".join(verdict.pair.effects),
            f"[{STATUS_STYLE[verdict.status]}]{verdict.status}[/]", "; ".join(verdict.missing),
        )  # fmt: skip
    console.print(pairs)
    problems = len(check.problems)
    outcome = f"{problems} problem{'s' * (problems != 1)}, {len(check.findings) - problems} warnings"
    console.print(f"{outcome}; " + ("no diagnosis is possible yet" if problems else "a diagnosis is possible"), markup=False)
