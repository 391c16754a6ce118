"""``rvwear forecast``: remaining life from the first inspections of a campaign."""

import argparse
from typing import TYPE_CHECKING

from cli.exporting import add_exports, check_exports, write_exports
from cli.options import add_json

if TYPE_CHECKING:
    from discrepancy.forecast.forecast import Forecast, Range
    from discrepancy.forecast.readings import Inspections, Limit


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = sub.add_parser("forecast", help="how sure is the life: wear and remaining life from inspections so far, with intervals")
    command.add_argument("campaign", help="folder with campaign.toml")
    command.add_argument("--limit", required=True, metavar="QUANTITY=NUMBER", help="where the life ends, for instance lost_motion=1arcmin")
    command.add_argument("--condition", metavar="TEXT", help="which, where the quantity was read at several (the refusal lists them)")
    command.add_argument("--noise", metavar="NUMBER", help='standard deviation of a reading, for instance "0.3 arcsec" (default: as stated, or by repetitions)')
    command.add_argument("--until", type=float, metavar="HOURS", help="use inspections up to these hours alone; the others are compared with")
    command.add_argument("--data", metavar="FOLDER", help="where the data files are (default: as campaign.toml says)")
    add_json(command)
    add_exports(command, pictures=False)
    command.set_defaults(run=run_forecast)


def run_forecast(options: argparse.Namespace) -> int:
    from cli.screen import json_text
    from discrepancy.campaign.load import load_campaign
    from discrepancy.campaign.repetition_words import what_is_done, words
    from discrepancy.forecast.contradictions import contradictions
    from discrepancy.forecast.forecast import narrowing
    from discrepancy.forecast.readings import Inspections, inspections, limit_of
    from discrepancy.forecast.tables import forecast_tables

    check_exports(options)
    limit = limit_of(options.limit)
    found = inspections(load_campaign(options.campaign, options.data), limit, options.condition, options.noise)
    if options.until is not None:
        every = sorted(found.readings + found.held_out, key=lambda r: r.hours)
        found = Inspections([r for r in every if r.hours <= options.until], [r for r in every if r.hours > options.until], found.condition, found.outlying)
    asked = sorted({r.hours for r in found.held_out})
    forecasts = narrowing(found.readings, limit.value, asked=asked)
    doubts = [f"{words(one)}; {what_is_done(one)}" for one in found.outlying]
    doubts += [one.text for one in contradictions(found.readings, forecasts[-1], limit.unit)]
    if options.json:
        json_text({"limit": vars(limit), "condition": found.condition, "forecasts": [f.as_json() for f in forecasts], "doubts": doubts,
                   "unused": [vars(r) for r in found.held_out], "units": units_of(limit)})
    else:
        show(forecasts, found, limit, doubts)
    write_exports(options, lambda: forecast_tables(forecasts, found, limit), list)
    return 0


def units_of(limit: "Limit") -> dict[str, str]:
    """Of what a forecast holds, by its keys: a rate counts per 1,000 h on the screen, per hour in data."""
    unit = limit.unit
    return {"hours": "h", "remaining": "h", "level": unit, "first_level": unit, "later": unit, "rate": f"{unit}/h", "run_in_time": "h",
            "run_in_ratio": "1", "rate_deviation": "1", "drift": "1/h", "horizon": "h", "value": unit, "noise": unit}  # fmt: skip


def share_text(share: float) -> str:
    """In per cent; a small one is not 0, one that leaves something not 100."""
    return "below 1" if share < 0.01 else "over 99" if 0.99 < share < 1.0 else f"{100.0 * share:.0f}"


def show(forecasts: "list[Forecast]", found: "Inspections", limit: "Limit", doubts: list[str]) -> None:
    """``doubts``: what contradicts in the readings."""
    import math

    from cli.screen import console, dense, styled
    from discrepancy.campaign.amount import readable
    from discrepancy.forecast.forecast import COVERAGE
    from discrepancy.words.intervals import digits_of

    def text(r: "Range", scale: float = 1.0, most: float = math.inf) -> str:
        """``most``: what lies beyond is more than that, in words."""
        digits = digits_of(scale * r.low, scale * r.high, write=readable)
        middle, low, high = (readable(scale * v, digits) if v <= most and math.isfinite(v) else f"over {most:,.0f}" for v in (r.middle, r.low, r.high))
        return f"{middle} ({low} to {high})"

    unit = limit.unit
    table = dense(f"{limit.quantity} up to {limit.value:g} {unit}; read at {found.condition}")
    heads = ("inspected\nuntil h", "readings", "hours left\nto the limit", f"now\n{unit}", f"rate now\n{unit}/1000 h", "running-in\nratio", "running-in\nh")
    for head in heads:
        table.add_column(head, justify="right")
    for f in forecasts:
        intervals = (text(f.remaining, most=f.horizon - f.hours), text(f.level), text(f.rate, 1000.0), text(f.run_in_ratio), text(f.run_in_time))
        table.add_row(f"{f.hours:g}", str(f.readings), *(interval.replace(" (", "\n(") for interval in intervals))
    console(100).print(table)
    last = forecasts[-1]
    print(f"middle and interval of {100.0 * COVERAGE:.0f} %; hours count from the last inspection, {last.hours:g} h")
    if last.beyond > 0.0:
        print(f"with a probability of {share_text(last.beyond)} % the limit is not reached within {last.horizon:,.0f} h; nobody looks further")
    if last.readings == 2:
        print(f"two inspections cannot tell how much of the first {last.hours:g} h was running-in: the intervals rest on what is usual there"
              " (docs/forecast.md); a third one tells")  # fmt: skip
    for doubt in doubts:
        console(100).print(styled(("doubtful: ", "yellow"), doubt))
    for r in found.held_out:
        expected = last.later[r.hours]
        within = "within" if expected.low - 2.0 * r.noise <= r.value <= expected.high + 2.0 * r.noise else "outside"
        print(f"not used: {readable(r.value, 4)} {unit} at {r.hours:g} h; expected {text(expected)}: {within}")
    slope = last.rate.middle / 3600.0
    print(f"for RvReducer: life.expected_rate {slope:.3g} {unit}/s, life.rate_deviation {last.rate_deviation:.2g},"
          f" life.rate_drift {last.drift / 3600.0:.2g} 1/s, life.reading_noise {found.readings[-1].noise:.3g} {unit}")  # fmt: skip
