"""JSON schemas of the files that people write: editors complete from them and show what a key means."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from cli.schema_words import WORDS
from discrepancy.campaign.file_format import CampaignFile, Run
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.model_file import Content as ModelContent
from discrepancy.model_file import Number, every_effect
from fmu_src.display import display_unit
from fmu_src.strict_file import Strict
from fmu_src.table import Table
from fmu_src.variables import SETTABLE, Variable
from orchestrator.scenario import ScenarioFile
from reducers.entry import Entry
from reducers.reducer import Counts, Head, every_table
from studies.duty import DutyFile
from studies.ensemble.ensemble_file import Content as EnsembleContent

Schema = dict[str, Any]
DIALECT = "https://json-schema.org/draft/2020-12/schema"
# Entries of groups that are tables in a table: errors.pin.radius.
Leaf = Callable[[Variable], Schema]


def schema_of(kind: str) -> Schema:
    """The schema of one of ``KINDS``."""
    title, make = KINDS[kind]
    return {"$schema": DIALECT, "title": title} | make()


def of_model(model: type[Strict], kind: str) -> Schema:
    """Of a pydantic model, with the words of its keys."""
    found: Schema = model.model_json_schema(by_alias=True)
    words = WORDS[kind]
    for name, piece in [(model.__name__, found), *found.get("$defs", {}).items()]:
        piece.pop("title", None)
        for key, entry in piece.get("properties", {}).items():
            entry.pop("title", None)
            if (said := words.get(f"{name}.{key}")) is not None:
                entry["description"] = said
    return found


def settable(of: Iterable[Table]) -> dict[str, Variable]:
    """What may be set, by structured name."""
    return {v.path: v for table in of for v in table.of_role(*SETTABLE)}


def explained(v: Variable) -> str:
    """Meaning, unit and bounds in a line."""
    if v.choices:
        return f"{v.description}: {', '.join(v.choices)}"
    unit = display_unit(v) or v.unit
    bounds = f"; {v.minimum:g} to {v.maximum:g} {v.unit}" if abs(v.minimum) < 1e300 and abs(v.maximum) < 1e300 else ""
    return f"{v.description} [{unit}]{bounds}"


def nested(variables: Mapping[str, Variable], leaf: Leaf) -> Schema:
    """Tables within tables, as dotted keys are read."""
    root: Schema = {"type": "object", "properties": {}, "additionalProperties": False}
    for path, variable in variables.items():
        place = root
        *groups, last = path.split(".")
        for group in groups:
            place = place["properties"].setdefault(group, {"type": "object", "properties": {}, "additionalProperties": False})
            # A group may be a variable, too.
            place.setdefault("properties", {})
        place["properties"][last] = place["properties"].get(last, {}) | leaf(variable)
        if variable.shape:
            # Elements are written with their indices.
            place.setdefault("patternProperties", {})[rf"^{last}\[[0-9, ]+\]$"] = leaf(variable)
    return root


def setting(v: Variable) -> Schema:
    return {"description": explained(v), "enum": list(v.choices)} if v.choices else {"description": explained(v), "type": ["number", "string"]}


def reducer_schema() -> Schema:
    def leaf(v: Variable) -> Schema:
        chosen = {"properties": {"value": {"enum": list(v.choices)}}} if v.choices else {}
        return referred("Entry", explained(v)) | chosen

    groups = nested({path: v for path, v in settable(every_table()).items() if "." in path}, leaf)
    head = {"reducer": of_model(Head, "reducer"), "topology": of_model(Counts, "reducer")}
    return {
        "type": "object", "properties": head | groups["properties"], "required": list(head), "additionalProperties": False,
        "$defs": {"Entry": of_model(Entry, "reducer")},
    }  # fmt: skip


def referred(name: str, text: str) -> Schema:
    """A definition with words of its own; older validators look at nothing beside a reference."""
    return {"allOf": [{"$ref": f"#/$defs/{name}"}], "description": text}


def model_schema() -> Schema:
    found = of_model(ModelContent, "model")
    found.setdefault("$defs", {})["Number"] = of_model(Number, "model")
    found["properties"]["settings"] |= nested(settable(every_table()), setting)
    # A number with its unit, as one text or as a table.
    either: Schema = {"anyOf": [{"type": "string"}, {"$ref": "#/$defs/Number"}]}
    effects: Schema = {}
    for name, effect in every_effect().items():
        parameters = {p.variable.path.rpartition(".")[2]: {**either, "description": explained(p.variable)} for p in effect.parameters}
        arrays = {rf"^{key}\[[0-9, ]+\]$": either for key, p in zip(parameters, effect.parameters) if p.variable.shape}
        effects[name] = {"type": "object", "description": effect.title, "properties": parameters, "additionalProperties": False}
        effects[name] |= {"patternProperties": arrays} if arrays else {}
    # One's own effects are there, too.
    found["properties"]["effects"] |= {"properties": effects, "additionalProperties": {"type": "object"}}
    return found


def campaign_schema() -> Schema:
    found = of_model(CampaignFile, "campaign")
    run = found["$defs"]["Run"]
    run["properties"]["quantity"]["enum"] = list(QUANTITIES)
    run["properties"]["layout"] = {"type": "string", "description": "takes what it does not state itself from [layouts.NAME]"}
    partial = {key: value for key, value in run.items() if key != "required"}
    found["$defs"]["Layout"] = partial
    found["properties"]["layouts"] = {"type": "object", "additionalProperties": {"$ref": "#/$defs/Layout"}, "description": "what several runs have in common"}
    unknowns = nested(settable(every_table()[:2]), lambda v: referred("NuisanceEntry", explained(v)))
    # Numbers of the measuring chain are known by short names.
    found["properties"]["nuisances"] |= unknowns | {"additionalProperties": {"$ref": "#/$defs/NuisanceEntry"}}
    # A layout may state what runs leave out.
    run["required"] = ["id"]
    assert set(Run.model_fields) <= set(run["properties"])
    return found


def scenario_schema() -> Schema:
    found = of_model(ScenarioFile, "scenario")
    found["$defs"]["ComponentEntry"]["properties"]["parameters"] |= {"type": "object", "additionalProperties": True}
    return found


def ensemble_schema() -> Schema:
    found = of_model(EnsembleContent, "ensemble")
    entry = {"$ref": "#/$defs/Entry"}
    wanted = {path: v for path, v in settable(every_table()[:2]).items() if not v.choices}
    scattered = nested(wanted, lambda v: referred("Entry", explained(v)))
    scattered["properties"] |= dict.fromkeys(("duty_torque_factor", "duty_speed_factor"), entry)
    found["properties"]["parameters"] |= scattered
    return found


# File -> (title, its schema).
KINDS: dict[str, tuple[str, Callable[[], Schema]]] = {
    "reducer": ("reducer file of rvwear", reducer_schema), "model": ("model file of rvwear", model_schema),
    "campaign": ("campaign.toml of rvwear", campaign_schema), "scenario": ("scenario file of rvwear", scenario_schema),
    "duty": ("duty file of rvwear", lambda: of_model(DutyFile, "duty")), "ensemble": ("ensemble file of rvwear", ensemble_schema),
}  # fmt: skip
