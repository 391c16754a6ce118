"""What a page carries inside, so that it opens offline."""

from pathlib import Path

from markupsafe import Markup

STYLE = Path(__file__).with_name("page.css")


def inside(file: Path) -> Markup:
    """A file, to stand in the page."""
    return Markup(file.read_text(encoding="utf-8"))
