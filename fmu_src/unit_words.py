"""Units as people write them in files, names and settings, and what kind of quantity they are of."""

import re

ANGLE, TORQUE, SPEED, LENGTH, TIME, TEMPERATURE, SHARE, MASS = "angle", "torque", "speed", "length", "time", "temperature", "share", "mass"
ACCELERATION, STIFFNESS = "acceleration", "stiffness"
# Steps of an encoder: an angle, once it is known how many make a turn.
COUNTS = "counts"

# Kind -> unit of a campaign -> ways of writing it in English, German, French, Italian, Spanish, Portuguese, Chinese, Japanese; a blank within stands as a dot,
# and these signs are one: . * · - ・
WRITTEN = {
    ANGLE: {
        "deg": "° º deg degs degree degrees Grad degré degrés grado gradi grados grau graus 度",
        "arcmin": "arcmin arcmins arc.min arcminute arcminutes arc.minute arc.minutes ' ′ amin minofarc min.of.arc Winkelmin Winkelminuten Bogenmin"
        " Bogenminuten min.d'arc minute.d'arc minutes.d'arc minuti.d'arco primi minutos.de.arco min.de.arco min.arco 角分 弧分 分角 分",
        "arcsec": "arcsec arcsecs arc.sec arcsecond arcseconds arc.second arc.seconds \" '' ″ asec as secofarc sec.of.arc Winkelsek Winkelsekunden Bogensek"
        " Bogensekunden sec.d'arc seconde.d'arc secondes.d'arc secondi.d'arco segundos.de.arco"
        " seg.de.arco seg.arco 角秒 弧秒 秒角",
        "mdeg": "mdeg m° millideg", "urad": "urad µrad microrad 微弧度", "mrad": "mrad 毫弧度",
        "rad": "rad radian radians radianti radianes radianos 弧度 ラジアン",
        "turn": "turn turns rev revs U Umdr Umdr. Umdrehungen tr tour tours giro giri vueltas volta voltas 圈 转 転",
        COUNTS: "counts count cts inc incs Ink Inkremente ticks pulses LSB impulsions incréments impulsi incrementi pulsos incrementos"
        " contagens contagem impulsos 脉冲 パルス",
    },
    TORQUE: {
        "N.m": "N.m Nm m.N 牛米 牛.米 牛顿米 牛顿.米 Newtonmeter newton.mètre newton.metro ニュートンメートル", "mN.m": "mN.m mNm", "kN.m": "kN.m kNm 千牛.米",
        "daN.m": "daN.m daNm m.daN", "N.mm": "N.mm Nmm 牛.毫米", "N.cm": "N.cm Ncm 牛.厘米", "kN.mm": "kN.mm kNmm", "kN.cm": "kN.cm kNcm",
        "kgf.m": "kgf.m kg.m kgm kgfm kp.m kpm m.kg 公斤.米 千克力.米", "kgf.cm": "kgf.cm kg.cm kgcm kgfcm kp.cm 公斤.厘米",
        "ozf.inch": "ozf.in oz.in in.oz in.ozf inoz ozin ozf.inch",
        "lbf.inch": "lbf.in in.lb in.lbf lb.in inlb inlbf lbin lbfin in.lbs lbs.in in.lbfs inch.lb inch.lbs inch.lbf lb.inch lbf.inch inch.pound inch.pounds"
        " pound.inch pound.inches",
        "lbf.foot": "lbf.ft ft.lb ft.lbf lb.ft ftlb ftlbf lbft lbfft ft.lbs lbs.ft ft.lbfs foot.lb foot.lbs foot.lbf lb.foot lbf.foot foot.pound foot.pounds"
        " pound.foot pound.feet",
    },
    SPEED: {
        "rpm": "rpm r.p.m r/min rev/min 1/min U/min Upm Umin min^.1 min.1 /min U.min^.1 U.min.1 Umdr/min Umdr./min Umdrehungen/min tr/min trmin tr/mn tr.min^.1"
        " tr.min.1 tour/min tours/min giri/min giri/minuto vueltas/min"
        " rot/min rotações/min voltas/min 转/分 转/分钟 转每分 转每分钟 轉/分 轉/分鐘 回転/分 回/分 毎分回転数",
        "krpm": "krpm 1000/min",
        "turn/s": "rev/s rps r.p.s. rev/sec U/s r/s tr/s tours/s giri/s vueltas/s rot/s voltas/s 转/秒 轉/秒 回転/秒",
        "rad/s": "rad/s 弧度/秒 ラジアン/秒",
        "deg/s": "deg/s °/s Grad/s degrés/s gradi/s grados/s graus/s 度/秒",
    },
    LENGTH: {
        "um": "um µm micron microns Mikrometer micromètre micromètres micrometri micras micrómetros micrômetros mícrons 微米 ミクロン",
        "mm": "mm Millimeter millimètre millimètres millimetri milímetros 毫米 ミリ", "nm": "nm 纳米", "m": "m",
    },
    TIME: {
        "s": "s sec secs Sek seconds seconde secondes secondi segundos seg 秒", "ms": "ms 毫秒 ミリ秒", "us": "us µs 微秒", "ns": "ns",
        "min": "min minutes Minuten minuti minutos 分钟 分鐘 分間",
        "h": "h hr hrs hours hour Std Std. Stunden heure heures ore horas 小时 小時 時間 时",
    },
    TEMPERATURE: {"degC": "°C ℃ degC deg.C C Celsius 摄氏度 攝氏度 摂氏", "K": "K Kelvin degK", "degF": "°F ℉ degF deg.F F Fahrenheit"},
    SHARE: {"%": "% ％ pct percent Prozent pour.cent pourcent pourcents per.cento por.ciento パーセント", "ppm": "ppm", "1": "1 - –"},
    MASS: {"mg": "mg 毫克", "g": "g Gramm grammes grammi gramos gramas 克 グラム", "ug": "ug µg", "kg": "kg 公斤 千克"},
    ACCELERATION: {"m/s^2": "m/s^2 m/s2 m/ss 米/秒^2", "mm/s^2": "mm/s^2 mm/s2", "g_0": "gn"},
    STIFFNESS: {
        "N.m/arcmin": "N.m/arcmin Nm/arcmin N.m/arc.min Nm/arc.min Nm/' N.m/' Nm/角分 N.m/角分 牛米/角分 N.m/分", "N.m/rad": "N.m/rad Nm/rad",
        "N.m/deg": "N.m/deg Nm/deg Nm/° N.m/°",
        "lbf.inch/arcmin": "in.lbf/arcmin in.lb/arcmin lbf.in/arcmin lb.in/arcmin in.lbf/arc.min in.lb/arc.min lbf.in/arc.min lb.in/arc.min",
        "lbf.inch/deg": "in.lbf/deg in.lb/deg lbf.in/deg lb.in/deg", "lbf.inch/rad": "in.lbf/rad in.lb/rad lbf.in/rad lb.in/rad",
    },
}  # fmt: skip
# Letters, figures and signs of East Asian width as those of ASCII.
NARROW = {wide: wide - 0xFEE0 for wide in range(0xFF01, 0xFF5F)}


