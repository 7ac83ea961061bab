"""The workspace of a mechanism with proof: bounds of its volume and of the areas of sections, and the boxes behind.

The bounds hold whatever the rounding does, for the mechanism whose dimensions, strokes and box are exactly the floats
given. What is not proved but assumed is stated in `assur.numerics.intervals.functions`: how far the library's cosine
and sine may be wrong.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from numpy.typing import ArrayLike

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.work import Progress
from assur.workspace.bounds import Stroke
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.paving import MOST, Paving, Stopped, pave
from assur.workspace.domain import Box, box_of
from assur.workspace.slices import Slice, slice_at

HOW = "proved by interval arithmetic"
STEPS = 1000

Pair = tuple[float, float]


@dataclass(frozen=True)
class CertifiedSection:
    """A cut across a coordinate.

    Attributes:
        coordinate, value: where, in length units or rad.
        area: proved bounds (low, high); of a region in a plane the length of the cut.
        unit: of the area.
        stopped: why the bounds are further apart than was asked for; "" where they are not.
    """

    coordinate: str
    value: float
    area: Pair
    unit: str
    stopped: Stopped = ""


@dataclass(frozen=True, eq=False)
class CertifiedWorkspace:
    """The workspace of one working mode, with proof.

    Attributes:
        mechanism, mode, box: what it is the workspace of.
        slice: which coordinates vary and at what the others are held.
        unit: of `volume`: "mm^3", or "mm^2 rad" where one of three coordinates is an angle.
        volume: proved bounds (low, high) of the volume (area in a plane) of the region inside the box.
        gap: the difference that was asked for, as a share of the lower bound; None where a size was asked for.
        sections: cuts across the last pose coordinate.
        paving: the boxes inside, outside and about the boundary.
        stopped: why the volume's bounds are further apart than was asked for; "" where they are not.
        how: how the bounds are known.
    """

    mechanism: str
    mode: str
    box: Box
    slice: Slice
    unit: str
    volume: Pair
    gap: float | None
    sections: tuple[CertifiedSection, ...]
    paving: Paving = field(repr=False)
    stopped: Stopped = ""
    how: str = HOW

    @property
    def held(self) -> Mapping[str, float]:
        """At what the other coordinates are held."""
        return self.slice.held

    @property
    def gap_reached(self) -> float | None:
        """Difference of the bounds as a share of the lower one; None where that is 0."""
        low, high = self.volume
        return (high - low) / low if low > 0 else None

    @property
    def note(self) -> str:
        """Why it ended early, and what the whole would take; "" where it did not end early.

        What a gap takes is told from what was reached: boxes about a surface grow with 1/gap, about a line with the
        root of that.
        """
        if not self.stopped:
            return ""
        text = {
            "interrupted": "interrupted: these are the bounds reached",
            "rounding": "the gap is as small as rounding lets it be",
            "too many boxes": "as many boxes were looked at as may be",
        }[self.stopped]
        reached = self.gap_reached
        if self.stopped != "too many boxes" or not self.gap or not reached:
            return text
        count = len(self.paving.boundary) * (reached / self.gap) ** ((len(self.paving.names) - 1) / 2)
        return f"{text}; the gap {self.gap:g} would take about {count:.1g} (reached: {reached:.2g})"


def certified_workspace(
    record: MechanismRecord,
    mode: str | None = None,
    box: Mapping[str, Sequence[float]] | ArrayLike | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
    gap: float = 1e-3,
    sections: Sequence[float] | None = None,
    finest: float | Mapping[str, float] | None = None,
    progress: Progress | None = None,
    section_gap: float | None = None,
    most: int = MOST,
) -> CertifiedWorkspace:
    """Proved bounds of the volume of a workspace inside a box, and of the areas of its sections.

    Args:
        record: the mechanism; it needs a closed form.
        mode: signs of the working mode; the file's default where none is given.
        box: (low, high) per coordinate that varies, in order or by name, in length units and rad.
        strokes: input name -> (low, high) as printed, or None for no limit; the file's for what is left out.
        held: pose coordinates that stand still, as `workspace` takes them.
        gap: by how much the bounds may differ, as a share of the lower one. Of a region below a millionth of its box
            the bounds are that share of the box times the gap apart.
        sections: values of the last pose coordinate; by default those of the file that lie in the box.
        finest: in place of a gap the extent at which boxes about the boundary are no longer cut, in length units;
            angles in rad are that over the characteristic length, or by coordinate. Sections keep the gap.
        progress: called with (steps done, steps in all).
        section_gap: the gap of sections, where it is another.
        most: boxes looked at, at most, for the volume and for each section.

    Returns:
        The frozen result. Ctrl-C, and more boxes than the memory holds, end it with the bounds reached; `note` says so.

    Errors:
        UsageError: no closed form; a box, stroke or section that is none; a gap or size that is not positive.

    Example: the paper's search box, Table 2 row 4: 500 mm times an area that quadrature gives as 45629.17 mm^2.

    >>> from assur.model.registry import load_record
    >>> found = certified_workspace(load_record("zeng2019"), gap=1e-4, sections=())
    >>> found.volume[0] < 22_814_586.4 < found.volume[1], found.gap_reached < 1e-4, found.unit
    (True, True, 'mm^3')
    """
    poses = slice_at(record, held)
    domain = box_of(record, box, poses.free)
    mode = mode or record.modes.default_working
    last, values = domain.names[-1], _values(record, domain, sections)
    asked = criteria(record, mode, strokes, held)
    tick = _Steps(progress, 1 + len(values))
    paving = pave(asked, domain, gap, _extents(record, domain.names, finest), tick.part(0), most)
    cuts: list[CertifiedSection] = []
    rest = Box(domain.names[:-1], domain.low[:-1], domain.high[:-1]) if values else domain
    for k, value in enumerate(values):
        if "interrupted" in (paving.stopped, *(item.stopped for item in cuts)):
            break
        asked = criteria(record, mode, strokes, {**poses.held, last: value})
        found = pave(asked, rest, section_gap or gap, None, tick.part(k + 1), most)
        cuts.append(CertifiedSection(last, value, (found.low, found.high), unit(record, rest.names), found.stopped))
    return CertifiedWorkspace(
        mechanism=record.name,
        mode=mode,
        box=domain,
        slice=poses,
        unit=unit(record, domain.names),
        volume=(paving.low, paving.high),
        gap=gap if finest is None else None,
        sections=tuple(cuts),
        paving=paving,
        stopped=paving.stopped,
    )


@dataclass(frozen=True)
class _Steps:
    """Progress of several pavings, one after the other, as one."""

    progress: Progress | None
    count: int

    def part(self, index: int) -> Progress | None:
        progress, count = self.progress, self.count
        if progress is None:
            return None
        return lambda done, total: progress(index * STEPS + done * STEPS // total, count * STEPS)


def unit(record: MechanismRecord, names: Sequence[str]) -> str:
    """The unit of a volume over coordinates.

    >>> from assur.model.registry import load_record
    >>> unit(load_record("zeng2019"), ("x", "z")), unit(load_record("planar_3rpr"), ("x", "phi"))
    ('mm^2', 'mm rad')
    """
    angles = sum(map(is_angle, names))
    powers = [(record.unit, len(names) - angles), ("rad", angles)]
    return " ".join(name if power == 1 else f"{name}^{power}" for name, power in powers if power)


def _values(record: MechanismRecord, box: Box, sections: Sequence[float] | None) -> tuple[float, ...]:
    """Where to cut: the file's sections are values of the last coordinate of the pose, where that one varies."""
    if sections is None:
        own = record.sections if box.names[-1] == record.platform.pose[-1] and len(box.names) > 1 else ()
        return tuple(value for value in own if box.low[-1] <= value <= box.high[-1])
    for value in sections:
        if not box.low[-1] <= value <= box.high[-1]:
            raise UsageError(
                f"section: {box.names[-1]} = {value:g} is outside the box, {box.low[-1]:g} to {box.high[-1]:g}"
            )
    if sections and len(box.names) < 2:
        raise UsageError(f"section: only {box.names[0]} varies", hint="a cut needs two coordinates that vary")
    return tuple(map(float, sections))


def _extents(
    record: MechanismRecord, names: Sequence[str], finest: float | Mapping[str, float] | None
) -> dict[str, float] | None:
    """The finest extent by coordinate."""
    if finest is None or isinstance(finest, Mapping):
        return None if finest is None else dict(finest)
    turning = finest / characteristic_length(record)
    return {name: turning if is_angle(name) else finest for name in names}
