"""Direct problems that end in one polynomial: its coefficients over intervals, all of its roots in discs.

The discs are as many as the degree, so there is no other root. Each real root is one pose, by the kernel over
intervals; and each pose is proved again from the legs.
"""

from __future__ import annotations

import itertools
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import position
from assur.kinematics.certified.branches import JudgedBranches, judged
from assur.kinematics.certified.given import joint_inputs, parameters
from assur.kinematics.certified.legs import Legs
from assur.kinematics.certified.matching import Candidates, matched
from assur.kinematics.certified.proofs import proofs
from assur.kinematics.certified.result import CertifiedSolutions, Doubt
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Branch, Eliminant
from assur.model.mechanism import MechanismRecord
from assur.numerics import polynomials
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import concatenate, empty, stack
from assur.numerics.number_types import Intervals
from assur.numerics.root_discs import RootDiscs, root_discs
from assur.work import stage

FloatArray = NDArray[np.float64]
TURNS = ((1, 0), (4, 3), (3, -4), (12, 5))
"""Turns by twice the angle of (c, s): in t = tan(angle/2) a root at infinity is at a finite place after one of them."""


@stage("proof by roots of the polynomial")
def direct_by_roots(record: MechanismRecord, eliminant: Eliminant, inputs: FloatArray) -> CertifiedSolutions:
    """Every pose at printed inputs (n,), from the real roots of one polynomial for each choice of its signs."""
    given, p = joint_inputs(record, inputs), parameters(record)
    extra: list[Doubt] = []
    pieces: list[JudgedBranches] = []
    margins = closed_form_of(record).direct_margins
    for signs in itertools.product((1.0, -1.0), repeat=len(eliminant.signs)):
        sign = (SimpleNamespace(**dict(zip(eliminant.signs, signs, strict=True))),) if eliminant.signs else ()
        entries = eliminant.coefficients(Intervals(), p, given, *sign)
        discs, root = _real_roots(eliminant, tuple(as_interval(entry) for entry in entries))
        extra += _doubts(eliminant, discs)
        if len(discs.real.low):
            kernel = partial(_back, eliminant, p, given, root, sign)
            pieces.append(judged(record, kernel, margins, len(discs.real.low)))
    floats = position.direct(record, inputs)
    known = proofs(Legs(record, inputs), floats)
    found = _together(record, pieces)
    rows = nearest_rows(found.pose, floats.poses, floats.exists)
    names = (_texts(found, floats.labels[rows]), _texts(found, floats.other_labels[rows]))
    parts = 2 ** len(eliminant.signs)
    which = f"{parts} polynomials" if parts > 1 else "the polynomial"
    right = f"the closed form, all roots of {which} of degree {eliminant.roots} in discs over intervals"
    return matched(record, inputs, Candidates(found, *names), known, floats, right, extra)


def _back(eliminant: Eliminant, p: SimpleNamespace, given: Any, root: Any, sign: tuple[Any, ...], ns: Any) -> Branch:
    return eliminant.back(ns, p, given, root, *sign)


def _real_roots(eliminant: Eliminant, coefficients: tuple[Interval, ...]) -> tuple[RootDiscs, Any]:
    """The discs, and the real roots as the kernel takes them back."""
    if eliminant.kind == "plain":
        discs = root_discs(_row(coefficients))
        return discs, discs.real
    best: tuple[RootDiscs, Any] | None = None
    for c, s in TURNS:
        discs = root_discs(_row(_turned(coefficients, c, s)))
        tangent = discs.real
        over, under = tangent * c + s, c - tangent * s
        size = over.square() + under.square()
        pair = ((under.square() - over.square()) / size, 2 * over * under / size)
        if best is None or (discs.decided, -len(discs.undecided.low)) > (best[0].decided, -len(best[0].undecided.low)):
            best = (discs, pair)
        if discs.decided and not len(discs.undecided.low):
            break
    if best is None:
        raise AssertionError("no turn was tried")
    return best


def _turned(coefficients: tuple[Interval, ...], c: int, s: int) -> tuple[Interval, ...]:
    """The polynomial in T, with t = (c T + s) / (c - s T): sum of a_k (c T + s)^k (c - s T)^(d - k)."""
    degree = len(coefficients) - 1
    total: tuple[Any, ...] = (0,) * (degree + 1)
    for k, factor in enumerate(coefficients):
        basis: tuple[int, ...] = (1,)
        for part, times in (((s, c), k), ((c, -s), degree - k)):
            for _ in range(times):
                basis = polynomials.multiply(basis, part)
        total = polynomials.add(total, polynomials.scaled(basis, factor))
    return tuple(as_interval(item) for item in total)


def _doubts(eliminant: Eliminant, discs: RootDiscs) -> list[Doubt]:
    if not discs.decided:
        whole = np.array([-np.inf]), np.array([np.inf])
        return [Doubt(eliminant.unknown, *whole, "the polynomial may vanish, or have a root at infinity")]
    meaning = "roots that nobody can tell apart, or from complex ones"
    return [
        Doubt(eliminant.unknown, np.array([low]), np.array([high]), meaning)
        for low, high in zip(discs.undecided.low, discs.undecided.high, strict=True)
    ]  # fmt: skip


def _row(items: tuple[Interval, ...]) -> Interval:
    return stack([Interval(item.low.reshape(()), item.high.reshape(()), item.defined.reshape(())) for item in items])


def _together(record: MechanismRecord, pieces: list[JudgedBranches]) -> JudgedBranches:
    """All branches of all choices of signs as one."""
    start = 0
    doubts: list[tuple[int, Doubt]] = []
    by: dict[str, int] = {}
    for item in pieces:
        doubts += [(k + start, doubt) for k, doubt in item.doubts]
        start += len(item.exists)
        for name, count in item.by.items():
            by[name] = by.get(name, 0) + count
    none = np.zeros(0, dtype=bool)
    return JudgedBranches(
        pose=concatenate([empty(len(record.platform.pose)), *(item.pose for item in pieces)]),
        inputs=concatenate([empty(len(record.inputs)), *(item.inputs for item in pieces)]),
        exists=np.concatenate([none, *(item.exists for item in pieces)]),
        absent=np.concatenate([none, *(item.absent for item in pieces)]),
        merging=np.concatenate([none, *(item.merging for item in pieces)]),
        doubts=tuple(doubts),
        by=by,
    )


def _texts(judged: JudgedBranches, labels: NDArray[np.str_]) -> tuple[str, ...]:
    """The labels of all branches; empty ones where there is no float answer."""
    return tuple(map(str, labels)) or ("",) * len(judged.exists)


def nearest_rows(bounds: Interval, poses: FloatArray, exists: NDArray[np.bool_]) -> list[int]:
    """The row of the float answer (K, m) that is each branch (N, m): that of the nearest pose; none without any.

    Where limbs stand in several ways at one pose, that is as near in several rows: each of these is one branch.
    """
    rows = np.flatnonzero(exists)
    if not len(rows):
        return []
    widths = np.linalg.norm(bounds.high - bounds.low, axis=-1)
    gaps = np.linalg.norm(bounds.middle[:, None] - poses[rows], axis=-1)
    taken: list[int] = []
    for width, own in zip(widths, gaps, strict=True):
        near = np.flatnonzero(own <= np.min(own) + width)
        free = [k for k in near if rows[k] not in taken]
        taken.append(int(rows[free[0] if free else np.argmin(own)]))
    return taken
