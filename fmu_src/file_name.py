"""Names as parts of file names: in whatever language, without the signs that a system takes for others."""

import re
import unicodedata

# No folder, nothing that a system refuses, and no hidden file.
FILE_NAME = r'^[^\s./\\:*?"<>|\x00-\x1f][^/\\:*?"<>|\x00-\x1f]*$'
REFUSED = re.compile(r'[/\\:*?"<>|]')
# Of a name at most so many signs and bytes: systems take 255 of these, of which an ending needs some.
MOST_SIGNS, MOST_BYTES = 100, 200


def file_name(text: str) -> str:
    """The text with ``_`` for each sign that no file's name can have; ``unnamed`` where nothing is left."""
    plain = "".join(c if c.isprintable() and not REFUSED.match(c) else "_" for c in unicodedata.normalize("NFC", text))
    short = plain.strip(" .")[:MOST_SIGNS].encode()[:MOST_BYTES].decode(errors="ignore")
    return short or "unnamed"


def name_of_folder(folder: str) -> str:
    """A folder's name as the name of the campaign in it, which begins with no sign."""
    return file_name(folder).lstrip(" ._-") or "campaign"
