"""What a person finds inside an FMU: documentation, diagram, icon and licence."""

import re
from html import escape

from fmu_src.display import display_unit
from fmu_src.icons import drawing, picture, terminal_drawing, terminal_picture
from fmu_src.link import FMI_HEADERS
from fmu_src.project import Project
from fmu_src.table import Table
from fmu_src.terminals import terminals_file
from fmu_src.variables import Variable

STYLE = """body{font:15px/1.45 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#223}
table{border-collapse:collapse;width:100%}th,td{text-align:left;vertical-align:top;padding:3px 8px;border-bottom:1px solid #ccd}
code{font-size:14px}svg text{font:13px sans-serif}h2{margin-top:1.6em}"""


def files_for_people(table: Table, fmi: str, identity: str, made_by: Project) -> dict[str, bytes]:
    """The files of one FMU by their path in the archive, where its FMI version wants them."""
    files = {
        "documentation/index.html": page(table, identity, made_by).encode(),
        "documentation/diagram.svg": diagram(table).encode(),
        "documentation/diagram.png": picture(512),
        "documentation/licenses/license.txt": licence(table, made_by).encode(),
    }
    # Of FMI 3.0; importers of FMI 2.0 that do not know the folder leave it alone.
    place, arrays = "terminalsAndIcons", fmi != "2.0"
    files |= {
        f"{place}/icon.png": picture(128), f"{place}/icon.svg": drawing(),
        f"{place}/terminalsAndIcons.xml": terminals_file(table.terminals, lambda name: names_in(table, name, arrays)),
    }  # fmt: skip
    for icon in sorted({t.icon for t in table.terminals}):
        files |= {f"{place}/{icon}.png": terminal_picture(icon, 64), f"{place}/{icon}.svg": terminal_drawing(icon)}
    return files if arrays else files | {"model.png": picture(128)}


def names_in(table: Table, name: str, arrays: bool) -> list[str]:
    """What a description calls a variable: an array by one name, or each element by its own."""
    return [name] if arrays else list(table.by_path[name].element_names())


def page(table: Table, identity: str, made_by: Project) -> str:
    """documentation/index.html: what the unit is, how it connects, every variable."""
    sections = {"Inputs": "input", "Outputs": "output", "Parameters": "parameter", "Diagnostics": "local"}
    parts = [
        f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>{escape(table.name)}</title><style>{STYLE}</style>",
        f"<h1>{escape(table.name)}</h1><p>{escape(table.description)}.</p>{diagram(table)}",
        "<p>Steps may vary in size. The state can be saved, restored and serialised whole. Within a communication point"
        " no output depends on an input. A value out of its bounds, an impossible call or step is refused with a message,"
        " and the state stays what it was.</p>",
        f"<p>Identity {escape(identity)}. Version {escape(made_by.version)}, {escape(made_by.author)};"
        f" licence {escape(made_by.licence)} (<a href=licenses/license.txt>text</a>).</p>",
    ]
    for title, role in sections.items():
        parts += [f"<h2>{title}</h2>", variable_table(table.of_role(role))]
    profiles = [v for v in table.variables if v.profile]
    if profiles:
        parts += ["<h2>Surfaces</h2><p>Local arrays in FMI 3.0.</p>", variable_table(profiles)]
    return "\n".join(parts) + "\n"


def variable_table(variables: list[Variable]) -> str:
    rows = ["<tr><th>variable<th>unit<th>shown in<th>start<th>bounds<th>meaning<th>source"]
    for v in variables:
        shape = f"[{', '.join(f'{a} 1..{n}' for a, n in v.seen_axes)}]" if v.shape else ""
        start = v.choices[int(v.start)] if v.choices else f"{v.start:.6g}"
        bounds = v.numbered_choices if v.choices else f"{v.minimum:.4g} to {v.maximum:.4g}"
        cells = (v.unit, display_unit(v), start, bounds, v.description, v.source)
        rows.append(f"<tr><td><code>{escape(v.path)}</code>{escape(shape)}" + "".join(f"<td>{escape(c)}" for c in cells))
    return "<table>" + "\n".join(rows) + "</table>"


def diagram(table: Table) -> str:
    """The unit as a box with its inputs on the left and its outputs on the right."""
    sides = (table.of_role("input"), table.of_role("output"))
    height = 22 * max(len(side) for side in sides) + 60
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 {height}" width="760" height="{height}">',
        f'<rect x="280" y="10" width="200" height="{height - 20}" rx="8" fill="#eef3f8" stroke="#456"/>',
        f'<text x="380" y="36" text-anchor="middle" font-weight="bold">{escape(table.name)}</text>',
    ]
    for side, (end, start, anchor, label) in zip(sides, ((280, 240, "end", 232), (520, 480, "start", 528))):
        for i, v in enumerate(side):
            y = 62 + 22 * i
            shape = f"[{' x '.join(map(str, v.shape))}]" if v.shape else ""
            unit = f", {v.unit}" if v.unit != "1" else ""
            parts.append(f'<path d="M{start} {y}H{end}m-7 -4l7 4l-7 4" fill="none" stroke="#456"/>')
            parts.append(f'<text x="{label}" y="{y + 4}" text-anchor="{anchor}">{escape(v.path + shape + unit)}</text>')
    return "".join(parts) + "</svg>"


def licence(table: Table, made_by: Project) -> str:
    """Whose the parts are; the FMI headers ask for their notice in binaries."""
    header = (FMI_HEADERS / "fmi3Functions.h").read_text(encoding="utf-8")
    notice = re.search(r"Copyright \(C\).*?POSSIBILITY OF SUCH DAMAGE\.", header, re.DOTALL)
    assert notice is not None, "FMI's headers carry no copyright notice any more"
    return (
        f"{table.name}, made with rvwear. {made_by.terms()}\n"
        f"It contains the headers of the FMI standard:\n\n{notice.group()}\n"
    )
