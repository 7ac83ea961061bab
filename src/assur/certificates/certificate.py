"""A certificate: what is stated about a mechanism, the formulas, the tree of boxes that proves it, and what follows."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from importlib.metadata import version
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.certificates.exact_check import exact_check
from assur.certificates.formulas import RegionFormulas, formulas
from assur.certificates.leaves import INSIDE, OPEN, OUTSIDE, REGULAR, Leaves
from assur.certificates.tree import Limits, Tree, grow, planted
from assur.errors import UsageError
from assur.model.mechanism import MechanismRecord
from assur.model.registry import CLOSED_FORM
from assur.results.files import write_whole
from assur.work import Progress
from assur.workspace.bounds import Stroke
from assur.workspace.certified.boxes import Boxes, together
from assur.workspace.domain import box_of

FORMAT, VERSION = "assur certificate", 3
FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Kind = Literal["workspace", "box", "path"]
CLAIMS = {
    "workspace": ("leaves", "volume", "regular_volume"),
    "box": ("leaves", "reached", "regular"),
    "path": ("leaves", "reached", "regular"),
}
GAPS = {"workspace": 1e-2, "box": 1e-4}
"""What may stay open, as a share of what is certainly reached."""

MOST = 100_000
"""Leaves at most; the rest stays open."""


@dataclass(frozen=True, eq=False)
class Certificate:
    """A statement with its proof; `assur.verifier` checks it.

    Attributes:
        kind: "workspace", bounds of a volume; "box", whether a box is reached and free of singularities; "path",
            that all of a polyline is, see `path_certificate`. Of the volume: of all free coordinates, in length units
            and rad.
        statement: mechanism, hashes of its files, dimensions that are not the file's, mode, strokes, box or path.
        program: the formulas as data.
        proof: the tree, depth first; of a path, that of each of its boxes.
        claims: what the leaves prove together.
        exact: how surely the formulas are those of the joint graph, see `exact_check`.
    """

    kind: Kind
    statement: Mapping[str, Any]
    program: Mapping[str, Any]
    proof: str
    claims: Mapping[str, Any]
    exact: Mapping[str, Any]

    def to_json(self) -> dict[str, Any]:
        """Plain data with the checksum of everything else; floats are in hex, so that they are exact."""
        data = {
            "format": FORMAT,
            "version": VERSION,
            "kind": self.kind,
            "made_by": f"assur {version('assur')}",
            "statement": dict(self.statement),
            "program": dict(self.program),
            "exact": dict(self.exact),
            "claims": dict(self.claims),
            "proof": self.proof,
        }
        text = json.dumps(data, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
        return {**data, "sha256": hashlib.sha256(text.encode()).hexdigest()}

    @property
    def text(self) -> str:
        """The file's content."""
        return json.dumps(self.to_json(), ensure_ascii=True, allow_nan=False) + "\n"

    def write(self, path: str | Path) -> Path:
        """Write the file whole, or raise `OutputError`."""
        return write_whole(path, self.text)


