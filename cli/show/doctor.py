"""What ``rvwear doctor`` shows on the screen."""

from cli.doctor import ABSENT, GOOD, WRONG, Finding
from cli.screen import WIDTH, console, styled

STYLES = {GOOD: "green", ABSENT: "yellow", WRONG: "bold red"}


def show(found: list[Finding]) -> None:
    """A line each, what to do below it."""
    out = console(WIDTH)
    longest = max(len(finding.what) for finding in found)
    for finding in found:
        out.print(styled((f"{finding.state:<7}", STYLES[finding.state]), f" {finding.what:<{longest}}  {finding.text}"), soft_wrap=True)
        if finding.remedy:
            out.print(f"{'':{longest + 10}}{finding.remedy}", soft_wrap=True)
    wrong, absent = (sum(f.state == state for f in found) for state in (WRONG, ABSENT))
    ending = "" if wrong else "; everything that is needed is there"
    out.print(f"{wrong} wrong, {absent} optional and absent{ending}")
