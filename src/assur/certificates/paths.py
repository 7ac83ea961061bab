"""Certificates of paths: each straight piece lies in a box, all of which is reached and free of singularities."""

from __future__ import annotations

import numpy as np

from assur.certificates.certificate import (
    CLAIMS,
    MOST,
    Certificate,
    common_statement,
    exact,
    least_sides,
    proved_by,
    tree_of,
)
from assur.certificates.exact_check import exact_check
from assur.certificates.formulas import formulas
from assur.certificates.leaves import INSIDE, OPEN, Leaves
from assur.certificates.tree import Limits, Tree
from assur.errors import UsageError
from assur.model.mechanism import MechanismRecord
from assur.work import Progress
from assur.workspace.aspects.aspects import Aspects
from assur.workspace.aspects.path import AspectPath
from assur.workspace.certified.boxes import Boxes


def path_certificate(
    record: MechanismRecord,
    aspects: Aspects,
    path: AspectPath,
    most: int = MOST,
    progress: Progress | None = None,
) -> Certificate:
    """The certificate of a path from one pose to another inside one aspect.

    It states both poses, the vertices and a box about each straight piece; the proof is a tree for each box. Nothing of
    what the search for the path found is believed: every box is judged anew.

    Args:
        record: the mechanism.
        aspects: its aspects in one working mode.
        path: one that is "connected", from `aspects.path`.
        most: leaves at most, of all boxes together; each has one at least.
        progress: called with boxes done and boxes in all.

    Returns:
        The certificate; `claims["regular"]` is "yes", else it is not proved and the verifier refuses it.

    Errors:
        UsageError: there is no path.

    Ctrl-C is raised on: a path is proved whole, or not at all.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.aspects.aspects import aspects
    >>> record = load_record("fivebar")
    >>> found = aspects(record, "-+")
    >>> made = path_certificate(record, found, found.path([-60.0, 150.0], [60.0, 220.0]))
    >>> made.claims["reached"], made.claims["regular"]
    ('yes', 'yes')
    """
    if path.status != "connected":
        raise UsageError(f"no path to certify: {path.why}")
    rules = formulas(record, aspects.mode, aspects.strokes, aspects.slice.held)
    leaves, boxes = Leaves(rules), covering(aspects, path)
    trees: list[Tree] = []
    room = most
    for k in range(len(boxes)):
        whole = boxes[k : k + 1]
        limits = Limits((OPEN, INSIDE), 0.0, least_sides(whole, 0.0, rules.used), room)
        trees.append(tree_of(leaves, whole, limits))
        room -= int(np.sum(trees[-1].leaves)) - 1
        if progress is not None:
            progress(k + 1, len(boxes))
    statement = {
        **common_statement(record, aspects.mode, aspects.strokes, rules),
        "from": exact(path.points[0]),
        "to": exact(path.points[-1]),
        "points": [exact(point) for point in path.points],
        "boxes": [
            [exact(pair) for pair in zip(low, high, strict=True)]
            for low, high in zip(boxes.low.T, boxes.high.T, strict=True)
        ],
    }
    everything = proved_by(leaves, trees)
    return Certificate(
        "path",
        statement,
        rules.to_json(),
        "".join(tree.text for tree in trees),
        {name: everything[name] for name in CLAIMS["path"]},
        exact_check(record),
    )


def covering(aspects: Aspects, path: AspectPath) -> Boxes:
    """The boxes of a path over all free coordinates, none of them flat: over those without influence, the box's range.

    Both ends of a piece lie in its box exactly, whatever was rounded on the way.
    """
    low, high = (
        np.repeat(np.array(side)[:, None], len(path.boxes), axis=1) for side in (aspects.box.low, aspects.box.high)
    )
    used = [path.coordinates.index(name) for name in path.names]
    low[used], high[used] = path.boxes.low, path.boxes.high
    starts, ends = path.points[:-1].T, path.points[1:].T
    low, high = np.minimum(low, np.minimum(starts, ends)), np.maximum(high, np.maximum(starts, ends))
    return Boxes(np.where(low < high, low, np.nextafter(low, -np.inf)), high)
