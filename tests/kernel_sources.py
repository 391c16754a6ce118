"""Random kernels as text: typed expressions and statements of the subset, drawn by Hypothesis.

Every variable keeps one kind (number, whole number), so that Python and the compiler must agree to
the last bit; whole numbers stay below ``LARGEST``, beyond which Python's do not wrap and those of kernels do.
"""

from hypothesis import strategies as st

LARGEST = 2**50
# Bounds of the whole numbers that a kernel starts from, and of those that it stores (through % STORED).
GIVEN, STORED = 9, 97
NUMBERS, WHOLES = ("x", "y", "a", "b"), ("i", "j", "m", "n")
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
ROW, WHOLE = 5, 4
HELPERS = """
def scaled(u, v):
    return u * v if abs(v) < 10.0 else u


def split(u, k):
    if k % 2 == 0:
        return -u, k // 2
    return u, k


"""


class Writer:
    """Draws one kernel; ``counters`` are names of loops, whole numbers that are read only."""

    def __init__(self, draw):
        self.draw = draw
        self.counters = []
        self.named = 0

    def among(self, choices):
        return self.draw(st.sampled_from(choices))

    # Expressions: text of a number; text and largest size of a whole number; text of a test.

    def number(self, depth):
        if depth == 0:
            return self.among((*NUMBERS, "0.5", "2.0", "1.0e-3", "-3.25", "0.0", f"row[{self.among(range(-ROW, ROW))}]"))
        one = lambda: self.number(depth - 1)
        match self.among(("infix", "infix", "infix", "mixed", "call", "extreme", "choice", "minus", "element", "whole", "power")):
            case "infix":
                return f"({one()} {self.among(('+', '-', '*', '/', '//', '%'))} {one()})"
            case "mixed":
                sides = [one(), self.whole(depth - 1)[0]]
                left, right = sides if self.draw(st.booleans()) else reversed(sides)
                return f"({left} {self.among(('+', '-', '*', '/', '//', '%'))} {right})"
            case "call":
                return self.among(("abs({})", "math.sqrt(abs({}))", "math.sin({})", "math.atan({})", "scaled({}, b)", "math.atan2({}, x)")).format(one())
            case "extreme":
                return f"{self.among(('min', 'max'))}({', '.join(one() for _ in range(self.among((2, 3))))})"
            case "choice":
                return f"({one()} if {self.test(depth - 1)} else {one()})"
            case "minus":
                return f"-{one()}"
            case "element":
                return f"row[{self.index(depth - 1, ROW)}]"
            case "whole":
                whole = self.whole(depth - 1)[0]
                return self.among((f"float({whole})", f"({whole} / 4)"))
            case "power":
                # Constant powers are products (see test_powers); one, none and variable ones are the same in both.
                return self.among(("abs({}) ** y", "({}) ** 1", "({}) ** 0")).format(one())

    def whole(self, depth):
        if depth == 0:
            text = self.among((*WHOLES, *self.counters, "0", "1", "2", "-3", "7", "len(row)", "whole.shape[0]", f"whole[{self.among(range(-WHOLE, WHOLE))}]"))
            return text, STORED
        one = lambda: self.whole(depth - 1)
        match self.among(("infix", "infix", "extreme", "choice", "minus", "element", "number", "power", "truth")):
            case "infix":
                (left, most), (right, more) = one(), one()
                operator = self.among(("+", "-", "*", "//", "%"))
                return self.bounded(f"({left} {operator} {right})", {"*": most * more, "%": more}.get(operator, most + more))
            case "extreme":
                parts = [one() for _ in range(self.among((2, 3)))]
                return f"{self.among(('min', 'max'))}({', '.join(text for text, _ in parts)})", max(most for _, most in parts)
            case "choice":
                (left, most), (right, more) = one(), one()
                return f"({left} if {self.test(depth - 1)} else {right})", max(most, more)
            case "minus":
                text, most = one()
                return self.among((f"-{text}", f"abs({text})")), most
            case "element":
                return f"whole[{self.index(depth - 1, WHOLE)}]", STORED
            case "number":
                return f"{self.among(('int', 'math.floor', 'math.ceil', 'math.trunc'))}(math.fmod({self.number(depth - 1)}, 50.0))", STORED
            case "power":
                text, most = one()
                return self.bounded(f"{text} ** 2" if text.isidentifier() else f"({text}) ** 2", most * most)
            case "truth":
                return self.among((f"int({self.test(depth - 1)})", f"(({self.test(depth - 1)}) + 1)")), 2

    def bounded(self, text, most):
        return (f"({text} % {STORED})", STORED) if most > LARGEST else (text, most)

    def index(self, depth, length):
        """Within the array, from either end; what counts a loop may be beyond, where Python raises."""
        text = self.whole(depth)[0]
        counted = tuple(self.counters)
        return self.among((f"{text} % {length}", f"-1 - {text} % {length}", *counted, *(f"{name} - 1" for name in counted)))

    def test(self, depth):
        if depth == 0:
            return self.among(("x > 0.0", "i < j", "m == 0", "flag", "not flag"))
        one = lambda: self.test(depth - 1)
        match self.among(("numbers", "wholes", "chain", "both", "either", "not", "choice", "bool")):
            case "numbers":
                return f"({self.number(depth - 1)} {self.among(COMPARISONS)} {self.number(depth - 1)})"
            case "wholes":
                return f"({self.whole(depth - 1)[0]} {self.among(COMPARISONS)} {self.whole(depth - 1)[0]})"
            case "chain":
                parts = [self.number(depth - 1) for _ in range(3)]
                return f"({parts[0]} {self.among(COMPARISONS)} {parts[1]} {self.among(COMPARISONS)} {parts[2]})"
            case "both":
                return f"({one()} and {one()})"
            case "either":
                return f"({one()} or {one()} or {one()})"
            case "not":
                return f"(not {one()})"
            case "choice":
                return f"({one()} if {one()} else {one()})"
            case "bool":
                return self.among((f"bool({self.number(depth - 1)})", f"bool({self.whole(depth - 1)[0]})"))

    # Statements: lists of lines.

    def block(self, depth, in_loop=False):
        # What gets its first value in here has none behind it.
        known = list(self.counters)
        lines = [line for _ in range(self.among((1, 2, 3))) for line in self.statement(depth, in_loop)]
        self.counters = known
        return ["    " + line for line in lines]

    def statement(self, depth, in_loop):
        kinds = ["number", "whole", "added", "stored", "tuple", "flag"]
        kinds += ["if", "if", "for", "while", "of"] * (depth > 0) + ["leave"] * in_loop
        match self.among(kinds):
            case "number":
                return [f"{self.among(NUMBERS)} = {self.number(2)}"]
            case "whole":
                return [f"{self.among(WHOLES)} = {self.whole(2)[0]} % {STORED} - {self.among((0, 3))}"]
            case "added":
                return [f"{self.among(NUMBERS)} {self.among(('+', '-', '*', '/', '//', '%'))}= {self.number(1)}"]
            case "stored":
                if self.draw(st.booleans()):
                    return [f"row[{self.index(1, ROW)}] {self.among(('=', '+=', '*='))} {self.number(2)}"]
                return [f"whole[{self.index(1, WHOLE)}] = {self.whole(2)[0]} % {STORED}"]
            case "tuple":
                return self.among((
                    [f"a, b = b, {self.number(1)}"], [f"x, (m, y) = a, ({self.whole(1)[0]} % {STORED}, b)"],
                    [f"y, n = split({self.number(1)}, n)"], [f"a = (x, y, b)[{self.among(range(-3, 3))}]"],
                    [f"b = ((a, x), y)[0][{self.among((0, 1, -1))}]"], [f"m = (i, j, 5)[{self.whole(1)[0]} % 3]"],
                ))
            case "flag":
                return [f"flag = {self.test(2)}"]
            case "if":
                lines = [f"if {self.test(2)}:", *self.block(depth - 1, in_loop)]
                if self.draw(st.booleans()):
                    lines += [f"elif {self.test(1)}:", *self.block(depth - 1, in_loop)]
                return lines + (["else:", *self.block(depth - 1, in_loop)] if self.draw(st.booleans()) else [])
            case "for":
                return self.loop(f"for {{}} in range({self.limits()}):", depth)
            case "of":
                items = ", ".join(self.whole(1)[0] for _ in range(self.among((2, 3))))
                return self.loop(f"for {{}} in ({items}):", depth)
            case "while":
                self.named += 1
                name = f"w{self.named}"
                return [f"{name} = 0", f"while {name} < 4 and {self.test(1)}:", f"    {name} += 1", *self.block(depth - 1, True), *self.otherwise(depth)]
            case "leave":
                return [f"if {self.test(1)}:", f"    {self.among(('break', 'continue', 'return a, y, m, flag'))}"]

    def limits(self):
        """Of a range: upwards or downwards, from below or above zero, sometimes empty."""
        return self.among(("4", f"{self.whole(1)[0]} % 4", f"-2, {self.whole(1)[0]} % 3", "3, -2, -1", "1, 8, 3", "i, i + 3", "5, 2"))

    def loop(self, head, depth):
        # A name of its own, or one that an earlier loop had: it may then stand for numbers of either sign.
        name = self.among((*self.counters, None)) if self.counters else None
        if name is None:
            self.named += 1
            name = f"k{self.named}"
        known = name in self.counters
        if not known:
            self.counters.append(name)
        lines = [head.format(name), *self.block(depth - 1, True), *self.otherwise(depth)]
        # Before the loop, or the name would have no value where it is empty.
        return lines if known else [f"{name} = 0", *lines] if self.draw(st.booleans()) else self.forgotten(name, lines)

    def forgotten(self, name, lines):
        """The loop alone gives the name its values: nothing behind it may ask for it."""
        self.counters.remove(name)
        return lines

    def otherwise(self, depth):
        return ["else:", *self.block(depth - 1)] if self.draw(st.booleans()) else []

    def kernel(self):
        body = [line for _ in range(self.among((2, 3, 4, 5))) for line in self.statement(2, False)]
        lines = ["a, b, m, n, flag = 1.5, y, 2, i, x < y", *body, "return a + x - b, y, m + 100 * n, flag"]
        return HELPERS + "def made(x, y, i, j, row, whole):\n" + "".join(f"    {line}\n" for line in lines)


@st.composite
def kernel_sources(draw):
    """The text of a function ``made(x, y, i, j, row, whole)`` that gives back four values."""
    return Writer(draw).kernel()
