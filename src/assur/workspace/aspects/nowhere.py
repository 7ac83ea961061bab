"""Nowhere: factors of det Jp that are proved to be zero at no pose that a working mode reaches."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from assur.model.mechanism import MechanismRecord
from assur.workspace.aspects.signs import factor_signs
from assur.workspace.bounds import Stroke
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.planes import BoxQuestion, judged
from assur.workspace.domain import box_of
from assur.workspace.slices import slice_at

MOST = 8192
"""So many boxes are looked at for a factor: one that vanishes, if only at the border, always leaves some open."""


def nowhere_zero(
    record: MechanismRecord,
    names: Collection[str] | None = None,
    mode: str | None = None,
    box: Mapping[str, Sequence[float]] | ArrayLike | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
) -> frozenset[str]:
    """Those parallel factors that are proved to have one sign or the other, never zero, at every pose that is reached.

    Boxes are halved until each is proved to hold no pose that is reached, or none where the factor is zero. Of a
    factor that is left out nothing is proved: it may vanish somewhere, or come too near to zero for so many boxes.
    Where nothing is reached all of them are there, which says nothing of them: see `nothing_reached`.

    Args:
        record: the mechanism; it needs a closed form.
        names: the parallel factors in question; all of them where nothing is said.
        mode: signs of the working mode; the file's default where none is given.
        box: (low, high) per coordinate that varies, in order or by name, in length units and rad.
        strokes: input -> (low, high) as printed, or None for no limit; the file's for what is left out.
        held: pose coordinates that stand still.

    Errors:
        UsageError: no closed form; a mode, box or stroke that is none.

    Example: of the paper's mechanism w and v vanish inside, and u1 - u2 where the region ends.

    >>> from assur.model.registry import load_record
    >>> sorted(nowhere_zero(load_record("zeng2019")))
    ['sin_alpha_minus_beta']
    """
    poses = slice_at(record, held)
    domain = box_of(record, box, poses.free)
    asked = criteria(record, mode, strokes, held, ("parallel",))
    used = asked.used if any(asked.used) else (True, *asked.used[1:])
    return frozenset(
        name
        for name in asked.names
        if (names is None or name in names)
        and _nonzero(BoxQuestion(replace(asked, regular=(*asked.regular, name)), domain, used), name)
    )


def nothing_reached(
    record: MechanismRecord,
    mode: str | None = None,
    box: Mapping[str, Sequence[float]] | ArrayLike | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
) -> bool:
    """Whether it is proved that no pose of the box is reached; all as for `nowhere_zero`.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> nothing_reached(record), nothing_reached(record, box={"x": (1000, 1100), "y": (1000, 1100)})
    (False, True)
    """
    domain = box_of(record, box, slice_at(record, held).free)
    asked = criteria(record, mode, strokes, held, ())
    frame = BoxQuestion(asked, domain, asked.used if any(asked.used) else (True, *asked.used[1:]))
    boxes, looked = _whole(frame), 0
    while looked < MOST:
        looked += len(boxes)
        known = judged(frame, boxes, shares=False)
        if known.inside.any():
            return False
        left = ~known.outside
        if not left.any():
            return True
        boxes = boxes[left].halved(known.axis[left])
    return False


def _nonzero(frame: BoxQuestion, factor: str) -> bool:
    """Whether a factor, one of what must not be zero, is proved to be zero at no pose that is reached."""
    column = frame.criteria.names.index(factor)
    boxes, looked = _whole(frame), 0
    while looked < MOST:
        looked += len(boxes)
        known = judged(frame, boxes, shares=False)
        left = ~known.outside & ~known.inside
        left[left] = factor_signs(frame, boxes[left])[:, column] == 0
        if not left.any():
            return True
        boxes = boxes[left].halved(known.axis[left])
    return False


def _whole(frame: BoxQuestion) -> Boxes:
    """The box of a frame, of the coordinates that are used."""
    ends = zip(frame.used, frame.box.intervals, strict=True)
    low, high = np.array([pair for has, pair in ends if has]).T
    return Boxes(low[:, None], high[:, None])
