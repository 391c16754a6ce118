"""One component of the compiled unit: what it asks of its host, what it offers, and how the one becomes the other."""

from functools import partial

from fmu_src.wasm import encoding, interface
from fmu_src.wasm.encoding import COMPONENT, number, plain_section, section, several, text, type_index
from fmu_src.wasm.interface import INSTANCE, PACKAGE, Type

CORE_FUNCTION, FUNCTION, TYPE, INSTANCE_SORT = b"\x00\x00", b"\x01", b"\x03", b"\x05"
CORE_MEMORY = b"\x00\x02"


class Builder:
    """A component while it is put together; what is made gets the next number of its sort."""

    def __init__(self) -> None:
        self.body = COMPONENT
        self.counts: dict[str, int] = {}
        self.types: dict[Type, int] = {}

    def next(self, sort: str) -> int:
        self.counts[sort] = self.counts.get(sort, -1) + 1
        return self.counts[sort]

    def add(self, sort: str, kind: int, item: bytes) -> int:
        """A section with one item; its number."""
        self.body += section(kind, item)
        return self.next(sort)

    def module(self, code: bytes) -> int:
        self.body += plain_section(1, code)
        return self.next("core module")

    # Types.

    def index(self, kind: Type) -> bytes:
        """What stands for a type within others; made now if it is new."""
        if isinstance(kind, str) and kind in encoding.PLAIN:
            return bytes([encoding.PLAIN[kind]])
        if kind not in self.types:
            self.types[kind] = self.type(encoding.defined(kind, self.index))
        return type_index(self.types[kind])

    def type(self, definition: bytes) -> int:
        return self.add("type", 7, definition)

    def function(self, parameters: tuple[tuple[str, Type], ...], result: Type | None) -> int:
        return self.type(encoding.function_type(parameters, result, self.index))

    # What there is elsewhere.

    def from_instance(self, sort: str, code: bytes, instance: int, name: str) -> int:
        return self.add(sort, 6, code + b"\x00" + number(instance) + text(name))

    def from_core(self, sort: str, code: bytes, instance: int, name: str) -> int:
        return self.add(sort, 6, code + b"\x01" + number(instance) + text(name))

    def imported(self, name: str, kind: int) -> int:
        self.add("instance", 10, b"\x00" + text(name) + b"\x05" + number(kind))
        return self.counts["instance"]

    def core_instance(self, module: int, **given: int) -> int:
        arguments = several(text(name) + b"\x12" + number(instance) for name, instance in given.items())
        return self.add("core instance", 2, b"\x00" + number(module) + arguments)

    def core_bundle(self, **items: tuple[bytes, int]) -> int:
        """Core things under names, as if a module offered them."""
        return self.add("core instance", 2, b"\x01" + several(text(name) + code[1:] + number(item) for name, (code, item) in items.items()))

    def offered(self, name: str, items: list[tuple[str, bytes, int]]) -> None:
        """An instance of these, which the component exports."""
        made = self.add("instance", 5, b"\x01" + several(b"\x00" + text(n) + sort + number(i) for n, sort, i in items))
        self.add("instance", 11, b"\x00" + text(name) + INSTANCE_SORT + number(made) + b"\x00")


def instance_type(definitions: list[bytes]) -> bytes:
    return b"\x42" + several(definitions)


def types_interface() -> bytes:
    """The type of the instance ``types``: every type, and its name."""
    made: dict[Type, int] = {}
    lines: list[bytes] = []

    def index(kind: Type) -> bytes:
        return bytes([encoding.PLAIN[kind]]) if kind in encoding.PLAIN else type_index(made[kind])

    for name, kind in interface.TYPES.items():
        lines.append(b"\x01" + encoding.defined(kind, index))
        # The name is a type anew, which later ones are made of.
        lines.append(b"\x04\x00" + text(name) + b"\x03\x00" + number(len(lines) - 1))
        made[name] = len(lines) - 1
    return instance_type(lines)


def callbacks_interface(status: int) -> bytes:
    """The type of the instance ``callbacks``, as far as the unit calls it: the type status and log-message."""
    names: dict[Type, int] = {"status": 1}

    def index(kind: Type) -> bytes:
        return bytes([encoding.PLAIN[kind]]) if kind in encoding.PLAIN else type_index(names[kind])

    return instance_type([
        b"\x02" + TYPE + b"\x02" + number(1) + number(status),
        b"\x04\x00" + text("status") + b"\x03\x00" + number(0),
        b"\x01" + encoding.function_type(interface.LOG_MESSAGE, None, index),
        b"\x04\x00" + text("log-message") + b"\x01" + number(2),
    ])  # fmt: skip


