"""What a document is: a mechanism with dimensions, or a topology."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

KIND = "topology"
_OF_MECHANISMS = frozenset(("links", "joints", "limbs", "home"))


def is_topology(data: Mapping[str, Any]) -> bool:
    """Whether a document is meant as a topology file, with faults or without.

    >>> is_topology({"chains": ["R[z] R[z]"]}), is_topology({"chains": {"leg": {"serial": ["A"]}}})
    (True, False)
    """
    return not is_mechanism(data) and ("kind" in data or isinstance(data.get("chains"), list))


def is_mechanism(data: Mapping[str, Any]) -> bool:
    """Whether a document has what only mechanisms with dimensions have.

    >>> is_mechanism({"links": {}}), is_mechanism({})
    (True, False)
    """
    return data.get("kind") != KIND and not _OF_MECHANISMS.isdisjoint(data)
