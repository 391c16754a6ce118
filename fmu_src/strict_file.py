"""TOML files against a model of what they may hold: every key is checked, the nearest right one is said."""

import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar, Union, get_args, get_origin

from pydantic import BaseModel, ConfigDict, ValidationError

from fmu_src.faults import InputFault, nearest
from fmu_src.reading import quoted, reading, shown

# A name becomes part of file names.
NAME = r"^[A-Za-z0-9][A-Za-z0-9 ._-]*$"
Location = tuple[int | str, ...]


class Strict(BaseModel):
    """Takes the keys that it names and no others."""

    model_config = ConfigDict(extra="forbid", strict=False)


Piece = TypeVar("Piece", bound=Strict)


def validated(model: type[Piece], content: dict[str, Any], path: Path, remedy: str) -> Piece:
    """The content as the model has it; InputFault with file, key, value and remedy."""
    with reading(path, "such a file", remedy):
        try:
            return model(**content)
        except ValidationError as problem:
            raise InputFault(f"{path}: {described(problem, model, content)}; {remedy}") from None


def described(problem: ValidationError, model: type[BaseModel], content: dict[str, Any]) -> str:
    """Key, value and remedy of the first fault; a key that is not known goes before those that are missing for it."""
    first = min(problem.errors(include_url=False), key=lambda error: error["type"] != "extra_forbidden")
    location, kind = first["loc"], first["type"]
    place = key_path(location, content)
    if kind == "missing":
        return shown(f"{place}.{location[-1]}".lstrip(".")) + " is missing; add it"
    if kind == "extra_forbidden":
        known = keys_at(model, location[:-1])
        hint = nearest(str(location[-1]), known, 1) or f"; possible here: {', '.join(known)}"
        return f"{shown(place)} = {quoted(first['input'])} is not a key here{hint}"
    message = first["msg"].removeprefix("Value error, ").replace("Input should", "it should")
    return f"{shown(place)} = {quoted(first['input'])}: {message}"


def key_path(location: Location, content: dict[str, Any]) -> str:
    """The place as written in the file, entries of lists counted from 1 and with their id.

    pydantic also names the members of a union; they are no keys of the file and are left out.
    """
    place = ""
    item: Any = content
    for part in location:
        if isinstance(item, list) and isinstance(part, int):
            item = item[part]
            place += f"[{part + 1}]" + (f" ({shown(str(item['id']))})" if isinstance(item, dict) and "id" in item else "")
        elif isinstance(item, dict) and part in item:
            item = item[part]
            place += f".{part}" if place else str(part)
    return place


def keys_at(model: type[BaseModel], location: Location) -> list[str]:
    """The keys that a table of the file may have."""
    owners = [model]
    for part in location:
        fields = [field for owner in owners for name, field in owner.model_fields.items() if part in (name, field.alias)]
        owners = [found for field in fields for found in models_in(field.annotation)] or owners
    return list(dict.fromkeys(field.alias or name for owner in owners for name, field in owner.model_fields.items()))


def models_in(annotation: Any) -> Iterator[type[BaseModel]]:
    """The models that a type speaks of."""
    if get_origin(annotation) in (Union, types.UnionType, list, dict, tuple):
        for argument in get_args(annotation):
            yield from models_in(argument)
    elif isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
