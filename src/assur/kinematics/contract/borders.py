"""Where a branch ends: at the zero of a margin, and only there, two branches merge and the joint graph is singular."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.closure import RANK_GAP
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions, solutions
from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.rates.motions import general, motions
from assur.kinematics.status import allows, branch_kernel, closed_form_of
from assur.model.closed_form import Margin
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
Signs = NDArray[np.int8]

HALVINGS = 60
"""Of a way from a place where a branch is to one where it is not: to the last digit of a float."""
PAIRS = 24
"""Ways that are halved, over all modes."""
REGULAR = 1e-3
"""A configuration whose singular values (sines) are all above this is regular: no two branches merge there."""


@dataclass(frozen=True, eq=False)
class BranchEnds:
    """Last places (B, k) at which a branch is listed, its signs (B, s), and the margin that ends it."""

    given: FloatArray
    signs: Signs
    margins: tuple[Margin, ...]


def ends(record: MechanismRecord, problem: Problem, given: FloatArray, random: np.random.Generator) -> BranchEnds:
    """Ends of branches on ways between places (N, k) at which they are listed and others.

    >>> from assur.model.registry import load_record
    >>> record, places = load_record("fivebar"), np.array([[0.0, 200.0], [0.0, 900.0]])
    >>> found = ends(record, "inverse", places, np.random.default_rng(0))
    >>> sorted({item.name for item in found.margins})
    ['reach1']
    """
    count = len(sign_names(record, problem))
    signs = random.choice(np.array([1, -1], dtype=np.int8), (PAIRS * 4, count))
    one, other = random.integers(len(given), size=(2, len(signs)))
    there = [_allowed(record, problem, given[rows], signs) for rows in (one, other)]
    kept = np.flatnonzero(np.all(there[0], axis=0) != np.all(there[1], axis=0))[:PAIRS]
    start_inside = np.all(there[0], axis=0)[kept]
    inside = np.where(start_inside[:, None], given[one[kept]], given[other[kept]])
    outside = np.where(start_inside[:, None], given[other[kept]], given[one[kept]])
    signs = signs[kept]
    for _ in range(HALVINGS):
        middle = (inside + outside) / 2
        real = np.all(_allowed(record, problem, middle, signs), axis=0)[:, None]
        inside, outside = np.where(real, middle, inside), np.where(real, outside, middle)
    failing = np.argmin(_allowed(record, problem, outside, signs), axis=0) if len(kept) else np.zeros(0, dtype=int)
    listed = _margins(record, problem)
    return BranchEnds(inside, signs, tuple(listed[k] for k in failing))


def named_by_signs(record: MechanismRecord, problem: Problem) -> bool:
    """Whether the branches of a problem are named by signs: then a margin says where they end.

    >>> from assur.model.registry import load_record
    >>> named_by_signs(load_record("fivebar"), "direct"), named_by_signs(load_record("planar_3rpr"), "direct")
    (True, False)
    """
    return problem == "inverse" or callable(closed_form_of(record).direct)


def refusing(record: MechanismRecord, problem: Problem, given: FloatArray, signs: Signs) -> str:
    """The first margin that does not allow the branch of these signs (s,) at a place (k,); empty where all do.

    >>> from assur.model.registry import load_record
    >>> refusing(load_record("fivebar"), "inverse", np.array([0.0, 900.0]), np.array([1, 1], dtype=np.int8))
    'reach1'
    """
    allowed = _allowed(record, problem, given[None], signs[None])[:, 0]
    return next((item.name for item, real in zip(_margins(record, problem), allowed, strict=True) if not real), "")


def _margins(record: MechanismRecord, problem: Problem) -> tuple[Margin, ...]:
    form = closed_form_of(record)
    return form.direct_margins if problem == "direct" else form.inverse_margins


def _allowed(record: MechanismRecord, problem: Problem, given: FloatArray, signs: Signs) -> BoolArray:
    """Which margins (M, N) allow branches of these signs (N, s) at places (N, k)."""
    names = sign_names(record, problem)
    asked = SimpleNamespace(**{name: signs[:, k].astype(float) for k, name in enumerate(names)})
    convert = border.input_components if problem == "direct" else border.pose_components
    kernel = branch_kernel(record) if problem == "direct" else closed_form_of(record).inverse
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        margins = kernel(Floats(), kernel_dimensions(record), convert(record, given), asked).margins
    rows = [np.broadcast_to(allows(record, item, margins[item.name]), len(given)) for item in _margins(record, problem)]
    return np.array(rows).reshape(len(rows), len(given))


def cut_short(record: MechanismRecord, problem: Problem, reached: BranchEnds) -> list[Mismatch]:
    """Margins that end a branch at a regular configuration of the joint graph, which goes on beyond.

    A margin without signs may end a reduced model where it likes; one of a sign is said to be where two branches merge.
    """
    whole = closed_form_of(record).complete_for == "joint_graph"
    judged = [k for k, item in enumerate(reached.margins) if item.zero == "merge" and (item.signs or whole)]
    if not judged:
        return []
    found = solutions(record, problem, reached.given[judged])
    rows = _own(found, reached.signs[judged])
    motion = motions(record, found.joints[rows], RANK_GAP)
    part = motion.inputs if problem == "direct" else motion.pose
    least = np.linalg.svd(part, compute_uv=False)[..., part.shape[-2] - 1] if len(rows) else np.zeros(0)
    least = np.where(motion.ranks.closure < np.max(motion.ranks.closure, initial=0), 0.0, least)
    if np.any(least > REGULAR):
        # a flat parallelogram is singular as a constraint, whatever inputs and platform do; all rows may be such places
        least = np.where(motion.ranks.closure < general(record).closure, 0.0, least)
    told: dict[str, Mismatch] = {}
    for row, size in zip(rows, least, strict=True):
        margin = reached.margins[judged[found.rows[row]]]
        if size > REGULAR:
            told.setdefault(margin.name, _told(found, int(row), margin, float(size)))
    return list(told.values())


def _own(solutions: Solutions, signs: Signs) -> NDArray[np.intp]:
    """Of all solutions at places those of the branch that ends there: merged signs are zero."""
    asked = signs[solutions.rows]
    return np.flatnonzero(np.all((solutions.signs == asked) | (solutions.signs == 0), axis=-1))


def _told(solutions: Solutions, row: int, margin: Margin, size: float) -> Mismatch:
    text = (
        f"it ends the branch {solutions.labels[row]} of the {solutions.problem} problem at "
        f"{place_text(solutions.record, solutions.problem, solutions.given[row])}, where the joint graph is regular "
        f"(smallest singular value {size:.3g}) and goes on"
    )
    return Mismatch("margin", margin.name, solutions.problem, text, "where it is zero two branches must merge")
