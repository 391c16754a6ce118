"""A reducer by whatever names one."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from reducers.reducer import Reducer, is_model_file, load_reducer

if TYPE_CHECKING:
    from discrepancy.model_file import ModelFile


def named_reducer(name: str | Path) -> Reducer:
    """A reducer of the library, of a reducer file, or of a model file."""
    if not is_model_file(Path(name)):
        return load_reducer(name)
    # Here: what reads models takes its time to load.
    from discrepancy.model_file import load_model

    return reducer_of_model(load_model(name))


def reducer_of_model(model: "ModelFile") -> Reducer:
    """The reducer with all that the model adds, called after both."""
    from discrepancy.model_file import extended_reducer

    return replace(extended_reducer(model), name=model.label, called=model.heading)
