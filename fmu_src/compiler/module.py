"""An entry point with everything that it calls: one LLVM module, optimised, as object code."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import llvmlite.binding as llvm
import numpy as np

from fmu_src.compiler.emitter import Emitter
from fmu_src.compiler.function import Instance
from fmu_src.compiler.source import Source
from fmu_src.compiler.types import INTEGER, Group, KernelFault, Layout, Number, Type, returned

# More would take 1.4 times as long to compile for 0.5 % fewer instructions an equilibrium, and 0.1 % more a motion.
OPTIMISATION = 1


@dataclass
class Module:
    """Functions written so far.

    ``separate`` are entry points that keep object code of their own: calls of them stay
    calls, and are listed in ``needs`` as symbol -> (kernel, argument types).
    """

    separate: Callable[[Source, tuple[Type, ...]], str | None] = lambda kernel, types: None
    instances: dict[tuple[Source, tuple[Type, ...]], Instance] = field(default_factory=dict)
    functions: list[str] = field(default_factory=list)
    declarations: set[str] = field(default_factory=set)
    needs: dict[str, tuple[Source, tuple[Type, ...]]] = field(default_factory=dict)
    # (module, name) -> value of every number that was taken from outside a function.
    constants: dict[tuple[str, str], Any] = field(default_factory=dict)
    layouts: dict[int, Layout] = field(default_factory=dict)

    def layout(self, dtype: np.dtype) -> Layout:
        return self.layouts.setdefault(id(dtype), Layout(dtype))

    def note_constant(self, kernel: Source, name: str, value: Any) -> None:
        if "[" not in name:
            self.constants[kernel.module, name] = value

    def declare(self, declaration: str, symbol: str) -> str:
        self.declarations.add(declaration)
        return symbol

    def instance(self, kernel: Source, arguments: tuple[Type, ...], is_called: bool = False) -> Instance:
        """The kernel for these types, written if it is new."""
        key = (kernel, arguments)
        if key in self.instances:
            return self.instances[key]
        symbol = self.separate(kernel, arguments) if is_called else None
        if symbol is not None:
            instance = Instance(kernel, arguments, f'@"{symbol}"', INTEGER, is_separate=True)
            self.needs[symbol] = key
            self.declarations.add(f'i64 @"{symbol}"({", ".join(kind.parts[0] for kind in arguments)})')
        else:
            instance = Instance(kernel, arguments, f'@"{kernel.module}.{kernel.name}.{len(self.instances)}"')
        self.instances[key] = instance
        if symbol is None:
            self.functions.append(Emitter(self, instance).define())
        return instance

    def modules(self) -> set[str]:
        """Names of the Python modules whose text decides what came out."""
        return {kernel.module for kernel, _ in self.instances}

    def entry(self, kernel: Source, arguments: tuple[Type, ...], symbol: str) -> Type:
        """Offer a kernel under a C name; the type of its result.

        One number is returned; results of several parts are written, 8 bytes each, to where
        a last argument points.
        """
        instance = self.instance(kernel, arguments)
        kinds = [part for kind in arguments for part in kind.parts]
        names = [f"%a{i}" for i in range(len(kinds))]
        passed = ", ".join(f"{kind} {name}" for kind, name in zip(kinds, names))
        result = instance.result
        assert result is not None
        taken = ", ".join(f"{'i8' if kind == 'i1' else kind} {name}{'.byte' if kind == 'i1' else ''}" for kind, name in zip(kinds, names))
        body = [f"  {name} = trunc i8 {name}.byte to i1" for kind, name in zip(kinds, names) if kind == "i1"]
        call = f"call {returned(result)} {instance.symbol}({passed})"
        if isinstance(result, Number):
            (kind,) = result.parts
            body.append(f"  %whole = {call}")
            if kind == "i1":
                body += ["  %wide = zext i1 %whole to i64", "  ret i64 %wide"]
            else:
                body.append(f"  ret {kind} %whole")
            returns = "i64" if kind == "i1" else kind
        elif isinstance(result, Group) and all(part != "ptr" for part in result.parts):
            returns, taken = "void", ", ".join(filter(None, [taken, "ptr %results"]))
            body.append(f"  {'%whole = ' if result.parts else ''}{call}")
            for i, kind in enumerate(result.parts):
                part = "%whole"
                if len(result.parts) > 1:
                    part = f"%p{i}"
                    body.append(f"  {part} = extractvalue {returned(result)} %whole, {i}")
                body.append(f"  %w{i} = {'zext i1' if kind == 'i1' else f'bitcast {kind}'} {part} to {'i64' if kind != 'double' else 'double'}")
                body.append(f"  %r{i} = getelementptr inbounds i64, ptr %results, i64 {i}")
                body.append(f"  store {'i64' if kind != 'double' else kind} %w{i}, ptr %r{i}, align 8")
            body.append("  ret void")
        else:
            raise KernelFault(f"{kernel.file}:{kernel.tree.lineno}: {kernel.name} returns {result}; give back numbers only")
        text = "\n".join(body)
        self.functions.append(f'define {returns} @"{symbol}"({taken}) #0 {{\n{text}\n}}\n')
        return result

    def unit_entry(self, kernel: Source, arguments: tuple[Type, ...]) -> Type:
        """Offer an entry point of a unit as the C function ``int64 name(void *cells, double ...)``."""
        instance = self.instance(kernel, arguments)
        if instance.result != INTEGER:
            raise KernelFault(f"{kernel.file}:{kernel.tree.lineno}: {kernel.name} must return a status code, a whole number")
        numbers = [f"double %a{i}" for i in range(len(arguments) - 1)]
        taken, passed = ", ".join(["ptr %cells", *numbers]), ", ".join(["ptr %cells", "i64 1", *numbers])
        self.functions.append(
            f"define i64 @{kernel.name}({taken}) #0 {{\n  %status = call i64 {instance.symbol}({passed})\n  ret i64 %status\n}}\n"
        )
        return INTEGER

    def text(self, triple: str) -> str:
        declared = "\n".join(f"declare {line}" for line in sorted(self.declarations))
        attributes = "attributes #0 = { nounwind }\nattributes #1 = { nounwind willreturn memory(none) }"
        return f'target triple = "{triple}"\n\n' + "\n".join([*self.functions, declared, attributes]) + "\n"


def target_machine(triple: str) -> llvm.TargetMachine:
    """Plain instructions of the target's kind of processor, so that equal numbers come out everywhere."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    return llvm.Target.from_triple(triple).create_target_machine(opt=2, reloc="pic", codemodel="default")


def host_triple() -> str:
    return str(llvm.get_process_triple())


def optimised(text: str, entries: list[str]) -> llvm.ModuleRef:
    """The module after LLVM's optimisation; all but the entries may be inlined and dropped."""
    module = llvm.parse_assembly(text)
    module.verify()
    machine = target_machine(host_triple())
    module.data_layout = str(machine.target_data)
    for function in module.functions:
        if function.name in entries:
            function.visibility = "hidden"
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=OPTIMISATION))
    builder.getModulePassManager().run(module, builder)
    return module


def emit_object(module: llvm.ModuleRef, triple: str) -> bytes:
    """Object code for one target; the module was made for this machine, its code holds for all."""
    machine = target_machine(triple)
    retargeted = module.clone()
    retargeted.triple = triple
    retargeted.data_layout = str(machine.target_data)
    return bytes(machine.emit_object(retargeted))


def external_symbols(module: llvm.ModuleRef) -> set[str]:
    """Symbols that the module needs from outside, LLVM's own intrinsics apart."""
    functions = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    return functions | {v.name for v in module.global_variables if v.is_declaration}
