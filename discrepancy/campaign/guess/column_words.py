"""What a column means by its name: words of the field as benches write them in English, German, French, Italian, Spanish,
Portuguese, Chinese and Japanese."""

import re

# Words of either side that mean it wherever they stand; "Antrieb" is the whole drive, too; the slow and the fast shaft are Romance words for them.
SIDES = {
    "input": r"input|mot(?:o|eu)r|rotor|(?<![a-z])entr[ée]e|entrada|entrata|ingresso|eingang|drive|(?:arbre|albero|eje) (?:rapide|veloce|r[áa]pido)",
    "output": r"output|sortie|salida|sa[íi]da|uscita|abtrieb|ausgang|(?:arbre|albero|eje) lent[oe]?(?![a-z])",
}  # fmt: skip
INPUT = SIDES["input"] + r"|antrieb(?!$)|(?<=[ _.-])antrieb|servo|输入|輸入|電機|电机|马达|入力|モータ|(?:^|[ _.-])(?:in|an|mot)(?:$|[ _.-])"
OUTPUT = SIDES["output"] + r"|输出|輸出|出力|負荷側|(?:^|[ _.-])(?:out|ab|load side)(?:$|[ _.-])"

# Meaning -> words; the first that fits counts.
MEANINGS = {
    "replicate": r"^(?:rep|replicate|repetition|wiederholung|wdh|r[ée]p[ée]tition|ripetizione|repetici[óo]n|repeti[çc][ãa]o|重复|重複|繰返し?)(?:$|[ _.-])"
    r"|^(?:test|run|lauf|versuch|cycle|essai|prova|ensayo|prueba|ensaio|teste)[ _.-]?(?:nr|no|num|number|id|n°|nº)(?![a-z])",
    "hours": r"hours|stunden|laufzeit|operating time|heures|horas|(?<![a-z])ore(?![a-z])|运行时间|運轉時間|運転時間|小时数",
    "stiffness": r"stiff|steif|raideur|rigidit|rigidez|刚度|剛度|剛性",
    "efficiency": r"efficien|wirkungsgrad|rendement|rendim|效率|効率|^eta$|^η$",
    "lost_motion": r"lost.?motion|verlust|mouvement perdu|movimento perso|movimi?ento perdido|空程|ロストモーション",
    "error": r"error|erreur|[ée]cart|fehler|abweich|deviation|deviazione|desviaci[óo]n|desvio|(?<![a-z])erro(?![a-z])|误差|誤差|偏差"
    r"|(?:^|[ _.-])(?:te|tf|err|dphi|delta)(?:$|[ _.-])|Δ",
    "wear": r"wear|depth|verschlei|tiefe|abtrag|usur[ea]|desgaste|profondeur|profondit|profundidad|磨损|磨損|磨耗|摩耗|深度|深さ",
    "mass_loss": r"mass.?loss|massenverlust|weight.?loss|perte de masse|perdita di massa|p[ée]rdida de masa|perda de massa|质量损失|質量損失",
    "iron": r"iron|eisen|hierro|ferro(?![a-z])|(?:^|[ _.-])(?:fe|fer)(?:$|[ _.-])|铁|鉄",
    "order": r"^order|ordnung|^(?:ordre|ordine|orden|ordem)(?![a-z])|阶次|階次|次数",
    "acceleration": r"acc|beschl|vibra|schwing|加速度|振动|振動",
    # Not what French and Italian call time.
    "temperature": r"temp(?!s(?![a-z])|o(?![a-z]))|温度|溫度|油温|油溫|室温|室溫|気温",
    "speed": r"speed|veloc|vitesse|drehzahl|geschw|rpm|r[ée]gime|numero (?:di )?giri|revoluciones|(?<!de )rota[çc](?:[ãa]o|[õo]es)|转速|轉速|回転(?!角)|速度"
    r"|(?:^|[ _.-])n(?:$|[ _.-])|(?:^|[ _.-])omega",
    "torque": r"torq|moment|drehm|(?<![a-z])couple(?![a-z])|coppia|(?<![a-z])bin[áa]rio|^par(?:$|[ _.-])|扭矩|转矩|轉矩|力矩|トルク|负载|負載|負荷(?!側)"
    r"|(?:^|[ _.-])(?:m|md|t|load|last|charge|carico|carga)(?:$|[ _.-])(?!.*time)",
    "twist": r"twist|torsi[oó]n|verdreh|wind.?up|deflect|hyst|hist[ée]res|isteresi|spiel|backlash|(?<![a-z])jeu(?![a-z])|gioco|juego"
    r"|(?<![a-z])folga(?![a-z])|tor[çc][ãa]o|^turn(?:ing)?(?:$|[ _.-])|扭转|扭轉|回差|滞回|变形|變形|ねじれ|ヒステリシス",
    "angle": r"angle|angol|[áâa]ngul|winkel|rotorlage|phi|theta|φ|θ|ϕ|encoder|codeur|geber"
    r"|(?:^|[ _.-])(?:enc|pos|position|rotation)(?:$|[ _.-])|posi[tzcç]|角|回転角",
    "time": r"time|zeit|temps|tempo|tiempo|时间|時間|uhr|clock|(?:^|[ _.-])t(?:$|[ _.-])|timestamp|时刻|時刻",
}  # fmt: skip
FITS = {meaning: re.compile(words, re.IGNORECASE) for meaning, words in MEANINGS.items()}
# An angle of the input that was divided already, and so turns as the output does.
OVER_RATIO = re.compile(
    r"[/÷]\s*(?:i|n|u|ratio|r[áa]tio|rapport|rapporto|relaci[óo]n|[üu]bersetzung|减速比|減速比|\d{2,3}(?:[.,]\d+)?)\s*(?:$|[\[(,;])"
    r"|over (?:the )?ratio|divided by (?:the )?ratio", re.IGNORECASE)  # fmt: skip
