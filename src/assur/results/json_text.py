"""JSON of results: one object, numbers that do not exist as null, every float so that it reads back the same."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

from assur.errors import hidden
from assur.results.answers.answer import entries


def plain(value: Any) -> Any:
    """Numbers, texts, lists and dicts only; NaN and infinity become None.

    >>> plain({"a": np.array([1.0, np.nan]), "b": np.int64(2)})
    {'a': [1.0, None], 'b': 2}
    """
    if isinstance(value, Enum):
        return value.name
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, (float, np.floating)):
        return float(value) if np.isfinite(value) else None
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if is_dataclass(value) and not isinstance(value, type):
        return {name: plain(part) for name, part in entries(value).items()}
    if isinstance(value, Path):
        return str(value)
    return [plain(entry) for entry in value]


def indented(value: Any) -> str:
    """The JSON text of a document that is read by people too.

    >>> print(indented({"type": "string"}))
    {
      "type": "string"
    }
    """
    return json.dumps(value, indent=2, ensure_ascii=False)


def json_text(value: Any) -> str:
    """The JSON text of a result, without NaN or Infinity.

    Characters that nobody sees are escaped, so that a terminal that shows it obeys none.

    >>> json_text({"residual": float("inf")})
    '{"residual": null}'
    """
    text = json.dumps(plain(value), allow_nan=False, ensure_ascii=False)
    for sign in set(hidden(text)):
        text = text.replace(sign, json.dumps(sign)[1:-1])
    return text
