"""A box proved reachable and free of singularities, or the parts of it where that is not so."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.model.mechanism import MechanismRecord
from assur.numerics.intervals.interval import Interval
from assur.work import Progress
from assur.workspace.bounds import Stroke
from assur.workspace.certified.boxes import LEAST, Boxes
from assur.workspace.certified.criteria import Criteria
from assur.workspace.certified.paving import MOST, Paving, Stopped, pave
from assur.workspace.certified.planes import BLOCK
from assur.workspace.certified.questions import Witness, asked_of, columns_of, violations
from assur.workspace.domain import Box, box_of
from assur.workspace.slices import slice_at

FloatArray = NDArray[np.float64]

LISTED = 20
"""Boxes that are written down; the result itself has all."""

PARTS = 32
"""Into so many parts a box is cut along each coordinate at most, where nobody says how many."""

SUMMED = 1e-9
"""More than the relative error of the sums of the sizes of boxes."""

Verdict = Literal["proved", "refuted", "undecided"]


@dataclass(frozen=True, eq=False)
class ProvedBox:
    """What is known of a box of poses.

    Attributes:
        mechanism, mode, box, what: the question; coordinates held at `held`.
        status: "proved" for every pose of the box, "refuted" where some pose certainly fails, else "undecided".
        proved: boxes in which every pose fulfils everything, over `names`.
        failed: boxes in which none is reached.
        doubtful: boxes of the finest size of which neither is proved.
        names: coordinates of the boxes; nothing depends on the others.
        share: of the box's volume that is proved, at least.
        witness: a pose that fails; of a factor that changes sign, one of two between which one fails.
        stopped: why the search ended early; "" where it did not.
    """

    mechanism: str
    mode: str
    box: Box
    held: Mapping[str, float]
    what: tuple[str, ...]
    status: Verdict
    names: tuple[str, ...]
    proved: Boxes = field(repr=False)
    failed: Boxes = field(repr=False)
    doubtful: Boxes = field(repr=False)
    share: float
    witness: Witness | None
    stopped: Stopped = ""


def prove_box(
    record: MechanismRecord,
    box: Mapping[str, Sequence[float]] | ArrayLike | None = None,
    mode: str | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    what: Sequence[str] = ("reached", "regular"),
    held: Mapping[str, float] | None = None,
    finest: Mapping[str, float] | None = None,
    progress: Progress | None = None,
    most: int = MOST,
) -> ProvedBox:
    """Prove that a working mode reaches every pose of a box within strokes and limits, away from singularities.

    Args:
        record: the mechanism; it needs a closed form.
        box: (low, high) per coordinate that varies, in order or by name; the file's for what is left out.
        mode: signs of the working mode; the file's default where none is given.
        strokes: input name -> (low, high) as printed, or None for no limit; the file's for what is left out.
        what: "reached" always, and "parallel", "serial", "constraint" (the closure of the joint graph loses rank) or
            "regular" for all three: no such singularity.
        held: pose coordinates that stand still.
        finest: extents, by coordinate, below which nothing is cut; by default a 32nd of the box.
        progress: called with (steps done, steps in all).
        most: boxes looked at, at most.

    Returns:
        The answer by a status. What stays undecided lies about a border or a singularity, within the finest size, or
        where floats end; `stopped` says which.

    Errors:
        UsageError: no closed form, a box turned round, an unknown name, mode or question.

    Example: the paper's mechanism away from singularities, and a box that reaches to where links 9 and 10
    are level.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> prove_box(record, {"x": (-40, 0), "y": (-50, 50), "z": (380, 400)}).status
    'proved'
    >>> found = prove_box(record, {"x": (-40, 0), "y": (-50, 50), "z": (180, 400)})
    >>> found.status, found.witness.why
    ('refuted', 'w changes sign on the way: singular, or not reached')
    """
    poses = slice_at(record, held)
    domain = box_of(record, box, poses.free)
    asked = asked_of(record, mode, strokes, held, what)
    extents = {
        name: max((high - low) / PARTS, LEAST)
        for name, low, high in zip(domain.names, domain.low, domain.high, strict=True)
    }
    paving = pave(asked, domain, finest={**extents, **(finest or {})}, progress=progress, most=most)
    witness = _witness(asked, domain, paving)
    certain = len(paving.boundary) + len(paving.outside) == 0
    known = float(np.sum(paving.inside.sizes.low))
    every = sum(float(np.sum(boxes.sizes.high)) for boxes in (paving.inside, paving.outside, paving.boundary))
    return ProvedBox(
        mechanism=record.name,
        mode=mode or record.modes.default_working,
        box=domain,
        held=poses.held,
        what=tuple(what),
        status="proved" if certain else "refuted" if witness is not None else "undecided",
        names=paving.names,
        proved=paving.inside,
        failed=paving.outside,
        doubtful=paving.boundary,
        share=1.0 if certain else known / every * (1 - SUMMED) if every > 0 else 0.0,
        witness=witness,
        stopped=paving.stopped,
    )


def _witness(asked: Criteria, box: Box, paving: Paving) -> Witness | None:
    """A pose of the box that certainly fails, if one is found among the corners and middles of boxes."""
    start = next((boxes for boxes in (paving.inside, paving.boundary) if len(boxes)), paving.outside)
    at = asked.over([Interval.of(row) for row in columns_of(box, paving.names, start[:1].middles)])
    for boxes in (paving.outside, paving.boundary):
        for k in range(0, len(boxes), BLOCK):
            columns = columns_of(box, paving.names, _points(boxes[k : k + BLOCK]))
            why = violations(asked, columns, at)
            found = np.flatnonzero(why != "")
            if len(found):
                pose = {name: float(row[found[0]]) for name, row in zip(box.names, columns, strict=True)}
                return Witness(pose, str(why[found[0]]))
    return None


def _points(boxes: Boxes) -> FloatArray:
    """Middles and corners (k, N) of boxes."""
    corners = [
        np.stack([(boxes.low, boxes.high)[end][axis] for axis, end in enumerate(ends)])
        for ends in itertools.product((0, 1), repeat=len(boxes.low))
    ]
    return np.hstack([boxes.middles, *corners])


def largest_of(boxes: Boxes) -> list[list[list[float]]]:
    """[[low, high] per coordinate] for each box, the largest first, at most `LISTED`."""
    order = np.argsort(-boxes.sizes.high, kind="stable")[:LISTED]
    chosen = boxes[order]
    listed: list[list[list[float]]] = np.stack([chosen.low.T, chosen.high.T], axis=-1).tolist()
    return listed
