"""The reference pages and the schemas of the documentation, from the code.

    python -m cli.reference          writes docs/reference/*.md and docs/schema/*.json
"""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from cli.main import parser
from cli.schemas import KINDS, explained, schema_of, settable
from fmu_src.project import NAME
from fmu_src.source_hash import ROOT
from reducers.reducer import every_table, must_be_stated
from reproduce.statements import stated

REFERENCE, SCHEMAS = ROOT / "docs" / "reference", ROOT / "docs" / "schema"
PLAIN_KINDS = {"string": "text", "number": "number", "integer": "whole number", "boolean": "`true`, `false`", "object": "table"}
MADE = "<!-- Made by python -m cli.reference: run it instead of editing this page. -->\n\n"
# What stands above the table of keys: what the file is for, and the smallest that is of use.
HEADS = {
    "reducer": (
        "A reducer: counts, and numbers with unit and source. Numbers that are `needed` must be there; all others have a default. It begins so;"
        " `rvwear reducer new` completes one from a few numbers ([how](../new_reducer.md)), [a tutorial](../tutorials/your_reducer.md) shows one's own.",
        '[reducer]\nname = "mine"\n[topology]\ndiscs = 2\ncranks = 2\npins = 40\nlobes = 39\nrollers = 16\n'
        '[pin]\nradius = { value = 2.0, unit = "mm", source = "drawing 12" }',
    ),
    "model": (
        "A model: a reducer with settings and effects that are on. `rvwear extend` writes it; one may write it oneself.",
        '[model]\nname = "warm"\nreducer = "RV20E-121"\n[settings]\noutput.load_torque = "150 N.m"\n'
        '[effects.thermal_expansion]\nexpansion = "5.4e-7 1/K"',
    ),
    "campaign": (
        "What was measured: files, columns, conditions. [Campaigns](../campaigns.md) explains it by examples; `rvwear campaign from FILES...` writes it.",
        '[campaign]\nname = "bench 3"\nreducer = "RV20E-121"\n[conditions.rated]\noutput_speed = "15 rpm"\nload_torque = "100 %"\n[[runs]]\nid = "te_1"\n'
        'quantity = "transmission_error"\ncondition = "rated"\nfile = "te_1.csv"\ncolumns.angle = { column = "angle", unit = "deg" }\n'
        'columns.value = { column = "te", unit = "arcsec" }',
    ),
    "scenario": (
        "Units, connected: what `rvwear run` steps. [Scenarios](../scenarios.md) explains it.",
        '[scenario]\nname = "one"\nstep = { value = 1, unit = "ms" }\nduration = { value = 1, unit = "s" }\n'
        '[components.plant]\nreducer = "RV20E-121"\nunit = "plant"\nrecord = ["output.lag"]',
    ),
    "duty": (
        "How a reducer is used: speeds and torques with their shares of the hours, for `rvwear life --duty FILE`.",
        '[[segment]]\nspeed = { value = 2000, unit = "rpm" }\ntorque = { value = 167, unit = "N.m" }\nshare = 1.0',
    ),
    "ensemble": (
        "Many lives of parts, duty and parameters that scatter: for `rvwear ensemble FILE`.",
        'reducer = "RV20E-121"\nsamples = 4\nhours = 1000\n[parameters]\n'
        'bearing.clearance = { distribution = "normal", mean = 2.5, deviation = 0.4, unit = "um" }',
    ),
}


def file_page(kind: str) -> str:
    """Keys of a file, with what they mean."""
    schema = schema_of(kind)
    text, example = HEADS[kind]
    lines = [MADE + f"# {kind.capitalize()} file\n", text, f"\n```toml\n{example}\n```\n", editor_words(kind)]
    if kind == "reducer":
        pieces = {"reducer": schema["properties"]["reducer"], "topology": schema["properties"]["topology"], "every number": schema["$defs"]["Entry"]}
        lines += [table_of(name, piece) for name, piece in pieces.items()]
        lines.append(numbers_table())
        return "\n".join(lines)
    lines.append(table_of("top of the file", schema))
    lines += [table_of(words_of(name), piece) for name, piece in schema.get("$defs", {}).items() if piece.get("properties") and name != "Layout"]
    if kind in ("model", "ensemble"):
        lines.append("\nNames of settings and parameters: [variables](../variables.md); of effects: [effects](../effects.md).")
    return "\n".join(lines) + "\n"


def editor_words(kind: str) -> str:
    return (
        "An editor that knows schemas of TOML files (VS Code with Even Better TOML, Neovim or Helix with taplo) completes keys and shows what they mean,"
        f" if the file begins with `#:schema ./{kind}.schema.json` and `rvwear schema {kind} --output {kind}.schema.json` has written that file beside it.\n"
    )


def words_of(name: str) -> str:
    """``ConditionEntry`` as a heading."""
    plain = name.removesuffix("Entry").removesuffix("File") or name
    return "".join(f" {c.lower()}" if c.isupper() and k else c.lower() for k, c in enumerate(plain))


def table_of(title: str, piece: dict[str, Any]) -> str:
    rows = [f"\n## {title[:1].upper()}{title[1:]}\n", "| key | takes | default | meaning |", "|---|---|---|---|"]
    needed = piece.get("required", [])
    for key, entry in piece.get("properties", {}).items():
        default = "needed" if key in needed else plain(entry.get("default"))
        rows.append(f"| `{key}` | {kind_of(entry)} | {default} | {cell(entry.get('description', ''))} |")
    return "\n".join(rows)


