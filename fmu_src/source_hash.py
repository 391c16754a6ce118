"""A fingerprint of the code that decides the numbers."""

import hashlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KERNEL_PACKAGES = ("fmu_src", "rv_plant", "wear_fmu")


def source_files(packages: tuple[str, ...] = KERNEL_PACKAGES, root: Path = ROOT) -> list[Path]:
    """Every source and reducer file of the packages, in a fixed order."""
    found = (p for name in packages for p in (root / name).rglob("*") if p.suffix in (".py", ".toml", ".c", ".h"))
    return sorted(found, key=lambda p: p.relative_to(root).as_posix())


def source_hash(packages: tuple[str, ...] = KERNEL_PACKAGES, root: Path = ROOT) -> str:
    """SHA-256 over names and contents: equal code gives an equal hash on every machine."""
    digest = hashlib.sha256()
    for path in source_files(packages, root):
        digest.update(path.relative_to(root).as_posix().encode() + b"\0")
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()


# Of the modules that this process runs; taken now, because an importer may delete the
# folder that they came from.
LOADED_HASH = source_hash()
