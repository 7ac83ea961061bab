"""Bars of a link: between which of its joints they run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.file.place import entry_hint, place
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinkBar:
    """A straight bar between the points of two joints: its ends (2, 3) in the link's frame, in the mechanism's unit."""

    joints: tuple[str, str]
    ends: FloatArray

    @property
    def length(self) -> float:
        """In the mechanism's unit."""
        return float(np.linalg.norm(self.ends[1] - self.ends[0]))


def joint_points(record: MechanismRecord, link: str) -> dict[str, FloatArray]:
    """Points (3,) of a link's joints in its frame, in the mechanism's unit.

    >>> from assur.model.registry import load_record
    >>> {name: point.tolist() for name, point in joint_points(load_record("fivebar"), "rod1").items()}
    {'B1': [0.0, 0.0, 0.0], 'P': [194.0, 0.0, 0.0]}
    """
    points = {}
    for name, joint in record.joints.items():
        if link in (joint.parent, joint.child):
            points[name] = joint.at if link == joint.parent else joint.child_at
    return points


def link_bars(record: MechanismRecord, link: str) -> tuple[LinkBar, ...]:
    """Bars of a link: those of the file, else the one between its two joints that are not prismatic.

    Errors:
        UsageError: the file does not say between which joints, and there are not two.
    """
    points = joint_points(record, link)
    data = record.machine.links.get(link)
    pairs = data.bars if data else ()
    if not pairs:
        ends = [name for name in points if record.joints[name].type.turning]
        if len(ends) != 2:
            pair = [f'"{place(record, "joints", name)[-1]}"' for name in (*ends, *points)[:2]]
            raise UsageError(
                f"link {link} of {record.name}: its bars are not known; it has {len(ends)} joints that are not "
                f"prismatic ({', '.join(ends) or 'none'})",
                hint=entry_hint(record, "links", link, f"bars = [[{', '.join(pair)}]]"),
            )
        pairs = ((ends[0], ends[1]),)
    return tuple(LinkBar(pair, np.array([points[name] for name in pair])) for pair in pairs)