def plain(value: Any) -> str:
    return "" if value in (None, "", [], {}) else f"`{str(value).lower() if isinstance(value, bool) else value}`"


def cell(text: str) -> str:
    return text.replace("|", "\\|")


def kind_of(entry: dict[str, Any]) -> str:
    """What a key takes, in words."""
    if "enum" in entry or "const" in entry:
        return ", ".join(f"`{value}`" for value in entry.get("enum", [entry.get("const")]))
    if "$ref" in entry or "allOf" in entry:
        return f"table: {words_of(str(entry.get('$ref') or entry['allOf'][0]['$ref']).rpartition('/')[2])}"
    if "anyOf" in entry:
        kinds = [kind_of(one) for one in entry["anyOf"] if one.get("type") != "null"]
        return " or ".join(dict.fromkeys(kinds))
    if entry.get("type") == "array":
        return f"list of {kind_of(entry.get('items', {}))}" if entry.get("items") else "list"
    inner = entry.get("additionalProperties")
    if entry.get("type") == "object" and isinstance(inner, dict) and inner.get("$ref"):
        return f"tables by name: {words_of(inner['$ref'].rpartition('/')[2])}"
    return PLAIN_KINDS.get(str(entry.get("type")), "anything")


def numbers_table() -> str:
    """All that a reducer file may state, with what a file that leaves it out gets."""
    rows = ["\n## Numbers\n", "A name `pin.radius` is the key `radius` in the section `[pin]`.\n", "| name | default | meaning |", "|---|---|---|"]
    for path, v in settable(every_table()).items():
        if "." in path and not path.startswith("effects."):
            number = f"{v.start:.6g} {v.unit}".removesuffix(" 1")
            usual = f"`{v.choices[int(v.start)]}`" if v.choices else number
            rows.append(f"| `{path}` | {'needed' if must_be_stated(v) else usual} | {cell(explained(v))} |")
    return "\n".join(rows) + "\n\nEffects' parameters may be stated, too: [effects](../effects.md).\n"


def commands_page() -> str:
    """All commands with their options, as ``--help`` has them."""
    codes = (
        "0 done, 1 a run that failed or a campaign that lacks something, 2 bad input, 3 `extend`: nothing was added, for the effect did not help or the"
        " diagnosis names none that may be added by itself, 130 interrupted, 143 terminated"
    )
    lines = [MADE + "# Commands\n", f"Every command takes `--help` and `--quiet`. Exit codes: {codes}."]
    for name, text, command in commands(parser()):
        lines.append(f"\n## {NAME} {name}\n\n{text}\n\n| option | meaning |\n|---|---|")
        for action in command._actions:
            if not isinstance(action, (argparse._HelpAction, argparse._SubParsersAction)) and action.help != argparse.SUPPRESS:
                lines.append(f"| {option_of(action)} | {cell((action.help or '').replace('%(default)s', str(action.default)))} |")
    return "\n".join(lines) + "\n"


def option_of(action: argparse.Action) -> str:
    names = ", ".join(action.option_strings) or str(action.metavar or action.dest)
    choices = "|".join(map(str, action.choices or ()))
    value = "" if not action.option_strings or action.nargs == 0 else f" {action.metavar or choices or action.dest.upper()}"
    return f"`{names}{value}`".replace("|", "\\|")


def commands(top: argparse.ArgumentParser, before: str = "") -> Iterator[tuple[str, str, argparse.ArgumentParser]]:
    """(words, help, parser) of every command that does something."""
    for action in top._actions:
        if isinstance(action, argparse._SubParsersAction):
            texts = {choice.dest: choice.help or "" for choice in action._choices_actions}
            for name, command in action.choices.items():
                inner = list(commands(command, f"{before}{name} "))
                yield from inner or [(f"{before}{name}", texts.get(name, ""), command)]


def claims_page() -> str:
    """What the sources and the literature say, by id."""
    lines = [MADE + "# Claims\n", "What the two source documents, catalogues and later literature say, held against the computation by `rvwear reproduce ID`;"
             " [a tutorial](../tutorials/paper_figure.md) shows one.\n"]  # fmt: skip
    sources: dict[str, list[str]] = {}
    for name, one in stated().items():
        sources.setdefault(one.source, []).append(f"| {name} | {cell(one.title)} | {'yes' if one.has_figure else ''} | {cell(one.says)} |")
    for source, rows in sources.items():
        lines += [f"\n## {source[:1].upper()}{source[1:]}\n", "| id | claim | figure | what the source says |", "|---|---|---|---|", *rows]
    return "\n".join(lines) + "\n"


def files() -> dict[Path, str]:
    """Everything that is made, by its place."""
    found = {REFERENCE / f"{kind}_file.md": file_page(kind) for kind in KINDS}
    found |= {SCHEMAS / f"{kind}.schema.json": json.dumps(schema_of(kind), indent=1) + "\n" for kind in KINDS}
    return found | {REFERENCE / "commands.md": commands_page(), REFERENCE / "claims.md": claims_page()}


if __name__ == "__main__":
    for path, text in files().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        print(path.relative_to(ROOT))
