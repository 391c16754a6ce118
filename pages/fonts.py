"""Fonts of pictures: a Latin one, and behind it those of the machine that have Chinese, Japanese and Korean signs."""

import logging
import unicodedata
import warnings
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

# It comes with matplotlib.
LATIN = "DejaVu Sans"
# What systems have of fonts with signs of Chinese, Japanese or Korean, the more complete first.
EASTERN = (
    "Noto Sans CJK SC", "Noto Sans CJK TC", "Noto Sans CJK JP", "Noto Sans CJK KR", "Noto Sans SC", "Noto Sans JP", "Noto Sans KR",
    "Source Han Sans SC", "Source Han Sans CN", "Source Han Sans JP", "Source Han Sans", "Microsoft YaHei", "SimHei", "SimSun", "Microsoft JhengHei",
    "PingFang SC", "Hiragino Sans GB", "Hiragino Sans", "Heiti SC", "Yu Gothic", "Meiryo", "MS Gothic", "Malgun Gothic", "Apple SD Gothic Neo",
    "NanumGothic", "WenQuanYi Micro Hei", "WenQuanYi Zen Hei", "Droid Sans Fallback", "IPAGothic", "TakaoGothic", "Arial Unicode MS",
)  # fmt: skip
# What a sign of 7 points takes at most in nearly all words, and one of Chinese, Japanese or Korean, which is as wide as high [mm].
SIGN, EASTERN_SIGN = 1.6, 2.5


def families(installed: Collection[str]) -> list[str]:
    """The Latin font, and those of ``EASTERN`` that are installed: of others matplotlib would say that it did not find them."""
    return [LATIN, *(name for name in EASTERN if name in installed)]


@contextmanager
def printed(style: Mapping[str, Any]) -> Iterator[None]:
    """Drawing in ``style`` by the machine's fonts; signs that none of them has are drawn as boxes, without a warning for each."""
    import matplotlib as mpl
    from matplotlib.font_manager import fontManager

    # By their names: of a family like "sans-serif" matplotlib takes the first alone, whatever signs that lacks.
    with mpl.rc_context({**style, "font.family": families(fontManager.get_font_names())}), warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"Glyph \d+ .*missing from font", UserWarning)
        log, before = logging.getLogger("matplotlib.font_manager"), logging.getLogger("matplotlib.font_manager").level
        # It says of some fonts that their weight is 500 and not 400.
        log.setLevel(logging.ERROR)
        try:
            yield
        finally:
            log.setLevel(before)


def room_of(line: str) -> float:
    """The width [mm] in which a line of 7 points surely stands."""
    return sum(EASTERN_SIGN if unicodedata.east_asian_width(sign) in "WF" else SIGN for sign in line)
