"""At which angle the input was locked, as heads and names of files say it: "Ingresso bloccato a 40°", "Eingang bei 40 Grad gesperrt"."""

import re
from collections.abc import Iterable, Sequence

from discrepancy.campaign.guess.state_words import BETWEEN, HELD, SHAFTS
from fmu_src.unit_words import NARROW, unit_of

# Words of which one at least leads to the angle: "gesperrt, 40°" may be a temperature.
LEADING = (
    r"at|a|à|auf|bei|in|en|su|al|all|alla|au|nella|pos|position|posizione|posici[óo]n|posi[çc][ãa]o|stellung|winkel|angle|angolo|[áâa]ngulo|em|einem|der|dem|un|une|l|la|the|an"
    r"|von|of|di|de"
)
AT = rf"(?:(?:{LEADING})\.? ){{1,4}}"
NUMBER = r"(?P<number>[+-]?\d+(?:\.\d+)?)"
NO_TEMPERATURE = r"(?! ?(?:c|f|celsius|fahrenheit|centigrad\w*)\b)"
ANGLE = rf"{NUMBER} ?(?P<unit>°|º|[^\W\d_]+)(?![\w/]){NO_TEMPERATURE}"
SHAFT = rf"\b(?:{SHAFTS['input']})\w*? ?(?:(?:{BETWEEN}|at) ){{0,3}}"
# Chinese and Japanese part no words.
EAST_ASIAN = "(?:输入|輸入|入力)(?:轴|軸|端|侧|側)?"
EAST_ASIAN_HELD = "(?:固定|锁死|锁定|鎖死|鎖定|拘束|ロック)"
EAST_ASIAN_ANGLE = rf"{NUMBER} ?(?P<unit>°|度|deg)(?!\w?[cC]\b)"
SAID = [
    re.compile(text)
    for text in (
        rf"{SHAFT}(?:{HELD}) {AT}{ANGLE}",
        # Without a word that leads to it a sign alone is no temperature's.
        rf"{SHAFT}(?:{HELD}) {NUMBER} ?(?P<unit>°|º|deg)(?![\w/]){NO_TEMPERATURE}",
        rf"\b(?:{HELD}) (?:{SHAFTS['input']})\w*? (?:{BETWEEN} ){{0,2}}{AT}{ANGLE}",
        rf"{SHAFT}{AT}{ANGLE} (?:{BETWEEN} ){{0,2}}(?:{HELD})\b",
        rf"{EAST_ASIAN}を?{EAST_ASIAN_HELD} ?(?:在|于|於|角度|位置|at) ?{EAST_ASIAN_ANGLE}",
        # Without a word that leads to it 度 may be of a temperature.
        rf"{EAST_ASIAN}を?{EAST_ASIAN_HELD} ?{NUMBER} ?(?P<unit>°|deg)(?!\w?[cC]\b)",
        rf"{EAST_ASIAN} ?(?:を|在|于|於)? ?{EAST_ASIAN_ANGLE} ?(?:处|處|で|に|の位置で)? ?{EAST_ASIAN_HELD}",
    )
]
# What was held is not named: only where something else says that it was the input.
HELD_AT = [re.compile(rf"\b(?:{HELD}) {AT}{ANGLE}"), re.compile(rf"\b{AT}{ANGLE} (?:{BETWEEN} ){{0,2}}(?:{HELD})\b")]
IN_NAME = re.compile(rf"(?<![\d.]){ANGLE}")
ANGLES = ("deg", "rad")
# Signs of a line that may say it; what is longer is data.
LONGEST = 200


def words_and_numbers(text: str) -> str:
    """In small letters, words and numbers parted by one blank each; a sign that leads to a value as the word "at"."""
    apart = re.sub(r"(?<=[a-zäöüßéè])(?=[A-ZÄÖÜÉ])", " ", text.translate(NARROW).replace("−", "-"))
    decimal = re.sub(r"(?<=\d),(?=\d)", ".", apart)
    led = re.sub(r"[:=@(]", " at ", decimal)
    return re.sub(r"\s+", " ", re.sub(r"[^\w°.+-]|_|(?<=[^\W_])-(?=[^\W_])", " ", led)).lower().strip()


def locked_angle(texts: Iterable[str]) -> str | None:
    """The angle of the input, as "40 deg"; None where nothing says one plainly, or several are said."""
    return only_angle(texts, SAID)


def held_angle(texts: Iterable[str]) -> str | None:
    """The same where no side is named: "locked at 90 deg"."""
    return only_angle(texts, HELD_AT)


def only_angle(texts: Iterable[str], patterns: Sequence[re.Pattern[str]]) -> str | None:
    plain = [words_and_numbers(text) for text in texts if len(text) <= LONGEST]
    found = {angle for text in plain for fits in patterns for match in fits.finditer(text) if (angle := angle_of(match))}
    return found.pop() if len(found) == 1 else None


def angle_named(name: str) -> str | None:
    """The one angle in a file's name, as "40 deg" of ``isteresi_40gradi``: of what it is, or whether it is a temperature, such a name does not say."""
    found = {angle for match in IN_NAME.finditer(words_and_numbers(name)) if (angle := angle_of(match))}
    return found.pop() if len(found) == 1 else None


def angle_of(match: re.Match[str]) -> str | None:
    known = unit_of(match["unit"])
    return f"{float(match['number']):g} {known[0]}" if known and known[0] in ANGLES else None
