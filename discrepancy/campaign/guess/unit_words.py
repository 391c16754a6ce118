"""Units as benches write them in header cells, lines of units and file names, and what kind of quantity they are of."""

import re

ANGLE, TORQUE, SPEED, LENGTH, TIME, TEMPERATURE, SHARE, MASS = "angle", "torque", "speed", "length", "time", "temperature", "share", "mass"
ACCELERATION, STIFFNESS = "acceleration", "stiffness"
# Steps of an encoder: an angle, once it is known how many make a turn.
COUNTS = "counts"

# Kind -> unit of a campaign -> ways of writing it; blanks do not count, and these signs are one: . * · -
WRITTEN = {
    ANGLE: {
        "deg": "° º deg degs degree degrees Grad 度", "arcmin": "arcmin arcmins ' ′ amin minofarc Winkelmin Winkelminuten Bogenmin Bogenminuten 角分 分",
        "arcsec": "arcsec arcsecs \" '' ″ asec as secofarc Winkelsek Winkelsekunden Bogensek Bogensekunden 角秒 秒角",
        "mdeg": "mdeg m° millideg", "urad": "urad µrad microrad", "mrad": "mrad", "rad": "rad radian radians 弧度",
        "turn": "turn turns rev revs tr tours U Umdr Umdrehungen 圈 転", COUNTS: "counts count cts inc incs Ink Inkremente ticks pulses LSB 脉冲 パルス",
    },
    TORQUE: {
        "N.m": "N.m Nm 牛米 牛.米 Newtonmeter", "mN.m": "mN.m mNm", "kN.m": "kN.m kNm", "N.mm": "N.mm Nmm", "N.cm": "N.cm Ncm",
        "kN.mm": "kN.mm kNmm", "kN.cm": "kN.cm kNcm",
        "kgf.m": "kgf.m kg.m kgm kgfm kp.m kpm", "kgf.cm": "kgf.cm kg.cm kgcm kgfcm kp.cm", "ozf.inch": "ozf.in oz.in in.oz",
        "lbf.inch": "lbf.in in.lb in.lbf lb.in inlb", "lbf.foot": "lbf.ft ft.lb ft.lbf lb.ft ftlb",
    },
    SPEED: {
        "rpm": "rpm r/min rev/min 1/min U/min Upm tr/min trmin min^.1 min.1 /min 转/分 转每分", "turn/s": "rev/s rps U/s tr/s r/s",
        "rad/s": "rad/s", "deg/s": "deg/s °/s",
    },
    LENGTH: {"um": "um µm micron microns Mikrometer 微米", "mm": "mm Millimeter 毫米", "nm": "nm", "m": "m"},
    TIME: {"s": "s sec secs Sek seconds 秒", "ms": "ms", "us": "us µs", "ns": "ns", "min": "min minutes",
           "h": "h hr hrs hours hour heures Std Stunden 小时 時間 时"},
    TEMPERATURE: {"degC": "°C ℃ degC C Celsius 摄氏度", "K": "K Kelvin", "degF": "°F degF"},
    SHARE: {"%": "% percent Prozent", "ppm": "ppm", "1": "1 - –"}, MASS: {"mg": "mg", "g": "g", "ug": "ug µg", "kg": "kg"},
    ACCELERATION: {"m/s^2": "m/s^2 m/s2 m/ss", "mm/s^2": "mm/s^2 mm/s2", "g_0": "gn"},
    STIFFNESS: {"N.m/arcmin": "N.m/arcmin Nm/arcmin Nm/' N.m/'", "N.m/rad": "N.m/rad Nm/rad", "N.m/deg": "N.m/deg Nm/deg Nm/°"},
}  # fmt: skip


def plain(text: str) -> str:
    """Without blanks, with one sign for each that is written in several ways."""
    for signs, sign in (("μ", "µ"), ("*·⋅•-−⁻ ", "."), ("²", "^2"), ("¹", "1"), ("’‘`´", "'"), ("“”", '"')):
        text = re.sub(f"[{re.escape(signs)}]", sign, text) if sign != "." else re.sub(rf"\s*[{re.escape(signs.strip())}]\s*|(?<=\S)\s+(?=\S)", ".", text)
    return text.strip(" .") or text.strip()


KNOWN: dict[str, tuple[str, str]] = {}
LOWER: dict[str, tuple[str, str]] = {}
for _kind, _units in WRITTEN.items():
    for _unit, _words in _units.items():
        for _word in _words.split():
            KNOWN.setdefault(plain(_word), (_unit, _kind))
            LOWER.setdefault(plain(_word).lower(), (_unit, _kind))
# Without regard to case M would be a metre, N a nanometre.
LEAST_LOWER = 2

IN_BRACKETS = re.compile(r"\s*[\[(（【{<]([^\[\](){}（）【】<>]*)[\])）】}>]\s*")
AFTER_WORD = re.compile(r"^(.*\S)\s*(?:/|\bin\b|,|:)\s*(\S+)$")
AFTER_LINE = re.compile(r"^(.+)[_ .-]([^_ ]+)$")


def unit_of(text: str) -> tuple[str, str] | None:
    """(unit, kind) that a text alone is, if it is one."""
    word = plain(text.strip().strip("[](){}（）"))
    return KNOWN.get(word) or (LOWER.get(word.lower()) if len(word) >= LEAST_LOWER else None)


def unit_in(header: str) -> tuple[str, str, str] | None:
    """(unit, kind, where it stands) of a header cell: in brackets, after a stroke, or as its last part."""
    for found in IN_BRACKETS.findall(header):
        if known := unit_of(found):
            return *known, f"[{found}] in its header"
    # Half of what stands in brackets is no unit: "N furlong" is none, and no furlong.
    outside = IN_BRACKETS.sub(" ", header).strip()
    for pattern in (AFTER_WORD, AFTER_LINE):
        if (match := pattern.match(outside)) and (known := unit_of(match[2])) and known[0] != "1":
            return *known, f"its header ends with {match[2]}"
    return None


def unknown_in(header: str) -> str:
    """What stands in a header's brackets where a unit does, and is none that is known; empty if there is nothing of that kind."""
    return "" if unit_in(header) else next((found.strip() for found in reversed(IN_BRACKETS.findall(header)) if found.strip()), "")


def name_of(header: str) -> str:
    """A header cell without its unit."""
    name = IN_BRACKETS.sub(" ", header).strip()
    for pattern in (AFTER_WORD, AFTER_LINE):
        if (match := pattern.match(name)) and (known := unit_of(match[2])) and known[0] != "1":
            return match[1].strip()
    return name
