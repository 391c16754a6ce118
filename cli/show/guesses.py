"""What ``rvwear campaign from`` shows on the screen."""

from collections.abc import Sequence

from cli.screen import WIDTH, console, styled
from cli.show.guessed_runs import table_of
from discrepancy.campaign.findings import Finding
from discrepancy.campaign.guess.in_columns import said_by_columns
from discrepancy.campaign.guess.propose import PlacedRun, Proposal
from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.whose_angle import over_output
from discrepancy.problem import WITH_ZERO

# What is assumed of encoders as long as nobody says a mounting.
ONE_ZERO = (
    "angles of all files are taken to count from one zero, as of encoders that stayed in place; where unit or encoder was taken off in between,"
    " --condition NAME:mounting=WORD says which conditions are of another mounting"
)


def show(proposal: Proposal, findings: Sequence[Finding] = (), reducer_given: bool = False) -> None:
    """Runs, what each column was taken for and why, conditions, what is not sure, ``findings`` in what was read, what is needed."""
    out = console(WIDTH)
    out.print(table_of(proposal.name, proposal.runs, out.width))
    seen = set()
    for run in proposal.runs:
        if (key := columns_key(run)) not in seen:
            seen.add(key)
            out.print(f"{run.guessed.quantity.value}, as in {run.guessed.path.name} (names: {run.guessed.name.pattern}):")
            for role, entry in run.guessed.columns.items():
                out.print(f"  {role}: column {entry.header!r}, {'; '.join(entry.why)}")
            for tag, guess in run.guessed.tags.items():
                out.print(f"  {tag} = {guess.value}: {guess.reason}")
            if run.guessed.left_out:
                out.print(f"  left out: {', '.join(map(repr, run.guessed.left_out))}; --column 'ROLE=COLUMN' gives one a part")
            if proposal.angle_of and over_output(run.guessed):
                out.print(f'  angle_of = "{proposal.angle_of.value}": {proposal.angle_of.reason}')
    for name, stated in proposal.conditions.items():
        kept = f"; {proposal.held_out[name].reason}" if name in proposal.held_out else ""
        by_column = said_by_columns([run.guessed for run in proposal.runs if run.condition == name], stated)
        said = [f"{key} {value}" for key, value in stated.items()] + [f"{key} {' and '.join(levels)} by its column" for key, levels in by_column.items()]
        out.print(f"condition {name}: {', '.join(said) or 'nothing is said'}{kept}")
    if len(proposal.conditions) > 1 and not any("mounting" in stated for stated in proposal.conditions.values()) and any(
        run.guessed.quantity.value in WITH_ZERO for run in proposal.runs
    ):
        out.print(ONE_ZERO)
    if proposal.reducer and proposal.reducer == proposal.named:
        told = "given; lines above the tables say the same" if reducer_given else "as lines above the tables say; --reducer takes another, or a reducer file"
        out.print(f"reducer {proposal.reducer}: {told}")
    for doubt in proposal.doubts:
        out.print(styled(("not sure", "yellow"), f"  {doubt.place}: {doubt.text}; {confirmed(doubt)}{doubt.remedy}"))
    for finding in findings:
        out.print(styled(("not sure", "yellow"), f"  {finding.text}; {finding.remedy}"))
    for need in proposal.needs:
        out.print(styled(("needed", "red"), f"  {need.place}: {need.text}; {need.remedy}"))


def confirmed(doubt: Doubt) -> str:
    """The option that states a guess as it is; of many files the command below has it."""
    if not doubt.so:
        return ""
    return f"{doubt.so} if so; " if doubt.so.count("--") == 1 else "the line below states it if so; "


def columns_key(run: PlacedRun) -> tuple[object, ...]:
    """Equal for runs whose columns and tags were taken alike."""
    columns = ((role, entry.header, entry.unit.value) for role, entry in run.guessed.columns.items())
    return run.guessed.quantity.value, *columns, *((tag, guess.value) for tag, guess in run.guessed.tags.items()), run.guessed.left_out
