"""What a column means by its name: words of the field in English, German, French as far as benches write it, Chinese and Japanese."""

import re

# Words of either side that mean it wherever they stand; "Antrieb" is the whole drive, too.
SIDES = {"input": r"input|mot(?:o|eu)r|rotor|(?<![a-z])entr[ée]e|eingang|drive", "output": r"output|sortie|abtrieb|ausgang"}
INPUT = SIDES["input"] + r"|antrieb(?!$)|(?<=[ _.-])antrieb|servo|输入|電機|电机|入力|モータ|(?:^|[ _.-])(?:in|an|mot)(?:$|[ _.-])"
OUTPUT = SIDES["output"] + r"|输出|出力|負荷側|(?:^|[ _.-])(?:out|ab|load side)(?:$|[ _.-])"

# Meaning -> words; the first that fits counts.
MEANINGS = {
    "replicate": r"^(?:rep|replicate|repetition|wiederholung|wdh|重复|重複|繰返し?)(?:$|[ _.-])"
    r"|^(?:test|run|lauf|versuch|cycle|essai)[ _.-]?(?:nr|no|num|number|id)\b",
    "hours": r"hours|stunden|heures|laufzeit|operating time|运行时间|運転時間|小时数",
    "stiffness": r"stiff|steif|raideur|rigidit|刚度|剛度|剛性",
    "efficiency": r"efficien|wirkungsgrad|rendement|效率|^eta$|^η$",
    "lost_motion": r"lost.?motion|verlust|空程|ロストモーション",
    "error": r"error|fehler|erreur|[ée]cart|abweich|deviation|误差|誤差|(?:^|[ _.-])(?:te|tf|err|dphi|delta)(?:$|[ _.-])|Δ",
    "wear": r"wear|depth|usure|profondeur|verschlei|tiefe|abtrag|磨损|磨耗|摩耗|深度|深さ",
    "mass_loss": r"mass.?loss|massenverlust|weight.?loss|质量损失|質量損失",
    "iron": r"iron|eisen|(?:^|[ _.-])fe(?:$|[ _.-])|铁|鉄",
    "order": r"^ordre|^order|ordnung|阶次|次数",
    "acceleration": r"acc|beschl|vibra|schwing|加速度|振动|振動",
    "temperature": r"temp(?!s(?![a-z]))|温度",
    "speed": r"speed|veloc|vitesse|drehzahl|geschw|rpm|转速|轉速|回転|(?:^|[ _.-])n(?:$|[ _.-])|(?:^|[ _.-])omega",
    "torque": r"torq|moment|drehm|(?<![a-z])couple(?![a-z])|扭矩|转矩|轉矩|力矩|トルク|负载|負荷"
    r"|(?:^|[ _.-])(?:m|md|t|load|last)(?:$|[ _.-])(?!.*time)",
    "twist": r"twist|torsion|verdreh|wind.?up|deflect|hyst[eé]r|spiel|backlash|(?<![a-z])jeu(?![a-z])"
    r"|^turn(?:ing)?(?:$|[ _.-])|扭转|扭轉|回差|变形|ねじれ|ヒステリシス",
    "angle": r"angle|winkel|rotorlage|codeur|phi|theta|φ|θ|ϕ|encoder|geber|(?:^|[ _.-])(?:enc|pos|position|rotation)(?:$|[ _.-])|posit|角|回転角",
    "time": r"time|zeit|(?<![a-z])temps(?![a-z])|时间|時間|uhr|clock|(?:^|[ _.-])t(?:$|[ _.-])|timestamp|时刻|時刻",
}  # fmt: skip
FITS = {meaning: re.compile(words, re.IGNORECASE) for meaning, words in MEANINGS.items()}
AT_INPUT, AT_OUTPUT = re.compile(INPUT, re.IGNORECASE), re.compile(OUTPUT, re.IGNORECASE)

# Quantity -> words of a file's name or of lines above its table.
QUANTITY_WORDS = {
    "transmission_error": r"te|tf|err|erreur(?:.de.transmission)?|transmission.?error|übertragungsfehler|uebertragungsfehler|drehfehler"
    r"|传动误差|傳動誤差|角度伝達誤差",
    "hysteresis": r"loops?|schleifen?|boucles?|hyst|hyst[ée]r[ée]sis|hysterese|hystereses|ramps?|torqueramp|rampe"
    r"|stiff(?:ness)?|raideur|rigidit[ée]|steifigkeit|回差|滞回|刚度|ヒステリシス",
    "wear_profile": r"profiles?|wear.?profile|profil|verschlei(?:ß|ss)profil|轮廓",
    "wear_depth": r"wear|depths?|wear.?depth|usure|verschlei(?:ß|ss)|磨损|摩耗",
    "no_load_torque": r"no.?load.?torque|leerlauf(?:moment)?|couple.[àa].vide|空载(?:转矩|扭矩)?|無負荷",
    "input_torque": r"torque|friction|reibung|frottement|drag|couple|input.?torque|antriebsmoment|moment|扭矩|摩擦|トルク",
    "lost_motion": r"lost.?motion|空程", "efficiency": r"efficiency|wirkungsgrad|rendement|效率", "temperature": r"temp[ée]ratur(?:e)?|temp|温度",
    "vibration": r"vib(?:ration)?|acc(?:eleration)?|schwingung|振动|振動", "vibration_order": r"orders?|vibration.?order|ordnung|阶次",
    "cage_speed": r"cages?|cage.?speed|käfig|kaefig|保持架",
}  # fmt: skip
IN_NAMES = {q: re.compile(rf"(?<![^\W\d_])(?:{words})(?![^\W\d_])", re.IGNORECASE) for q, words in QUANTITY_WORDS.items()}
SURFACES = {
    "inner_race": r"inner.?(?:race|ring)|innenring|内圈|内輪", "outer_race": r"outer.?(?:race|ring)|außenring|aussenring|外圈|外輪",
    "flank": r"flank|flanke|tooth|zahn|齿面|歯面|摆线", "pin": r"pins?|bolzen|针齿|ピン",
}  # fmt: skip
ON_SURFACE = {name: re.compile(rf"(?<![^\W\d_])(?:{words})(?![^\W\d_])", re.IGNORECASE) for name, words in SURFACES.items()}


def meaning_of(name: str) -> str | None:
    """``input_angle``, ``output_speed``, ``input_torque``, or one of MEANINGS; None if the name says nothing."""
    name = re.sub(r"(?<=[a-zäöü])(?=[A-ZÄÖÜ])", " ", name)
    found = next((meaning for meaning, words in FITS.items() if words.search(name)), None)
    if found in ("angle", "speed", "torque") and AT_INPUT.search(name) and not AT_OUTPUT.search(name):
        return f"input_{found}"
    return "output_speed" if found == "speed" and AT_OUTPUT.search(name) else found


def quantities_named(text: str) -> list[str]:
    """Quantities that a file's name speaks of, the longest word first; a word within a longer one (no-load torque) speaks of nothing else."""
    words = sorted(((-len(m[0]), m.span(), quantity) for quantity, fits in IN_NAMES.items() for m in fits.finditer(text)), key=lambda word: word[0])
    apart = [q for k, (_, (first, end), q) in enumerate(words) if not any(f <= first and end <= e and (f, e) != (first, end) for _, (f, e), _ in words[:k])]
    return list(dict.fromkeys(apart))


def surface_named(text: str) -> str | None:
    return next((surface for surface, words in ON_SURFACE.items() if words.search(text)), None)
