"""One kernel as a C function: what is computed once becomes an expression, blocks become labels.

An expression stands where its value is used, unless something that it reads is assigned
before: then its value gets a name first.
"""

from collections import Counter

from fmu_src.compiler import c_expressions
from fmu_src.compiler.assembly import CONVERSIONS, Definition, Instruction
from fmu_src.compiler.c_expressions import C_TYPES, Expression, address, arithmetic, called, cell, made, number
from fmu_src.compiler.types import KernelFault

# Beyond it a value gets a name, so that lines can be read; C99 promises 63 levels of brackets.
LONGEST = 100
# Words of C, names that the surroundings have, and functions that must not be hidden by a variable.
WORDS = """auto break case char const continue default do double else enum extern float for goto if inline int long register restrict return
short signed sizeof static struct switch typedef union unsigned void volatile while linux unix main whole unit cell initialise step
wrapped_add wrapped_sub wrapped_mul acos asin atan atan2 ceil cos cosh copysign exp expm1 fabs floor fmod hypot log log10 log1p log2 pow
sin sinh sqrt tan tanh trunc isnan"""
ENDS = ("br", "ret")


def reachable(definition: Definition) -> dict[str, list[Instruction]]:
    """The blocks that are ever come to."""
    found: dict[str, None] = {}
    waiting = ["entry"]
    while waiting:
        label = waiting.pop()
        if label not in found:
            found[label] = None
            waiting += taken(definition.blocks[label][-1])
    return {label: block for label, block in definition.blocks.items() if label in found}


def taken(end: Instruction) -> tuple[str, ...]:
    """Where a block goes on."""
    if end.operands == ("true",):
        return end.labels[:1]
    return end.labels[1:] if end.operation == "br" and end.operands == ("false",) else end.labels


def without_idle(blocks: dict[str, list[Instruction]]) -> dict[str, list[Instruction]]:
    """Without results that nobody uses, and variables that nobody reads."""
    while True:
        everything = [one for block in blocks.values() for one in block]
        loaded = {one.operands[0] for one in everything if one.operation == "load"}
        slots = {one.result for one in everything if one.operation == "alloca"}
        idle = {id(one) for one in everything if one.operation == "store" and one.operands[1] in slots - loaded}
        used = {operand for one in everything if id(one) not in idle for operand in one.operands}
        idle |= {id(one) for one in everything if one.operation not in (*ENDS, "store", "call", "alloca") and one.result not in used}
        if not idle:
            return blocks
        blocks = {label: [one for one in block if id(one) not in idle] for label, block in blocks.items()}


