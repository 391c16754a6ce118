"""The page docs/variables.md, from the units' tables.

    python -m reducers.documentation > docs/variables.md
"""

from fmu_src.display import display_unit
from fmu_src.variables import SEEN, Variable
from reducers.reducer import load_reducer

HEAD = """# Variables of the units

Each stands beside the kernels that need it; `rv_plant/variables.py`, `wear_fmu/variables.py` and `rv_reducer/variables.py`
gather them. With the numbers of RV20E-121: `python -m reducers.documentation > docs/variables.md`. Arrays are scalars named `mesh.force[1,7]` in FMI 2.0,
counted from 1; a scalar given for an array fills it. Tools show a value in the unit of the column "shown in", which stands in the
description as its displayUnit; it is exchanged in its own. Of a choice files and settings take the word, importers the number before it.
Locals may be looked at and recorded; nothing is connected to them.

The last column is what kernels call a variable, what result files (NetCDF) call what they keep of it, and what `component.get` and `set` take in
Python. Up to version 0.2 files and tools had these names too; in files and settings they go on working through version 0.3, with a
warning that says the new one.
"""

JOINT = """## RvReducer.fmu

Plant and wear in one unit. It has the variables of both under the same names, but for what the two
exchange and what belongs to a single contact; arrays and what goes between the two are local. Besides it has these:

"""


def markdown(variables: list[Variable]) -> str:
    """The table of those that a tool with arrays sees."""
    rows = ["| variable | causality | unit | shown in | start | meaning | source | in kernels and results |", "|---|---|---|---|---|---|---|---|"]
    for v in variables:
        if v.role not in SEEN and not v.profile:
            continue
        shape = f"[{', '.join(f'{a} 1..{n}' for a, n in v.seen_axes)}]" if v.shape else ""
        start = v.choices[int(v.start)] if v.choices else f"{v.start:.6g}"
        text = v.description + (f" ({v.numbered_choices})" if v.choices else "")
        cells = (f"`{v.path}`{shape}", "local" if v.profile else v.role, v.unit, display_unit(v), start, text, v.source, f"`{v.name}`")
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows) + "\n"


def page() -> str:
    """The whole page."""
    reducer = load_reducer("RV20E-121")
    parts = [HEAD]
    for table in (reducer.plant, reducer.wear):
        parts.append(f"## {table.name}.fmu\n\n{table.description}.\n\n{markdown(table.variables)}")
    own = [v for v in reducer.joint.variables if v.name not in {**reducer.plant.by_name, **reducer.wear.by_name}]
    parts.append(JOINT + markdown(own))
    return "\n".join(parts)


if __name__ == "__main__":
    print(page(), end="")
