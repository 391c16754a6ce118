"""A completed reducer on the screen."""

import shlex
from collections.abc import Sequence
from pathlib import Path
from textwrap import shorten

from cli.screen import WIDTH, console, dense, styled
from fmu_src.display import read_text
from reducers.completion.command import given_words
from reducers.completion.compare import Row
from reducers.completion.complete import AS_STIFF, COMPLETED, GIVEN, Completion
from reducers.completion.doubts import FREE
from reducers.completion.given import GAP
from reducers.completion.known import FROM_OPTIONS
from studies.catalogue_lost_motion import Tested
from studies.completed_ranges import Influence, what_matters

# Signs of a rule that a line of the table has room for.
RULE = 19
# A lost motion this share off the catalogue's is that.
SAME = 0.02


def show(completion: Completion, name: str, file: Path, tested: Tested | None, command: Sequence[str]) -> None:
    """Numbers with ranges and the beginning of their rules, doubts, a sum, and what the stiffness test reads of it; ``command`` makes its lost motion
    the catalogue's, if a gap does."""
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
    numbers = completion.numbers.values()
    if (free := completion.numbers[FREE]).source.startswith(AS_STIFF):
        console().print(f"{free.name} = {read_text(free.value, free.unit, 4)} {free.source.removeprefix(f'{GIVEN}: ')}")
    given, assumed = sum(n.is_given or n.name in FROM_OPTIONS for n in numbers), sum("assumed" in n.source for n in numbers)
    said = given_words(completion.given)
    console().print(
        f"given: {said}; of the file's {len(numbers)} numbers these say {given}, {len(numbers) - given - assumed} come by published rules,"
        f" {assumed} are assumed; each stands in the file with its range and its rule in full, --known NAME=VALUE replaces one and what hangs on it"
    )
    for note in completion.left_open:
        console().print(note)
    if tested is not None:
        console().print(in_words(tested, completion))
        if tested.gap is not None and not is_met(tested, completion):
            print(f"  {shlex.join([*command, '--overwrite'])}")
    # Plain, so that paths can be copied.
    print(f"\nfile  {file}\nnext  rvwear reducer check {shlex.quote(str(file))} --html {shlex.quote(str(file.with_suffix('.html')))}")


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


def in_words(tested: Tested, completion: Completion) -> str:
    """What the stiffness test reads, and of a lost motion that is not the catalogue's where it comes from and what would make it that."""
    told, gap = completion.given.lost_motion, completion.numbers[GAP]
    found = f"the stiffness test reads {tested.stiffness:.4g} N.m/arcmin and a lost motion of {tested.lost_motion:.3g} arcmin (the catalogue's: {told:g})"
    if is_met(tested, completion):
        return found
    found += f": a gap of the flanks of {gap.value:.3g} um is taken, and clearance of the bearings, play of the first stage and friction come on top; "
    if tested.gap is None:
        clearance = completion.numbers["bearing.clearance"].as_read
        least = f"--known bearing.clearance={clearance.low:.3g}{clearance.unit}"
        return found + f"without a gap ({GAP}) it is {tested.least:.3g} arcmin; {least} is the least clearance that bearings of this size have"
    return found + f"one of {tested.gap:g} um makes it {told:g} arcmin, and --meet-lost-motion takes that"


def is_met(tested: Tested, completion: Completion) -> bool:
    """Whether lost motion is the catalogue's, or is what a gap makes it that was given or found."""
    told = completion.given.lost_motion
    return completion.numbers[GAP].is_given or completion.given.flank_gap is not None or abs(tested.lost_motion - told) <= SAME * told


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
