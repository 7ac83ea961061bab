"""The largest cube, cylinder or ball about a point of which every pose is proved reached and not singular.

Branch and bound over boxes by the size at which the shape reaches them: what is proved is dropped, the nearest of the
others are halved. The nearest that is left bounds the size from below, the nearest pose known to fail from above.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.numerics.intervals.interval import Interval
from assur.work import Progress
from assur.workspace.bounds import Stroke
from assur.workspace.certified.boxes import Boxes, together
from assur.workspace.certified.criteria import Criteria
from assur.workspace.certified.planes import BoxQuestion, judged
from assur.workspace.certified.questions import Witness, asked_of, columns_of, violations
from assur.workspace.certified.shapes import Shape, ShapeName, shape_about
from assur.workspace.domain import Box
from assur.workspace.slices import slice_at

FloatArray = NDArray[np.float64]

FARTHEST = 4.0
"""Shapes are looked for up to this many characteristic lengths."""

AT_ONCE = 512
"""Boxes that are cut at a time, about."""

SMALLEST = 1e-10
"""A box below this share of the farthest size is not cut."""

ROUNDS = 400
"""Times that boxes are cut at most."""

Ending = Literal["", "interrupted", "undecided", "no limit"]


@dataclass(frozen=True, eq=False)
class LargestShape:
    """The answer.

    Attributes:
        mechanism, mode, what: the question; coordinates held at `held`.
        shape: the shape and its centre; `height` is that of a cylinder.
        size: edge or diameter up to which every pose inside is proved; 0 where the centre itself is not.
        refuted: the least size at which it certainly holds a pose that fails; infinite where none was found.
        witness: that pose; None where none was found.
        stopped: "" where the two sizes are as near as was asked for; "no limit" where nothing fails within the
            farthest size looked at, "undecided" where boxes got too small to cut (about a border that only touches, or
            a singularity of which no sign tells), "interrupted" by Ctrl-C.
    """

    mechanism: str
    mode: str
    what: tuple[str, ...]
    held: Mapping[str, float]
    shape: Shape
    size: float
    refuted: float
    witness: Witness | None
    stopped: Ending = ""

    @property
    def height(self) -> float | None:
        """Height of the cylinder that is proved; None of other shapes."""
        return self.size * self.shape.ratio if self.shape.name == "cylinder" else None


def largest(
    record: MechanismRecord,
    shape: ShapeName,
    centre: Mapping[str, float] | Sequence[float],
    ratio: float = 1.0,
    mode: str | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    what: Sequence[str] = ("reached", "regular"),
    held: Mapping[str, float] | None = None,
    tolerance: float = 1e-3,
    progress: Progress | None = None,
) -> LargestShape:
    """The largest shape about a point of which every pose is proved.

    Args:
        record: the mechanism; it needs a closed form.
        shape: "cube", "cylinder" (along the last coordinate) or "ball"; a square or disc in a plane.
        centre: its middle, in length units, by coordinate or in the order of those that vary.
        ratio: height over diameter of a cylinder.
        mode: signs of the working mode; the file's default where none is given.
        strokes: input name -> (low, high) as printed, or None for no limit; the file's for what is left out.
        what: as `prove_box` takes it.
        held: pose coordinates that stand still; angles must be held.
        tolerance: how near the proved and the refuted size should be, as a share.
        progress: called with (steps done, steps in all).

    Errors:
        UsageError: no closed form, an unknown name, a centre, ratio or tolerance that is none.

    Example: what stops it is parallelogram 1 stretched out.

    >>> from assur.model.registry import load_record
    >>> found = largest(load_record("zeng2019"), "cube", {"x": -20.0, "y": 0.0, "z": 400.0})
    >>> 0 < found.size <= found.refuted < 1.002 * found.size, found.witness.why
    (True, 'M3 < 0: not reached')
    """
    if not 0 < tolerance < 1:
        raise UsageError(f"tolerance: {tolerance!r} is not between 0 and 1", hint="1e-3 means a thousandth of the size")
    poses = slice_at(record, held)
    form = shape_about(shape, poses.free, centre, ratio)
    asked = asked_of(record, mode, strokes, held, what)
    search = _Search(asked, form, FARTHEST * characteristic_length(record))
    stopped = search.run(tolerance, progress)
    return LargestShape(
        mechanism=record.name,
        mode=mode or record.modes.default_working,
        what=tuple(what),
        held=poses.held,
        shape=form,
        size=search.proved,
        refuted=search.refuted,
        witness=search.witness,
        stopped=stopped,
    )


class _Search:
    """Boxes that are not proved yet, and the nearest pose that is known to fail."""

    def __init__(self, asked: Criteria, shape: Shape, farthest: float) -> None:
        low, high = shape.around(farthest)
        box = Box(shape.names, tuple(low.tolist()), tuple(high.tolist()))
        self.used = np.array(asked.used)
        self.frame, self.shape, self.farthest = BoxQuestion(asked, box, asked.used), shape, farthest
        middle = np.array(shape.centre)[:, None]
        self.at = asked.over([Interval.of(row) for row in middle])
        self.refuted = math.inf
        self.witness: Witness | None = None
        self.axis = np.empty(0, dtype=np.int64)
        whole = Boxes(low[self.used, None], high[self.used, None])
        self.boxes, self.axis = self._left(whole.divided([4] * len(whole.low)))
        self._drop()

    def _touching(self, boxes: Boxes) -> FloatArray:
        """Sizes (N,) at which the shape reaches boxes over the coordinates that matter."""
        centre = np.broadcast_to(np.array(self.shape.centre)[:, None], (len(self.used), len(boxes)))
        low, high = centre.copy(), centre.copy()
        low[self.used], high[self.used] = boxes.low, boxes.high
        return self.shape.touching(Boxes(low, high))

    @property
    def proved(self) -> float:
        """The size up to which nothing is left open."""
        nearest = float(np.min(self._touching(self.boxes))) if len(self.boxes) else math.inf
        return min(nearest, self.refuted, self.farthest)

    def run(self, tolerance: float, progress: Progress | None) -> Ending:
        """Cut until the sizes are near each other."""
        try:
            for _ in range(ROUNDS):
                open_ = 1.0 - self.proved / self.refuted if self.refuted > 0 else 0.0
                if progress is not None:
                    progress(*_way(open_, tolerance))
                if open_ <= tolerance:
                    return ""
                if not len(self.boxes):
                    return "no limit"
                if not self._cut():
                    return "undecided"
        except KeyboardInterrupt:
            return "interrupted"
        return "undecided"

    def _cut(self) -> bool:
        """Halve the nearest boxes; whether there were any that are large enough."""
        near = self._touching(self.boxes)
        order = np.argsort(near, kind="stable")[:AT_ONCE]
        nearest = self.boxes[order]
        axis = self.axis[order]
        extents = nearest.high - nearest.low
        if extents[axis[0], 0] < SMALLEST * self.farthest:
            return False
        parts = nearest.halved(axis)
        rest = np.ones(len(self.boxes), dtype=bool)
        rest[order] = False
        boxes, axes = self.boxes[rest], self.axis[rest]
        kept, fresh = self._left(parts)
        self.boxes, self.axis = together([boxes, kept]), np.concatenate([axes, fresh])
        self._drop()
        return True

    def _left(self, parts: Boxes) -> tuple[Boxes, NDArray[np.int64]]:
        """Those of some boxes that are not proved, and where to cut them; poses that fail are looked for on the way."""
        found = judged(self.frame, parts, shares=False)
        left = ~found.inside
        kept = parts[left]
        centre = np.array(self.shape.centre)[self.used, None]
        self._look(np.hstack([centre, kept.middles, np.clip(centre, kept.low, kept.high)]))
        return kept, found.axis[left]

    def _look(self, middles: FloatArray) -> None:
        """Take the nearest of points (k, N) that certainly fails for a witness, if it is nearer than the last one."""
        points = np.repeat(np.array(self.shape.centre)[:, None], middles.shape[1], axis=1)
        points[self.used] = middles
        sizes = self.shape.size(points) * (1 + 1e-14)
        nearer = np.flatnonzero(sizes < self.refuted)
        if not len(nearer):
            return
        chosen = points[:, nearer]
        columns = columns_of(self.frame.box, self.shape.names, chosen)
        why = violations(self.frame.criteria, columns, self.at)
        failing = np.flatnonzero(why != "")
        if len(failing):
            best = failing[np.argmin(sizes[nearer][failing])]
            self.refuted = float(sizes[nearer][best])
            self.witness = Witness(dict(zip(self.shape.names, chosen[:, best].tolist(), strict=True)), str(why[best]))

    def _drop(self) -> None:
        """Forget boxes that only shapes of a refuted size, or of more than the farthest, would reach."""
        left = self._touching(self.boxes) < min(self.refuted, self.farthest)
        self.boxes, self.axis = self.boxes[left], self.axis[left]


def _way(reached: float, gap: float) -> tuple[int, int]:
    """How far it is to the wanted tolerance, in thousandths of the way on a logarithmic scale."""
    share = math.log(max(min(reached, 1.0), gap)) / math.log(gap)
    return round(1000 * share), 1000