class FunctionInC:
    """``fields`` collects the names of record fields: (name, cells from the start)."""

    def __init__(self, definition: Definition, c_names: dict[str, str], pure: set[str], fields: dict[str, int]):
        self.definition, self.c_names, self.pure, self.fields = definition, c_names, pure, fields
        self.blocks = without_idle(reachable(definition))
        self.uses = Counter[str]()
        self.home: dict[str, str] = {}
        self.elsewhere: set[str] = set()
        self.kinds: dict[str, str] = {}
        self.names: dict[str, str] = {}
        self.slots: dict[str, str] = {}
        self.chosen: list[str] = []
        self.aliases: dict[str, str] = {}
        self.taken_names = set(WORDS.split())
        self.waiting: dict[str, Expression] = {}
        self.lines: list[str] = []
        self.tops: list[str] = []
        self.look_around()

    def look_around(self) -> None:
        """Where values are made and used."""
        for label, block in self.blocks.items():
            for one in block:
                if one.result is None:
                    continue
                self.home[one.result] = label
                self.kinds[one.result] = kind_of(one)
                if one.operation == "alloca":
                    self.slots[one.result] = one.kinds[0]
                if one.operation == "phi":
                    self.chosen.append(one.result)
        for label, block in self.blocks.items():
            for one in block:
                for i, operand in enumerate(one.operands):
                    self.uses[operand] += 1
                    if operand in self.home and self.home[operand] != (one.labels[i] if one.operation == "phi" else label):
                        self.elsewhere.add(operand)
        self.give_names()

    def give_names(self) -> None:
        """To arguments, variables and what depends on the way that was come."""
        stores = [one for block in self.blocks.values() for one in block if one.operation == "store" and one.operands[1] in self.slots]
        stored = Counter(one.operands[1] for one in stores)
        arguments = {name for _, name in self.definition.parameters}
        # A variable that only ever holds an argument is that argument.
        self.aliases = {
            place: value for one in stores for value, place in [one.operands] if value in arguments and stored[place] == 1
        }
        for _, name in self.definition.parameters:
            # One that is assigned anew goes on as a variable of its name.
            is_kept = name in self.aliases.values() or not self.uses[name]
            self.names[name] = fresh(bare(name) + ("" if is_kept else "_given"), self.taken_names)
        for slot, kind in self.slots.items():
            if slot in self.aliases:
                self.names[slot] = self.names[self.aliases[slot]]
            elif stored[slot]:
                self.names[slot] = fresh(bare(slot), self.taken_names)
                self.top(kind, self.names[slot])
        for result in self.chosen:
            self.names[result] = fresh("chosen", self.taken_names)
            self.top(self.kinds[result], self.names[result])

    def top(self, kind: str, name: str) -> None:
        """Declares a variable for the whole function."""
        c_type = self.c_type(kind)
        self.tops.append(f"{c_type}{'' if c_type.endswith('*') else ' '}{name} = {'NULL' if kind == 'ptr' else '0.0' if kind == 'double' else '0'};")

    def c_type(self, kind: str) -> str:
        return f"struct {letters(kind)}" if kind.startswith("{") else C_TYPES[kind]

    # Values.

    def value(self, operand: str) -> Expression:
        if not operand.startswith("%"):
            return number(operand)
        if operand in self.waiting:
            return self.waiting.pop(operand)
        name = self.names[operand]
        return Expression(name, reads=frozenset([name]) if operand in self.slots or operand in self.chosen else frozenset())

    def hold(self, result: str, expression: Expression) -> None:
        """Keeps a value until it is used, or gives it a name now."""
        self.waiting[result] = expression
        whole = bool(expression.parts)
        if result in self.elsewhere or (self.uses[result] > 1 and not whole) or (len(expression.text) > LONGEST and not whole):
            self.name_now(result)

    def name_now(self, result: str) -> None:
        expression, kind = self.waiting.pop(result), self.kinds[result]
        name = self.names[result] = fresh("t" + "".join(c for c in result if c.isdigit())[-6:], self.taken_names)
        if result in self.elsewhere:
            self.top(kind, name)
            self.write(f"{name} = {expression.text};")
        else:
            c_type = self.c_type(kind)
            self.write(f"{c_type}const {name} = {expression.text};" if kind == "ptr" else f"const {c_type} {name} = {expression.text};")

    def settle(self, *changed: str, cells: bool = False) -> None:
        """Names for all that reads what is about to change."""
        for result, expression in list(self.waiting.items()):
            if (cells and expression.cells) or expression.reads & set(changed):
                if expression.parts:
                    raise KernelFault(f"C source: {self.definition.name}: a result whose parts change before it is returned")
                self.name_now(result)

    def write(self, line: str) -> None:
        self.lines.append(f"    {line}")

    # Instructions.

    def text(self) -> str:
        order = list(self.blocks)
        asked = {"entry"}
        for label, following in zip(order, [*order[1:], ""]):
            if label != "entry":
                self.lines.append(f"{label}:;")
            for one in self.blocks[label][:-1]:
                self.instruction(one)
            asked |= self.end(self.blocks[label][-1], label, following)
        body = [line for line in self.lines if line.startswith(" ") or line[:-2] in asked]
        return "\n".join([f"{self.head()}", "{", *(f"    {line}" for line in self.tops), *body, "}"])

    def head(self) -> str:
        taken = [
            f"void *{self.names[name]}" if kind == "ptr" and not self.definition.is_internal
            else f"{self.c_type(kind)}{'' if kind == 'ptr' else ' '}{self.names[name]}"
            for kind, name in self.definition.parameters
        ]  # fmt: skip
        start = "static " if self.definition.is_internal else ""
        return f"{start}{self.c_type(self.definition.kind)} {self.c_names[self.definition.name]}({', '.join(taken) or 'void'})"

    def instruction(self, one: Instruction) -> None:
        match one.operation:
            case "alloca" | "phi":
                pass
            case "store":
                self.store(one)
            case "load" if one.operands[0] in self.slots:
                assert one.result is not None
                self.hold(one.result, self.value(self.aliases.get(one.operands[0], one.operands[0])))
            case "call":
                self.call(one)
            case _:
                assert one.result is not None
                self.hold(one.result, self.computed(one))

    def computed(self, one: Instruction) -> Expression:
        match one.operation:
            case "load":
                return cell(self.value(one.operands[0]), one.kinds[0])
            case "getelementptr":
                return address(self.value(one.operands[0]), self.cells_on(one))
            case "insertvalue":
                whole, value = one.operands
                before = self.value(whole).parts if whole != "poison" else (None,) * len(members(one.kinds[0]))
                parts = [*before]
                parts[int(one.detail)] = self.value(value)
                known = [part for part in parts if part is not None]
                listed = ", ".join(part.text for part in known)
                gathered = made(f"(struct {letters(one.kinds[0])}){{{listed}}}", c_expressions.NAME, *known)
                return Expression(gathered.text, gathered.binds, gathered.reads, gathered.cells, parts=tuple(parts))
            case "extractvalue":
                of = self.value(one.operands[0])
                return made(f"{of.within(c_expressions.NAME)}.m{one.detail}", c_expressions.NAME, of)
        return arithmetic(one, self.value)

    def cells_on(self, one: Instruction) -> Expression:
        """How many cells on an address lies; fields of records by their names."""
        if one.kinds[0] != "i8":
            return self.value(one.operands[1])
        if not one.operands[1].isdigit():
            return c_expressions.infix("/", c_expressions.PRODUCT, self.value(one.operands[1]), Expression("8"))
        cells = int(one.operands[1]) // 8
        hint = (one.result or "").lstrip("%")
        if ".at" not in hint:
            return Expression(str(cells))
        name = f"at_{hint.partition('.at')[0]}"
        if self.fields.setdefault(name, cells) != cells:
            name = f"{name}_{cells}"
            self.fields[name] = cells
        return Expression(name)

    def store(self, one: Instruction) -> None:
        kind, (value, place) = one.kinds[0], one.operands
        if place in self.aliases:
            return
        if place in self.slots:
            name, given = self.names[place], self.value(value)
            self.settle(name)
            self.write(f"{name} = {given.text};")
            return
        given, target = self.value(value), cell(self.value(place), kind)
        self.settle(cells=True)
        self.write(f"{target.text} = {given.text};")

    def call(self, one: Instruction) -> None:
        name = one.detail
        arguments = [self.value(operand) for operand in one.operands]
        if name.startswith("llvm."):
            result = called(name.split(".")[1], arguments)
        else:
            result = called(self.c_names.get(name, name), arguments)
        is_pure = name in self.pure or name not in self.c_names
        if not is_pure:
            self.settle(cells=True)
        if one.result is None or not self.uses[one.result]:
            self.write(f"{result.text};")
            return
        self.hold(one.result, result)
        if not is_pure and one.result in self.waiting:
            self.name_now(one.result)

    def end(self, one: Instruction, label: str, following: str) -> set[str]:
        """Writes how a block ends; the labels that it needs."""
        if one.operation == "ret":
            self.write(f"return {self.value(one.operands[0]).text};" if one.operands else "return;")
            return set()
        for wanted in dict.fromkeys(taken(one)):
            for phi in self.blocks[wanted]:
                if phi.operation == "phi" and phi.result is not None:
                    given = self.value(phi.operands[phi.labels.index(label)])
                    self.settle(self.names[phi.result])
                    self.write(f"{self.names[phi.result]} = {given.text};")
        labels = taken(one)
        if len(labels) == 1:
            return self.go(labels[0], following)
        test, (yes, no) = self.value(one.operands[0]), labels
        if yes == following:
            self.write(f"if ({c_expressions.denial(test).text})")
            self.write(f"    goto {no};")
            return {no}
        self.write(f"if ({test.text})")
        self.write(f"    goto {yes};")
        return {yes} | self.go(no, following)

    def go(self, label: str, following: str) -> set[str]:
        if label == following:
            return set()
        self.write(f"goto {label};")
        return {label}


def kind_of(one: Instruction) -> str:
    """The type of a result."""
    if one.operation in CONVERSIONS:
        return one.kinds[1]
    if one.operation == "extractvalue":
        return members(one.kinds[0])[int(one.detail)]
    return {"icmp": "i1", "fcmp": "i1", "getelementptr": "ptr"}.get(one.operation, one.kinds[0])


def members(group: str) -> list[str]:
    """The types of several results: of ``{ double, i64 }``."""
    return group.strip("{} ").split(", ")


def bare(name: str) -> str:
    return name.lstrip("%").partition(".")[0]


def fresh(base: str, taken_names: set[str]) -> str:
    """A name that nothing else has."""
    name, count = base, 1
    while name in taken_names:
        count += 1
        name = f"{base}_{count}"
    taken_names.add(name)
    return name


def letters(group: str) -> str:
    """The name of a structure of several results: ``{ double, i64 }`` is ``results_di``."""
    return "results_" + "".join({"double": "d", "i64": "i", "i1": "b"}[kind] for kind in members(group))
