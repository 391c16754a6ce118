"""From a result to its page."""

from pathlib import Path

from discrepancy.compare import Comparison
from discrepancy.extend import Extension
from discrepancy.model_file import ModelFile
from discrepancy.next_run import NextRun
from discrepancy.page import answer, comparison, extension, next_experiment
from discrepancy.verdict import Answer
from pages.content import Page
from pages.render import rendered_sections, written

MAKERS = {
    Comparison: comparison.page,
    Answer: answer.page,
    Extension: extension.extension_page,
    ModelFile: extension.model_page,
    NextRun: next_experiment.page,
}


def page_of(result) -> Page:
    """What the page of a result says and shows."""
    for kind, make in MAKERS.items():
        if isinstance(result, kind):
            return make(result)
    raise TypeError(f"no page for {type(result).__name__}: {', '.join(k.__name__ for k in MAKERS)} have one")


def write_page(result, path: Path) -> Path:
    """Write the page of a comparison, diagnosis, extension, ladder or proposal; equal results give equal bytes."""
    return written(rendered_sections(page_of(result)), path)