def component(core: bytes) -> bytes:
    """The component of a core module as ``linking`` makes it."""
    b = Builder()
    types = b.imported(PACKAGE.format("types"), b.type(types_interface()))
    for name in interface.USED:
        b.types[name] = b.from_instance("type", TYPE, types, name)
    callbacks = b.imported(PACKAGE.format("callbacks"), b.type(callbacks_interface(b.types["status"])))
    log = b.from_instance("function", FUNCTION, callbacks, "log-message")

    # The memory is a module of its own, so that the host's function can be given it before the unit's module is there.
    memory_instance = b.core_instance(b.module(encoding.memory_module(encoding.memory_pages(core))))
    memory = b.from_core("core memory", CORE_MEMORY, memory_instance, "memory")
    options = [b"\x00", b"\x03" + number(memory)]
    lowered = b.add("core function", 8, b"\x01\x00" + number(log) + several(options))
    unit = b.core_instance(b.module(core), env=memory_instance, callbacks=b.core_bundle(**{"log-message": (CORE_FUNCTION, lowered)}))

    of_unit = partial(b.from_core, "core function", CORE_FUNCTION, unit)
    resource = b.type(b"\x3f\x7f\x01" + number(of_unit("drop")))
    new_handle = b.add("core function", 8, b"\x02" + number(resource))
    between = b.core_instance(b.module(encoding.instantiating_module(12)), unit=b.core_bundle(**{
        "instantiate": (CORE_FUNCTION, of_unit("instantiate")), "new-handle": (CORE_FUNCTION, new_handle),
        "_initialize": (CORE_FUNCTION, of_unit("_initialize")), "memory": (CORE_MEMORY, memory),
    }))  # fmt: skip
    options += [b"\x04" + number(of_unit("cabi_realloc")), b"\x05" + number(of_unit("after_call"))]

    def lifted(core_function: int, kind: int) -> int:
        return b.add("function", 8, b"\x00\x00" + number(core_function) + several(options) + number(kind))

    b.offered(PACKAGE.format("common"), [("get-version", FUNCTION, lifted(of_unit("get-version"), b.function((), "string")))])
    b.types["do-step-result"] = b.type(encoding.defined(interface.DO_STEP_RESULT, b.index))
    b.types["dependency-kind"] = b.from_instance("type", TYPE, types, "dependency-kind")
    made = b.from_core("core function", CORE_FUNCTION, between, "instantiate")
    functions = {name: made if name == INSTANTIATE_NAME else of_unit(name) for name in signatures(resource)}
    given = {f"type-{name}": TYPE + number(b.types[name]) for name in (*interface.TYPES, "do-step-result")}
    given[f"type-{INSTANCE}"] = TYPE + number(resource)
    for name, (parameters, result) in signatures(resource).items():
        given[plain(name)] = FUNCTION + number(lifted(functions[name], b.function(parameters, result)))
    b.body += plain_section(4, naming_component())
    arguments = several(text(name) + item for name, item in given.items())
    instance = b.add("instance", 5, b"\x00" + number(b.next("component")) + arguments)
    b.add("instance", 11, b"\x00" + text(PACKAGE.format("co-simulation")) + INSTANCE_SORT + number(instance) + b"\x00")
    return b.body


INSTANTIATE_NAME = f"[static]{INSTANCE}.instantiate-co-simulation"


def signatures(resource: int) -> dict[str, tuple[tuple[tuple[str, Type], ...], Type]]:
    """The functions of the interface: name -> (parameters, result), where the instance is a type of this number."""
    methods = {
        f"[method]{INSTANCE}.{method}": ((("self", ("borrow", resource)), *parameters), result)
        for method, (parameters, result) in interface.METHODS.items()
    }
    return {INSTANTIATE_NAME: (interface.INSTANTIATE, ("option", ("own", resource))), **methods}


def plain(name: str) -> str:
    """A name without meaning, under which the component within takes a function."""
    return "function-" + name.translate({ord("["): None, ord("]"): "-", ord("."): "-"})


def naming_component() -> bytes:
    """A component within that gives back what it is given, under the names of the interface.

    Methods can be named after their resource only where that has been exported by its name.
    """
    b = Builder()

    def taken(name: str, description: bytes) -> None:
        b.body += section(10, b"\x00" + text(name) + description)

    for name, kind in (*interface.TYPES.items(), ("do-step-result", interface.DO_STEP_RESULT)):
        known = b.type(encoding.defined(kind, b.index))
        taken(f"type-{name}", TYPE + b"\x00" + number(known))
        b.types[name] = b.next("type")
    taken(f"type-{INSTANCE}", TYPE + b"\x01")
    resource = b.next("type")
    functions = {}
    for name, (parameters, result) in signatures(resource).items():
        taken(plain(name), FUNCTION + number(b.function(parameters, result)))
        functions[name] = b.next("function")
    given, b.types = b.types, {}
    for name in (*interface.USED, "do-step-result"):
        b.body += section(11, b"\x00" + text(name) + TYPE + number(given[name]) + b"\x00")
        b.types[name] = b.next("type")
    b.body += section(11, b"\x00" + text(INSTANCE) + TYPE + number(resource) + b"\x00")
    for name, (parameters, result) in signatures(b.next("type")).items():
        kind = b.function(parameters, result)
        b.body += section(11, b"\x00" + text(name) + FUNCTION + number(functions[name]) + b"\x01" + FUNCTION + number(kind))
        b.next("function")
    return b.body
