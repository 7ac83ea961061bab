"""A mechanism with its joints, links and inputs sorted by name, so that the order of its file decides nothing."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from assur.model.mechanism import Coordinate, MechanismRecord


@lru_cache(maxsize=64)
def sorted_by_name(record: MechanismRecord) -> MechanismRecord:
    """The same mechanism; joint values follow its joints.

    >>> from assur.model.registry import load_record
    >>> list(sorted_by_name(load_record("fivebar")).joints)
    ['A1', 'A2', 'B1', 'B2', 'P']
    """
    listed = sorted(record.coordinates, key=lambda own: (own.joint, own.index))
    names = [item.name for item in record.inputs]
    if (names, *map(list, (record.links, record.coordinates))) == (sorted(names), sorted(record.links), listed):
        return record
    moved = {item.index: replace(item, index=place) for place, item in enumerate(listed)}

    def at(coordinate: Coordinate) -> Coordinate:
        return moved[coordinate.index]

    return replace(
        record,
        links=dict(sorted(record.links.items())),
        joints=dict(sorted(record.joints.items())),
        inputs=tuple(
            replace(item, coordinate=at(item.coordinate)) for item in sorted(record.inputs, key=lambda own: own.name)
        ),
        coordinates=tuple(moved[item.index] for item in listed),
        angles={name: at(item) for name, item in record.angles.items()},
        home=np.array([record.home[item.index] for item in listed]),
    )
