"""Tables of an ensemble."""

from typing import Any

from cli.screen import WIDTH, console, dense
from discrepancy.words.intervals import digits_of, general


def show(found: dict[str, Any]) -> None:
    out = console(WIDTH)
    out.print(f"{found['reducer']}: {found['lives_done']} of {found['lives_planned']} lives of {found['hours']:g} h, "
              f"{found['lives_failed']} failed")
    for fault in found["faults"]:
        out.print(f"  {fault}")
    if "distributions" not in found:
        out.print("too few lives for a distribution")
        return
    table = dense("at the end, with 95 % intervals")
    for head in ("figure", "mean", "5 %", "50 %", "95 %"):
        table.add_column(head, justify="left" if head == "figure" else "right", overflow="fold")
    for name, values in found["distributions"].items():
        table.add_row(name, *(cell(value) for value in values.values()))
    if "life_hours" in found:
        table.add_row("life_hours", "", *(cell(value, found["hours"]) for value in found["life_hours"].values()))
    out.print(table)
    for name, share in found.get("beyond_limits", {}).items():
        out.print(f"share of reducers with {name} beyond {found['limits'][name]:g}: {cell(share)}")
    shown = {name: rows for name, rows in found.get("sensitivity", {}).items() if rows}
    if not shown:
        return
    table = dense("share of the variance that a parameter makes, alone / with all interactions")
    table.add_column("parameter", overflow="fold")
    for name in shown:
        table.add_column(name.rpartition("_")[0].replace("_", "\n"), justify="right")
    for parameter in sorted(next(iter(shown.values()))):
        table.add_row(parameter, *(f"{rows[parameter]['alone']:.2f} / {rows[parameter]['total']:.2f}" for rows in shown.values()))
    out.print(table)


def cell(value: dict[str, float | None], most: float | None = None) -> str:
    """Value and interval; ``most`` hours were run, and what lasts longer is more than that."""
    low, high = value["low"], value["high"]
    digits = 3 if low is None or high is None else digits_of(low, high)

    def text(number: float | None) -> str:
        return f"> {most:g}" if number is None else general(number, digits) if most is None else f"{number:.0f}"

    return f"{text(value['value'])} ({text(low)} .. {text(high)})"
