"""The documentation follows the code: generated pages, schemas, links, and the site that is built of it."""

import importlib.util
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from cli import reference
from cli.schema_words import WORDS
from cli.schemas import KINDS, schema_of
from discrepancy.campaign.file_format import CampaignFile
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.model_file import Content, every_effect, load_model
from fmu_src.source_hash import ROOT
from orchestrator.scenario import ScenarioFile
from reducers.documentation import page
from reducers.library import LIBRARY
from reducers.reducer import every_table
from studies.duty import DutyFile
from studies.ensemble.ensemble_file import load_ensemble

DOCS = ROOT / "docs"
EXAMPLES = ROOT / "examples"


def test_variables_page_is_up_to_date():
    """If this fails: python -m reducers.documentation > docs/variables.md."""
    assert (DOCS / "variables.md").read_text(encoding="utf-8") == page()


def test_reference_pages_and_schemas_are_up_to_date():
    """If this fails: python -m cli.reference."""
    made = reference.files()
    late = [str(path.relative_to(ROOT)) for path, text in made.items() if not path.is_file() or path.read_text(encoding="utf-8") != text]
    assert not late
    kept = {path for folder in (reference.REFERENCE, reference.SCHEMAS) for path in folder.iterdir() if path.name != "python.md"}
    assert kept == made.keys()


def keys_of(schema):
    """(class, key) of all that a file may have, but for names that come from the units' tables."""
    for name, piece in schema.get("$defs", {}).items():
        for key, entry in piece.get("properties", {}).items():
            yield name, key, entry


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_says_what_it_means_and_no_words_are_of_none(kind):
    schema = schema_of(kind)
    silent = [f"{name}.{key}" for name, key, entry in keys_of(schema) if not entry.get("description")]
    assert not silent
    known = {f"{name}.{key}" for name, key, _ in keys_of(schema)} | {f"{name}.{key}" for name in ("DutyFile", "Content", "CampaignFile", "ScenarioFile")
                                                                     for key in schema.get("properties", {})}  # fmt: skip
    known |= {f"{name}.{key}" for name, piece in (("Head", "reducer"), ("Counts", "topology")) for key in schema["properties"].get(piece, {}).get("properties", {})}
    assert set(WORDS[kind]) <= known


def complaints(item, schema, root, place=""):
    """What a validator would say of keys and choices: enough of one to hold files against their schema."""
    for one in (schema, *schema.get("allOf", [])):
        if "$ref" in one:
            yield from complaints(item, root["$defs"][one["$ref"].rpartition("/")[2]], root, place)
    if "anyOf" in schema:
        tried = [list(complaints(item, one, root, place)) for one in schema["anyOf"]]
        yield from min(tried, key=len)
        return
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    fits = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool, "null": type(None)}
    if kinds and not any(isinstance(item, fits[kind]) for kind in kinds):
        yield f"{place}: {item!r} is no {' or '.join(kinds)}"
    if "enum" in schema and item not in schema["enum"]:
        yield f"{place}: {item!r} is none of {schema['enum']}"
    if isinstance(item, dict):
        for key, value in item.items():
            patterns = [entry for pattern, entry in schema.get("patternProperties", {}).items() if re.search(pattern, key)]
            entry = schema.get("properties", {}).get(key) or next(iter(patterns), None) or schema.get("additionalProperties")
            if entry is False:
                yield f"{place}.{key} is not known"
            elif isinstance(entry, dict):
                yield from complaints(value, entry, root, f"{place}.{key}")
        yield from (f"{place}.{key} is missing" for key in schema.get("required", []) if key not in item)
    if isinstance(item, list) and isinstance(schema.get("items"), dict):
        for number, value in enumerate(item):
            yield from complaints(value, schema["items"], root, f"{place}[{number}]")


FILES = {
    "reducer": sorted(LIBRARY.glob("*.toml")), "campaign": sorted(EXAMPLES.rglob("campaign.toml")), "scenario": [EXAMPLES / "pair.toml"],
    "duty": [EXAMPLES / "move_and_return.toml"], "ensemble": [EXAMPLES / "ensemble.toml"],
}  # fmt: skip


