"""From a result to its page."""

from pathlib import Path

from discrepancy.compare import Comparison
from discrepancy.experiment.next_run import NextRun
from discrepancy.extend import Extension
from discrepancy.model_file import ModelFile
from discrepancy.page import answer, comparison, extension, next_experiment
from discrepancy.verdict import Answer
from pages.content import Page
from pages.render import rendered_sections, written


def page_of(result: object) -> Page:
    """What the page of a result says and shows; a page that was made is itself."""
    match result:
        case Page():
            return result
        case Comparison():
            return comparison.page(result)
        case Answer():
            return answer.page(result)
        case Extension():
            return extension.extension_page(result)
        case ModelFile():
            return extension.model_page(result)
        case NextRun():
            return next_experiment.page(result)
    raise TypeError(f"no page for {type(result).__name__}: Comparison, Answer, Extension, ModelFile and NextRun have one")


def write_page(result: object, path: Path) -> Path:
    """Write the page of a comparison, diagnosis, extension, ladder or proposal; equal results give equal bytes."""
    return written(rendered_sections(page_of(result)), path)
