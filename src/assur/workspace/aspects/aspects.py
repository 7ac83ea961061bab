"""Aspects of a working mode: the connected parts of its workspace without a parallel or serial singularity.

What is said of them is proved: boxes joined by faces lie in one aspect, and aspects that differ in the sign of a
factor, or that no chain of undecided boxes joins, are different ones. What neither proves is not told apart, and said
to be. All of it holds inside the box that is looked at: two aspects may be one through poses outside.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.intervals.interval import Interval, as_interval
from assur.results.notebook import Entries, Tabulated
from assur.work import Progress
from assur.workspace.aspects.path import AspectPath, path_between
from assur.workspace.aspects.places import Place, place, point_of
from assur.workspace.aspects.search import BoxSearch, search
from assur.workspace.aspects.turning import ends_of, turned
from assur.workspace.aspects.volumes import Pair, volumes
from assur.workspace.bounds import Stroke
from assur.workspace.certified.boxes import LEAST, Boxes
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.paving import Stopped
from assur.workspace.certified.planes import BoxQuestion
from assur.workspace.certified.region import HOW, unit
from assur.workspace.domain import Box, box_of
from assur.workspace.slices import Slice, slice_at

FloatArray = NDArray[np.float64]

KINDS = ("parallel", "serial")
PARTS = (1024, 256, 64)
"""Into so many parts boxes are cut along each of one, two or three coordinates, where nobody says how small."""


@dataclass(frozen=True, eq=False)
class Aspect:
    """One aspect, or a connected part of one.

    Attributes:
        label: signs of the factors that name it, and a number where several share them, the largest first: "+-/1".
        signs: factor -> 1 or -1, at every pose of it.
        volume: proved bounds (low, high), in the unit of the `Aspects`.
        boxes: certainly inside, joined by faces; over the coordinates that the paving has.
        perhaps: labels of those that may be the same aspect: undecided boxes may join them.
    """

    label: str
    signs: Mapping[str, int]
    volume: Pair
    boxes: Boxes = field(repr=False)
    perhaps: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Aspects(Tabulated):
    """The aspects of one working mode inside a box.

    Attributes:
        mechanism, mode, box: the question; `slice` says which coordinates vary and at what the others are held.
        strokes: as given.
        unit: of volumes: "mm^3"; "mm^2" where two coordinates vary.
        naming: factors of which the signs make up a label: all parallel ones, and serial ones that take both signs.
        aspects: the largest first.
        names: coordinates of the boxes; nothing depends on the others.
        turning: those of them that are looked at over a whole turn, so that they have no ends.
        finest: extents at which undecided boxes were no longer cut, by coordinate.
        search: the boxes and how they are linked; `order` gives the place in `aspects` of each component.
        stopped: why it ended early; "" where it did not.
        how: how it is known.
    """

    mechanism: str
    mode: str
    box: Box
    slice: Slice
    strokes: Mapping[str, Stroke | None] | None
    unit: str
    naming: tuple[str, ...]
    aspects: tuple[Aspect, ...]
    names: tuple[str, ...]
    turning: tuple[str, ...]
    finest: Mapping[str, float]
    search: BoxSearch = field(repr=False)
    order: tuple[int, ...] = field(repr=False)
    stopped: Stopped = ""
    how: str = HOW

    def __len__(self) -> int:
        return len(self.aspects)

    def __getitem__(self, label: str) -> Aspect:
        """The aspect of a label."""
        for item in self.aspects:
            if item.label == label:
                return item
        known = ", ".join(item.label for item in self.aspects) or "none"
        raise UsageError(f"{self.mechanism} has no aspect {label} in mode {self.mode}; it has {known}")

    def of(self, pose: Mapping[str, float] | Sequence[float] | FloatArray) -> Place:
        """Where a pose is: values in the order of the coordinates that vary, or by name; lengths and rad.

        >>> from assur.model.registry import load_record
        >>> found = aspects(load_record("fivebar"), "-+")
        >>> found.of([0.0, 200.0]).aspect, found.of([150.0, 260.0]).why
        ('+', 'reach1 < 0: not reached')
        """
        return place(self.search, self._labels, point_of(self.box, pose))

    def path(
        self,
        start: Mapping[str, float] | Sequence[float] | FloatArray,
        end: Mapping[str, float] | Sequence[float] | FloatArray,
    ) -> AspectPath:
        """Whether two poses lie in one aspect, and a path between them of which every pose is proved.

        >>> from assur.model.registry import load_record
        >>> found = aspects(load_record("fivebar"), "-+", {"x": (-300, 300), "y": (-300, 300)})
        >>> found.path([0.0, 200.0], [0.0, -200.0]).status
        'connected'
        """
        return path_between(self.search, self._labels, self.names, point_of(self.box, start), point_of(self.box, end))

    def _title(self) -> str:
        return f"{len(self.aspects)} aspects of {self.mechanism}, mode {self.mode}, {self.how}, in {self.unit}"

    def _entries(self) -> Entries:
        return [
            {"aspect": item.label, "at least": item.volume[0], "at most": item.volume[1], **item.signs}
            for item in self.aspects
        ]

    @property
    def undecided_share(self) -> float:
        """An upper bound of the share of the workspace that no aspect is proved to hold.

        The workspace is what is proved and some of the undecided boxes; the more of them, the larger the share.

        >>> from assur.model.registry import load_record
        >>> answer = aspects(load_record("fivebar"), finest=20.0)
        >>> bool(answer.search.open < answer.undecided_share < 1.0)
        True
        """
        proved = math.fsum(aspect.volume[0] for aspect in self.aspects)
        undecided = self.search.open * math.prod(high - low for low, high in self.search.frame.box.intervals)
        return undecided / (proved + undecided) if undecided else 0.0

    @property
    def _labels(self) -> list[str]:
        """Labels by component."""
        return [self.aspects[k].label for k in self.order]

    @property
    def told_apart(self) -> bool:
        """Whether all aspects listed are certainly different ones."""
        return not any(item.perhaps for item in self.aspects)

    @property
    def note(self) -> str:
        """What is not proved; "" where everything listed is."""
        size = ", ".join(f"{name} {value:.3g}" for name, value in self.finest.items() if name in self.names)
        parts = [] if self.told_apart else [f"some are not told apart at this size ({size})"]
        return "; ".join([*([self.stopped] if self.stopped else []), *parts])


def aspects(
    record: MechanismRecord,
    mode: str | None = None,
    box: Mapping[str, Sequence[float]] | ArrayLike | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
    finest: float | Mapping[str, float] | None = None,
    progress: Progress | None = None,
) -> Aspects:
    """The aspects of a working mode inside a box (P. Borrel, A. Liegeois 1986; for parallel mechanisms D. Chablat,
    P. Wenger, Working modes and aspects in fully parallel manipulators, ICRA 1998).

    Args:
        record: the mechanism; it needs a closed form.
        mode: signs of the working mode; the file's default where none is given.
        box: (low, high) per coordinate that varies, in order or by name, in length units and rad.
        strokes: input -> (low, high) as printed, or None for no limit; the file's for what is left out.
        held: pose coordinates that stand still.
        finest: extent at which undecided boxes are no longer cut, in length units; of angles that over the
            characteristic length. Or by coordinate. By default a 256th of the box, in space a 64th. Where
            components may or may not meet, boxes are cut down to a 64th of it.
        progress: called with (steps done, steps in all).

    Returns:
        The frozen result. What is listed is proved to be there; undecided boxes may hold further, small ones. An
        angle whose interval is a whole turn has no ends: aspects go on from 180 to -180 deg.

    Errors:
        UsageError: no closed form; a box, stroke or size that is none.

    Example: in the mode -+ the five-bar's reach above the base is one aspect, in a larger box there are three.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> [item.label for item in aspects(record, "-+").aspects]
    ['+']
    >>> found = aspects(record, "-+", {"x": (-300, 300), "y": (-300, 300)})
    >>> [item.label for item in found.aspects], found.naming, found.told_apart
    (['+', '-/1', '-/2'], ('sin_rods',), True)
    """
    poses = slice_at(record, held)
    domain = box_of(record, box, poses.free)
    asked = criteria(record, mode, strokes, held, KINDS).nonsingular
    used = asked.used if any(asked.used) else (True, *asked.used[1:])
    names = tuple(name for name, has in zip(domain.names, used, strict=True) if has)
    looked_at = turned(domain, names)
    extents = _extents(record, looked_at, finest, PARTS[sum(used) - 1])
    frame = BoxQuestion(asked, looked_at, used)
    found = search(frame, extents, progress)
    length = as_interval(1.0)
    for has, low, high in zip(used, domain.low, domain.high, strict=True):
        length = length if has else length * (Interval.of(high) - low)
    serial = asked.factors["serial"]
    signs = found.links.signs
    naming = tuple(name for k, name in enumerate(asked.names) if name not in serial or len(np.unique(signs[:, k])) > 1)
    bounds = [_times(pair, length) for pair in volumes(found)]
    order = sorted(range(len(bounds)), key=lambda k: (-bounds[k][0], k))
    labels = _labels(asked.names, naming, signs, order)
    return Aspects(
        mechanism=record.name,
        mode=mode or record.modes.default_working,
        box=domain,
        slice=poses,
        strokes=strokes,
        unit=unit(record, domain.names),
        naming=naming,
        aspects=tuple(
            Aspect(
                label=labels[k],
                signs=dict(zip(asked.names, signs[k].tolist(), strict=True)),
                volume=bounds[k],
                boxes=found.certain[found.links.component == k],
                perhaps=tuple(
                    labels[other] for other in order if other != k and found.links.group[other] == found.links.group[k]
                ),
            )
            for k in order
        ),
        names=names,
        turning=tuple(name for name, pair in zip(names, ends_of(frame), strict=True) if pair is not None),
        finest=extents,
        search=found,
        order=tuple(np.argsort(order).tolist()),
        stopped=found.stopped,
    )


def _extents(
    record: MechanismRecord, box: Box, finest: float | Mapping[str, float] | None, parts: int
) -> dict[str, float]:
    """The finest extent by coordinate; a part of the box where nothing is said."""
    sides = zip(box.names, box.low, box.high, strict=True)
    extents = {name: max((high - low) / parts, LEAST) for name, low, high in sides}
    if finest is None:
        return extents
    if isinstance(finest, Mapping):
        return {**extents, **finest}
    turning = finest / characteristic_length(record)
    return {name: turning if is_angle(name) else finest for name in box.names}


def _times(pair: Pair, length: Interval) -> Pair:
    total = Interval.of(*pair) * length
    return max(float(total.low), 0.0), float(total.high)


def _labels(names: Sequence[str], naming: Sequence[str], signs: NDArray[np.int8], order: Sequence[int]) -> list[str]:
    """Labels by component: signs, and a number among those that share them, in the order given."""
    columns = [names.index(name) for name in naming]
    texts = ["".join("+" if sign > 0 else "-" for sign in row[columns]) for row in signs]
    counts: dict[str, int] = {}
    labels = list(texts)
    for k in order:
        counts[texts[k]] = counts.get(texts[k], 0) + 1
        if texts.count(texts[k]) > 1:
            labels[k] = f"{texts[k]}/{counts[texts[k]]}"
    return labels
