"""A path that was followed, and why it stopped."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border
from assur.kinematics.border import drive_names, input_names, joint_names
from assur.kinematics.following.course import Prescribed
from assur.kinematics.following.ranks import SINGULAR
from assur.kinematics.turns import periodic_inputs
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations
from assur.results.answers.path import NamedModes, PathAnswer, StoppedPath
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
ANOTHER = 1e-6
"""Two configurations that differ by more, in rad or characteristic lengths, are different ones."""

SINGULARITIES = ("serial", "parallel", "comprehensive", "constraint", "self_motion")
WORDS = {
    "serial": "a serial singularity",
    "parallel": "a parallel singularity",
    "comprehensive": "a comprehensive singularity",
    "constraint": "a constraint singularity",
    "self_motion": "a self-motion",
    "limit": "a limit",
    "unreachable": "what no motion of the mechanism does",
    "undecided": "a place where the steps became too small",
    "interrupted": "Ctrl-C ended it",
}


@dataclass(frozen=True, eq=False)
class Stop:
    """Why a path stopped, at its last point.

    Attributes:
        kind: serial, parallel, comprehensive, constraint or self_motion: a singularity lies ahead; limit: a stroke or
            a joint limit of the file; unreachable: the wanted rates are those of no motion; undecided: none of these
            is seen, but no step can be taken; interrupted: by Ctrl-C, nothing is said of what lies ahead.
        share, joints, pose, inputs: the place: share of the way, joint values (n,), pose (m,) and inputs (n,).
        quantity: what goes to zero: the smallest singular value with something locked, or the room to a limit.
        value: its value at the place; singular values without a dimension, rooms in rad or lengths.
        turns_back: whether the branch ends here (two branches merge); else it goes on behind the singularity.
        gap: where the branch ends, by how much the loops stay open a little further on, in length units: 0 where
            another assembly was found there, None where nothing was tried.
        factor, meaning, size: of a closed form, the factor that is closest to zero here, what it means where it is
            zero, and its value relative to its scale; "", "" and None where none is known.
    """

    kind: str
    share: float
    joints: FloatArray
    pose: FloatArray
    inputs: FloatArray
    quantity: str
    value: float
    turns_back: bool = False
    gap: float | None = None
    factor: str = ""
    meaning: str = ""
    size: float | None = None

    def __str__(self) -> str:
        begun = f"stopped at {100 * self.share:.6g} % of the way before {WORDS[self.kind]}"
        if self.share == 0.0 and self.kind in SINGULARITIES and abs(self.value) <= SINGULAR:
            begun = f"the start is at {WORDS[self.kind]}, which no one way leaves: begin beside it"
        return "; ".join([begun, *self.reasons])

    @property
    def reasons(self) -> list[str]:
        """What goes to zero at the place, what that means, and what lies beyond."""
        parts = [f"{self.quantity} is {self.value:.3g}{' already' if self.value < 0 else ''}"]
        if self.factor:
            parts.append(f"{self.factor} -> 0: {self.meaning}")
        if self.turns_back:
            ahead = "another assembly lies" if self.gap == 0.0 else f"a gap of {self.gap:.3g} remains"
            parts.append(f"the branch ends here, and a little further on {ahead}")
        return parts


@dataclass(frozen=True, eq=False, repr=False)
class Path(Tabulated):
    """A path of one mechanism in one mode, from point to point.

    Attributes:
        prescribed: "inputs" (a direct problem) or "poses" (an inverse one).
        shares: (N,) shares of the way, from 0 up.
        joints, poses, inputs: (N, n), (N, m), (N, n), in lengths and rad; angles of inputs run on without jumps.
        smallest: (N,) each: smallest singular value of the closure, and with the inputs or the platform locked.
        modes: working and assembly mode at the first and at the last point, by the quantities of the file.
        stopped: None where the end was reached.
    """

    record: MechanismRecord
    prescribed: Prescribed
    shares: FloatArray
    joints: FloatArray
    poses: FloatArray
    inputs: FloatArray
    smallest: Mapping[str, FloatArray]
    modes: tuple[tuple[str, str], tuple[str, str]]
    stopped: Stop | None

    def __len__(self) -> int:
        """Number of points."""
        return len(self.shares)

    def __repr__(self) -> str:
        return f"<{self}>"

    def _title(self) -> str:
        return str(self)

    def _entries(self) -> Entries:
        record, least = self.record, {f"least, {name} held": value for name, value in self.smallest.items()}
        names = ["share", *record.platform.pose, *drive_names(record)[: self.inputs.shape[1]], *least]
        numbers = [
            self.shares[:, None],
            pose_at_border(record, self.poses),
            inputs_at_border(record, self.inputs),
            *(value[:, None] for value in least.values()),
        ]
        return [dict(zip(names, row, strict=True)) for row in np.concatenate(numbers, axis=1).tolist()]

    def __str__(self) -> str:
        head = f"path of {self.record.name} along {self.prescribed}, {len(self)} points"
        if self.stopped is not None:
            return f"{head}; {self.stopped}"
        seen = f"{WORDS[self.left]} left, no other seen" if self.left else "no singularity seen"
        return f"{head}, {seen}{'; ' + self.remark if self.remark else ''}"

    @property
    def left(self) -> str:
        """The singularity at the start that the path has left: "serial", "parallel", or ""."""
        other, kind = ("inputs", "parallel") if self.prescribed == "poses" else ("poses", "serial")
        return kind if len(self) > 1 and self.smallest[other][0] <= SINGULAR else ""

    @property
    def closed(self) -> bool:
        """Whether what is prescribed is at the end what it was at the start."""
        return self._difference(self.prescribed) <= ANOTHER

    @property
    def changed_assembly(self) -> bool:
        """Whether a closed path ends in another configuration than it began in: a cuspidal mechanism."""
        return self.closed and self._difference("poses" if self.prescribed == "inputs" else "inputs") > ANOTHER

    @property
    def remark(self) -> str:
        """What is to be said of the end that one would not expect; empty where nothing is."""
        said = []
        if self.changed_assembly:
            same, other = ("inputs", "pose") if self.prescribed == "inputs" else ("pose", "inputs")
            said.append(f"the {same} are those of the start and the {other} is another: an assembly change")
        for kind, before, after in zip(("working", "assembly"), *self.modes, strict=True):
            if before != after:
                said.append(f"{kind} mode {before} became {after}")
        return "; ".join(said)

    def _difference(self, what: Prescribed) -> float:
        """How far the last inputs or pose are from the first, in rad and characteristic lengths."""
        length = characteristic_length(self.record)
        if what == "inputs":
            change = self.inputs[-1] - self.inputs[0]
            angular = np.array([item.coordinate.kind == "angle" for item in self.record.inputs])
            turning = periodic_inputs(self.record)
        else:
            names = self.record.platform.pose
            first, last = self.poses[0].copy(), self.poses[-1].copy()
            if has_quaternion(names):
                columns = [names.index(name) for name in QUATERNION]
                last[columns] *= np.sign(first[columns] @ last[columns])
            change = last - first
            turning = angular = np.array([is_angle(name) for name in names])
            length_like = np.array([name not in QUATERNION for name in names])
            change = np.where(length_like, change, change * length)
        change = np.where(turning, rotations.nearest_turn(change), change)
        return float(np.max(np.abs(np.where(angular, change, change / length))))

    def answer(self) -> PathAnswer:
        """The path with angles of poses and inputs in the mechanism's angle unit, joint values in rad.

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> start = next(iter(fivebar.inverse([0.0, 200.0], "-+")))
        >>> fivebar.follow(start.joints, poses=[0.0, 210.0]).answer().stopped is None
        True
        """
        record, stop = self.record, self.stopped
        return PathAnswer(
            mechanism=record.name,
            unit=record.unit,
            angle=record.angle,
            prescribed=self.prescribed,
            coordinates=record.platform.pose,
            input_names=input_names(record),
            joint_names=joint_names(record),
            shares=self.shares.tolist(),
            poses=pose_at_border(record, self.poses).tolist(),
            inputs=inputs_at_border(record, self.inputs).tolist(),
            joints=self.joints.tolist(),
            smallest={name: values.tolist() for name, values in self.smallest.items()},
            modes=tuple(NamedModes(*names) for names in self.modes),
            remark=self.remark,
            stopped=None if stop is None else self._stopped(stop),
        )

    def _stopped(self, stop: Stop) -> StoppedPath:
        return StoppedPath(
            kind=stop.kind,
            share=stop.share,
            pose=pose_at_border(self.record, stop.pose).tolist(),
            inputs=inputs_at_border(self.record, stop.inputs).tolist(),
            quantity=stop.quantity,
            value=stop.value,
            turns_back=stop.turns_back,
            gap=stop.gap,
            factor=stop.factor,
            meaning=stop.meaning,
            size=stop.size,
            text=str(stop),
        )
