"""The page docs/variables.md, from the units' tables.

    python -m reducers.documentation > docs/variables.md
"""

from fmu_src.variables import Table
from reducers.reducer import load_reducer

HEAD = """# Variables of the units

Each stands beside the kernels that need it; `rv_plant/variables.py`, `wear_fmu/variables.py` and `rv_reducer/variables.py`
gather them. With the numbers of RV20E-121: `python -m reducers.documentation > docs/variables.md`. Arrays are scalars named `mesh_force[1,7]` in FMI 2.0,
counted from 1; a scalar given for an array fills it.
"""

JOINT = """## RvReducer.fmu

Plant and wear in one unit. It has the inputs, parameters and outputs of both under the same names, but for what the two
exchange and what belongs to a single contact, and these:

"""


def page() -> str:
    """The whole page."""
    reducer = load_reducer("RV20E-121")
    parts = [HEAD]
    for table in (reducer.plant, reducer.wear):
        parts.append(f"## {table.name}.fmu\n\n{table.description}.\n\n{table.markdown()}")
    own = [v for v in reducer.joint.variables if v.name not in {**reducer.plant.by_name, **reducer.wear.by_name}]
    parts.append(JOINT + Table("", "", own).markdown())
    return "\n".join(parts)


if __name__ == "__main__":
    print(page(), end="")
