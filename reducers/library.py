"""The reducers that come with the software, by name: one .toml file each beside this module."""

from pathlib import Path

LIBRARY = Path(__file__).parent


def available() -> list[str]:
    """Their names, from the names of the files: nothing is read."""
    return sorted(path.stem for path in LIBRARY.glob("*.toml"))
