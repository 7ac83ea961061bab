"""pymadcad on a mechanism file: the same joint graph built of its joints, and its loops closed by its own solver."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version as installed_version
from typing import Any

import numpy as np

from assur.model.mechanism import Joint, MechanismRecord

missing = ""
try:
    from madcad import mathutils
    from madcad.joints import Prismatic, Revolute
    from madcad.kinematic import Free, Kinematic, KinematicError
except (ImportError, OSError) as error:
    mathutils, missing = None, str(error)

UNIT = 1e-3  # in m: its steps are at most 0.3 of whatever unit lengths and angles have
MOST_STEPS = 60


def version() -> str | None:
    """pymadcad's, or None where it cannot be loaded."""
    return None if mathutils is None else installed_version("pymadcad")


@dataclass(frozen=True, eq=False)
class Model:
    """A mechanism of sliders and hinges in pymadcad; with a free joint to the platform where its pose is given.

    Attributes:
        units: (n,) what a joint value of ours is times this is one of its own: m for a slider, rad for a hinge.
    """

    joints: Mapping[str, Any]
    free: Any
    kinematic: Any
    units: np.ndarray

    def at_inputs(self, record: MechanismRecord, start: np.ndarray, precision: float) -> np.ndarray | None:
        """Joint values (n,) with the inputs locked where `start` (n,) has them; None where it does not converge."""
        names = [name for k, name in enumerate(record.joints) if k in record.input_indices]
        held = [start[k] * self.units[k] for k in record.input_indices]
        fixed = {self.joints[name]: float(value) for name, value in zip(names, held, strict=True)}
        return self._solved(fixed, (start * self.units).tolist(), precision)

    def at_pose(self, point: np.ndarray, start: np.ndarray, precision: float) -> np.ndarray | None:
        """Joint values (n,) with the unturned platform's point (3,) held there, from a neighbouring `start` (n,)."""
        pose = np.array([1.0, 0.0, 0.0, 0.0, *(point * UNIT)])
        return self._solved({self.free: pose}, [*(start * self.units).tolist(), pose], precision)

    def _solved(self, fixed: Mapping[Any, Any], start: list[Any], precision: float) -> np.ndarray | None:
        with contextlib.redirect_stdout(io.StringIO()):  # it says on every call after how many steps it ends
            try:
                found = self.kinematic.solve(fixed, close=start, precision=precision, maxiter=MOST_STEPS)
            except KinematicError:
                return None
        return np.array(found[: len(self.units)], dtype=float) / self.units


def model(record: MechanismRecord, platform_given: bool = False) -> Model:
    """The joint graph of a record, every loop of it, redundant constraints too."""
    sliders = np.array([joint.type.name == "prismatic" for joint in record.joints.values()])
    joints = {
        name: (Prismatic if slides else Revolute)((joint.parent, joint.child), *_places(joint))
        for (name, joint), slides in zip(record.joints.items(), sliders, strict=True)
    }
    free = Free((record.base, record.platform.link)) if platform_given else None
    kinematic = Kinematic([*joints.values(), *([free] if free else [])], ground=record.base)
    return Model(joints, free, kinematic, np.where(sliders, UNIT, 1.0))


def _places(joint: Joint) -> tuple[Any, Any]:
    """Its frame in the parent and in the child, the third axis along the joint's."""
    axis = joint.axes[0]
    across = np.cross(np.eye(3)[np.argmin(np.abs(axis))], axis)
    across /= np.linalg.norm(across)
    turned = np.stack([across, np.cross(axis, across), axis], axis=1)
    return _matrix(turned, joint.at), _matrix(joint.turn.T @ turned, joint.child_at)


def _matrix(rotation: np.ndarray, point: np.ndarray) -> Any:
    full = np.eye(4)
    full[:3, :3], full[:3, 3] = rotation, point * UNIT
    return mathutils.mat4(*full.T.ravel().tolist())
