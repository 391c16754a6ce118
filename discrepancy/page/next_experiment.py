"""The page of a proposal: what to measure next, at what cost, and what it would settle."""

import math
import re
from collections.abc import Sequence

from discrepancy.experiment.next_run import NextRun
from discrepancy.inference.next_experiment import ENOUGH, NextExperiment, Proposal
from discrepancy.page import amounts, comparison, maps, whys
from discrepancy.page.evidence import listed
from discrepancy.words.clauses import clauses
from fmu_src.effect_words import effect_title
from pages import look
from pages.content import Card, Page, Section, Table
from pages.look import Figure, short
from pages.words import capital, number

MOST = 12
# What an experiment is expected to do is shown by nothing yet: no green.
ENOUGH_COLOUR, POOR = look.NOW, "#98a3af"
# What is typed into a file: a word in quotes, a key before one, a key with its tables.
KEY = re.compile(r'"[^"]*"|(?<![\w.])(?:[a-z_]+(?= = ["\[])|[a-z]\w*(?:\.[a-z]\w*)+)')


def page(run: NextRun) -> Page:
    currency = run.cost_unit
    sections = (
        [proposals(run.result, currency, run.rivals), stake(run)]
        if run.result
        else [Section("proposals", "Proposals", "There are no two effects to separate.")]
    )
    if run.open:
        rows = [[readable(a.experiment), readable(a.why), a.like, number(a.cost), number(a.expected)] for a in run.asked]
        lead = (
            "Nothing is missing that these runs show. What they cannot show, whatever it is, and what would:" if run.answer.would_show
            else f"Something is left {run.answer.left_over}. Where it would show its law:"
        )  # fmt: skip
        head = ["measure", "because", "condition", f"cost{f' [{currency}]' if currency else ''}", "expected misfit"]
        note = "Misfit in chi-square, of two runs that are off as those of this signal are on average."
        title = "What these runs cannot show" if run.answer.would_show else "What nothing explains"
        left = Section("open", title, lead, [], [Table("", head, rows, (3, 4), note)])
        # The table that answers stands first.
        sections = [*sections, left] if run.result else [left, *sections]
    rivals = listed([effect_title(r) for r in run.rivals])
    # What no run tells has a place of its own: the finding is what to do.
    untold = [line for text in run.untold for line in clauses(text)]
    finding = sentences(run.lines[len(untold) :])
    if untold:
        sections = [*sections, Section("untold", "What no other run of these signals tells", sentences(untold))]
    where = f"To separate {rivals}" if len(run.rivals) > 1 else "Diagnosis: " + run.answer.verdict
    return Page(
        "The next experiment", comparison.title(run.answer), where, finding, cards(run, currency), sections, run.answer.warnings
    )


def sentences(lines: Sequence[str]) -> str:
    return " ".join(f"{line if KEY.match(line) else capital(line)}." for line in map(in_sentence, map(amounts.in_words, lines)))


def in_sentence(line: str) -> str:
    """Names as words; what is typed into a file stays as it is typed there."""
    # What is split at stands at the odd places.
    return "".join(part if k % 2 else readable(part) for k, part in enumerate(re.split(f"({KEY.pattern})", line)))


def cards(run: NextRun, currency: str) -> list[Card]:
    if not run.result or not run.result.proposals:
        return [Card("Diagnosis", run.answer.verdict, run.answer.reason)]
    best = run.result.proposals[0]
    tone = "plain" if best.least >= ENOUGH else "bad"
    return [
        Card(
            "Proposed" if best.least >= ENOUGH else "Best of those possible",
            readable(best.experiment.partition(" at ")[0]),
            readable(best.experiment.partition(" at ")[2]),
            tone=tone,
        ),
        Card("Cost", number(best.cost), "", unit=currency),
        Card("Least separation of two rivals", size(best.least), f"in chi-square; {ENOUGH:g} is enough", tone=tone, why=whys.of_proposal(best, run.rivals)),
        Card("Diagnosis so far", run.answer.verdict, f"{len(run.rivals)} rivals"),
    ]


def proposals(result: NextExperiment, currency: str, rivals: Sequence[str]) -> Section:
    best = result.proposals
    good = sum(p.least >= ENOUGH for p in best)
    lead = (
        f"{good} of {len(best)} possible experiments would separate every pair of rivals (least separation {ENOUGH:g} or more)."
        if good
        else f"None of {len(best)} possible experiments separates every pair of rivals: this cannot be settled within the limits of the rig."
    )
    if not best:
        return Section("proposals", "Proposals", "The rig can measure none of what this campaign has.")
    rows = [[title(p), number(p.cost), size(p.least), size(p.score)] for p in best[:MOST]]
    head = ["experiment", f"cost{f' [{currency}]' if currency else ''}", "least separation [chi-square]", "mean separation [chi-square]"]
    table = Table(
        f"The best {len(rows)}",
        head,
        rows,
        (1, 2, 3),
        "Separations in chi-square, parameters of the rivals free within what is known of them.",
        [whys.of_proposal(p, rivals) for p in best[:MOST]],
    )
    figures = [ranking(best[:MOST], currency)]
    if len({pair for p in best for pair in p.separation}) > 1:
        figures.append(separations(best[:MOST]))
    if len({p.cost for p in best}) > 1:
        figures.append(cloud(best, currency))
    return Section("proposals", "Proposals", lead, figures, [table])


def title(proposal: Proposal) -> str:
    return readable(proposal.experiment)


def readable(name: str) -> str:
    return name.replace("_", " ").replace("degC", "°C").replace("N.m", "N m")


