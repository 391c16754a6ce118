"""The report of a life: one HTML file that opens offline.

``result`` reads the dataset; ``shapes`` and ``look`` know contours and appearance; the
figures are in ``parts`` and ``circles`` (what is worn where), ``contacts`` and ``phase``
(forces over a crank turn and along a tooth), ``growth`` (over the hours) and
``spectrum`` (orders of the transmission error); ``findings`` says it in words and
``inputs`` lists what it came from; ``page`` puts it together.
"""

from pathlib import Path

import xarray as xr

from pages.render import written
from studies.report.page import page_of
from studies.report.result import Result


def write_report(dataset: xr.Dataset, path: Path) -> Path:
    """Write the report of a life's dataset; equal datasets give equal bytes."""
    return written(page_of(Result.of(dataset)), path)
