"""Files as benches write them: German, Chinese and Japanese ones, with other separators, units, heads and formats."""

from pathlib import Path

import numpy as np
import pandas as pd
import scipy.io
from asammdf import MDF, Signal
from nptdms import ChannelObject, TdmsWriter

TURN = 2.0 * np.pi
ARCSEC, ARCMIN = np.radians(1 / 3600), np.radians(1 / 60)
# Two output turns, in half degrees; a transmission error of 40 arcsec from peak to peak.
ANGLE = np.radians(np.arange(0.0, 720.5, 0.5))
ERROR = ARCSEC * (15.0 * np.sin(39 * ANGLE) + 5.0 * np.sin(2 * ANGLE + 0.3))
# Torque put on and taken off both ways; a loop of 8 arcmin.
TORQUE = 167.0 * np.sin(np.linspace(0.0, 2.5 * np.pi, 601))
TWIST = ARCMIN * (TORQUE / 49.0 + 0.4 * np.sign(np.gradient(TORQUE)))
SPEEDS, FRICTION = np.array([200.0, 350, 600, 1000, 1800, 2500]), np.array([0.162, 0.155, 0.16, 0.171, 0.19, 0.21])
HOURS, DEPTH = np.array([0.0, 500, 1000, 2000, 5000]), 1e-6 * np.array([0.0, 0.6, 1.1, 1.9, 4.2])
CURVES = {
    "te": ("transmission_error", {"angle": ANGLE, "value": ERROR}), "loop": ("hysteresis", {"torque": TORQUE, "value": TWIST}),
    "drag": ("input_torque", {"speed": SPEEDS * TURN / 60, "value": FRICTION}), "wear": ("wear_depth", {"hours": 3600 * HOURS, "value": DEPTH}),
}
KGM = 9.80665


def german(number: float) -> str:
    return f"{number:,.5f}".replace(",", " ").replace(".", ",").replace(" ", ".")


def comma(number: float) -> str:
    return f"{number:.6f}".replace(".", ",")


def point(number: float) -> str:
    return f"{number:.6f}"


def grouped(number: float) -> str:
    return f'"{number:,.6f}"'


# What is measured; lines above the table; header, a line of units; size of the unit of either column; delimiter; number; encoding.
DEG = np.radians(1.0)
WRITTEN = {
    "plain": ("te", "", "angle_deg,error_arcsec", "", (DEG, ARCSEC), ",", point, "utf-8"),
    "german": ("te", "", "Winkel [°];Fehler [\"]", "", (DEG, ARCSEC), ";", comma, "cp1252"),
    "german_excel": ("te", "", "Abtriebswinkel;Drehfehler", "°;arcmin", (DEG, ARCMIN), ";", german, "utf-8-sig"),
    "german_head": ("te", "Prüfstand 3\nDatum: 01.02.2024\n\n", "Winkel in °;Abweichung in mrad", "", (DEG, 1e-3), ";", comma, "cp1252"),
    "din": ("te", "", "φ / rad\tΔφ / µrad", "", (1.0, 1e-6), "\t", point, "utf-8"),
    "chinese": ("te", "", "输出角度(°),传动误差(角秒)", "", (DEG, ARCSEC), ",", point, "gb18030"),
    "chinese_utf16": ("te", "", "角度\t误差", "度\t角分", (DEG, ARCMIN), "\t", point, "utf-16"),
    # No mark of the order of bytes: "name the table's columns" was said of it.
    "chinese_utf16_unmarked": ("te", "", "角度\t误差", "度\t角分", (DEG, ARCMIN), "\t", point, "utf-16-be"),
    "japanese": ("te", "", "出力角度[deg],角度伝達誤差[arcsec]", "", (DEG, ARCSEC), ",", point, "cp932"),
    "rad_mdeg": ("te", "", "theta [rad] , te [mdeg]", "", (1.0, DEG / 1000), ",", point, "utf-8"),
    "no_header": ("te", "", "", "", (DEG, ARCSEC), " ", point, "utf-8"),
    "commented": ("te", "# made by a script\n", "# angle te", "", (DEG, ARCSEC), " ", point, "utf-8"),
    "thousands": ("te", "", "angle (deg),deviation (arcsec)", "", (DEG, ARCSEC), ",", grouped, "utf-8"),
    "bars": ("te", "Rig;A\nSpeed: 15 rpm\nLoad: 167 Nm\n", "out_angle|err", "[deg]|[arcsec]", (DEG, ARCSEC), "|", point, "utf-8"),
    "loop": ("loop", "", "torque_Nm;turn_arcmin", "", (1.0, ARCMIN), ";", comma, "utf-8"),
    "ramp_kgm": ("loop", "", "Load (kg.m),Twist (arcmin)", "", (KGM, ARCMIN), ",", point, "utf-8"),
    "ramp_german": ("loop", "", "Drehmoment (Nm);Verdrehung (')", "", (1.0, ARCMIN), ";", german, "cp1252"),
    "loop_chinese": ("loop", "", "扭矩[N·m],扭转角[′]", "", (1.0, ARCMIN), ",", point, "utf-8"),
    "loop_bare": ("loop", "", "x,y", "", (1.0, ARCMIN), ",", point, "utf-8"),
    "drag": ("drag", "", "n_motor [1/min];M_an [Nm]", "", (TURN / 60, 1.0), ";", comma, "utf-8"),
    "drag_chinese": ("drag", "", "输入转速(r/min)\t输入扭矩(N.m)", "", (TURN / 60, 1.0), "\t", point, "gb18030"),
    "wear_table": ("wear", "", "hours,depth_um", "", (3600.0, 1e-6), ",", point, "utf-8"),
    "verschleiss": ("wear", "", "Laufzeit;Verschleißtiefe", "h;µm", (3600.0, 1e-6), ";", comma, "cp1252"),
}  # fmt: skip
# In these the size of a unit is nowhere said, and so is in doubt.
GUESSED_UNITS = {"no_header", "commented", "loop_bare"}


def write(folder: Path, kind: str) -> Path:
    what, above, header, units, sizes, mark, number, encoding = WRITTEN[kind]
    columns = [values / size for values, size in zip(CURVES[what][1].values(), sizes)]
    if number is grouped and kind == "thousands":
        columns[0] = columns[0] + 990.0
    lines = [line for line in (header, units) if line] + [mark.join(map(number, row)) for row in zip(*columns)]
    path = folder / f"{'a' if kind == 'no_header' else what}_167Nm_15rpm_1.csv"
    path.write_text(above + "\n".join(lines) + "\n", encoding=encoding)
    return path


def binary(folder: Path, ending: str) -> Path:
    angle, error = np.degrees(ANGLE), ERROR / ARCSEC
    path = folder / f"te_1.{ending}"
    if ending == "parquet":
        pd.DataFrame({"angle_deg": angle, "te_arcsec": error}).to_parquet(path)
    elif ending == "mat":
        scipy.io.savemat(path, {"angle_deg": angle, "te_arcsec": error, "operator": "me"})
    elif ending == "mf4":
        with MDF(version="4.10") as file:
            time = np.arange(len(angle)) / 100.0
            file.append([Signal(angle, time, name="angle", unit="deg"), Signal(error, time, name="te", unit="arcsec")])
            file.save(path)
    else:
        with TdmsWriter(path) as file:
            file.write_segment([
                ChannelObject("bench", "angle", angle, {"unit_string": "deg"}), ChannelObject("bench", "te", error, {"unit_string": "arcsec"}),
            ])  # fmt: skip
    return path
