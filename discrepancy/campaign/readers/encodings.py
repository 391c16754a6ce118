"""Encodings of a text, from its first bytes."""

import codecs
import re

# Bytes of GB 2312's symbols and common characters, and of kana and common characters in Shift JIS: both bytes, or the first.
HIGH = re.compile(rb"[\x80-\xff]+")
COMMON_CHINESE = re.compile(rb"(?:[\xa1-\xd7][\xa1-\xfe])+")
COMMON_JAPANESE = re.compile(rb"[\x00-\x7f]*(?:[\x81-\x98][\x40-\x7e\x80-\xfc][\x00-\x7f]*)+")


# Of every second byte so many are zero at least where digits and delimiters have two bytes, and names of columns may be Chinese (assumed).
ZEROS = 0.3


def encodings_of(beginning: bytes) -> tuple[str, ...]:
    """Encodings to try in turn on a file that begins so.

    UTF-8 where the file is; else what Windows programs write: "Unicode text" (UTF-16, by some without a mark of its order of bytes), in Europe
    Windows-1252 (micro and degree signs, single letters between plain ones), in China GB 18030, in Japan Shift JIS (pairs of bytes, by which they
    are known).
    """
    if beginning.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return ("utf-16",)
    if unmarked := unmarked_utf16(beginning):
        return (unmarked,)
    if len(pairs := HIGH.findall(beginning)) and all(COMMON_CHINESE.fullmatch(pair) for pair in pairs):
        return ("utf-8-sig", "gb18030", "cp1252")
    if COMMON_JAPANESE.fullmatch(beginning):
        return ("utf-8-sig", "cp932", "cp1252")
    return ("utf-8-sig", "cp1252")


def unmarked_utf16(beginning: bytes) -> str:
    """UTF-16 without a byte order mark, by which of each pair of bytes is zero: none is in a text of single bytes; empty if it is none."""
    first, second = (half.count(0) / max(1, len(half)) for half in (beginning[::2], beginning[1::2]))
    return "utf-16-be" if first > ZEROS and not second else "utf-16-le" if second > ZEROS and not first else ""


# What ``encodings_of`` tells of a file: nobody need state it.
FOUND = ("utf-8-sig", "utf-16", "utf-16-be", "utf-16-le", "cp1252", "gb18030", "cp932")
