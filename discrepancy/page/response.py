"""What the model leaves unexplained beside what the best effect would add to it."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from discrepancy.inference.noise.series import stream_of
from discrepancy.page import comparison, spectra
from discrepancy.page.runs import Run, axis_of, by_signal, runs_of
from discrepancy.scales import of_axis
from discrepancy.verdict import Answer
from fmu_src.arrays import Floats
from fmu_src.effect_words import effect_title
from pages.content import Section

WORDS = ("measured − base model", "effect", "what the effect leaves")


def section(answer: Answer) -> Section:
    """The best fit (one effect, or several together) over the signals that it touches."""
    space, best = answer.diagnosis.fits.space, answer.diagnosis.fits.members[0]
    every = list(range(len(space.records)))
    base = space.predictions(space.base.values, every)
    full = space.predictions(best.fit.values, every)
    runs = runs_of(space, [a - b for a, b in zip(full, base)], of_axis("speed", answer.model.campaign), base)
    touched = {
        signal
        for signal, members in by_signal(runs).items()
        if any(abs(run.predicted).max(initial=0.0) > 0.05 * run.noise.max(initial=0.0) for run in members)
    }
    runs = [run for signal, members in by_signal(runs).items() if signal in touched for run in members]
    figures = comparison.run_figures("response", averaged(runs), words=WORDS)
    for signal, members in by_signal(runs).items():
        lines = [r for r in members if r.series]
        orders, _ = spectra.figure("response_orders", signal, lines, WORDS[:2])
        if orders:
            figures.append(orders)
    figures.sort(key=lambda f: -f.columns)
    lead = (
        f"In blue what {' + '.join(effect_title(c.name) for c in best.candidates)} adds with its fitted parameters, "
        "in grey what the base model leaves (of series the mean of replicates that share their samples, each single replicate where they do not);"
        " held-out conditions were not fitted."
    )
    return Section(
        "response",
        "The effect beside the misfit",
        lead if figures else "The effect changes no signal by more than a twentieth of its noise.",
        figures,
    )


def averaged(runs: list[Run]) -> list[Run]:
    """Replicates of a series in one, where they share their samples; noise falls with their number."""
    cells: dict[tuple[str, str, str, bool, bytes | str], list[Run]] = {}
    for run in runs:
        key = (stream_of(run.record), run.record.condition, run.record.mounting, run.record.held_out)
        alike = np.asarray(run.record.axes[axis_of(run)])[run.kept].tobytes() if run.series else run.record.name
        cells.setdefault((*key, alike), []).append(run)
    return [
        replace(members[0], measured=mean_of(members), noise=members[0].noise / np.sqrt(len(members)), mean_of=len(members),
                outlying=np.all([r.outlying for r in members], axis=0))
        for members in cells.values()
    ]  # fmt: skip


def mean_of(members: Sequence[Run]) -> Floats:
    """Mean of replicates, sample by sample, over those that do not stand far off there."""
    counts = np.sum([~r.outlying for r in members], axis=0)
    total = np.sum([np.where(r.outlying & (counts > 0), 0.0, r.measured) for r in members], axis=0)
    return np.asarray(total / np.where(counts > 0, counts, len(members)))
