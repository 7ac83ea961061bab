"""Units of a mechanism as a reader of the report sees them."""

from __future__ import annotations

from collections.abc import Sequence

from assur.model.mechanism import MechanismRecord
from assur.results.typeset_text import shown_unit
from assur.workspace.certified.region import unit


def extent_unit(record: MechanismRecord, names: Sequence[str]) -> str:
    """Unit of a length, an area or a volume in these coordinates of the pose.

    >>> from assur.model.registry import load_record
    >>> extent_unit(load_record("zeng2019"), ("x", "z")), extent_unit(load_record("zeng2019"), ("x", "phi"))
    ('mm²', 'mm rad')
    """
    return " ".join(map(shown_unit, unit(record, names).split()))