AT_INPUT, AT_OUTPUT = re.compile(INPUT, re.IGNORECASE), re.compile(OUTPUT, re.IGNORECASE)

# Quantity -> words of a file's name or of lines above its table.
QUANTITY_WORDS = {
    "transmission_error": r"te|tf|err|transmission.?error|übertragungsfehler|uebertragungsfehler|drehfehler|erreur(?:.(?:de.)?transmission)?"
    r"|errore(?:.(?:di.)?trasmissione)?|error(?:.(?:de.)?transmisi[óo]n)?|erro(?:.(?:de.)?transmiss[ãa]o)?|传动误差|傳動誤差|角度伝達誤差",
    "hysteresis": r"loops?|schleifen?|boucles?|hyst|hysteresis|hysterese|hystereses|hyst[ée]r[ée]sis|isteresi|hist[ée]resis|histerese"
    r"|ramps?|torqueramp|rampe|rampa"
    r"|stiff(?:ness)?|steifigkeit|raideur|rigidit[éeà]|rigidezza|rigidez|回差|滞回|刚度|剛性|ヒステリシス",
    "wear_profile": r"profiles?|wear.?profile|profilo?|perfil|verschlei(?:ß|ss)profil|轮廓",
    "wear_depth": r"wear|depths?|wear.?depth|verschlei(?:ß|ss)|usur[ea]|desgaste|磨损|摩耗",
    "no_load_torque": r"no.?load.?torque|leerlauf(?:moment)?|couple.[àa].vide|coppia.a.vuoto|par.en.vac[íi]o"
    r"|(?:torque|bin[áa]rio).(?:em.vazio|sem.carga)|空载(?:转矩|扭矩)?|無負荷(?:トルク)?",
    "input_torque": r"torque|friction|reibung|drag|input.?torque|antriebsmoment|moment|couple|frottement|coppia|attrito|rozamiento"
    r"|fricci[óo]n|bin[áa]rio|atrito|扭矩|摩擦|トルク",
    "lost_motion": r"lost.?motion|movimento.perdido|空程|ロストモーション", "efficiency": r"efficiency|wirkungsgrad|rendement|rendimento|rendimiento|效率|効率",
    "temperature": r"temperatur[ea]?|temp[ée]rature|temp|温度",
    "vibration": r"vib(?:rations?)?|acc(?:eleration)?|schwingung|vibrazion[ei]|vibraci[óo]n|vibra[çc](?:[ãa]o|[õo]es)|振动|振動",
    "vibration_order": r"orders?|vibration.?order|ordnung|ordres?|ordini|ordens|阶次",
    "cage_speed": r"cages?|cage.?speed|käfig|kaefig|gabbia|jaula|gaiola|保持架",
}  # fmt: skip
IN_NAMES = {q: re.compile(rf"(?<![^\W\d_])(?:{words})(?![^\W\d_])", re.IGNORECASE) for q, words in QUANTITY_WORDS.items()}
SURFACES = {
    "inner_race": r"inner.?(?:race|ring)|innenring|bague.int[ée]rieure|anello.interno|anillo.interior|anel.interno|内圈|内輪",
    "outer_race": r"outer.?(?:race|ring)|außenring|aussenring|bague.ext[ée]rieure|anello.esterno|anillo.exterior|anel.externo|外圈|外輪",
    "flank": r"flank|flanke|tooth|zahn|flanc|fianco|flanco|齿面|歯面|摆线", "pin": r"pins?|bolzen|perno|pinos?|针齿|ピン",
}  # fmt: skip
ON_SURFACE = {name: re.compile(rf"(?<![^\W\d_])(?:{words})(?![^\W\d_])", re.IGNORECASE) for name, words in SURFACES.items()}


def meaning_of(name: str) -> str | None:
    """``input_angle``, ``output_speed``, ``input_torque``, or one of MEANINGS; None if the name says nothing."""
    name = re.sub(r"(?<=[a-zäöüßéè])(?=[A-ZÄÖÜÉ])", " ", name)
    found = next((meaning for meaning, words in FITS.items() if words.search(name)), None)
    if found == "angle" and over_ratio(name):
        return "angle"
    if found in ("angle", "speed", "torque") and AT_INPUT.search(name) and not AT_OUTPUT.search(name):
        return f"input_{found}"
    return "output_speed" if found == "speed" and AT_OUTPUT.search(name) else found


def says_output(name: str) -> bool:
    """Whether a name says that something is the output's."""
    return bool(AT_OUTPUT.search(name) and not AT_INPUT.search(name))


def over_ratio(name: str) -> bool:
    """Whether a name says an angle of the input over the ratio."""
    return bool(AT_INPUT.search(name) and OVER_RATIO.search(name))


def quantities_named(text: str) -> list[str]:
    """Quantities that a file's name speaks of, the longest word first; a word within a longer one (no-load torque) speaks of nothing else."""
    words = sorted(((-len(m[0]), m.span(), quantity) for quantity, fits in IN_NAMES.items() for m in fits.finditer(text)), key=lambda word: word[0])
    apart = [q for k, (_, (first, end), q) in enumerate(words) if not any(f <= first and end <= e and (f, e) != (first, end) for _, (f, e), _ in words[:k])]
    return list(dict.fromkeys(apart))


def surface_named(text: str) -> str | None:
    return next((surface for surface, words in ON_SURFACE.items() if words.search(text)), None)
