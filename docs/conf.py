"""The documentation site: ``python -m sphinx -W docs results/site``, then results/site/index.html; nothing is fetched, search included."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from pygments.lexers import TextLexer  # noqa: E402 - as the others

from fmu_src.project import NAME  # noqa: E402 - found where this file lies
from fmu_src.project import project as of_project  # noqa: E402

project, author = NAME, of_project().author
version = release = of_project().version
html_title = f"{NAME} {version}"
extensions = ["myst_parser", "sphinx.ext.autodoc", "docs.formulas"]
html_math_renderer = "mathml"
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
html_theme = "furo"
html_static_path = ["site"]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_copy_source = False
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
exclude_patterns = ["site", "*.py"]
# Pages from outside begin with their own headings.
suppress_warnings = ["myst.header"]

# Pages outside of this folder that its pages link to: where the site has them, and what they are.
OUTSIDE = {
    "SECURITY.md": "project/security", "CONTRIBUTING.md": "project/contributing", "CHANGELOG.md": "project/changes",
    "examples/rv_reducer_te/README.md": "project/rv_reducer_te", "README.md": "index",
}  # fmt: skip
# Folders and files of the source that pages name: the site does not have them.
INSIDE = {page: file for file, page in OUTSIDE.items() if page != "index"}


def within(app: "Sphinx", name: str, source: list[str]) -> None:
    """Links as they work in a checkout become links within the site; pages from outside are read from where they are."""
    up = "../" * name.count("/")
    if name in INSIDE:
        source[0] = (ROOT / INSIDE[name]).read_text(encoding="utf-8").replace("](docs/", f"]({up}")
    for outside, page in OUTSIDE.items():
        for way in (outside, f"{up}../{outside}"):
            source[0] = source[0].replace(f"]({way}", f"]({up}{page}.md")


def setup(app: "Sphinx") -> dict[str, Any]:
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", within)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
