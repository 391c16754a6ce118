"""Which file imports which, read from the sources, and the table of what is allowed (architecture.toml)."""

import ast
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TABLE = tomllib.loads((ROOT / "docs" / "architecture.toml").read_text(encoding="utf-8"))["folders"]


def sources(root: Path = ROOT) -> dict[str, Path]:
    """Every Python file of the folders in the table, by its path without ending; a package stands for its __init__."""
    tops = sorted({name.partition("/")[0] for name in TABLE})
    found = {}
    for path in sorted(path for top in tops for path in (root / top).rglob("*.py")):
        name = path.relative_to(root).with_suffix("").as_posix()
        found[name.removesuffix("/__init__")] = path
    return found


def imported(name: str, path: Path, known: dict[str, Path]) -> Iterator[tuple[str, int]]:
    """(file, line) of what a file imports from the project, within functions too."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            # A module of a package, or a name in the package itself.
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for text in names:
            target = text.replace(".", "/")
            while target and target not in known:
                target = target.rpartition("/")[0]
            if target and target != name:
                yield target, node.lineno


@cache
def arrows(root: Path = ROOT) -> dict[str, list[tuple[str, int]]]:
    """File -> (imported file, line)."""
    known = sources(root)
    return {name: list(imported(name, path, known)) for name, path in known.items()}


def entry_of(name: str) -> str:
    """The table's entry for a file: the longest that its path begins with."""
    while name not in TABLE:
        name = name.rpartition("/")[0]
    return name


def within(name: str, folder: str) -> bool:
    return name == folder or name.startswith(folder + "/")


def permission(source: str, target: str) -> str | None:
    """What of the table allows an import, or None."""
    own = entry_of(source)
    if entry_of(target) == own:
        return own
    named = [folder for folder in TABLE[own]["imports"] if within(target, folder)]
    if not named and "*" in TABLE[own]["imports"] and "row" in TABLE[target.partition("/")[0]]:
        named = ["*"]
    return max(named, key=len, default=None)


def circles(graph: dict[str, list[tuple[str, int]]]) -> list[list[str]]:
    """Files that import each other, directly or around (Tarjan's strongly connected components)."""
    number: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    found = []

    def visit(name: str) -> None:
        number[name] = lowest[name] = len(number)
        stack.append(name)
        for target, _ in graph[name]:
            if target not in number:
                visit(target)
            if target in stack:
                lowest[name] = min(lowest[name], lowest[target])
        if lowest[name] == number[name]:
            members = stack[stack.index(name):]
            del stack[stack.index(name):]
            if len(members) > 1:
                found.append(sorted(members))

    for name in graph:
        if name not in number:
            visit(name)
    return found
