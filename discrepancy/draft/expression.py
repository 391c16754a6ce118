"""A closed form of a recovered law as terms of a kernel: amplitudes with the law's unit, shapes without one.

The form speaks of the campaign's units; here all is SI, over u = (x - x_0)/X with X the largest x that was measured.  Amplitudes
and shapes have one letter in the equation and in the code.
"""

import math
from dataclasses import dataclass, replace

from discrepancy.inference.law.closed_forms import Form
from discrepancy.inference.law.recover import Recovered
from discrepancy.inference.law.waves import Growth

# Bounds of what was recovered (assumed): amplitudes up to so many times their size, rates and widths as many times longer or shorter.
WIDE = 20.0
# Exponents beyond these are steps (assumed).
STEEPEST = 8.0
# A search looks beside the recovered shape by its interval, by no more than this share of its range.
WIDEST_LOOK = 0.3
# A form with this share of the best one's confidence is nearly as sure (assumed).
NEARLY = 0.5


@dataclass(frozen=True)
class Shape:
    """A parameter that says how the law bends: recovered value, bounds, and where a search looks."""

    suffix: str
    letter: str
    text: str
    value: float
    low: float
    high: float
    grid: tuple[float, ...]


@dataclass(frozen=True)
class Term:
    """An amplitude of ``size`` (of about ``scale``) times the kernel expression ``code`` of u; ``slope`` is its derivative by u, ``symbol`` how one writes it.

    Its ``letter`` is that of the form's constant that it comes from.
    """

    suffix: str
    letter: str
    text: str
    size: float
    scale: float
    symbol: str
    code: str
    slope: str


ONE, NOUGHT = "1.0", "0.0"
# Letter of the exponent by which a wave's size goes with a condition.
POWER = "q"


@dataclass(frozen=True)
class Expression:
    """y = sum of the terms, over u = (x - zero)/scale; all in SI.  ``form`` is what it was made from."""

    form: Form
    terms: tuple[Term, ...]
    shapes: tuple[Shape, ...]
    zero: float
    scale: float

    def law(self) -> str:
        """The right side as one writes it: a for the level, b and c for what follows the form."""
        return " + ".join(t.letter + (f" {t.symbol}" if t.symbol else "") for t in self.terms)


def expression_of(law: Recovered, with_level: bool) -> Expression:
    """The law's form, of forms that are nearly as sure as the best the one with the fewest.

    Without its constant where a level cannot show.
    """
    nearly = [form for form in law.forms if form.confidence >= NEARLY * law.forms[0].confidence and form.name in FORMS]
    return min((written(law, form, with_level) for form in nearly), key=lambda e: len(e.terms) + len(e.shapes))


def written(law: Recovered, form: Form, with_level: bool) -> Expression:
    factor, offset, _ = law.x_told
    x = [factor * v + offset for v in law.points["x"]]
    low, high = min(x), max(x)
    scale = max(abs(low), abs(high)) or 1.0
    terms, shapes = FORMS[form.name](form, low / scale, high / scale, scale)
    kept = [t for t in terms if tells(t, form, with_level)]
    if not any(t.suffix != "level" for t in kept):
        # None of a law's terms is sure by itself, together they are: the largest stands for them.
        kept.append(max((t for t in terms if t.suffix != "level"), key=lambda t: abs(t.size)))
    if law.growth:
        shapes.append(grown(law.growth))
    in_si = tuple(replace(t, size=t.size / law.y_told[0], scale=t.scale / law.y_told[0]) for t in kept)
    return Expression(form, in_si, tuple(shapes), -offset / factor + 0.0, scale / factor)


def tells(term: Term, form: Form, with_level: bool) -> bool:
    """Whether the data show this term: its interval does not hold 0."""
    low, high = form.intervals[term.letter]
    # A wave's parts make one amplitude with a phase.
    return (low * high > 0.0 or form.name == "periodic") if term.suffix != "level" else with_level and low * high > 0.0


def level(size: float) -> Term:
    return Term("level", "a", "what does not depend on it", size, abs(size), "", ONE, NOUGHT)


def main(size: float, symbol: str, code: str, slope: str) -> Term:
    return Term("size", "b", "at the largest measured value, without the level", size, abs(size), symbol, code, slope)


def looked(value: float, interval: tuple[float, float], low: float, high: float) -> tuple[float, ...]:
    """The value and its neighbours by the interval, within the bounds."""
    half = min(0.5 * abs(interval[1] - interval[0]), WIDEST_LOOK * (high - low))
    if not half > 0.0:
        return (value,)
    return tuple(sorted({min(max(v, low), high) for v in (value - half, value, value + half)}))


def shape_of(form: Form, key: str, suffix: str, letter: str, text: str, low: float, high: float, factor: float) -> Shape:
    """The form's constant ``key`` as ``factor`` times itself, within bounds."""
    value = min(max(form.parameters[key] * factor, low), high)
    first, last = (v * factor for v in form.intervals[key])
    return Shape(suffix, letter, text, value, low, high, looked(value, (first, last), low, high))


