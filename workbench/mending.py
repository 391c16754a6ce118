"""A column takes another role by one click: in what is proposed of the files, or in a campaign.toml that was written elsewhere."""

from collections.abc import Mapping
from typing import Any

from workbench.editing import recast
from workbench.folder import Folder
from workbench.intake import WISHES, is_saved, save, wish, written_here


def mend(folder: Folder, given: Mapping[str, Any]) -> None:
    """``column`` as its files name it takes ``role``; InputFault, and nothing is changed, where that cannot be.

    What was saved on the page is saved again, so that the next comparison reads the column as it was said.
    """
    column, role = str(given.get("column") or ""), str(given.get("role") or "")
    if folder.campaign.is_file() and not written_here(folder):
        recast(folder, column, role)
        return
    saved, wishes = is_saved(folder), folder.recall(WISHES)
    others = {r: header for r, header in (wishes.get("columns") or {}).items() if header != column}
    wish(folder, {**wishes, "columns": others | {role: column}})
    if saved:
        save(folder)
