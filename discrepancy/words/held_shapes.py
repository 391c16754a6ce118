"""Numbers of an effect that no fit changes, which is to be said wherever its amplitudes are told."""

from discrepancy.model_file import ModelFile, every_effect
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.scales import of_variable
from discrepancy.words.as_told import effect_name


def held_text(effect: str, model: object) -> str:
    """Shapes of an effect that a diagnosis holds, with the values that they have in a model, or a model file; empty if there are none."""
    file = model.file if isinstance(model, PhysicalModel) else model
    known, values = every_effect().get(effect), file.values() if isinstance(file, ModelFile) else {}
    found = []
    for p in known.parameters if known else ():
        if p.is_held:
            value = values.get(p.variable.name, float(p.variable.start))
            # A number that chooses says nothing by itself.
            meaning = f" ({p.variable.description})" if p.variable.description.startswith("0:") else ""
            found.append(f"{effect_name(effect, p.variable.name)} = {of_variable(p.variable, abs(value)).text(value, 4)}{meaning}")
    return f"held, not fitted: {', '.join(found)}" if found else ""
