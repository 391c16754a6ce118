"""Apache Parquet, through pyarrow."""

from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet

from discrepancy.campaign.readers import Options, missing_column


def read(path: Path, names: set[str], options: Options) -> dict[str, np.ndarray]:
    available = parquet.read_schema(path).names
    for name in names:
        if name not in available:
            raise missing_column(name, available)
    table = parquet.read_table(path, columns=sorted(names))
    return {name: table[name].to_numpy() for name in sorted(names)}


def contents(path: Path) -> dict[str, str]:
    """Columns, with the units that the file states ("" for none)."""
    return dict.fromkeys(parquet.read_schema(path).names, "")
