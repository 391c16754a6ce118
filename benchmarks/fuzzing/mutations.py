"""Mutants of a file: bytes, tokens and lines changed, and pieces of what readers stumble upon put in."""

import random
import re

NUMBERS = (b"0", b"-1", b"1e308", b"-1e308", b"1e400", b"1e-320", b"nan", b"inf", b"-inf", b"9999999999999999999999", b"-9223372036854775809", b"4294967296",
           b"2147483648", b"9" * 5000, b"0x7fffffff", b"1_000", b"1,5", b"0.1.2", b"+", b"")  # fmt: skip
VALUES = (b'""', b'"x"', b"[]", b"{}", b"true", b"false", b"[[]]", b"[{}]", b'["a", 1]', b"{ value = 1 }", b'{ value = 1, unit = "m" }', b"1979-05-27", b"07:32:00",
          b'"../../x"', b'"/etc/passwd"', b'"C:\\\\x"', b'"\\u0000"', b'"' + b"a" * 3000 + b'"', b"[" * 100 + b"]" * 100, b'"9**9**9**9"', b'"m**9**9**9"',
          b'"1/0"', b'"N.m.m.m/s/s"', b"'''", b'"RV20E-121"', b'"BX-40E"', b'"nan m"', b'"1e308 km"', b'"um"', b'"degC"')  # fmt: skip
PIECES = (b"\xff\xfe", b"\x00", b"\xef\xbb\xbf", b"\r", b"\n", b"\xc3", b"\xed\xa0\x80", b"<", b">", b"&amp;", b"&#0;", b"]]>", b"<!--", b"<!DOCTYPE a [<!ENTITY b 'c'>]>", b"&b;",
          b"=", b"[", b"]]", b"{", b"}", b'"', b"'", b"#", b";", b",", b"..", b"/", b"\\", b"%00", b"%2e%2e%2f")  # fmt: skip
NUMBER = re.compile(rb"-?\d+\.?\d*(?:[eE][+-]?\d+)?")
VALUE = re.compile(rb"(?<==)[ ]*(?:\{[^}\n]*\}|\[[^\]\n]*\]|\"[^\"\n]*\"|[^\s,}\]]+)")
WORD = re.compile(rb"[A-Za-z_]{3,}")


def mutant(seed: bytes, others: list[bytes], chance: random.Random) -> bytes:
    """One to a few changes, most often one: a fault behind a fault is not seen."""
    data = seed
    for _ in range(chance.choice((1, 1, 1, 1, 2, 2, 3, 6))):
        data = chance.choice(CHANGES)(data, others, chance)
    return data[:2_000_000]


def replaced(pattern: "re.Pattern[bytes]", pieces: tuple[bytes, ...], data: bytes, chance: random.Random) -> bytes:
    found = list(pattern.finditer(data[:200_000]))
    if not found:
        return flip(data, [], chance)
    where = chance.choice(found)
    return data[: where.start()] + chance.choice(pieces) + data[where.end() :]


def number(data: bytes, _: list[bytes], chance: random.Random) -> bytes:
    return replaced(NUMBER, NUMBERS, data, chance)


def value(data: bytes, _: list[bytes], chance: random.Random) -> bytes:
    return replaced(VALUE, VALUES + NUMBERS, data, chance)


def word(data: bytes, others: list[bytes], chance: random.Random) -> bytes:
    """Another word of the same or another file, or the word misspelt."""
    words = WORD.findall(chance.choice([data, *others])[:200_000]) or [b"x"]
    found = list(WORD.finditer(data[:200_000]))
    if not found:
        return flip(data, others, chance)
    where = chance.choice(found)
    old = where[0]
    new = chance.choice(words) if chance.random() < 0.6 else old[:-1] if chance.random() < 0.5 else old + old[-1:]
    return data[: where.start()] + new + data[where.end() :]


def flip(data: bytes, _: list[bytes], chance: random.Random) -> bytes:
    if not data:
        return b"\x00"
    changed = bytearray(data)
    for _time in range(chance.choice((1, 1, 2, 8))):
        place = chance.randrange(len(changed)) if chance.random() < 0.5 else chance.randrange(min(len(changed), 2000))
        changed[place] = changed[place] ^ (1 << chance.randrange(8)) if chance.random() < 0.5 else chance.choice((0, 1, 127, 128, 255, chance.randrange(256)))
    return bytes(changed)


def word_of_bytes(data: bytes, _: list[bytes], chance: random.Random) -> bytes:
    """Lengths, counts and addresses of binary formats."""
    width = chance.choice((2, 4, 8))
    if len(data) <= width:
        return data + b"\xff"
    place = chance.randrange(len(data) - width)
    new = chance.choice((0, 1, -1, 2 ** (8 * width - 1) - 1, len(data), len(data) + 1, place, chance.randrange(1 << 16), 1 << 30)) % (1 << 8 * width)
    return data[:place] + new.to_bytes(width, "little") + data[place + width :]


def cut(data: bytes, _: list[bytes], chance: random.Random) -> bytes:
    if chance.random() < 0.3:
        return data[: chance.randrange(len(data) + 1)]
    start, length = chance.randrange(len(data) + 1), chance.choice((1, 4, 16, 100, 1000))
    return data[:start] + data[start + length :]


def put(data: bytes, _: list[bytes], chance: random.Random) -> bytes:
    place = chance.randrange(len(data) + 1)
    return data[:place] + chance.choice(PIECES + VALUES + NUMBERS) + data[place:]


def rows_changed(data: bytes, others: list[bytes], chance: random.Random) -> bytes:
    """A line twice, away, elsewhere, or one of another file."""
    rows = data.split(b"\n")
    k = chance.randrange(len(rows))
    match chance.randrange(4):
        case 0:
            rows.insert(chance.randrange(len(rows) + 1), rows[k])
        case 1:
            del rows[k]
        case 2:
            rows.insert(chance.randrange(len(rows)), rows.pop(k))
        case _:
            rows.insert(k, chance.choice(chance.choice([data, *others]).split(b"\n")))
    return b"\n".join(rows)


def splice(data: bytes, others: list[bytes], chance: random.Random) -> bytes:
    other = chance.choice([data, *others])
    return data[: chance.randrange(len(data) + 1)] + other[chance.randrange(len(other) + 1) :]


CHANGES = (number, number, value, value, value, word, word, flip, flip, word_of_bytes, cut, put, put, rows_changed, rows_changed, splice)
