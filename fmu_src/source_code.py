"""The folder ``sources/`` of a unit: C99 that a compiler alone turns into it, kernels included.

Everything goes through one file, ``all.c``, in which all but FMI's functions is static:
units compiled so can be linked into one program.
"""

from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from fmu_src.compiler import loading
from fmu_src.compiler.types import Layout
from fmu_src.link import FMI_HEADERS, SHELL
from fmu_src.native import NativeFault
from fmu_src.unit import Unit
from fmu_src.unit_table import c_source

HEADERS = {
    "2": ("fmi2TypesPlatform.h", "fmi2FunctionTypes.h", "fmi2Functions.h"),
    "3": ("fmi3PlatformTypes.h", "fmi3FunctionTypes.h", "fmi3Functions.h"),
}
ALL = """/* {name}: this file includes all others and is the only one to compile, with C99 and without any other file:
 *
 *     cc -std=c99 -O2 -fPIC -shared all.c -o {name}.so -lm
 *
 * -std=c99 rounds every operation as written; where a compiler contracts a*b+c by itself, say -ffp-contract=off, and never
 * -ffast-math.  For several units in one program define FMI{version}_FUNCTION_PREFIX as {name}_.
 *
 * Memory is taken (calloc, malloc) when an instance is made and when the importer asks for a copy of the state, and at no
 * other time; there is no recursion, no setjmp, no file, no clock and no thread.  Of the C library are needed
 *     stdlib.h  calloc malloc free        string.h  memcpy memset memcmp strcmp strcpy strlen strncpy
 *     stdio.h   snprintf vsnprintf, for messages alone
 *     math.h    {functions}
 * The FMI headers beside are the standard's own, under the licence that stands in them (2-clause BSD).
 */
#define UNIT_IN_ONE_FILE

{includes}
"""


def kernels_source(unit: Unit) -> str:
    """The kernels of a unit as C99."""
    if unit.kernels is None:
        raise NativeFault("kernels run as plain Python here and are not compiled; unset RVWEAR_PLAIN_PYTHON")
    return loading.unit_source(*unit.kernels, Layout(unit.table.dtype))


def source_files(unit: Unit, kernels: str, identity: str, version: str) -> dict[str, bytes]:
    """The files of ``sources/`` for an FMI version, by their path in the archive; ``kernels`` as from ``kernels_source``."""
    other = {"2": "fmi3", "3": "fmi2"}[version]
    files = {path.name: path.read_bytes() for path in sorted(SHELL.iterdir()) if path.suffix in (".c", ".h") and not path.name.startswith(other)}
    # What is refused comes last: it does without its parameters and says so to the compiler for all that follows.
    order = ["unit_table.c", "unit_kernels.c", *sorted(name for name in files if name.endswith(".c") and "absent" not in name), f"fmi{version}_absent.c"]
    files |= {name: (FMI_HEADERS / name).read_bytes() for name in HEADERS[version]}
    files["unit_table.c"] = c_source(unit, identity).encode()
    files["unit_kernels.c"] = kernels.encode()
    used = sorted(name for name in loading.LIBM if f" {name}(" in kernels or f"({name}(" in kernels or f"-{name}(" in kernels)
    files["all.c"] = ALL.format(
        name=unit.table.name, version=version, functions=" ".join(used), includes="\n".join(f'#include "{name}"' for name in order)
    ).encode()
    if version == "3":
        files["buildDescription.xml"] = build_description(unit.table.name)
    return {f"sources/{name}": content for name, content in files.items()}


def build_description(name: str) -> bytes:
    """What FMI 3.0 wants to know: which file in which language, and that it needs the mathematics library."""
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=name, description="any platform with a C99 compiler")
    files = SubElement(configuration, "SourceFileSet", language="C99", compilerOptions="-O2 -ffp-contract=off")
    SubElement(files, "SourceFile", name="all.c")
    SubElement(configuration, "Library", name="m", external="true", description="the C library's mathematics, where it is one of its own")
    ElementTree.indent(root)
    return bytes(ElementTree.tostring(root, "utf-8", xml_declaration=True))


def declare_sources(description: Element) -> None:
    """FMI 2.0 lists them in the model description."""
    unit = description.find("CoSimulation")
    assert unit is not None
    SubElement(SubElement(unit, "SourceFiles"), "File", name="all.c")
