"""Encodings of a text, from its first bytes."""

import codecs
import re

# Bytes of GB 2312's symbols and common characters, and of kana and common characters in Shift JIS: both bytes, or the first.
HIGH = re.compile(rb"[\x80-\xff]+")
COMMON_CHINESE = re.compile(rb"(?:[\xa1-\xd7][\xa1-\xfe])+")
COMMON_JAPANESE = re.compile(rb"[\x00-\x7f]*(?:[\x81-\x98][\x40-\x7e\x80-\xfc][\x00-\x7f]*)+")


def encodings_of(beginning: bytes) -> tuple[str, ...]:
    """Encodings to try in turn on a file that begins so.

    UTF-8 where the file is; else what Windows programs write: "Unicode text" (UTF-16), in Europe Windows-1252 (micro and degree signs,
    single letters between plain ones), in China GB 18030, in Japan Shift JIS (pairs of bytes, by which they are known).
    """
    if beginning.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return ("utf-16",)
    if len(pairs := HIGH.findall(beginning)) and all(COMMON_CHINESE.fullmatch(pair) for pair in pairs):
        return ("utf-8-sig", "gb18030", "cp1252")
    if COMMON_JAPANESE.fullmatch(beginning):
        return ("utf-8-sig", "cp932", "cp1252")
    return ("utf-8-sig", "cp1252")