def certificate(
    record: MechanismRecord,
    mode: str | None = None,
    box: Mapping[str, Sequence[float]] | ArrayLike | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
    *,
    kind: Literal["workspace", "box"] = "workspace",
    gap: float | None = None,
    finest: float = 0.0,
    most: int = MOST,
    progress: Progress | None = None,
    start: Mapping[str, Any] | None = None,
) -> Certificate:
    """Prove what a working mode reaches of a box of poses.

    Args:
        record: the mechanism; it needs a closed form.
        mode: working mode, that of the file by default.
        box: (low, high) per coordinate that varies, in order or by name, lengths and rad; the file's by default.
        strokes: input -> (low, high), or None for none; the file's for what is left out.
        held: values of coordinates that do not vary; the angles at home where there are more than three coordinates.
        kind: "workspace" for bounds of the volume, "box" for whether all of the box is reached and regular.
        gap: what may stay open, as a share of the volume certainly reached; 0.01 by default, and 0.0001 of kind "box".
        finest: sides below this share of the box's are not halved; 0 for no limit.
        most: leaves at most.
        progress: called with leaves so far and leaves at most.
        start: an earlier certificate as data, of the same statement, that is carried on. Only its cuts are taken over:
            every leaf is judged anew, so nothing that it says is believed.

    Errors:
        UsageError: no closed form, an unknown name, limits that are none, a start of another statement or without a
            whole tree.

    >>> from assur.model.registry import load_record
    >>> around = {"x": (-20, 0), "y": (0, 10), "z": (400, 420)}
    >>> found = certificate(load_record("zeng2019"), box=around, kind="box")
    >>> found.claims["reached"], found.claims["regular"]
    ('yes', 'yes')
    """
    gap = _checked(kind, gap, finest, most)
    rules = formulas(record, mode, strokes, held)
    where = box_of(record, box, rules.slice.free)
    leaves = Leaves(rules)
    whole = Boxes(*(np.array(side)[:, None] for side in (where.low, where.high)))
    unsettled = (OPEN, INSIDE) if kind == "box" else (OPEN,)
    limits = Limits(unsettled, gap, least_sides(whole, finest, rules.used), most, stoppable=True)
    box_stated = [exact(pair) for pair in zip(where.low, where.high, strict=True)]
    statement = {**common_statement(record, mode, strokes, rules), "box": box_stated}
    program = rules.to_json()
    if start is not None and [start.get(key) for key in ("kind", "statement", "program")] != [kind, statement, program]:
        raise UsageError("the certificate to be carried on states something else", hint="write to another file")
    tree = tree_of(
        leaves,
        whole,
        limits,
        progress,
        None if start is None else planted(start.get("proof"), whole, leaves.tokens),
    )
    everything = proved_by(leaves, [tree])
    return Certificate(
        kind,
        statement,
        program,
        tree.text,
        {name: everything[name] for name in CLAIMS[kind]},
        exact_check(record),
    )


def tree_of(
    leaves: Leaves, whole: Boxes, limits: Limits, progress: Progress | None = None, start: Tree | None = None
) -> Tree:
    """The tree of one box."""
    extents = whole.high - whole.low
    return grow(whole, leaves.tokens, lambda boxes: leaves.axes(boxes, extents, limits.least), limits, progress, start)


def least_sides(whole: Boxes, finest: float, used: Sequence[bool]) -> FloatArray:
    """Sides (k, 1) that are not halved: finer than asked for, at the end of floats, or without influence."""
    end = 4 * np.spacing(np.maximum(np.abs(whole.low), np.abs(whole.high)))
    return np.where(np.array(used)[:, None], np.maximum(finest * (whole.high - whole.low), end), np.inf)


def file_hashes(record: MechanismRecord) -> dict[str, str]:
    """SHA-256 of the mechanism's file and of its closed form, where it has one, by name."""
    paths = (record.file, record.file.parent / CLOSED_FORM)
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in paths if path.is_file()}


def _checked(kind: str, gap: float | None, finest: float, most: int) -> float:
    """The gap that is meant."""
    if kind not in GAPS:
        raise UsageError(f"kind: {kind!r} is none of {', '.join(GAPS)}")
    gap = GAPS[kind] if gap is None else gap
    if not 0 <= gap < math.inf:
        raise UsageError(f"gap: {gap!r} is no share", hint="1e-2 leaves a hundredth of the volume open")
    if not 0 <= finest < math.inf:
        raise UsageError(f"finest: {finest!r} is no share of the box", hint="0 for no limit, 1e-3 for a thousandth")
    if most < 1:
        raise UsageError(f"most: {most!r} leaves; a proof has at least one")
    return gap