def linear(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p = form.parameters
    return [level(p["a"]), main(p["b"] * scale, "u", "u", ONE)], []


def quadratic(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p = form.parameters
    square = Term("square", "c", "its square, at the largest measured value", p["c"] * scale**2, abs(p["c"]) * scale**2, "u^2", "u * u", "2.0 * u")
    return [level(p["a"]), main(p["b"] * scale, "u", "u", ONE), square], []


def power(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p = form.parameters
    c = min(max(p["c"], -STEEPEST), STEEPEST)
    bounds = (0.05, STEEPEST) if c > 0.0 else (-STEEPEST, -0.05)
    shape = shape_of(form, "c", "power", "p", "exponent", *bounds, 1.0)
    return [level(p["a"]), main(p["b"], "u^p", "max(u, 1e-9) ** p", "p * max(u, 1e-9) ** (p - 1.0)")], [shape]


def logarithmic(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p = form.parameters
    return [level(p["a"] + p["b"] * math.log(scale)), main(p["b"], "ln u", "math.log(max(u, 1e-9))", "1.0 / max(u, 1e-9)")], []


def exponential(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    """The form's reference is the end of the range where it is large."""
    p = form.parameters
    c = p["c"] * scale
    end = low if c < 0.0 else high
    least, most = sorted((c / WIDE, c * WIDE))
    shape = shape_of(form, "c", "rate", "s", "rate of growth over the largest measured value", least, most, scale)
    code = f"math.exp(min(60.0, s * (u - {plain(end)})))"
    return [level(p["a"]), main(p["b"], f"exp[s (u - {plain(end)})]", code, f"s * {code}")], [shape]


def saturating(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p = form.parameters
    c = max(abs(p["c"]) / scale, 1e-3 * (high - low))
    spread = max(abs(v) for v in form.intervals["c"]) / scale - c
    shape = Shape("half", "h", "how far on half of it is reached", c, c / WIDE, c * WIDE, looked(c, (c - spread, c + spread), c / WIDE, c * WIDE))
    along = f"max(0.0, u - {plain(low)})"
    start = f"(u - {plain(low)})"
    return [level(p["a"]), main(p["b"], f"{start}/[{start} + h]", f"{along} / ({along} + h)", f"h / ({along} + h) ** 2")], [shape]


def place(form: Form, text: str, low: float, high: float, scale: float) -> Shape:
    return shape_of(form, "c", "place", "m", text, low, high, 1.0 / scale)


def threshold(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p = form.parameters
    term = main(p["b"] * scale, "max(0, u - m)", "max(0.0, u - m)", "(1.0 if u > m else 0.0)")
    return [level(p["a"]), term], [place(form, "where it begins", low, high, scale)]


def step(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p, width = form.parameters, plain(0.02 * (high - low))
    code = f"1.0 / (1.0 + math.exp(min(60.0, (m - u) / {width})))"
    slope = f"({code}) * (1.0 - {code}) / {width}"
    return [level(p["a"]), main(p["b"], f"/[1 + exp((m - u)/{width})]", code, slope)], [place(form, "where it steps", low, high, scale)]


def bump(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    p, span = form.parameters, high - low
    width = min(max(abs(p["d"]) / scale + 1e-3 * span, 0.02 * span), 2.0 * span)
    shapes = [
        place(form, "its middle", low - 0.2 * span, high + 0.2 * span, scale),
        Shape("width", "w", "its width", width, 0.02 * span, 2.0 * span, (width,)),
    ]
    code = "math.exp(-(((u - m) / w) ** 2))"
    return [level(p["a"]), main(p["b"], "exp[-((u - m)/w)^2]", code, f"-2.0 * (u - m) / (w * w) * {code}")], shapes


def periodic(form: Form, low: float, high: float, scale: float) -> tuple[list[Term], list[Shape]]:
    """Counted from the middle of the range, as the form."""
    p = form.parameters
    middle, k = 0.5 * (low + high), p["k"] * scale
    # Another wave within the range would be another order.
    free = 0.5 * math.pi / (high - low)
    shape = shape_of(form, "k", "wave", "k", "wave number over the largest measured value", k - free, k + free, scale)
    phase, written = (f"k * (u - {plain(middle)})", f"k (u - {plain(middle)})") if middle else ("k * u", "k u")
    size = math.hypot(p["b"], p["c"])
    terms = [
        level(p["a"]),
        Term("cosine", "b", "its cosine part", p["b"], size, f"cos[{written}]", f"math.cos({phase})", f"-k * math.sin({phase})"),
        Term("sine", "c", "its sine part", p["c"], size, f"sin[{written}]", f"math.sin({phase})", f"k * math.cos({phase})"),
    ]
    return terms, [shape]


def grown(growth: Growth) -> Shape:
    """The power by which the size of a wave goes with a condition."""
    p, half = growth.exponent, 1.96 * growth.deviation
    low, high = (0.05, STEEPEST) if p > 0.0 else (-STEEPEST, -0.05)
    value = min(max(p, low), high)
    return Shape("growth", POWER, f"exponent of its size over {growth.factor}", value, low, high, looked(value, (p - half, p + half), low, high))


def plain(value: float) -> str:
    """A number as one writes it in a formula."""
    return f"{value:.6g}"


FORMS = {
    "linear": linear, "quadratic": quadratic, "power": power, "logarithmic": logarithmic, "exponential": exponential,
    "saturating": saturating, "threshold": threshold, "step": step, "bump": bump, "periodic": periodic,
}  # fmt: skip
