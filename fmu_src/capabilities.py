"""What native units can do beyond the editable ones, as their model descriptions declare it.

docs/capabilities.md says of every flag with what it was tested; a test holds the page against the units.
"""

from xml.etree.ElementTree import Element

from fmu_src.unit import Unit


def declare(description: Element, version: str, unit: Unit) -> None:
    """Set the flags of FMI ``version`` ("2" or "3") in a model description."""
    flags = {"2": ["providesDirectionalDerivative"], "3": ["providesDirectionalDerivatives"]}[version]
    if version == "3" and unit.pause is not None:
        flags += ["providesIntermediateUpdate", "mightReturnEarlyFromDoStep", "canReturnEarlyAfterIntermediateUpdate"]
    element = description.find("CoSimulation")
    assert element is not None
    element.attrib.update(dict.fromkeys(flags, "true"))
