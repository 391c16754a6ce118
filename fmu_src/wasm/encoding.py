"""The binary format of WebAssembly modules and components, as far as a unit needs it.

WebAssembly core specification 3.0, section 5; component model, ``design/mvp/Binary.md``.
"""

from collections.abc import Callable, Iterable

from fmu_src.wasm.interface import Type

PLAIN = {
    "bool": 0x7F, "s8": 0x7E, "u8": 0x7D, "s16": 0x7C, "u16": 0x7B, "s32": 0x7A, "u32": 0x79, "s64": 0x78, "u64": 0x77, "f32": 0x76,
    "f64": 0x75, "char": 0x74, "string": 0x73,
}  # fmt: skip
MODULE = b"\0asm\x01\0\0\0"
COMPONENT = b"\0asm\x0d\0\x01\0"


def number(value: int) -> bytes:
    """LEB128, unsigned."""
    made = bytearray()
    while True:
        value, low = value >> 7, value & 0x7F
        made.append(low | (0x80 if value else 0))
        if not value:
            return bytes(made)


def type_index(value: int) -> bytes:
    """A number of a type where a plain type could stand as well: LEB128, signed."""
    made = bytearray()
    while True:
        value, low = value >> 7, value & 0x7F
        ends = value == 0 and not low & 0x40
        made.append(low if ends else low | 0x80)
        if ends:
            return bytes(made)


def text(name: str) -> bytes:
    return number(len(name.encode())) + name.encode()


def several(items: Iterable[bytes]) -> bytes:
    listed = list(items)
    return number(len(listed)) + b"".join(listed)


def section(kind: int, *items: bytes) -> bytes:
    body = several(items)
    return bytes([kind]) + number(len(body)) + body


def plain_section(kind: int, body: bytes) -> bytes:
    return bytes([kind]) + number(len(body)) + body


def defined(kind: Type, index: Callable[[Type], bytes]) -> bytes:
    """The definition of a type that is made of others; ``index`` gives what stands for these."""
    match kind:
        case ("list", of):
            return b"\x70" + index(of)
        case ("option", of):
            return b"\x6b" + index(of)
        case ("result", well, refused):
            return b"\x6a\x01" + index(well) + b"\x01" + index(refused)
        case ("tuple", *items):
            return b"\x6f" + several(index(item) for item in items)
        case ("record", *fields):
            return b"\x72" + several(text(name) + index(of) for name, of in fields)
        case ("enum", *names):
            return b"\x6d" + several(map(text, names))
        case ("own", int(resource)):
            return b"\x69" + number(resource)
        case ("borrow", int(resource)):
            return b"\x68" + number(resource)
    return index(kind)


def function_type(parameters: Iterable[tuple[str, Type]], result: Type | None, index: Callable[[Type], bytes]) -> bytes:
    given = b"\x01\x00" if result is None else b"\x00" + index(result)
    return b"\x40" + several(text(name) + index(kind) for name, kind in parameters) + given


# Of core modules.

I32, I64, F64 = 0x7F, 0x7E, 0x7C


def memory_module(pages: int) -> bytes:
    """A module that is nothing but memory, which others import: ``memory``."""
    memory = section(5, b"\x00" + number(pages))
    return MODULE + memory + section(7, text("memory") + b"\x02" + number(0))


def memory_pages(module: bytes) -> int:
    """How much memory a module wants to import [64 KiB]."""
    for kind, body in sections(module):
        if kind == 2:
            place = body.index(text("env") + text("memory")) + len(text("env") + text("memory"))
            # The sort (2: memory), the flags of the limits, the least.
            return read_number(body, place + 2)[0]
    raise ValueError("a module that imports no memory")


def sections(module: bytes) -> Iterable[tuple[int, bytes]]:
    place = len(MODULE)
    while place < len(module):
        kind = module[place]
        size, place = read_number(module, place + 1)
        yield kind, module[place : place + size]
        place += size


def read_number(data: bytes, place: int) -> tuple[int, int]:
    """(value, where it ends)."""
    value = shift = 0
    while True:
        byte = data[place]
        place += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if not byte & 0x80:
            return value, place


def instantiating_module(parameters: int) -> bytes:
    """A module between the host and ``instantiate``: makes a handle of what the unit gives back, and starts the unit's module.

    What comes back is an address: a mark (1 if there is an instance) and four bytes on what the handle stands for.
    """
    types = section(
        1, b"\x60" + several([bytes([I32])] * parameters) + several([bytes([I32])]), b"\x60" + several([bytes([I32])]) + several([bytes([I32])]),
        b"\x60\x00\x00",
    )  # fmt: skip
    imports = section(
        2, text("unit") + text("instantiate") + b"\x00" + number(0), text("unit") + text("new-handle") + b"\x00" + number(1),
        text("unit") + text("_initialize") + b"\x00" + number(2), text("unit") + text("memory") + b"\x02\x00" + number(1),
    )  # fmt: skip
    functions = section(3, number(0))
    exports = section(7, text("instantiate") + b"\x00" + number(3))
    start = plain_section(8, number(2))
    result = number(parameters)
    code = (
        several([number(1) + bytes([I32])])
        + b"".join(b"\x20" + number(i) for i in range(parameters)) + b"\x10" + number(0) + b"\x22" + result  # call, keep the address
        + b"\x2d\x00\x00\x04\x40"  # load the mark, if
        + b"\x20" + result + b"\x20" + result + b"\x28\x02\x04" + b"\x10" + number(1) + b"\x36\x02\x04"  # handle in place of the address
        + b"\x0b\x20" + result + b"\x0b"
    )  # fmt: skip
    return MODULE + types + imports + functions + exports + start + section(10, number(len(code)) + code)
