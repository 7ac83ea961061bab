"""The search: a paving free of singularities, cut further where undecided boxes leave open what is connected."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.work import Progress
from assur.workspace.aspects.components import Links, links
from assur.workspace.aspects.neighbours import Neighbours, neighbours
from assur.workspace.aspects.signs import Signs, factor_signs
from assur.workspace.aspects.turning import ends_of
from assur.workspace.certified.boxes import Boxes, together
from assur.workspace.certified.paving import Stopped, pave
from assur.workspace.certified.planes import BoxQuestion, judged

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

ROUNDS = 16
"""Times that boxes between components are cut at most."""

MORE, SPARE = 1.3, 4096
"""Undecided boxes grow by this factor and number at most: parts that only touch are never told apart by cutting."""

DEEPER = 64.0
"""Boxes between components are cut down to this part of the finest size."""

AT_ONCE = 32
"""Components about which boxes are cut at a time, the largest first."""

STEPS = 1000


@dataclass(frozen=True, eq=False)
class BoxSearch:
    """The boxes found, and how they are linked.

    Attributes:
        frame: the question, over the coordinates that are cut.
        signs: (N, f) of the factors in certain boxes.
        possible: (M, f) of the factors in undecided boxes, where such a pose has that one for certain, else 0.
        outside: boxes in which no pose is reached.
        met: which of the first two meet.
        links: how they are connected.
        stopped: why it ended early; "" where it did not.
    """

    frame: BoxQuestion
    signs: Signs
    possible: Signs
    outside: Boxes
    met: Neighbours
    links: Links
    stopped: Stopped = ""

    @property
    def certain(self) -> Boxes:
        """Boxes in which every pose is reached and no factor is zero."""
        return self.met.certain

    @property
    def undecided(self) -> Boxes:
        """Boxes of which some poses may be so."""
        return self.met.undecided

    @property
    def open(self) -> float:
        """Share of the box that is undecided."""
        extents = [
            high - low for has, (low, high) in zip(self.frame.used, self.frame.box.intervals, strict=True) if has
        ]
        return float(np.sum(self.undecided.sizes.high) / np.prod(extents))


def search(frame: BoxQuestion, finest: Mapping[str, float], progress: Progress | None = None) -> BoxSearch:
    """Pave the box of a frame down to extents by coordinate, and further where components may or may not meet.

    Args:
        frame: criteria with factors among what must not be zero, over a box.
        finest: largest extent of an undecided box by coordinate, in length units and rad.
        progress: called with (steps done, steps in all).
    """
    paving = pave(frame.criteria, frame.box, finest=finest, progress=_part(progress))
    signs, possible = factor_signs(frame, paving.inside), factor_signs(frame, paving.boundary)
    met = neighbours(paving.inside, paving.boundary, ends_of(frame))
    state = BoxSearch(frame, signs, possible, paving.outside, met, links(met, signs, possible), paving.stopped)
    least = np.array([finest[name] for name in paving.names]) / DEEPER
    room = int(MORE * len(state.undecided)) + SPARE
    try:
        for k in range(0 if paving.stopped == "interrupted" else ROUNDS):
            if progress is not None:
                progress(STEPS + STEPS * k // ROUNDS, 2 * STEPS)
            chosen = _between(state, least)
            if not chosen.any() or len(state.undecided) + int(np.sum(chosen)) > room:
                break
            state = _cut(state, chosen)
    except KeyboardInterrupt:
        state = replace(state, stopped="interrupted")
    if progress is not None:
        progress(2 * STEPS, 2 * STEPS)
    return state


def _between(state: BoxSearch, least: FloatArray) -> BoolArray:
    """Undecided boxes (M,) on the shortest chains between components that are not told apart."""
    found, boxes = state.links, state.undecided
    weights = state.certain.sizes.low
    sizes = np.asarray(np.bincount(found.component, weights, minlength=len(found.group)), dtype=float)
    smaller = [k for k in np.argsort(-sizes) if found.group[k] in found.graphs and not _largest(found, sizes, int(k))]
    chosen = np.zeros(len(boxes), dtype=bool)
    for k in smaller[:AT_ONCE]:
        chosen |= found.chains(int(k))
    return np.asarray(chosen & np.any(boxes.high - boxes.low > least[:, None], axis=0))


def _largest(links: Links, sizes: FloatArray, component: int) -> bool:
    """Whether a component is the first of the largest of its group."""
    members = np.flatnonzero(links.group == links.group[component])
    return int(members[np.argmax(sizes[members])]) == component


def _cut(state: BoxSearch, chosen: BoolArray) -> BoxSearch:
    """The state with chosen boxes halved once along each coordinate, and what follows from it."""
    frame, parts = state.frame, state.undecided[chosen]
    inside, outside, axes = [], [state.outside], len(parts.low)
    known = judged(frame, parts, shares=False)
    for _ in range(axes):
        parts = parts.halved(known.axis)
        known = judged(frame, parts, shares=False)
        inside.append(parts[known.inside])
        outside.append(parts[known.outside])
        left = ~known.inside & ~known.outside
        parts, known = parts[left], known[left]
    fresh = together(inside)
    signs = np.concatenate([state.signs, factor_signs(frame, fresh)])
    possible = np.concatenate([state.possible[~chosen], factor_signs(frame, parts)])
    met = state.met.cut(chosen, fresh, parts)
    found = links(met, signs, possible)
    return replace(state, signs=signs, possible=possible, outside=together(outside), met=met, links=found)


def _part(progress: Progress | None) -> Progress | None:
    """The paving is the first half of the work."""
    if progress is None:
        return None
    return lambda done, total: progress(STEPS * done // total, 2 * STEPS)
