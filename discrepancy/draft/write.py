"""The draft as a file: docstring with equation, range and source, the effect's parameters, its kernel."""

import textwrap
from collections.abc import Iterable

from discrepancy.draft.expression import NOUGHT, ONE, WIDE, Expression, Shape, Term
from discrepancy.draft.places import WEAR, Place
from discrepancy.inference.law.recover import Recovered

WIDTH = 118
INDENT = "    "
MOST_FORMS = 4


def text_of(name: str, law: Recovered, place: Place, expression: Expression, campaign: str, model: str) -> str:
    """The file of the effect ``name``: the law put at its place, off at amplitudes 0."""
    source = f"recovered from campaign {campaign!r}"
    parts = [
        f'"""{docstring(law, place, expression, source, model)}"""', imports(place, expression), effect(name, law, place, expression, source),
        *([kernel("prepare(r)", prepare(name, expression))] if place.package == WEAR else []),
        kernel(place.hook, body(name, place, expression)),
    ]  # fmt: skip
    head, *rest = parts
    return head + "\n\n" + "\n\n\n".join([rest[0] + "\n\n" + rest[1], *rest[2:]]) + "\n"


def equation(place: Place, expression: Expression) -> str:
    law = expression.law()
    # What stands before the law multiplies all of it.
    return place.law + (law if place.law.endswith("= ") or len(expression.terms) == 1 else f"({law})")


def over(place: Place, expression: Expression) -> str:
    """What u is."""
    axis, zero = place.axis, expression.zero * place.axis.per
    x = f"({axis.symbol} - {zero:.6g})" if zero else axis.symbol
    return f"u = {x}/{scale(place, expression)} {axis.unit}, {axis.symbol} the {axis.text}"


def scale(place: Place, expression: Expression) -> str:
    return f"{expression.scale * place.axis.per:.6g}"


def docstring(law: Recovered, place: Place, expression: Expression, source: str, model: str) -> str:
    """Title, equation, range, source: nothing is claimed that was not seen."""
    quantity, low, high = law.signal.partition("[")[0].replace("_", " "), min(law.points["x"]), max(law.points["x"])
    factor, offset, unit = law.x_told
    ends = sorted(factor * v + offset for v in (low, high))
    form = expression.form
    others = ", ".join(f"{f.name} {f.confidence:.2f}" for f in law.forms[:MOST_FORMS] if f is not form)
    what = [
        wrapped(f"Draft: {place.text}."),
        f"{INDENT}{equation(place, expression)}",
        wrapped(f"with {over(place, expression)}."),
        wrapped(
            f"Recovered from what {model} leaves of the {quantity}: {law.text}.  Confidence of the form taken ({form.name}) among closed forms"
            f" {form.confidence:.2f}{f'; of others: {others}' if others else ''}."
        ),
        wrapped(
            f"Range: {law.leading.replace('_', ' ')} {ends[0]:.4g} to {ends[1]:.4g} {unit}, as measured; nothing is known beyond.  There is no"
            " physics behind it yet: bounds are assumed, wide about what was recovered."
        ),
        f"Source: {source}.",
    ]
    return escaped("\n\n".join(what) + "\n")


def escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"""', "'''")


def wrapped(text: str) -> str:
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False)


def imports(place: Place, expression: Expression) -> str:
    codes = " ".join(t.code + t.slope for t in expression.terms)
    lines = ["import math\n"] if "math." in codes else []
    lines.append(f"from fmu_src.effect import Effect, amplitude{', shape' if expression.shapes else ''}")
    lines.append("from fmu_src.kernel import kernel")
    lines += [f"from {module} import {', '.join(names)}" for module, names in (place.imports or {}).items()]
    return "\n".join(lines)


def effect(name: str, law: Recovered, place: Place, expression: Expression, source: str) -> str:
    """``EFFECT`` with amplitudes in the law's unit and shapes that have none."""
    quantity = law.signal.partition("[")[0].replace("_", " ")
    signature = f"{quantity} over {law.leading.replace('_', ' ')}, as it was recovered"
    parameters = [amplitude(name, t, place) for t in expression.terms] + [shape(name, s) for s in expression.shapes]
    return "\n".join([
        "EFFECT = Effect(",
        f"{INDENT}0, {quoted(f'draft: {quantity} over {law.leading}')},",
        f"{INDENT}{quoted(equation(place, expression) + ', ' + over(place, expression).partition(',')[0])},",
        f"{INDENT}{quoted(source)},",
        f"{INDENT}{quoted(signature)},",
        f"{INDENT}(", *(f"{INDENT}{INDENT}{line}" for line in parameters), f"{INDENT}),",
        f"{INDENT}signals=({', '.join(map(quoted, place.signals))}{',' * (len(place.signals) == 1)}),", ")",
    ])  # fmt: skip


