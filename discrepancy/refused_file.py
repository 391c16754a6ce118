"""Model files that ``extend`` wrote for effects that it refused."""

from collections.abc import Mapping
from typing import Any


def only_refused(content: Mapping[str, Any]) -> bool:
    """Whether a model file, as it was read, holds nothing but attempts that were not kept: it is its reducer over again, and no other model."""
    steps = content.get("steps") or ()
    return bool(steps) and not content.get("effects") and not content.get("settings") and not any(step.get("kept", True) for step in steps)