def plain(text: str) -> str:
    """Without blanks, with one sign for each that is written in several ways."""
    text = re.sub(r"\s*/\s*", "/", text.translate(NARROW))
    for signs, sign in (("μ", "µ"), ("*·⋅•・･-−⁻ ", "."), ("²", "^2"), ("¹", "1"), ("’‘`´", "'"), ("“”", '"')):
        text = re.sub(f"[{re.escape(signs)}]", sign, text) if sign != "." else re.sub(rf"\s*[{re.escape(signs.strip())}]\s*|(?<=\S)\s+(?=\S)", ".", text)
    # "min. d'arc": a dot that shortens a word, and the blank behind it.
    text = re.sub(r"\.{2,}", ".", text)
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


def unit_of(text: str) -> tuple[str, str] | None:
    """(unit, kind) that a text alone is, if it is one."""
    word = plain(text.strip().strip("[](){}（）"))
    return KNOWN.get(word) or (LOWER.get(word.lower()) if len(word) >= LEAST_LOWER else None)


# A torque's unit in a text of ours; in a name (50N.m), a head ([N.m]), quotes or behind an option's = it stands as in the file, or as it is typed.
TORQUE_UNIT = re.compile(r"(?<![\w.\[\"'`=])((?:k|m|da)?N)[.·]([cm]?m)(?:[.·](arcmin|s)\b)?(?![\w\]\"'`])")


def unit_on_screen(text: str) -> str:
    """A unit, or a text with units, as screen and pages have it; what is typed and what files hold keep their point: N.m."""
    return TORQUE_UNIT.sub(lambda m: " ".join(filter(None, m.groups())), text)