def size(separation: float) -> str:
    return "< 0.01" if separation < 0.01 else number(separation)


def separations(best: Sequence[Proposal]) -> Figure:
    """Which pair of rivals each experiment tells apart."""
    pairs = list(dict.fromkeys(pair for p in best for pair in p.separation))
    values = [[p.separation.get(pair, float("nan")) for pair in pairs] for p in best]
    z = [[math.log10(min(max(v, 0.1), 100.0)) if v == v else v for v in row] for row in values]
    names, columns = (
        [title(p) for p in best],
        ["<br>from<br>".join(effect_title(n).replace(" (", "<br>(") for n in pair.split(" ~ ")) for pair in pairs],
    )
    hover = [[f"{name}<br>{c.replace('<br>', ' ')}: {size(v)}" for c, v in zip(columns, row)] for name, row in zip(names, values)]
    ticks = {-1.0: "≤ 0.1", 0.0: "1", math.log10(ENOUGH): f"{ENOUGH:g}", 2.0: "≥ 100"}
    few = len(pairs) <= 10
    trace = maps.heat(
        z,
        columns,
        names,
        [[size(v) if few else "" for v in row] for row in values],
        hover,
        "separation",
        -1.0,
        2.0,
        ticks,
        ("#ffffff", *look.HOURS),
    )
    return Figure(
        "separations",
        "Which rivals each experiment tells apart",
        f"Chi-square of each pair; {ENOUGH:g} is enough.",
        [trace],
        maps.layout(names, level=few),
        12,
        190 + 27 * max(len(best), 3),
    )


def ranking(best: Sequence[Proposal], currency: str) -> Figure:
    """Cost to the left, separation to the right."""
    names = [title(p) for p in best]
    colours = [ENOUGH_COLOUR if p.least >= ENOUGH else POOR for p in best]
    most = max([p.least for p in best] + [ENOUGH])
    wide = most > 30.0 * ENOUGH
    both = {"type": "bar", "orientation": "h", "y": names}
    data = [
        both
        | {
            "x": short([p.cost for p in best], 4),
            "marker": {"color": "#d9b06a"},
            "hovertemplate": "%{y}<br>cost %{x}<extra></extra>",
            "text": [number(p.cost) for p in best],
            "textposition": "inside",
            "insidetextanchor": "start",
        },
        both
        | {
            "x": short([max(p.least, 0.1 if wide else 0.0) for p in best], 4),
            "xaxis": "x2",
            "marker": {"color": colours},
            "hovertemplate": "%{y}<br>least separation %{x}<extra></extra>",
            "text": [size(p.least) for p in best],
            "textposition": "auto",
        },
    ]
    right = {"type": "log", "range": [-1.0, math.log10(1.5 * most)]} if wide else {"range": [0.0, 1.1 * most]}
    line = {
        "type": "line",
        "xref": "x2",
        "yref": "paper",
        "x0": ENOUGH,
        "x1": ENOUGH,
        "y0": 0,
        "y1": 1,
        "line": {"color": ENOUGH_COLOUR, "width": 1.2, "dash": "dot"},
    }
    layout = look.layout(
        xaxis=look.axis(
            f"cost{f' [{currency}]' if currency else ''}", domain=[0.0, 0.28], range=[0.0, 1.1 * max([p.cost for p in best] + [1e-9])]
        ),
        xaxis2=look.axis("least separation of two rivals [chi-square]", domain=[0.34, 1.0], anchor="y", **right),
        yaxis=look.axis("", type="category", autorange="reversed", showgrid=False, ticks=""),
        shapes=[line],
        bargap=0.35,
        margin={"l": 60, "r": 20, "t": 10, "b": 46},
    )
    return Figure(
        "ranking",
        "What they cost and what they settle",
        f"Best first; the dotted line at {ENOUGH:g} is enough to tell two rivals apart.",
        data,
        layout,
        12,
        90 + 28 * max(len(best), 3),
    )


def cloud(best: Sequence[Proposal], currency: str) -> Figure:
    """All experiments of the grid."""
    least = [max(p.least, 1e-2) for p in best]
    dots = {
        "type": "scatter",
        "mode": "markers",
        "x": short([p.cost for p in best], 5),
        "y": short(least, 4),
        "customdata": [title(p) for p in best],
        "marker": {"color": [ENOUGH_COLOUR if p.least >= ENOUGH else POOR for p in best], "size": 8, "opacity": 0.7},
        "hovertemplate": "%{customdata}<br>cost %{x}, least separation %{y}<extra></extra>",
    }
    line = {
        "type": "line",
        "xref": "paper",
        "x0": 0,
        "x1": 1,
        "y0": ENOUGH,
        "y1": ENOUGH,
        "line": {"color": ENOUGH_COLOUR, "width": 1.2, "dash": "dot"},
    }
    layout = look.layout(
        xaxis=look.axis(f"cost{f' [{currency}]' if currency else ''}", rangemode="tozero"),
        yaxis=look.axis("least separation [chi-square]", type="log", dtick=1),
        shapes=[line],
    )
    return Figure("cloud", "All experiments within the rig's limits", "Separations below 0.01 are drawn there.", [dots], layout, 12, 300)


def stake(run: NextRun) -> Section:
    """What is unknown as long as the rivals are not told apart."""
    rows = [[readable(name), amounts.pretty(text)] for name, text in run.stakes().items()]
    lead = (
        "Largest difference of the rivals' predictions: the error that remains if nobody measures."
        if rows
        else "No condition of interest was given."
    )
    return Section(
        "stake", "What it costs not to know", lead, [], [Table("", ["condition", "rivals differ by up to"], rows, (1,))] if rows else []
    )
