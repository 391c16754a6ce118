"""A fingerprint of the code that decides the numbers."""

import hashlib
import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KERNEL_PACKAGES = ("fmu_src", "rv_plant", "wear_fmu", "rv_reducer")

# Folder with a user's own effects: DIR/rv_plant/*.py and DIR/wear_fmu/*.py.
USER_EFFECTS = "RVWEAR_EFFECTS"
# Lies beside the sources inside an FMU, which has its effects with it and takes no others.
STAMP = "unit.json"
# Known now, as ``LOADED_HASH`` is: an importer may delete the folder before its next instance.
IN_FMU = (ROOT / STAMP).is_file()


def own_effects_hint() -> str:
    """The end of a message about an effect that is not there; empty where a folder of one's own is named."""
    return "" if os.environ.get(USER_EFFECTS) else f" (effects of your own are found in the folder that {USER_EFFECTS} names, which is not set here)"


def user_effect_files(package: str) -> list[tuple[str, Path]]:
    """(name inside the project, file) of the user's effects of a package, in a fixed order.

    What editors and file managers put beside files begins with a dot.  What cannot be read is told by ``effect_check``.
    """
    folder = None if IN_FMU else os.environ.get(USER_EFFECTS)
    files = sorted((Path(folder).resolve() / package).glob("[!.]*.py")) if folder else []
    return [(f"{package}/effects/{file.name}", file) for file in files if readable(file)]


def readable(file: Path) -> bool:
    return file.is_file() and os.access(file, os.R_OK)


def source_files(packages: tuple[str, ...] = KERNEL_PACKAGES, root: Path = ROOT) -> list[tuple[str, Path]]:
    """(name, file) of every source and reducer file of the packages, in a fixed order."""
    found = [(p.relative_to(root).as_posix(), p) for name in packages
             for p in (root / name).rglob("*") if p.suffix in (".py", ".toml", ".c", ".h")]
    for name in packages:
        found += user_effect_files(name)
    return sorted(found)


def source_hash(packages: tuple[str, ...] = KERNEL_PACKAGES, root: Path = ROOT) -> str:
    """SHA-256 over names and contents: equal code gives an equal hash on every machine."""
    digest = hashlib.sha256()
    for name, path in source_files(packages, root):
        digest.update(name.encode() + b"\0")
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()


# Of the modules that this process runs; taken now, because an importer may delete the
# folder that they came from.
LOADED_HASH = source_hash()
