"""What ``rvwear extend --draft`` shows on the screen beside the extension itself."""

from cli.screen import WIDTH, console, styled
from discrepancy.draft.choose import Draft
from discrepancy.draft.write import over
from discrepancy.verdict import Answer


def show_draft(answer: Answer, draft: Draft, reasons: list[str]) -> None:
    out = console(WIDTH)
    out.print(styled("verdict  ", (answer.verdict, "bold"), f": {answer.reason}"))
    out.print(f"law      {draft.law.text}")
    out.print(styled("drafted  ", (draft.equation, "bold"), f"   ({over(draft.place, draft.expression)})"))
    out.print(f"         {draft.place.text}")
    if draft.beside:
        out.print(f"beside   {', '.join(draft.beside)}")
    out.print(f"file     {draft.file}")
    for reason in reasons:
        out.print(styled(("not drafted", "yellow"), f"  {reason}"))


def show_use(draft: Draft, use: str, command: str, kept: bool) -> None:
    if kept:
        print(f"whoever loads this model needs the effect, in {draft.file.parents[1]}:\n  {use} {command}")
    else:
        print(f"the model does not have the effect; the draft stays in {draft.file}, give it another form or take it away")
