"""One kernel for given argument types as LLVM code, in a single walk over its syntax tree."""

import ast

from fmu_src.compiler import expressions, statements
from fmu_src.compiler.function import Function, Wider
from fmu_src.compiler.types import NOTHING, Value, returned


class Emitter(Function):
    """Walks the tree until the types of the variables have settled."""

    def expression(self, node: ast.expr) -> Value:
        return expressions.expression(self, node)

    def statements(self, body: list[ast.stmt]) -> None:
        statements.statements(self, body)

    def define(self) -> str:
        """The definition of the function in LLVM's language."""
        for _ in range(32):
            try:
                return self.walk()
            except Wider:
                continue
        raise self.fault(f"the types of {self.instance.kernel.name} do not settle")

    def walk(self) -> str:
        names, kinds = self.tree.args.args, self.instance.arguments
        if len(names) != len(kinds):
            raise self.fault(f"{self.instance.kernel.name} takes {len(names)} arguments, not {len(kinds)}")
        self.begin()
        parameters = []
        for name, kind in zip(names, kinds):
            operands = tuple(f"%{name.arg}.{i}" for i in range(len(kind.parts)))
            parameters += [f"{part} {operand}" for part, operand in zip(kind.parts, operands)]
            self.store_name(name.arg, Value(kind, operands))
        self.statements(self.tree.body)
        if not self.ended:
            statements.give_back(self, Value(NOTHING, ()))
        if self.never_negative & self.sometimes_negative:
            raise Wider
        assert self.result is not None
        self.instance.result = self.result
        body = "\n".join(["entry:", *self.slots, *self.lines])
        return f"define internal {returned(self.result)} {self.instance.symbol}({', '.join(parameters)}) #0 {{\n{body}\n}}\n"
