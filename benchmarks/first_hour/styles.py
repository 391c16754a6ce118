"""How benches of several countries write their files: names, heads, what stands above the table, signs and encoding."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Style:
    """``error``, ``loop``: file names of ``load`` [N m], ``speed`` [rpm of the input], ``degrees`` of the locked input, ``k`` of a repetition.

    ``above``, ``loop_above``: lines before the heads, of the same; ``error_heads``, ``loop_heads``: columns of output angle [deg] and error
    [arcsec], of torque [N m] and turning [arcmin].
    """

    error: str
    loop: str
    above: str
    loop_above: str
    error_heads: tuple[str, str]
    loop_heads: tuple[str, str]
    encoding: str = "utf-8"
    delimiter: str = ";"
    decimal: str = ","


STYLES = {
    "en": Style(
        "te_{load}Nm_{speed}rpm_{k}.txt", "hysteresis_locked_{degrees}deg_{k}.txt",
        "Test rig 4\n", "Test rig 4\n", ("output angle (deg)", "transmission error (arcsec)"), ("torque (Nm)", "twist (arcmin)"),
        delimiter="\t", decimal=".",
    ),
    "de": Style(
        "Drehfehler {load}Nm {speed} U_min Versuch {k}.csv", "Hysterese Eingang blockiert {degrees}° Versuch {k}.csv",
        "Prüfstand 4\nLast: {load} Nm\nAntriebsdrehzahl: {speed} U/min\n\n", "Prüfstand 4\nAntrieb blockiert\n\n",
        ("Abtriebswinkel [°]", "Drehfehler [\"]"), ("Drehmoment [Nm]", "Verdrehung [']"), "cp1252",
    ),
    "pt": Style(
        "Erro de transmissão {load} Nm {speed} rpm ensaio {k}.csv", "Histerese entrada bloqueada {degrees}° ensaio {k}.csv",
        "Bancada 4\nBinário de saída: {load} N.m\nRotação de entrada: {speed} rot/min\n\n", "Bancada 4\nEntrada bloqueada\n\n",
        ("Ângulo de saída [graus]", "Erro de transmissão [seg. arco]"), ("Binário de saída [N.m]", "Rotação da saída [min. de arco]"), "cp1252",
    ),
    "zh": Style(
        "传动误差_{load}Nm_{speed}rpm_第{k}次.csv", "滞回曲线_输入轴锁定_{degrees}度_第{k}次.csv",
        "4号试验台\n", "4号试验台\n", ("输出角度(°)", "传动误差(角秒)"), ("输出转矩(N·m)", "输出转角(角分)"), "gb18030", ",", ".",
    ),
    "ja": Style(
        "角度伝達誤差_{load}Nm_{speed}rpm_{k}回目.csv", "ヒステリシス_入力軸固定_{degrees}度_{k}回目.csv",
        "試験機4\n", "試験機4\n", ("出力角度[deg]", "角度伝達誤差[arcsec]"), ("出力トルク[N・m]", "ねじれ角[arcmin]"), "cp932", ",", ".",
    ),
}  # fmt: skip
