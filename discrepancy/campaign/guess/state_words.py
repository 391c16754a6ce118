"""What names and heads of files say of the state of the reducer: which side is held, that nothing loads it."""

import re

from discrepancy.campaign.guess.column_words import SIDES

# What is held is a shaft: "Antrieb" is the input's.
SHAFTS = SIDES | {"input": SIDES["input"] + "|antrieb"}
HELD = (
    r"locked|fixed|blocked|clamped|held|gesperrt\w*|blockiert\w*|fest|festgehalten\w*|festgesetzt\w*|arretiert\w*|geklemmt\w*|bloqu[ée]\w*|verrouill[ée]\w*"
    r"|immobilis[ée]\w*|bloccat[oa]|ferm[oa]|fiss[oa]|fissat[oa]|fij[oa]|fijad[oa]|travad[oa]|fix[oa]|fixad[oa]"
)
# Between a side and what was done to it.
BETWEEN = r"(?:shaft|side|end|seite|welle|ist|is|was|war|wurde|mechanisch|est|è|está)"
EAST_ASIAN = {
    "input": "(?:输入|輸入|入力)(?:轴|軸|端|侧|側)?を?(?:固定|锁死|锁定|鎖死|鎖定|拘束|ロック)",
    "output": "(?:输出|輸出|出力)(?:轴|軸|端|侧|側)?を?(?:固定|锁死|锁定|鎖死|鎖定|拘束|ロック)",
}  # fmt: skip
IS_HELD = {
    side: re.compile(rf"\b(?:{words})\w*? ?(?:{BETWEEN} ){{0,3}}(?:{HELD})\b|\b(?:{HELD}) (?:{words})|{EAST_ASIAN[side]}") for side, words in SHAFTS.items()
}  # fmt: skip
UNLOADED = re.compile(
    r"\b(?:ohne (?:äußere |externe )?(?:last|belastung)|lastfrei|lastlos|unbelastet|leerlauf\w*"
    r"|sans charge|[àa] vide|senza carico|a vuoto|sin carga|en vac[íi]o|sem carga|em vazio"
    r"|no load|unloaded|without (?:a |any |external )?load)\b|空载|空載|无负载|無負荷"
)


def plainly(text: str) -> str:
    """In small letters, words parted by one blank each: ``Antrieb_gesperrt`` as ``antrieb gesperrt``."""
    apart = re.sub(r"(?<=[a-zäöüßéè])(?=[A-ZÄÖÜÉ])", " ", text)
    return re.sub(r"[\W_]+", " ", apart).lower().strip()


def locked_side(text: str) -> str | None:
    """``input`` or ``output``; None where nothing is said, or both."""
    said = [side for side, held in IS_HELD.items() if held.search(plainly(text))]
    return said[0] if len(said) == 1 else None


def unloaded(text: str) -> bool:
    return UNLOADED.search(plainly(text)) is not None
