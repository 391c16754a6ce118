"""What ``rvwear doctor`` shows on the screen."""

from textwrap import wrap

from cli.doctor import ABSENT, GOOD, WRONG, Finding
from cli.screen import WIDTH, console, styled

STYLES = {GOOD: "green", ABSENT: "yellow", WRONG: "bold red"}


def show(found: list[Finding]) -> None:
    """What each is, and what to do below it, in as many lines as the width asks for."""
    out = console(WIDTH)
    longest = max(len(finding.what) for finding in found)
    beside = f"{'':{longest + 10}}"
    for finding in found:
        first, *more = folded(finding.text, beside)
        out.print(styled((f"{finding.state:<7}", STYLES[finding.state]), f" {finding.what:<{longest}}  {first.lstrip()}"), soft_wrap=True)
        for line in more + remedy_lines(finding.remedy, beside):
            out.print(line, soft_wrap=True)
    wrong, absent = (sum(f.state == state for f in found) for state in (WRONG, ABSENT))
    ending = "" if wrong else "; everything that is needed is there"
    out.print(f"{wrong} wrong, {absent} optional and absent{ending}")


def folded(text: str, beside: str) -> list[str]:
    """Lines of a text behind an indentation; a path is never broken."""
    return wrap(text, WIDTH, initial_indent=beside, subsequent_indent=beside, break_long_words=False, break_on_hyphens=False) or [""]


def remedy_lines(text: str, beside: str) -> list[str]:
    """A command to be copied stays in one line, further to the left where it needs the room; what only says what to do is folded."""
    if " install " not in text:
        return folded(text, beside) if text else []
    return [f"{beside if len(beside) + len(text) <= WIDTH else '  '}{text}"]
