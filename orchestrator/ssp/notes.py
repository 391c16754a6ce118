"""Where masters look for the communication step of a package: each has an annotation of its own.

SSP knows a start and an end, and no step: without these a tool takes its own, or refuses the
package (OMSimulator).
"""

from xml.etree.ElementTree import Element, SubElement

# Namespaces by prefix.  libcosim takes an attribute of osp:Algorithm for another algorithm, and OMSimulator goes
# by prefixes: they are declared at the root.
NAMESPACES = {
    "osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
    "oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
    "mc": "com.avl.model.connect.ssp.task",
}


def note_in_system(system: Element, step: float) -> None:
    """OMSimulator's, which belongs to the system: it takes the first annotation there."""
    note = SubElement(annotation(system, "org.openmodelica"), "oms:Annotations")
    information = SubElement(note, "oms:SimulationInformation")
    # "oms-ma" exchanges at the beginning of a step and steps all units by it.
    SubElement(information, "oms:FixedStepMaster", description="oms-ma", stepSize=repr(step), relativeTolerance="1e-4")


def note_in_experiment(experiment: Element, step: float, scheme: str) -> None:
    """This project's own, libcosim's and OpenMCx's."""
    SubElement(annotation(experiment, "rvwear.master"), "Master", step=repr(step), scheme=scheme)
    algorithm = SubElement(annotation(experiment, "com.opensimulationplatform"), "osp:Algorithm")
    SubElement(algorithm, "osp:FixedStepAlgorithm", baseStepSize=repr(step))
    order = "sequential" if scheme == "gauss-seidel" else "parallel_single_thread"
    SubElement(annotation(experiment, NAMESPACES["mc"]), "mc:Task", stepType=order, deltaTime=repr(step), endType="end_time")


def annotation(parent: Element, kind: str) -> Element:
    found = parent.find("ssd:Annotations")
    return SubElement(SubElement(parent, "ssd:Annotations") if found is None else found, "ssc:Annotation", type=kind)
