"""Which of the files that were built to take for what."""

from collections.abc import Iterable
from pathlib import Path

# The first that there is serves most tools.
FOLDERS = {"fmi3": "tools of FMI 3.0", "fmi2": "tools of FMI 2.0", "": "Python alone, to edit the sources inside"}
UNIT, PLANT, WEAR, PACKAGE = "RvReducer.fmu", "RvPlant.fmu", "RvWear.fmu", "RvReducer.ssp"


def which_to_take(folder: Path, files: Iterable[Path]) -> list[str]:
    """Sentences; none where there is nothing to choose from."""
    there = set(files)
    places = [(name, folder / name if name else folder) for name in FOLDERS]
    units = [(place / UNIT, FOLDERS[name]) for name, place in places if place / UNIT in there]
    if len(units) < 2:
        return []
    beside = [PLANT, WEAR, *([PACKAGE] if units[0][0].with_name(PACKAGE) in there else [])]
    return [
        f"to take: {'; '.join(f'{path} for {tools}' for path, tools in units)}: plant and wear in one unit, the same numbers in each",
        f"{', '.join(beside)} beside it: the two apart, for a master of your own (connected already in the package)",
    ]
