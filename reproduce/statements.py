"""What the claims of the sources say, read from the files that hold them: nothing that computes is loaded for a list."""

import ast
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from itertools import groupby
from operator import itemgetter
from pathlib import Path

from fmu_src.faults import InputFault, nearest

HERE = Path(__file__).parent
CLAIMS = "*_claims.py"


@dataclass(frozen=True)
class Statement:
    """Of a claim the source, its title, what the source says, and whether it draws anything."""

    source: str
    title: str
    says: str
    has_figure: bool


@cache
def statements() -> dict[str, Statement]:
    """By id, in the order of the files."""
    shared: dict[str, str] = {}
    for file in sorted(set(HERE.glob("*.py")) - set(HERE.glob(CLAIMS))):
        shared |= texts_of(parsed(file), {})
    found: dict[str, Statement] = {}
    for file in sorted(HERE.glob(CLAIMS)):
        tree = parsed(file)
        texts = texts_of(tree, shared)
        for function in (node for node in tree.body if isinstance(node, ast.FunctionDef)):
            for call in function.decorator_list:
                if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "states":
                    identity, source, title, says = (text_of(argument, texts) for argument in call.args)
                    found[identity] = Statement(source, title, says, draws(function))
    return found


def parsed(file: Path) -> ast.Module:
    return ast.parse(file.read_text(encoding="utf-8"))


def texts_of(tree: ast.Module, known: dict[str, str]) -> dict[str, str]:
    """The names that stand for a text in a file, with those that are ``known``."""
    texts = dict(known)
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            # A name of something else than a text.
            with suppress(KeyError, ValueError):
                texts[node.targets[0].id] = text_of(node.value, texts)
    return texts


def text_of(node: ast.expr, texts: dict[str, str]) -> str:
    """A text as a claim writes it: plain, by name, with named ones in it, or added to one."""
    if isinstance(node, ast.JoinedStr):
        return "".join(text_of(part.value if isinstance(part, ast.FormattedValue) else part, texts) for part in node.values)
    if isinstance(node, ast.BinOp):
        return text_of(node.left, texts) + text_of(node.right, texts)
    return texts[node.id] if isinstance(node, ast.Name) else str(ast.literal_eval(node))


def draws(function: ast.FunctionDef) -> bool:
    return any(word.arg == "figures" for call in ast.walk(function) if isinstance(call, ast.Call) for word in call.keywords)


def available_claims() -> list[str]:
    """The ids of all claims."""
    return sorted(statements(), key=lambda name: ("TNLCI".index(name[0]), name))


def chosen(selected: list[str] | None) -> list[str]:
    """The ids that ids or prefixes of them name, in capitals or not; InputFault for one that names none."""
    ids = available_claims()
    selected = [name.upper() for name in selected or ()]
    for name in selected:
        if not any(known.startswith(name) for known in ids):
            groups = [list(group) for _, group in groupby(ids, key=itemgetter(0))]
            there = ", ".join(f"{group[0]} to {group[-1]}" for group in groups)
            raise InputFault(f"claim {name!r}: there is none{nearest(name, ids) or f'; there are {there}'}; --list says what each is")
    return [known for known in ids if not selected or known.startswith(tuple(selected))]


def stated(selected: list[str] | None = None) -> dict[str, Statement]:
    """What claims say, by id."""
    return {name: statements()[name] for name in chosen(selected)}
