"""A reducer by whatever names one."""

from dataclasses import replace
from pathlib import Path

from reducers.reducer import Reducer, is_model_file, load_reducer


def named_reducer(name: str | Path) -> Reducer:
    """A reducer of the library, of a reducer file, or of a model file with all that it adds, called after both."""
    if not is_model_file(Path(name)):
        return load_reducer(name)
    # Here: what reads models takes its time to load.
    from discrepancy.model_file import extended_reducer, load_model

    model = load_model(name)
    return replace(extended_reducer(model), name=model.label)
