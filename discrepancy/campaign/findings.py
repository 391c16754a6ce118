"""The searches of the check: each yields what it finds wrong with a design or a record."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

import numpy as np

from discrepancy.campaign.design import FRICTION, PLAY, WEAR, Design, highest_order, turns, values_of, worst_gap
from discrepancy.campaign.mending import OfColumn
from discrepancy.campaign.quantities import QUANTITIES, VALUE, keys_for
from discrepancy.campaign.repetition_words import copied_words, interchanged_words, what_is_done, words
from discrepancy.campaign.row_order import is_shuffled
from discrepancy.campaign.sample_words import REMEDY, words_of
from discrepancy.campaign.zeros import unused_means
from discrepancy.interchanged import interchanged
from discrepancy.outlying_samples import outlying_samples
from discrepancy.problem import ERROR, ORDERS
from discrepancy.repetitions import SERIES, outlying

PROBLEM, WARNING = "problem", "warning"
# Of a quantity from so many on one may be held out: two are left to fit.
LEAST_CONDITIONS = 3


@dataclass(frozen=True)
class Finding:
    """``problem``: no diagnosis is possible, or none to rely on; ``warning``: some answers will be out of reach.  ``of``: the one
    column that it is about, if it is about one."""

    level: str
    code: str
    text: str
    remedy: str
    of: OfColumn | None = None

    @property
    def sentence(self) -> str:
        return f"{self.text}: {self.remedy}"


def unfilled(design: Design) -> Iterator[Finding]:
    campaign = design.campaign
    # What has rows is diagnosed without the others.
    level = WARNING if campaign.records else PROBLEM
    for run, file in campaign.unfilled.items():
        yield Finding(level, "no rows", f"run {run}: {file} holds no complete row", "fill it in, or remove the run")
    if campaign.records and not campaign.training:
        yield Finding(PROBLEM, "nothing to fit", "every run is held out", "leave held_out away in most conditions")


def noise(design: Design) -> Iterator[Finding]:
    """As a diagnosis takes it: from repetitions, else as stated, else of series from their own scatter; single numbers have none."""
    lacking = [q for q in design.quantities if not repeated(design, q) and not all(record.stated_noise for record in design.of(q))]
    series = [q for q in lacking if q != ORDERS and any(len(record.values) >= SERIES for record in design.of(q))]
    remedy = "repeat at least one condition (replicate = 2), or state noise = \"...\" in its runs"
    for quantity in design.quantities:
        if quantity in series:
            yield Finding(
                WARNING, "noise guessed",
                f"{quantity}: no run is repeated and no noise is stated: it is guessed from the scatter within runs, times 1.5, and what differs from run"
                " to run is assumed: small effects pass for noise", remedy,
            )  # fmt: skip
        elif quantity in lacking:
            yield Finding(
                WARNING if len(lacking) - len(series) < len(design.quantities) else PROBLEM, "noise unknown",
                f"{quantity}: no run is repeated and no noise is stated: nothing can be concluded from these numbers", remedy,
            )  # fmt: skip
        elif not repeated(design, quantity):
            yield Finding(
                WARNING, "no replicates", f"{quantity}: the noise is only stated, not measured",
                "repeat at least one condition (replicate = 2)",
            )  # fmt: skip


def repeated(design: Design, quantity: str) -> bool:
    return any(count > 1 for count in design.replicates(quantity).values())


def missing_factors(design: Design) -> Iterator[Finding]:
    lacking: dict[tuple[str, str], list[str]] = {}
    for record in design.campaign.records:
        for factor in QUANTITIES[record.quantity].factors:
            if not len(values_of(record, factor)):
                lacking.setdefault((record.condition, factor), []).append(record.name)
    for (condition, factor), runs in lacking.items():
        keys = " or ".join(keys_for(factor))
        yield Finding(
            PROBLEM, "condition incomplete", f"condition {condition} states no {factor}, which {', '.join(runs)} need",
            f"state {keys} in [conditions.{condition}], or give it as a column",
        )  # fmt: skip


def held_out(design: Design) -> Iterator[Finding]:
    if not design.records:
        return
    trained = {record.condition for record in design.records}
    kept = {record.condition for record in design.campaign.held_out}
    if not kept - trained:
        text = "only repetitions are held out, no whole condition" if kept else "no condition is held out"
        yield Finding(
            WARNING, "no held-out condition", f"{text}: whether an effect improves the model elsewhere stays open",
            "set held_out = true in one or two whole conditions, best inside the range of the others",
        )  # fmt: skip
        return
    for quantity in design.quantities:
        alike = (ERROR, ORDERS) if quantity in (ERROR, ORDERS) else (quantity,)
        conditions = {record.condition for record in design.campaign.records if record.quantity in alike}
        if len(conditions) >= LEAST_CONDITIONS and not conditions & (kept - trained):
            yield Finding(
                WARNING, "no held-out condition",
                f"{quantity}: none of its {len(conditions)} conditions is held out: an effect that shows in {quantity} alone cannot be proven",
                "set held_out = true in one of them, best inside the range of the others",
            )  # fmt: skip


# (factor, quantities, levels wanted, what aliases with fewer)
LEVELS = (
    ("load", ("transmission_error", "torsional_stiffness"), 4,
     "with up to 3 loads a cubic stiffness and a backlash fit equally well"),
    ("load", ("input_torque", "efficiency"), 3, "friction that grows with load and drag that does not are not told apart"),
    ("speed", FRICTION, 3, "a Stribeck minimum, viscous drag and a constant are not told apart"),
    ("speed", ("transmission_error",), 2, "a resonance of rig or load, which lifts other orders at another speed, is not told from orders that are off"),
    ("temperature", PLAY + FRICTION, 2, "nothing that follows temperature (expansion, viscosity) shows"),
    ("hours", PLAY + WEAR, 2, "wear and what was there from the start are not told apart"),
    ("hours", WEAR, 3, "running-in, steady wear and late acceleration are not told apart"),
)  # fmt: skip


def levels(design: Design) -> Iterator[Finding]:
    for factor, quantities, wanted, alias in LEVELS:
        present = [quantity for quantity in quantities if design.measures(quantity)]
        # A loop sweeps the torque: it shows more levels than any series of loads.
        swept = factor == "load" and "torsional_stiffness" in quantities and design.measures("hysteresis")
        if not present or swept:
            continue
        found = len(design.levels(factor, *present))
        if found < wanted:
            yield Finding(
                WARNING, f"few levels of {factor}",
                f"{', '.join(present)}: {found or 'no'} level{'s' * (found != 1)} of {factor}: {alias}",
                f"measure at {wanted} or more, stated as {' or '.join(keys_for(factor))}",
            )  # fmt: skip
    directed = [q for q in ("transmission_error", *FRICTION) if design.measures(q)]
    if directed and len(design.directions(*directed)) < 2:
        yield Finding(
            WARNING, "one direction", f"{', '.join(directed)}: only one direction: one-sided wear, and friction that"
            " hides in the mean, do not show", "measure with direction = \"reverse\" too",
        )  # fmt: skip
    if design.measures("transmission_error") and len(design.mountings("transmission_error")) < 2:
        yield Finding(
            WARNING, "one mounting", "transmission_error: one mounting: encoder eccentricity and carrier run-out are not"
            " told apart", "mount the encoder anew, turned by 90 degrees, and state mounting = \"2\"",
        )  # fmt: skip


def coupled(design: Design) -> Iterator[Finding]:
    for a, b in design.coupled_factors():
        yield Finding(
            WARNING, "coupled factors", f"{a} and {b} always change together: effects of one pass for effects of the other",
            f"add a condition with another {b} at the same {a}",
        )  # fmt: skip


def angles(design: Design) -> Iterator[Finding]:
    records = [record for record in design.of("transmission_error") if "angle" in record.axes]
    if not records:
        return
    longest, highest = max(map(turns, records)), max(map(highest_order, records))
    if longest < 3.0 - 0.01:
        short = longest < 1.0 - 0.01
        consequence = (
            "orders that differ by 2 per turn (ring and carrier, 78 and 80 at 40 pins) are not resolved" if short
            else "neighbouring orders are resolved, but with little to spare"
        )  # fmt: skip
        yield Finding(
            WARNING, "record too short", f"transmission_error: the longest record has {longest:.2f} turns of the output: {consequence}",
            "record at least one turn of the output, better three" if short else "three turns are better",
        )  # fmt: skip
    if (reducer := design.campaign.reducer) is None:
        return
    pins, lobes, discs = reducer.topology.pins, reducer.topology.lobes, reducer.topology.discs
    for order, what in ((discs * pins, "the clearance order"), (pins * lobes, "the meshing order")):
        if highest < order:
            yield Finding(
                WARNING, "sampling too coarse",
                f"transmission_error: sampled to order {highest:.0f} per output turn, below {what} {order}, which folds"
                " into lower orders", f"sample more than {2 * order} values per output turn, or average before sampling",
            )  # fmt: skip
            return


def vibrations(design: Design) -> Iterator[Finding]:
    reducer = design.campaign.reducer
    for record in design.of("vibration"):
        time = record.axes["time"]
        speed = values_of(record, "speed")
        if len(time) < 2 or not len(speed) or reducer is None or not design.campaign.ratio or not speed.max() > 0.0:
            continue
        rate = (len(time) - 1) / np.ptp(time)
        meshing = reducer.topology.pins * reducer.topology.lobes * speed.max() / design.campaign.ratio / (2.0 * np.pi)
        if rate < 2.0 * meshing:
            yield Finding(
                WARNING, "sampling too coarse",
                f"run {record.name}: {rate:.4g} samples per second do not reach the meshing frequency, {meshing:.4g} Hz",
                f"sample at more than {2 * meshing:.4g} Hz, behind a low-pass filter",
            )  # fmt: skip


def rows(design: Design) -> Iterator[Finding]:
    for record in design.campaign.records:
        count = design.campaign.rows[record.name]
        if count.dropped > 0.05 * count.selected:
            yield Finding(
                WARNING, "dropouts", f"run {record.name}: {count.dropped} of {count.selected} rows are incomplete and left"
                " out", "look for the cause: what is missing may be missing where it matters",
            )  # fmt: skip
        for name in ("time", "angle"):
            axis = record.axes.get(name)
            if axis is None or len(axis) < 3 or is_shuffled(record, name):
                continue
            if name == "angle" and np.abs(np.diff(axis)).max() > 1.9 * np.pi:
                yield Finding(
                    WARNING, "angle jumps",
                    f"run {record.name}: the angle jumps by a turn, as that of an encoder within one turn does",
                    "state unwrap = true in its column",
                )  # fmt: skip
            elif name == "time" and np.any(np.diff(axis) < 0.0):
                back = np.flatnonzero(np.diff(axis) < 0.0)
                yield Finding(
                    WARNING, "time runs back",
                    f"run {record.name}: time{design.campaign.place(record.name, 'time')} falls {len(back)} times, first from {axis[back[0]]:.6g}"
                    f" to {axis[back[0] + 1]:.6g} s at sample {back[0] + 2}",
                    "split repetitions by where = { ... } into runs of their own; put shuffled rows into the order of time",
                )  # fmt: skip
            elif worst_gap(axis) > 10.0:
                yield Finding(
                    WARNING, "uneven sampling", f"run {record.name}: the largest step of {name} is {worst_gap(axis):.0f}"
                    " times the usual one", "close the gap, or split the run there",
                )  # fmt: skip


def repetitions(design: Design) -> Iterator[Finding]:
    for found in outlying(design.campaign.records):
        yield Finding(
            WARNING, "outlying repetition", words(found) + design.campaign.place(found.run, VALUE), what_is_done(found)
        )  # fmt: skip


def exchanges(design: Design) -> Iterator[Finding]:
    for found in interchanged(design.campaign.records):
        yield Finding(WARNING, "interchanged runs", *interchanged_words(found, design.campaign))


def samples(design: Design) -> Iterator[Finding]:
    for found in outlying_samples(design.campaign.records):
        yield Finding(WARNING, "outlying samples", words_of(found, design.campaign), REMEDY)


def copied(design: Design) -> Iterator[Finding]:
    if design.campaign.copies:
        yield Finding(WARNING, "copied runs", *copied_words(design.campaign.copies))


def zeros(design: Design) -> Iterator[Finding]:
    for text, remedy in unused_means(design.campaign.records):
        yield Finding(WARNING, "means not used", text, remedy)


def statements(design: Design) -> Iterator[Finding]:
    """What the file leaves open or what misleads."""
    campaign = design.campaign
    if campaign.reducer is None:
        yield Finding(
            WARNING, "no reducer", "no reducer is stated: orders cannot be judged", "state reducer in [campaign]"
        )
    silent = [c.name for c in campaign.conditions.values() if not c.direction_stated]
    if silent:
        yield Finding(
            WARNING, "direction not stated", f"condition{'s' * (len(silent) > 1)} {', '.join(silent)}: taken as forward",
            "state direction = \"forward\" or \"reverse\"",
        )  # fmt: skip
    endogenous = [r.name for r in design.of(*FRICTION) if "speed" in r.axes and np.ptp(r.axes["speed"]) > 0.0]
    if endogenous:
        yield Finding(
            WARNING, "measured speed", f"{', '.join(endogenous)}: the speed is a measured column: a controller moves it in"
            " answer to the torque, so that it explains scatter that it did not cause",
            "use the commanded speed as column, or state it in the condition",
        )  # fmt: skip


def shows_less(design: Design) -> Iterator[Finding]:
    """What no run of this design shows, or tells apart, whatever the reducer does."""
    return chain(levels(design), coupled(design), angles(design), vibrations(design), zeros(design))


SEARCHES = (unfilled, noise, missing_factors, held_out, levels, coupled, angles, vibrations, rows, repetitions, exchanges, samples, copied, zeros, statements)
