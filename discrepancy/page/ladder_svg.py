"""The ladder as a standalone SVG, for a README: the misfit in the patterns falling step by step."""

import math
from collections.abc import Sequence
from pathlib import Path
from xml.sax.saxutils import escape

from discrepancy.ladder_step import Change, Step, steps_of
from discrepancy.model_file import ModelFile
from discrepancy.page.ladder import KINDS, WIDE, attempts, stairs
from discrepancy.words.sample_errors import PATTERNS
from fmu_src.checked_file import write_text
from pages.look import FONT, GRID, INK, QUIET

LEFT, RIGHT, TOP, BOTTOM, STEP, HEIGHT = 64.0, 40.0, 62.0, 74.0, 190.0, 250.0
# The names of fonts stand inside an attribute.
QUOTES = {'"': "'"}
HELPED, POOR = "#00705a", "#b3401b"
TICKS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)


def ladder_picture(file: ModelFile, path: Path) -> Path:
    """Write the picture; equal ladders give equal bytes."""
    path = Path(path)
    write_text(path, svg(file.name, steps_of(file.steps)))
    return path


class Scale:
    """From step and error to the sheet."""

    def __init__(self, values: Sequence[float], count: int):
        values = [v for v in values if v > 0.0] or [1.0]
        low, high = min([*values, 0.9]), max([*values, 1.2])
        self.wide = high / low > WIDE
        self.count = count
        self.low, self.high = (math.log10(0.8 * low), math.log10(1.25 * high)) if self.wide else (0.0, 1.12 * high)

    def x(self, place: float) -> float:
        return LEFT + STEP * (place - 0.4)

    def y(self, value: float) -> float:
        level = math.log10(max(value, 1e-9)) if self.wide else value
        part = (level - self.low) / (self.high - self.low)
        return TOP + HEIGHT * (1.0 - min(max(part, 0.0), 1.0))

    def ticks(self) -> list[float]:
        if self.wide:
            return [t for t in TICKS if self.low <= math.log10(t) <= self.high]
        step = next((s for s in (0.2, 0.5, 1.0, 2.0, 5.0) if self.high / s <= 7), 10.0)
        return [k * step for k in range(int(self.high / step) + 1)]


def svg(name: str, steps: Sequence[Step]) -> str:
    drawn = {kind: stairs(steps, kind) for kind, *_ in KINDS}
    lost = {kind: attempts(steps, kind) for kind, *_ in KINDS}
    values = [v for _, ys in drawn.values() for v in ys if v is not None] + [change.after for rows in lost.values() for _, change, _ in rows]
    scale = Scale(values, len(steps))
    right = scale.x(max(len(steps), 1) + 0.6)
    width, height = right + RIGHT, TOP + HEIGHT + BOTTOM
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" height="{height:.0f}"'
        f' role="img" font-family="{escape(FONT, QUOTES)}" font-size="13">',
        f"<title>{escape(name)}: {PATTERNS}, step by step</title>",
        f'<rect width="{width:.0f}" height="{height:.0f}" rx="6" fill="#ffffff"/>',
        text(LEFT, 24, f"{name}: {PATTERNS}, over noise", INK, weight=600),
    ]
    if not steps:
        parts.append(text(LEFT, TOP + 20, "no steps yet", QUIET))
    for tick in scale.ticks():
        y = scale.y(tick)
        parts += [line(LEFT, y, right, y, GRID), text(LEFT - 8, y + 4, f"{tick:g}", QUIET, "end")]
    parts += [line(LEFT, scale.y(1.0), right, scale.y(1.0), QUIET, 1.4, "3 4"), text(right + 4, scale.y(1.0) + 4, "noise", QUIET)]
    place = LEFT
    for kind, title, colour, thick in KINDS:
        if any(v is not None for v in drawn[kind][1]):
            parts += [line(place, 42, place + 24, 42, colour, thick), text(place + 30, 46, title, QUIET)]
            place += 130.0
    for kind, _, colour, thick in KINDS:
        parts += staircase(*drawn[kind], scale, colour, thick)
        parts += [mark for row in lost[kind] for mark in failed(row, scale, colour, kind == "held_out")]
    for k, step in enumerate(steps, start=1):
        parts += caption(k, step, scale)
    return "\n".join([*parts, "</svg>", ""])


def staircase(xs: Sequence[float | None], ys: Sequence[float | None], scale: Scale, colour: str, thick: float) -> list[str]:
    """Polylines, broken where a step was not judged."""
    found: list[str] = []
    run: list[str] = []
    for x, y in [*zip(xs, ys), (None, None)]:
        if x is not None and y is not None:
            run.append(f"{scale.x(x):.1f},{scale.y(y):.1f}")
        elif run:
            found.append(
                f'<polyline points="{" ".join(run)}" fill="none" stroke="{colour}" stroke-width="{thick:g}" stroke-linejoin="round"/>'
            )
            run = []
    return found


def failed(row: tuple[int, Change, Step], scale: Scale, colour: str, labelled: bool) -> list[str]:
    """A dotted way to a cross."""
    k, change, _ = row
    before, after = change.before, change.after
    x, y = scale.x(k), scale.y(after)
    found = [
        line(x, scale.y(before), x, y, colour, 1.2, "2 3"),
        line(x - 4, y - 4, x + 4, y + 4, colour, 1.8),
        line(x - 4, y + 4, x + 4, y - 4, colour, 1.8),
    ]
    return found + ([text(x + 9, y + (-6 if after > before else 15), f"{after:.2f}", colour)] if labelled else [])


def caption(k: int, step: Step, scale: Scale) -> list[str]:
    """Effect and verdict below, numbers at the corners of the unused runs."""
    x, base, kept = scale.x(k), TOP + HEIGHT, step.kept
    verdict = step.verdict + ("" if kept else ", not kept")
    found = [text(x, base + 24 + 16 * i, part, INK, "middle") for i, part in enumerate(wrapped(step.label))]
    found.append(
        text(
            x,
            base + 60,
            verdict,
            HELPED if step.verdict == "helped" else POOR if step.verdict == "did not help" else QUIET,
            "middle",
            style="italic",
        )
    )
    change, colour = (step.held_out, KINDS[1][2]) if step.held_out else (step.training, QUIET)
    if change is None:
        return found
    if k == 1:
        found.append(text(scale.x(0.5), scale.y(change.before) - 8, f"{change.before:.2f}", colour, weight=600))
    if kept:
        found += [
            f'<circle cx="{x:.1f}" cy="{scale.y(change.after):.1f}" r="4.5" fill="{colour}"/>',
            text(x + 9, scale.y(change.after) - 8, f"{change.after:.2f}", colour, weight=600),
        ]
    return found


def wrapped(words: str, most: int = 26) -> list[str]:
    """At most two lines."""
    if len(words) <= most:
        return [words]
    cut = words.rfind(" ", 0, most + 1)
    cut = cut if cut > 0 else most
    rest = words[cut:].strip()
    return [words[:cut], rest if len(rest) <= most else rest[: most - 1] + "…"]


def line(x0: float, y0: float, x1: float, y1: float, colour: str, width: float = 1.0, dash: str = "") -> str:
    more = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{colour}" stroke-width="{width:g}"{more}/>'


def text(x: float, y: float, words: str, colour: str, anchor: str = "start", weight: int = 400, style: str = "normal") -> str:
    place = f'x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"'
    # The white rim keeps words readable on lines.
    rim = 'stroke="#ffffff" stroke-width="3" paint-order="stroke"'
    return f'<text {place} fill="{colour}" font-weight="{weight}" font-style="{style}" {rim}>{escape(words)}</text>'
