"""The packages against the schemas of the SSP standard, which fmpy has of 1.0 only."""

import re
import zipfile
from pathlib import Path

from lxml import etree

from benchmarks.importers.cases import Bench, Outcome
from fmu_src.faults import InputFault
from fmu_src.references import FOLDER

DESCRIPTION, VALUES = "SystemStructureDescription.xsd", "SystemStructureParameterValues.xsd"


def outcomes(bench: Bench, folder: Path) -> list[Outcome]:
    """System and parameter files of the packages, and the parameter files that RvReducer carries."""
    for name in (DESCRIPTION, VALUES):
        if not (folder / name).is_file():
            raise InputFault(f"--schemas {folder}: there is no {name}; give the folder schema of modelica/ssp-standard")
    known = {name: etree.XMLSchema(etree.parse(str(folder / name))) for name in (DESCRIPTION, VALUES)}
    match = re.search(r"Version: (\S+)", (folder / DESCRIPTION).read_text(encoding="utf-8"))
    found = []
    for version, inline in (("2", False), ("2", True), ("3", False)):
        packages = [bench.package(version, inline), bench.fmu(version, "RvReducer")]
        problems, count = [], 0
        for path in packages:
            with zipfile.ZipFile(path) as archive:
                names = [n for n in archive.namelist() if n.endswith(".ssd") or (n.endswith(".ssv") and (n.startswith(("resources/", FOLDER))))]
                for name in names:
                    schema = known[DESCRIPTION if name.endswith(".ssd") else VALUES]
                    count += 1
                    if not schema.validate(etree.fromstring(archive.read(name))):
                        problems.append(f"{name}: {schema.error_log}")
        what = "package with values inline" if inline else "package and carried values"
        found.append(Outcome("schemas of SSP", match[1] if match else "", f"FMI {version}.0", what, count, said=problems[0] if problems else "valid"))
    return found