def common_statement(
    record: MechanismRecord, mode: str | None, strokes: Mapping[str, Stroke | None] | None, rules: RegionFormulas
) -> dict[str, Any]:
    """What every kind states: which mechanism, in which mode, with which strokes, and over which coordinates."""
    given = {name: None if pair is None else exact(pair) for name, pair in (strokes or {}).items()}
    return {
        "mechanism": record.name,
        "files": file_hashes(record),
        "parameters": {name: float(value).hex() for name, value in record.overrides.items()},
        "mode": record.modes.default_working if mode is None else mode,
        "strokes": given,
        "held": {name: value.hex() for name, value in rules.slice.held.items()},
        "coordinates": list(rules.slice.free),
    }


def exact(values: Iterable[float]) -> list[str]:
    """Numbers as hex, which loses nothing.

    >>> exact([3])
    ['0x1.8000000000000p+1']
    """
    return [float(value).hex() for value in values]


def proved_by(leaves: Leaves, trees: Sequence[Tree]) -> dict[str, Any]:
    """What the leaves of trees prove together; volumes are exact sums, rounded outwards in the end."""
    boxes = together([tree.boxes[np.flatnonzero(tree.leaves)] for tree in trees])
    tokens = np.concatenate([tree.tokens[tree.leaves] for tree in trees])
    of = {key: tokens == key for key in (INSIDE, REGULAR, OPEN)}
    of[OUTSIDE] = ~(of[INSIDE] | of[REGULAR] | of[OPEN])
    count = {key: int(np.sum(mask)) for key, mask in of.items()}
    volume = {key: _volume(boxes[mask]) for key, mask in of.items()}
    reached = "no" if count[OUTSIDE] else "open" if count[OPEN] else "yes"
    changes = reached == "yes" and leaves.vanishes(boxes[of[REGULAR]], boxes[of[INSIDE]])
    inside = volume[INSIDE] + volume[REGULAR]
    return {
        "leaves": {
            "inside": count[INSIDE],
            "regular": count[REGULAR],
            "outside": count[OUTSIDE],
            "open": count[OPEN],
        },
        "volume": exact((_below(inside), -_below(-inside - volume[OPEN]))),
        "regular_volume": _below(volume[REGULAR]).hex(),
        "reached": reached,
        "regular": "no" if changes else "yes" if reached == "yes" and not count[INSIDE] else "open",
    }


def _volume(boxes: Boxes) -> Fraction:
    """Exact volume of boxes together; those of the same sides, of which a tree has many, are counted."""
    kind = np.zeros(len(boxes), dtype=np.int64)
    lengths: list[list[Fraction]] = [[]]  # of no side so far
    for low, high in zip(boxes.low, boxes.high, strict=True):
        axis, which = _lengths(low, high)
        kinds, kind = np.unique(kind * len(axis) + which, return_inverse=True)
        lengths = [[*lengths[k // len(axis)], axis[k % len(axis)]] for k in kinds.tolist()]
    counts = np.bincount(kind, minlength=len(lengths)).tolist()
    return sum((count * math.prod(sides) for count, sides in zip(counts, lengths, strict=True)), Fraction(0))


def _lengths(low: FloatArray, high: FloatArray) -> tuple[list[Fraction], IntArray]:
    """The different exact lengths of intervals (N,), and which of them (N,) each has."""
    length = high - low
    back = length - high
    lost = (high - (length - back)) - (low + back)  # by rounding, exactly: Knuth's sum of two numbers
    main, first = np.unique(length, return_inverse=True)
    rest, second = np.unique(lost, return_inverse=True)
    pairs, which = np.unique(first * len(rest) + second, return_inverse=True)
    exact_ones = [Fraction(main[k // len(rest)]) + Fraction(rest[k % len(rest)]) for k in pairs.tolist()]
    return exact_ones, which


def _below(value: Fraction) -> float:
    """The largest float that is not above an exact number."""
    rounded = float(value)
    return rounded if Fraction(rounded) <= value else math.nextafter(rounded, -math.inf)
