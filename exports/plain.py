"""Results as data that every program takes: neither JSON nor Excel has a sign for NaN and infinity."""

import json
import math
from dataclasses import asdict
from typing import Any


def plain(value: Any) -> Any:
    """Of dictionaries, lists, arrays, dataclasses and what is in them: numbers that are not finite become None."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if hasattr(value, "__dataclass_fields__"):
        return plain(asdict(value))
    return None if isinstance(value, float) and not math.isfinite(value) else value


def plain_json(content: object, indent: int | None = None) -> str:
    """As JSON has it."""
    return json.dumps(plain(content), indent=indent, allow_nan=False, default=str)
