"""The page of a completed reducer: the parts to scale, every number with its range, and which ranges matter for what."""

from collections.abc import Sequence

from fmu_src.display import read_in
from pages import look
from pages.content import Card, Page, Section, Table
from pages.look import Figure
from reducers.completion.complete import Completion
from reducers.completion.counts import counts_of
from reducers.reducer import Reducer
from studies.catalogue_targets import Target
from studies.completed_ranges import HOURS, RING_ERROR, THROW_ERROR, Influence, what_matters
from studies.figure_units import figure_unit
from studies.report.assembly import assembly, zoom
from studies.report.target_card import target_card


def page_of(completion: Completion, reducer: Reducer, found: list[Influence], targets: Sequence[Target] = ()) -> Page:
    """``found`` may be empty: then nothing is said of signals; ``targets``: what the catalogue says of it."""
    given = completion.given
    whole = assembly(reducer, given.diameter)
    cards = [card(completion, name, label) for name, label in (
        ("pin.circle_radius", "pin circle radius"), ("pin.radius", "pin radius"), ("crank.eccentricity", "eccentricity"), ("mesh.width", "width of a disc"),
    )] + [target_card(target) for target in targets]  # fmt: skip
    sections = [
        Section("parts", "Parts", "Drawn from the completed file.", [whole, zoom(whole, reducer)]),
        *([signals(completion, found)] if found else []),
        Section("numbers", "Numbers", "Ranges add up, as squares of logarithms, what each dial at either end of its own range makes of the number.",
                tables=[numbers(completion), dials(completion)]),
    ]  # fmt: skip
    return Page(
        "completed reducer", reducer.name, f"ratio {given.ratio:g}, {given.pins} pins, {given.rated:g} N m at {given.speed:g} rpm",
        counts_of(completion).short, cards, sections,
        [*completion.doubts, *completion.left_open],
    )  # fmt: skip


def card(completion: Completion, name: str, label: str) -> Card:
    number = completion.numbers[name]
    return Card(label, f"{number.value:.4g}", "given" if number.is_given else f"{number.low:.3g} to {number.high:.3g}", unit=number.unit)


def numbers(completion: Completion) -> Table:
    rows = [
        [n.name, f"{n.value:.5g}", n.unit, f"{n.low:.4g} to {n.high:.4g}" if n.low < n.high else "", n.source]
        for n in (number.as_read for number in completion.numbers.values())
    ]
    return Table("Every number of the file", ["number", "value", "unit", "range", "by"], rows, (1, 3))


def dials(completion: Completion) -> Table:
    rows = []
    for d in completion.dials:
        unit, (value, low, high) = read_in(d.unit, d.value, d.low, d.high)
        rows.append([d.name, d.meaning, f"{value:.4g}", "" if unit == "1" else unit, f"{low:.4g} to {high:.4g}", d.source])
    return Table("What is free: dials and their ranges", ["dial", "meaning", "value", "unit", "range", "from"], rows, (2, 4))


def signals(completion: Completion, found: list[Influence]) -> Section:
    """A map of all dials and signals, and the strongest in words."""
    meaning = {dial.name: dial.meaning for dial in completion.dials}
    rows = [
        [signal_text(signal), meaning[one.dial], f"{one.low:.4g}", f"{one.middle:.4g}", f"{one.high:.4g}", f"{100.0 * one.share:.0f}"]
        for signal, strongest in what_matters(found).items() for one in strongest
    ]  # fmt: skip
    table = Table("The strongest for each signal", ["signal", "dial", "at its lower end", "in the middle", "at its upper end", "± %"], rows, (2, 3, 4, 5),
                  "Signals that no range moves by 2 % have no row.")
    lead = (
        f"Each dial to both ends of its range, all else in the middle. Orders are those of a reducer with one throw {1e6 * THROW_ERROR:g} µm too large and its"
        f" ring {1e6 * RING_ERROR:g} µm eccentric; wear is that after {HOURS:,.0f} h at rated speed and torque,"
        " efficiency and no-load torque (at the input) are those at rated speed,"
        " natural frequencies the lowest at rated torque with the input held. What moves the signals that one can measure is"
        " what is worth measuring on the parts, or finding by a fit."
    )
    return Section("signals", "Which ranges matter for which signal", lead, [influence_map(found, meaning)], [table])


def influence_map(found: list[Influence], meaning: dict[str, str]) -> Figure:
    """Dials over signals, half of the signal's spread in per cent."""
    names = list(dict.fromkeys(one.signal for one in found))
    by = {(one.dial, one.signal): 100.0 * one.share for one in found}
    strongest = sorted(meaning, key=lambda dial: max(by.get((dial, name), 0.0) for name in names))
    shown = [dial for dial in strongest if any(by.get((dial, name), 0.0) >= 2.0 for name in names)]
    values = [[min(by.get((dial, name), 0.0), 100.0) for name in names] for dial in shown]
    trace = {
        "type": "heatmap", "x": [signal_text(name) for name in names], "y": [meaning[dial] for dial in shown], "z": look.short(values, 3),
        "text": [[f"{by.get((dial, name), 0.0):.0f}" for name in names] for dial in shown], "texttemplate": "%{text}",
        "colorscale": look.colour_scale(look.FORCE), "showscale": False, "xgap": 1, "ygap": 1, "hovertemplate": "%{y}: ± %{text} % of %{x}<extra></extra>",
    }  # fmt: skip
    plain = {"ticks": "", "showgrid": False, "automargin": True}
    across = look.axis("") | plain | {"side": "top", "tickangle": -35}
    layout = look.layout(xaxis=across, yaxis=look.axis("") | plain, margin={"l": 10, "r": 10, "t": 10, "b": 10})
    caption = "Half of what a dial's range makes of the signal, in per cent of the signal; darkest from 100 % on."
    return Figure("influences", "Ranges and signals", caption, [trace], layout, 12, 150 + 26 * len(shown))


def signal_text(name: str) -> str:
    """``lost_motion_arcmin`` as "lost motion"."""
    unit = {"N.m/arcmin": "Nm_per_arcmin", "N.m": "Nm", "%": "percent"}.get(figure_unit(name), figure_unit(name))
    return name.removesuffix(f"_{unit}").replace("_", " ")