def amplitude(name: str, term: Term, place: Place) -> str:
    """Free to either side, but for what cannot be negative."""
    bound = number(WIDE * term.scale)
    only = place.lost and place.sign * term.size > 0.0
    ends = f"0.0, {bound}, sign=1" if only else f"-{bound}, {bound}"
    text = f"{term.letter}: {term.text}"
    return f"amplitude({quoted(f'{name}_{term.suffix}')}, {quoted(place.unit)}, {quoted(text)}, {number(term.scale)}, {ends}),"


def shape(name: str, s: Shape) -> str:
    grid = ", ".join(map(number, s.grid)) + ("," if len(s.grid) == 1 else "")
    numbers = f"{number(s.value)}, {number(s.low)}, {number(s.high)}"
    return f"shape({quoted(f'{name}_{s.suffix}')}, \"1\", {quoted(f'{s.letter}: {s.text}')}, {numbers}, \"as recovered\", grid=({grid})),"


def quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', "'") + '"'


def number(value: float) -> str:
    """Four digits, as a Python number."""
    text = f"{value:.4g}"
    return text if any(sign in text for sign in ".en") else f"{text}.0"


def kernel(hook: str, lines: Iterable[str]) -> str:
    return "\n".join(["@kernel", f"def {hook}:", *(f"{INDENT}{line}" if line else "" for line in lines)])


def on(name: str, expression: Expression) -> str:
    return " or ".join(f"r.{name}_{t.suffix} != 0.0" for t in expression.terms)


def off(name: str, expression: Expression) -> str:
    return " and ".join(f"r.{name}_{t.suffix} == 0.0" for t in expression.terms)


def prepare(name: str, expression: Expression) -> list[str]:
    return [f"if {on(name, expression)}:", f"{INDENT}r.effects_on += 1"]


def body(name: str, place: Place, expression: Expression) -> list[str]:
    """Nothing where it is off; then u, the law, and what it changes."""
    zero = expression.zero * place.axis.per
    x = f"({place.axis.code} - {zero:.6g})" if zero else place.axis.code
    letters = {t.letter: f"r.{name}_{t.suffix}" for t in expression.terms} | {s.letter: f"r.{name}_{s.suffix}" for s in expression.shapes}
    lines = [
        f"if {off(name, expression)}:", f"{INDENT}return" + (" 1.0" if place.package == WEAR else ""), *place.before,
        f"{', '.join(letters)} = {', '.join(letters.values())}", f"u = {x} / {scale(place, expression)}",
        f"y = {total((t.letter, t.code) for t in expression.terms)}",
    ]  # fmt: skip
    slope = total((t.letter, t.slope) for t in expression.terms if t.slope != NOUGHT)
    if place.rate:
        lines += ["# A depth adds up over the hours what the coefficient was: its share, and the growth of that.", f"y += u * ({slope})"]
    if place.slope:
        lines.append(f"slope = ({slope}) / {scale(place, expression)}")
    return [*lines, *place.apply]


def total(parts: Iterable[tuple[str, str]]) -> str:
    """The sum of letters times what they multiply."""
    return " + ".join(letter if code == ONE else f"{letter} * {code}" if single(code) else f"{letter} * ({code})" for letter, code in parts)


def single(code: str) -> bool:
    """Whether an expression needs no brackets as a factor."""
    return " " not in code or ("(" in code and code.endswith(")") and not code.startswith(("(", "-")) and code.index("(") < code.index(" "))
