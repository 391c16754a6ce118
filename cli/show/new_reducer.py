"""A completed reducer on the screen."""

import shlex
from collections.abc import Sequence
from pathlib import Path
from textwrap import shorten

from cli.screen import WIDTH, console, dense, styled
from fmu_src.display import read_text
from reducers.completion.command import given_words
from reducers.completion.compare import Row
from reducers.completion.complete import AS_STIFF, COMPLETED, FOUND, Completion
from reducers.completion.counts import counts_of
from reducers.completion.doubts import FREE
from reducers.completion.given import GAP
from studies.catalogue_lost_motion import CLEARANCE, clearance_for
from studies.catalogue_targets import LOST_MOTION, STIFFNESS, Target
from studies.completed_ranges import Influence, what_matters
from studies.hysteresis import Hysteresis

# Signs of a rule that a line of the table has room for.
RULE = 19


def show(completion: Completion, name: str, file: Path, test: Hysteresis | None, targets: Sequence[Target], command: Sequence[str]) -> None:
    """Numbers with ranges and the beginning of their rules, doubts, a sum, and what the stiffness test reads of it; ``command`` makes it anew."""
    table = dense(f"{name}: completed by design rules")
    for head in ("number", "value", "unit", "range"):
        table.add_column(head, justify="right" if head in ("value", "range") else "left", no_wrap=True)
    table.add_column("by", no_wrap=True)
    for number in (number.as_read for number in completion.numbers.values()):
        span = f"{number.low:.3g} to {number.high:.3g}" if number.low < number.high else ""
        rule = shorten(number.source.removeprefix(f"{COMPLETED}: "), RULE, placeholder=" ...")
        table.add_row(number.name, f"{number.value:.4g}", number.unit, span, rule)
    console(WIDTH).print(table)
    for doubt in completion.doubts:
        console().print(styled(("doubtful: ", "yellow"), doubt))
    if (free := completion.numbers[FREE]).source.startswith(AS_STIFF):
        console().print(f"{free.name} = {read_text(free.value, free.unit, 4)} {free.source.removeprefix(f'{FOUND}: ')}")
    console().print(
        f"given: {given_words(completion.given)}; {counts_of(completion).words}; each stands in the file with its range and its rule in full,"
        " --known NAME=VALUE replaces one and what hangs on it"
    )
    for note in completion.left_open:
        console().print(note)
    if test is not None:
        console().print(in_words(test, targets))
    for target in (target for target in targets if target.name == LOST_MOTION):
        show_made(completion, target.is_met, command)
    # Plain, so that paths can be copied.
    print(f"\nfile  {file}\nnext  rvwear reducer check {shlex.quote(str(file))} --html {shlex.quote(str(file.with_suffix('.html')))}")


def show_made(completion: Completion, is_met: bool, command: Sequence[str]) -> None:
    """What the lost motion of the catalogue asked for, and the command that would meet it where nothing within the ranges does."""
    if words := made_words(completion, is_met):
        console().print(words if is_met else styled(("doubtful: ", "yellow"), words))
    if is_met or CLEARANCE not in completion.given.made:
        return
    clearance = clearance_for(completion)
    if clearance is None:
        console().print("no smaller clearance would make it: look at --lost-motion and --stiffness")
    else:
        console().print("a smaller clearance than bearings of this size have would make it; if yours fit so close:")
        print(f"  {shlex.join([*command, '--known', f'{CLEARANCE}={clearance:g}um', '--overwrite'])}")


def show_against(rows: list[Row], name: str, full: str) -> None:
    """Number by number, and how many of those that the full file has from its source lie inside."""
    table = dense(f"{name} against {full}")
    for head in ("number", "completed", "range", "in the file", "unit", "inside?", "the file has it from"):
        table.add_column(head, justify="right" if head in ("completed", "range", "in the file") else "left", overflow="fold")
    for row in (row.as_read for row in rows):
        span = f"{row.low:.4g} to {row.high:.4g}" if row.low < row.high else ""
        inside = "yes" if row.inside else ("no", "red")
        table.add_row(row.name, f"{row.completed:.4g}", span, f"{row.in_file:.4g}", row.unit, styled(inside), row.source)
    console(WIDTH).print(table)
    known = [row for row in rows if row.tests]
    console().print(
        f"{sum(row.inside for row in known)} of {len(known)} numbers that {full} has from its source, and that come by a published rule, lie inside;"
        f" {sum(row.inside for row in rows)} of {len(rows)} of all"
    )


def in_words(test: Hysteresis, targets: Sequence[Target]) -> str:
    """What the stiffness test reads beside what the catalogue has, and which options make it that."""
    asked = {target.name: f" (the catalogue's: {target.asked:g})" for target in targets}
    stiff, lost = asked.get(STIFFNESS, ""), asked.get(LOST_MOTION, "")
    found = f"the stiffness test reads {test.stiffness_Nm_per_arcmin:.4g} N m/arcmin{stiff} and a lost motion of {test.lost_motion_arcmin:.3g} arcmin{lost}"
    left = [option for option, said in (("--stiffness", stiff), ("--lost-motion", lost)) if not said]
    return found + (f"; {' and '.join(left)} of the catalogue would make it that" if left else "")


def made_words(completion: Completion, is_met: bool) -> str:
    """Which numbers the lost motion of the catalogue asked for beyond the gap of the flanks, and what the rest hangs on where it is missed; mostly nothing."""
    made = [completion.numbers[name] for name in completion.given.made]
    if is_met and len(made) < 2:
        return ""
    told = ", ".join(f"{n.name} = {n.value:.3g} {n.unit} (assumed, range {n.low:.3g} to {n.high:.3g} {n.unit})" for n in made if n.name != GAP)
    gap = f"without a gap of the flanks ({GAP} = 0) usual clearances leave more than the catalogue has, so that they are taken smaller: {told}"
    if is_met:
        return f"{gap}; --known NAME=VALUE where one was measured"
    rest = "clearance of the bearings, play of the first stage, friction and torsion make the rest"
    return f"{gap}, the least of their ranges; {rest}" if told else f"the gap of the flanks is given; {rest}"


def show_influences(completion: Completion, found: list[Influence]) -> None:
    """For each signal the dials whose ranges move it most."""
    meaning = {dial.name: dial.meaning for dial in completion.dials}
    table = dense("which ranges matter: the signal with a dial at either end of its range")
    for head in ("signal", "dial", "lower end", "middle", "upper end", "± %"):
        table.add_column(head, justify="left" if head in ("signal", "dial") else "right", overflow="fold")
    for signal, strongest in what_matters(found).items():
        for k, one in enumerate(strongest):
            values = [f"{value:.4g}" for value in (one.low, one.middle, one.high)]
            table.add_row("" if k else signal, meaning[one.dial], *values, f"{100.0 * one.share:.0f}", end_section=one is strongest[-1])
    console(WIDTH).print(table)
