"""Draw architecture.svg: folders as boxes in their layers, arrows from the imports that the code makes.

    python -m docs.make_architecture
"""

import re
from textwrap import wrap
from xml.sax.saxutils import escape

from docs.imports import ROOT, TABLE, arrows

PICTURE = ROOT / "docs" / "architecture.svg"
# Of what counts as source, by its ending.
KINDS = (".py", ".c", ".h", ".toml", ".html", ".css", ".js")
WIDTH, EDGE, BETWEEN, GAP = 1040, 20, 24, 40
LINE, TOP, BOTTOM = 17, 24, 10
# Pixels per letter of the small type, on average.
LETTER = 6.3
# Left edge, upper edge, width, height.
Box = tuple[float, float, float, float]
STYLE = (
    "text { font: 12px system-ui, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif; fill: #1d2733 } "
    ".name { font-size: 15px; font-weight: 650 } .quiet { fill: #5d6975 } .parts { fill: #0b4f94 } "
    "rect { fill: #f6f8fa; stroke: #b9c4cf } path { stroke: #0b4f94; stroke-width: 1.6; fill: none; marker-end: url(#head) }"
)


def folders() -> list[str]:
    """The folders of the house, from the roof down."""
    return [name for name, entry in TABLE.items() if "row" in entry]


def lines_of() -> dict[str, int]:
    """Lines of source by folder of the house, and by what of it is shown by name."""
    found = {}
    for folder in folders():
        for place in [folder, *parts_of(folder)]:
            files = [p for p in (ROOT / place).rglob("*") if p.suffix in KINDS and "__pycache__" not in p.parts]
            found[place] = sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files)
    return found


def parts_of(folder: str) -> list[str]:
    """Folders within a folder that hold sources, by name."""
    inside = (path for path in (ROOT / folder).iterdir() if path.is_dir() and any(p.suffix in KINDS for p in path.iterdir()))
    return sorted(path.relative_to(ROOT).as_posix() for path in inside)


def used() -> set[tuple[str, str]]:
    """Pairs of folders of the house, the first of which imports from the second."""
    house = set(folders())
    tops = {
        (source.partition("/")[0], target.partition("/")[0]) for source, targets in arrows().items() for target, _ in targets
    }  # fmt: skip
    return {(a, b) for a, b in tops if a != b and a in house and b in house}


def drawn(pairs: set[tuple[str, str]]) -> list[tuple[str, str]]:
    """Arrows that no way over other folders stands for: the others would cover the picture."""
    def reaches(start: str, end: str) -> bool:
        return any(b == end or reaches(b, end) for a, b in pairs if a == start)

    return sorted((a, b) for a, b in pairs if not any(m != b and reaches(m, b) for x, m in pairs if x == a))


def texts(folder: str, lines: dict[str, int], uses: set[tuple[str, str]], width: float) -> list[tuple[str, str]]:
    """(class, text) of a box's lines below its name."""
    letters = int((width - 2 * 12) / LETTER)
    parts = " · ".join(f"{place.rpartition('/')[2]}\N{NO-BREAK SPACE}{about(lines[place])}" for place in parts_of(folder))
    below = ", ".join(other for other in folders() if (folder, other) in uses)
    rows = [("", row) for row in wrap(TABLE[folder]["says"], letters)]
    rows += [("parts", row) for row in wrap(parts, letters)]
    return rows + [("quiet", row) for row in wrap(f"imports from {below}" if below else "imports nothing of the house", letters)]


def about(lines: int) -> str:
    """Two digits: more would change with every commit."""
    digits = max(0, len(str(lines)) - 2)
    return f"{round(lines, -digits):,}"


def picture(lines: dict[str, int]) -> str:
    """The whole picture; equal folders and imports give equal bytes."""
    uses = used()
    rows: dict[int, list[str]] = {}
    for name in folders():
        rows.setdefault(TABLE[name]["row"], []).append(name)
    boxes: dict[str, Box] = {}
    below, y = [], EDGE
    for _, names in sorted(rows.items()):
        width = (WIDTH - 2 * EDGE - (len(names) - 1) * BETWEEN) / len(names)
        said = {name: texts(name, lines, uses, width) for name in names}
        height = TOP + LINE * max(map(len, said.values())) + BOTTOM
        for i, name in enumerate(names):
            x = EDGE + i * (width + BETWEEN)
            boxes[name] = (x, y, width, height)
            below.append(f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="6"/>')
            below.append(f'<text class="name" x="{x + 12:g}" y="{y + 20:g}">{name}/</text>')
            count = f"{about(lines[name])} lines"
            below.append(f'<text class="quiet" x="{x + width - 12:g}" y="{y + 20:g}" text-anchor="end">{count}</text>')
            for k, (kind, text) in enumerate(said[name]):
                at = f'x="{x + 12:g}" y="{y + TOP + 13 + k * LINE:g}"'
                below.append(f'<text class="{kind}" {at}>{escape(text)}</text>' if kind else f"<text {at}>{escape(text)}</text>")
        y += height + GAP
    lines_kept = " ".join(f"{name}={count}" for name, count in sorted(lines.items()))
    head = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y - GAP + EDGE:g}" role="img"'
        ' aria-label="Folders in layers; arrows from the imports that the code makes">',
        "<!-- Made by: python -m docs.make_architecture -->",
        f"<!-- lines: {lines_kept} -->",
        f"<style>{STYLE}</style>",
        '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<polygon points="0,0 8,4 0,8" fill="#0b4f94"/></marker></defs>',
        f'<rect width="{WIDTH}" height="{y - GAP + EDGE:g}" style="fill: #ffffff; stroke: none"/>',
    ]
    return "\n".join([*head, *(arrow(boxes[a], boxes[b]) for a, b in drawn(uses)), *below, "</svg>"]) + "\n"


def arrow(above: Box, under: Box) -> str:
    """From the middle of what two boxes have in common sideways, or from middle to middle."""
    left, right = max(above[0], under[0]), min(above[0] + above[2], under[0] + under[2])
    from_x = to_x = 0.5 * (left + right)
    if left > right:
        from_x, to_x = (box[0] + 0.5 * box[2] for box in (above, under))
    return f'<path d="M{from_x:g},{above[1] + above[3]:g} L{to_x:g},{under[1]:g}"/>'


def shown_lines(text: str) -> dict[str, int]:
    """The counts of lines that a picture was made with."""
    kept = re.search(r"<!-- lines: (.*) -->", text)
    assert kept is not None, "a picture that was not made here"
    return {name: int(count) for name, _, count in (entry.rpartition("=") for entry in kept[1].split())}


if __name__ == "__main__":
    PICTURE.write_text(picture(lines_of()), encoding="utf-8")
    print(PICTURE)
