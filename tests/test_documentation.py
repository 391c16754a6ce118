"""The documentation follows the code."""

from fmu_src.source_hash import ROOT
from reducers.documentation import page


def test_variables_page_is_up_to_date():
    """If this fails: python -m reducers.documentation > docs/variables.md."""
    assert (ROOT / "docs" / "variables.md").read_text(encoding="utf-8") == page()
