"""What a closed form claims at a batch of problems: every solution that it lists, one after another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closed_form.branches import Branches
from assur.kinematics.modes import Problem, mode_texts, sign_names
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status, closed_form_of, scale
from assur.model.closed_form import Margin, PolynomialSystem
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int_]


@dataclass(frozen=True, eq=False)
class Solutions:
    """Solutions (S, ...) of one problem, all that are listed.

    Attributes:
        rows: which of the problems (S,) each is of; `given` (S, k) is that problem.
        labels: its mode, as the answer names it.
        signs: (S, s) of this problem's mode signs as they are claimed; 0 where two branches merge.
        poses, inputs, joints: (S, m), (S, n), (S, coordinates).
        jp, jq: (S, r, k) and (S, r, n), of joint values, not of printed inputs.
        factors, margins: name -> (S,).
        named: name of a mode sign, of either problem -> the quantity (S,) of `core` of which it is the sign.
        near: (S,) how near the nearest margin is to zero: of a radicand the root of its share, at most 1.
        undecided: problems of which it is left open whether there are more.
    """

    record: MechanismRecord
    problem: Problem
    rows: IntArray
    given: FloatArray
    labels: NDArray[np.str_]
    signs: NDArray[np.int8]
    poses: FloatArray
    inputs: FloatArray
    joints: FloatArray
    jp: FloatArray
    jq: FloatArray
    factors: Mapping[str, FloatArray]
    margins: Mapping[str, FloatArray]
    named: Mapping[str, FloatArray]
    near: FloatArray
    undecided: IntArray

    def __len__(self) -> int:
        return len(self.rows)

    def at(self, chosen: Any) -> Solutions:
        """Some of the solutions, by a mask or by indices."""
        whole = {name: value for name, value in vars(self).items() if name not in ("record", "problem", "undecided")}
        taken: dict[str, Any] = {
            name: {key: item[chosen] for key, item in value.items()} if isinstance(value, Mapping) else value[chosen]
            for name, value in whole.items()
        }
        return Solutions(self.record, self.problem, undecided=self.undecided, **taken)

    def spread(self, most: int) -> Solutions:
        """At most so many of the solutions, as evenly over the modes as they go."""
        if len(self) <= most:
            return self
        _, mode, counts = np.unique(self.labels, return_inverse=True, return_counts=True)
        order = np.argsort(mode, kind="stable")
        rank = np.arange(len(self)) - np.repeat(np.cumsum(counts) - counts, counts)
        return self.at(np.sort(order[np.argsort(rank, kind="stable")[:most]]))

    @property
    def size(self) -> FloatArray:
        """The length (S,) against which a gap counts: the mechanism's own, or that of a pose or an input far off."""
        record = self.record
        lengths = [np.abs(self.poses[:, k]) for k, name in enumerate(record.platform.pose) if name in ("x", "y", "z")]
        lengths += [
            np.abs(self.inputs[:, k]) for k, item in enumerate(record.inputs) if item.coordinate.kind == "length"
        ]
        return np.asarray(np.max([np.full(len(self), characteristic_length(record)), *lengths], axis=0))


def solutions(record: MechanismRecord, problem: Problem, given: FloatArray) -> Solutions:
    """All that the closed form lists at poses or inputs (N, k); what it leaves undecided it does not list.

    >>> from assur.model.registry import load_record
    >>> found = solutions(load_record("fivebar"), "inverse", np.array([[0.0, 200.0], [0.0, 9999.0]]))
    >>> found.rows.tolist(), found.labels.tolist()
    ([0, 0, 0, 0], ['++', '+-', '-+', '--'])
    """
    solve = direct if problem == "direct" else inverse
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        found = solve(record, given, method="closed form")
        if not isinstance(found, Branches):
            raise AssertionError("a closed form answers by branches")
        return _listed(record, problem, found)


def solves(record: MechanismRecord, problem: Problem) -> bool:
    """Whether a problem is answered by branches or roots, which cost nothing.

    >>> from assur.model.registry import load_record
    >>> solves(load_record("fivebar"), "direct"), solves(load_record("gough_stewart"), "direct")
    (True, False)
    """
    kernel = closed_form_of(record).direct
    return problem == "inverse" or not (kernel is None or isinstance(kernel, PolynomialSystem))


def _listed(record: MechanismRecord, problem: Problem, branches: Branches) -> Solutions:
    form, core = closed_form_of(record), branches.branch.core
    unsettled = np.isin(branches.formula_status, (Status.undecided, Status.self_motion))
    finite = np.all(np.isfinite(branches.joints), axis=-1) & np.all(np.isfinite(branches.poses), axis=-1)
    chosen = branches.exists & (branches.formula_status != Status.undecided) & finite
    jp, jq = (_matrix(rows, branches) for rows in form.jacobians(Floats(), kernel_dimensions(record), core))
    named = {name: _expanded(getattr(core, sign.attribute), branches) for name, sign in form.signs.items()}
    margins = form.direct_margins if problem == "direct" else form.inverse_margins
    signs = branches.signs(problem) if problem == "direct" and not callable(form.direct) else branches.modes
    return Solutions(
        record,
        problem,
        rows=np.nonzero(chosen)[0],
        given=np.broadcast_to(branches.given[:, None], (*chosen.shape, branches.given.shape[-1]))[chosen],
        labels=mode_texts(signs)[chosen] if sign_names(record, problem) else branches.labels[chosen],
        signs=signs[chosen],
        poses=branches.poses[chosen],
        inputs=branches.inputs[chosen],
        joints=branches.joints[chosen],
        jp=jp[chosen],
        jq=jq[chosen],
        factors={name: value[chosen] for name, value in branches.factors.items()},
        margins={item.name: branches.margins[item.name][chosen] for item in margins},
        named={name: value[chosen] for name, value in named.items()},
        near=_nearness(record, margins, branches)[chosen],
        undecided=np.flatnonzero(np.any(unsettled, axis=-1)),
    )


def _nearness(record: MechanismRecord, margins: Sequence[Margin], branches: Branches) -> FloatArray:
    near = np.ones(branches.exists.shape)
    for item in margins:
        share = np.abs(branches.margins[item.name]) / scale(record, item.scale)
        power = 2 if item.zero == "merge" else max(item.unit, 1)
        near = np.fmin(near, share ** (1 / power))
    return near


def _expanded(value: Any, branches: Branches) -> FloatArray:
    """A number of the kernel as (N, K): its sign axes, which are not expanded, come last."""
    count = len(branches.given)
    wide = np.broadcast_to(np.asarray(value, dtype=float), (*branches.sign_shape, count))
    return np.moveaxis(wide.reshape(len(branches.modes_asked), count), 0, -1)


def _matrix(rows: Sequence[Sequence[Any]], branches: Branches) -> FloatArray:
    entries = [np.stack([_expanded(entry, branches) for entry in row], axis=-1) for row in rows]
    return np.stack(entries, axis=-2)  # (N, K, r, k)
