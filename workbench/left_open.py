"""What is named or added stands at one of several places, or comes from one of several things, that look alike: said wherever it is shown as a fact."""

from contextlib import suppress
from typing import TYPE_CHECKING

from fmu_src.faults import InputFault
from pages.words import capital
from workbench.folder import Folder
from workbench.page_words import on_page

if TYPE_CHECKING:
    from discrepancy.model_file import ModelFile
    from discrepancy.verdict import Answer


def left_open(answer: "Answer") -> list[str]:
    """Of an answer: parts, origins, and directions or signs that show the same."""
    from discrepancy.alike.untold import parts_untold
    from discrepancy.page.amounts import with_titles

    texts = [*parts_untold(answer.effects), *answer.untold]
    return [sentence(with_titles(text)) for text in dict.fromkeys(texts)]


def left_open_in(file: "ModelFile", folder: Folder) -> list[str]:
    """Of a model file: the parts as the diagnosis left them open, and the origins that the folder's campaign does not tell."""
    from discrepancy.alike.untold import origins_untold, parts_untold_before
    from discrepancy.campaign.load import load_campaign
    from discrepancy.campaign.pairs import PAIRS

    texts = parts_untold_before(file)
    # Reading a campaign takes seconds.
    if file.effects and any(pair.within and name.startswith(pair.within) for pair in PAIRS for name in file.values()):
        # Without one nothing was measured that could tell, and In says what is wrong with it.
        with suppress(InputFault):
            texts += origins_untold((), file, load_campaign(folder.root))
    return [sentence(text) for text in dict.fromkeys(texts)]


def sentence(text: str) -> str:
    # A name stays what it is.
    return on_page(f"{text}." if "." in text.partition(" ")[0] else f"{capital(text)}.")
