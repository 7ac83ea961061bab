"""Solutions of the direct or the inverse problem, however they were found: the one shape that all else reads."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import BatchError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.answers.at_border import angle_at_border, inputs_at_border, pose_at_border
from assur.kinematics.answers.excess import beyond, excesses, open_loop, within
from assur.kinematics.answers.self_motion import SelfMotionCurve
from assur.kinematics.answers.solution import Failure, Solution
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.limits import limits_stated
from assur.kinematics.modes import Problem
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.model.pose import kind_of
from assur.results.notebook import Entries, Tabulated

if TYPE_CHECKING:
    from assur.kinematics.limbs.solving import LimbSolutions

FloatArray = NDArray[np.float64]
BLOCK = 4096


class SolutionSet(Tabulated):
    """K candidates for each problem of a batch (...), of which those that `exists` are the solutions.

    Attributes:
        problem: "direct" or "inverse".
        given: (..., n) inputs, or (..., m) poses.
    """

    record: MechanismRecord
    problem: Problem
    given: FloatArray

    @property
    @abstractmethod
    def complete(self) -> bool:
        """Whether these are all solutions of the model `complete_for`."""

    @property
    @abstractmethod
    def complete_for(self) -> str:
        """The model: "joint_graph", or "reduced" where assemblies of the joint graph are left out."""

    @property
    @abstractmethod
    def right(self) -> str:
        """By what right the answer is complete, or why it is not known to be: one phrase."""

    @property
    @abstractmethod
    def exists(self) -> NDArray[np.bool_]:
        """Whether a candidate (..., K) is a solution that is listed."""

    @property
    @abstractmethod
    def poses(self) -> FloatArray:
        """Poses (..., K, m), NaN where there is no solution."""

    @property
    @abstractmethod
    def inputs(self) -> FloatArray:
        """Printed inputs (..., K, n), NaN where there is no solution."""

    @property
    @abstractmethod
    def joints(self) -> FloatArray:
        """Every joint's value (..., K, coordinates), in rad or length; NaN where there is no solution."""

    @property
    @abstractmethod
    def status(self) -> NDArray[np.int8]:
        """`Status` (..., K) of every candidate."""

    @property
    @abstractmethod
    def overall_status(self) -> NDArray[np.int8]:
        """`Status` (...) of the answer: the most severe among the solutions that answer, or why there is none."""

    @property
    @abstractmethod
    def labels(self) -> NDArray[np.str_]:
        """Text (..., K) of each solution's mode in this problem."""

    @property
    @abstractmethod
    def other_labels(self) -> NDArray[np.str_]:
        """Text (..., K) of each solution's mode in the other problem."""

    @property
    @abstractmethod
    def factors(self) -> Mapping[str, FloatArray]:
        """What vanishes where a solution (..., K) is singular, by name."""

    @property
    @abstractmethod
    def named_quantities(self) -> Mapping[str, FloatArray]:
        """What the source names on its way (..., K), by name; angles in rad."""

    @property
    @abstractmethod
    def curves(self) -> tuple[SelfMotionCurve, ...]:
        """The curves of a self-motion (a batch of one): described, never one sample."""

    @property
    @abstractmethod
    def failures(self) -> tuple[Failure, ...]:
        """Why there is no solution (a batch of one); empty where there is one."""

    @property
    def limbs(self) -> tuple[LimbSolutions, ...]:
        """Of one inverse problem whose solutions are all choices of one way a limb, these ways; else empty."""
        return ()

    def __repr__(self) -> str:
        size = f"batch {self.batch_shape}, {self.candidates} branches"
        return f"<{self.problem} solutions of {self.record.name}: {size}>"

    def rows(self) -> list[dict[str, object]]:
        """The listed solutions of a batch of one, each with its numbers in the file's units, mode, status and gap.

        >>> import assur
        >>> [row["mode"] for row in assur.load("fivebar").direct([1.0, 1.0]).rows()]
        ['+', '-']
        """
        record = self.record
        names = [own.name for own in record.drives]
        return [
            {
                **dict(zip(record.platform.pose, pose_at_border(record, item.pose).tolist(), strict=True)),
                **dict(zip(names, inputs_at_border(record, item.inputs).tolist(), strict=True)),
                "mode": item.mode,
                "status": item.status.name,
                "gap": item.residual,
            }
            for item in self
        ]

    def _entries(self) -> Entries:
        return [] if self.batch_shape else self.rows()

    def _sizes(self) -> Mapping[str, float]:
        record = self.record
        kinds = {name: kind_of(name) for name in record.platform.pose}
        kinds |= {item.name: item.coordinate.kind for item in record.drives}
        sizes = {"length": characteristic_length(record), "angle": float(angle_at_border(record, np.pi)), "": 1.0}
        return {name: sizes[kind] for name, kind in kinds.items()}

    def _title(self) -> str:
        if self.batch_shape:
            return repr(self)
        units = f"{self.record.unit} and {self.record.angle}"
        return f"{len(self)} {self.problem} solutions of {self.record.name} in {units}: {self.right}"

    def _picture(self) -> Any:
        """The listed solutions of a batch of one on one another, numbered as rows where their platforms are apart."""
        listed = () if self.batch_shape else tuple(self)
        if not listed:
            return None
        apart = self.problem == "direct"
        return import_module("assur.figures.solutions").pictured(self.record, listed, numbered=apart)

    def __getitem__(self, place: int) -> Solution:
        """One of the listed solutions of a batch of one, counted from 0."""
        return list(self)[place]

    @property
    def candidates(self) -> int:
        """K, the number of candidates for each problem."""
        return int(self.exists.shape[-1])

    @property
    def first_joints(self) -> FloatArray:
        """Joint values (..., coordinates) of the first solution that is listed, NaN where there is none."""
        joints = np.full((*self.batch_shape, self.joints.shape[-1]), np.nan)
        for place in map(tuple, np.argwhere(np.any(self.exists, axis=-1))):
            joints[place] = self.joints[place][np.argmax(self.exists[place])]
        return joints

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Shape (...) of the batch."""
        return self.given.shape[:-1]

    @cached_property
    def residuals(self) -> FloatArray:
        """What a solution (..., K) misses, in length units; NaN where there is no solution.

        The largest of: the closure error of the full joint graph; the distance of the platform from the pose; the
        difference of the actuated joint values from the inputs (angles times the characteristic length). So an
        answer to another question than the one asked has a residual.
        """
        joints = self.joints.reshape(-1, self.joints.shape[-1])
        real = np.all(np.isfinite(joints), axis=-1)
        rows = np.flatnonzero(real)
        error = np.full(len(joints), np.nan)
        for start in range(0, len(rows), BLOCK):
            block = rows[start : start + BLOCK]
            error[block] = np.maximum(closure_error(self.record, joints[block]), self._miss(joints[block], block))
        return error.reshape(self.joints.shape[:-1])

    @cached_property
    def within_limits(self) -> NDArray[np.bool_]:
        """Whether a solution (..., K) keeps every stroke, joint limit and cone of the file; false where there is none.

        True for every solution where the file states no limits.
        """
        joints = self.joints.reshape(-1, self.joints.shape[-1])
        rows = np.flatnonzero(np.all(np.isfinite(joints), axis=-1))
        given = np.repeat(self.given.reshape(-1, self.given.shape[-1]), self.candidates, axis=0)
        kept = np.zeros(len(joints), dtype=bool)
        kept[rows] = within(self.record, beyond(self.record, self.problem, given[rows], joints[rows]))
        return kept.reshape(self.joints.shape[:-1])

    def _closed(self, status: NDArray[np.int8]) -> NDArray[np.int8]:
        """A status (..., K) of candidates, `not_closed` where what answers keeps a gap."""
        with np.errstate(invalid="ignore"):
            gap = self.residuals > CLOSED * characteristic_length(self.record)
        return np.where(gap & (status < Status.not_closed), Status.not_closed, status).astype(np.int8)

    def _miss(self, joints: FloatArray, rows: NDArray[np.intp]) -> FloatArray:
        """How far joint values (N, coordinates) are from the poses and inputs of flat rows, in length units."""
        poses = self._asked(self.poses, "inverse").reshape(-1, self.poses.shape[-1])[rows]
        inputs = self._asked(self.inputs, "direct").reshape(-1, self.inputs.shape[-1])[rows]
        return border.distance(self.record, joints, poses, inputs)

    def _asked(self, poses: FloatArray, problem: Problem) -> FloatArray:
        """What was given, where this is the problem in which it is given; else what was found."""
        return np.broadcast_to(self.given[..., None, :], poses.shape) if self.problem == problem else poses

    def __iter__(self) -> Iterator[Solution]:
        """The listed solutions of a batch of one."""
        self._only_one()
        names = [self.record.coordinate_label(item) for item in self.record.coordinates]
        quantities = self.named_quantities
        for k in np.flatnonzero(self.exists):
            mode, other = str(self.labels[k]), str(self.other_labels[k])
            direct, status = self.problem == "direct", Status(int(self.status[k]))
            exceeded = excesses(self.record, self.problem, self.given, self.joints[k])
            yield Solution(
                record=self.record,
                pose=self.poses[k],
                inputs=self._drives(int(k)),
                mode=mode,
                working_mode=other if direct else mode,
                assembly_mode=mode if direct else other,
                joints=dict(zip(names, self.joints[k].tolist(), strict=True)),
                residual=float(self.residuals[k]),
                status=status,
                factors={name: float(value[k]) for name, value in self.factors.items()},
                quantities={name: float(value[k]) for name, value in quantities.items()},
                within_limits=not exceeded if limits_stated(self.record) else None,
                excesses=exceeded,
                open_loop=open_loop(self.record, self.joints[k]) if status == Status.not_closed else None,
            )

    def __len__(self) -> int:
        """Number of listed solutions of a batch of one."""
        self._only_one()
        return int(np.sum(self.exists))

    def _drives(self, k: int) -> FloatArray:
        """Every input of a solution of a batch of one."""
        if not self.record.redundant_inputs:
            return np.asarray(self.inputs[k])
        following = border.drives_of(self.record, self.joints[k])[len(self.record.inputs) :]
        return np.concatenate([self.inputs[k], following])

    def _only_one(self) -> None:
        if self.batch_shape != ():
            raise BatchError(
                f"this is a batch of shape {self.batch_shape}; iterate over one problem at a time",
                hint="use the arrays .poses, .inputs, .labels, .status, .exists, .residuals, .within_limits",
            )