@pytest.mark.parametrize("kind", FILES)
def test_files_fit_their_schema_and_wrong_ones_do_not(kind):
    schema = schema_of(kind)
    assert FILES[kind]
    for path in FILES[kind]:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
        assert not list(complaints(content, schema, schema, path.name))
    first = next(iter(content))
    assert list(complaints(content | {"no_such_key": 1}, schema, schema))
    assert list(complaints({key: value for key, value in content.items() if key != first}, schema, schema))


def test_examples_of_the_reference_pages_are_read(tmp_path):
    def example(kind):
        return re.search("```toml\n(.*?)```", (reference.REFERENCE / f"{kind}_file.md").read_text(encoding="utf-8"), re.DOTALL)[1]

    (tmp_path / "warm.toml").write_text(example("model"))
    assert "thermal_expansion" in load_model(tmp_path / "warm.toml").effects
    (tmp_path / "ensemble.toml").write_text(example("ensemble"))
    assert load_ensemble(tmp_path / "ensemble.toml").samples == 4
    for kind, model in (("campaign", CampaignFile), ("scenario", ScenarioFile), ("duty", DutyFile), ("model", Content)):
        schema, content = schema_of(kind), tomllib.loads(example(kind))
        assert not list(complaints(content, schema, schema)) and model(**content)


def links_of(path):
    """(link, page) of the links of a page of Markdown that lead into the source."""
    text = re.sub("```.*?```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    text = re.sub("`[^`\n]*`|\\$[^$\n]*\\$", "", text)
    return [(link, path) for link in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in link and not link.startswith("#")]


def test_every_link_leads_somewhere():
    pages = [*DOCS.rglob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *EXAMPLES.rglob("*.md")]
    lost = [f"{path.relative_to(ROOT)}: {link}" for page in pages for link, path in links_of(page) if not (path.parent / link.partition("#")[0]).exists()]
    assert not lost


def test_every_page_is_in_the_site():
    listed = set(re.findall(r"^([\w/]+)$", (DOCS / "index.md").read_text(encoding="utf-8"), re.MULTILINE))
    pages = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md")}
    assert pages - {"index"} == listed & pages and listed <= pages


@pytest.mark.campaign
def test_the_site_is_built_without_a_warning_and_reads_offline(tmp_path):
    """All pages, the search, the formulas; nothing that a browser would fetch from elsewhere."""
    for package in ("sphinx", "myst_parser", "furo", "latex2mathml"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f'{package} is not installed: pip install "rvwear[docs]"')
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-d", str(tmp_path / "trees"), str(DOCS), str(tmp_path / "site")]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, env=os.environ | {"PYTHONPATH": str(ROOT)})
    assert done.returncode == 0, done.stderr[-3000:]
    pages = list((tmp_path / "site").rglob("*.html"))
    fetched = [f"{path.name}: {found}" for path in pages for found in re.findall(r'<(?:script|link|img)[^>]+(?:src|href)="(?:https?:)?//[^"]*"', path.read_text(encoding="utf-8"))]
    assert len(pages) > 30 and not fetched
    index = (tmp_path / "site" / "searchindex.js").read_text(encoding="utf-8")
    assert "hysteresi" in index and "<math" in (tmp_path / "site" / "physics.html").read_text(encoding="utf-8")
    assert "rvwear.solve" in (tmp_path / "site" / "reference" / "python.html").read_text(encoding="utf-8")
    assert Path(tmp_path / "site" / "_static").is_dir()


def test_names_of_the_glossary_are_those_of_the_program():
    """Rows are whole, and what stands as code is a quantity, an effect or a variable."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in (DOCS / "glossary.md").read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
    assert len({len(row) for row in rows}) == 1 and len(rows) > 45
    variables = {v.path for table in every_table() for v in table.variables}
    known = {*QUANTITIES, *every_effect(), *variables, "replicate", "code"}
    named = {name for row in rows[1:] for cell in row for name in re.findall(r"`([\w.]+)`", cell) if not name.endswith(".fmu") and ".toml" not in name}
    assert named <= known, named - known
    for term in ("transmission error", "Drehwinkelabweichung", "传动误差", "角度伝達誤差"):
        assert any(term in cell for row in rows for cell in row), term
