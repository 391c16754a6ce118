"""A series on the screen, beside its catalogue."""

from collections.abc import Mapping

from cli.screen import console, dense, styled
from studies.family import CATALOGUE, SCATTER, SPEEDS, Member, dial_of
from studies.family_marks import fixed, in_the_middle, marks, passed, range_from


def show_family(dials: Mapping[str, float], members: list[Member], fitted: float | None) -> None:
    """Dials and what is fixed beside them, a line a size, and who fails in what; a stiffness beyond the mark is red."""
    table = dense("dials, the same for all sizes; below them what is fixed beside them")
    for head in ("dial", "value", "range", "meaning, and where the range comes from"):
        table.add_column(head, justify="right" if head in ("value", "range") else "left", overflow="fold")
    for name, value in dials.items():
        dial = dial_of(name)
        table.add_row(name, f"{value:g}", f"{dial.low:g} to {dial.high:g}", f"{dial.meaning} ({range_from(dial)})", end_section=name == [*dials][-1])
    for dial, value in fixed():
        table.add_row(f"{dial.name}, fixed", f"{value:.3g}", f"{dial.low:.3g} to {dial.high:.3g}", f"{dial.meaning} ({dial.source})")
    console(100).print(table)
    console(100).print(f"{in_the_middle()} further dials of the completion stand where its rules put them (rvwear reducer new)")
    if fitted is not None:
        console().print(f"support_share fitted to all sizes together: {fitted:.2f}")
    sizes = dense(f"model / catalogue ({CATALOGUE})")
    over_load = f"efficiency % at {SPEEDS[1]:g} rpm: 100, 50, 25, 10 % of rated"
    over_speed = f"at {SPEEDS[0]:g} and {SPEEDS[-1]:g} rpm, rated"
    for head in (
        "size", "cranks", "stiffness N m/arcmin", "ratio", "lost motion '", "start-up %", over_load, over_speed, "no load N m", "crank supports softer",
    ):  # fmt: skip
        sizes.add_column(head, justify="left" if head == "size" else "right", overflow="fold")
    for one in members:
        size = one.size
        far = abs(one.over_catalogue - 1.0) > SCATTER
        ratio = f"{one.over_catalogue:.2f}"
        loads = dict.fromkeys(share for share, _ in one.efficiency)
        sizes.add_row(
            size.name, f"{one.cranks}", f"{one.stiffness:.4g} / {size.stiffness:g}", styled((ratio, "red") if far else ratio),
            f"{one.lost_motion:.2f} / <{size.lost_motion:g}", f"{one.start_up:.0f} / {size.start_up:g}",
            ", ".join(f"{one.efficiency[share, SPEEDS[1]]:.0f}" for share in loads),
            f"{one.efficiency[1.0, SPEEDS[0]]:.0f}, {one.efficiency[1.0, SPEEDS[-1]]:.0f}", f"{one.no_load:.3f}",
            f"{100.0 * one.missing_at_cranks:+.0f} %",
        )  # fmt: skip
    console(100).print(sizes)
    failing = dense("marks, and who fails")
    for head in ("figure", "mark", "within", "not within"):
        failing.add_column(head, overflow="fold")
    for mark in marks(members):
        failing.add_row(mark.figure, mark.mark, passed(mark, members), styled((", ".join(mark.failed), "red")))
    console(100).print(failing)
    console(100).print(
        "The last column of the sizes names what is missing for the catalogue's stiffness: compliance of the cranks' supports, four fifths of the whole."
        " Catalogue charts of efficiency were not to be had: 80 to 90 % at rated load and 50 to 60 % at a tenth are what is generally read off them."
    )
