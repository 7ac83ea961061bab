"""Frames of links and screws of joints, as arrays at joint values in batches."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import joint_geometry
from assur.joint_graph.programs import Outputs, program
from assur.joint_graph.state import joint_state
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import STILL
from assur.model.mechanism import Joint, MechanismRecord

FloatArray = NDArray[np.float64]
Frame = tuple[FloatArray, FloatArray]
"""A frame in the base frame: orientation (..., 3, 3) and origin (..., 3)."""


def frames(record: MechanismRecord, values: FloatArray) -> dict[str, Frame]:
    """Frame of every link in the base frame, along the spanning tree, for joint values (..., n).

    Loops need not close: the joints that close them are not asked.
    """
    numbers = program(record, frame_numbers)(record, flat(record, values))
    batch, links = np.shape(values)[:-1], placed_links(record)
    blocks = numbers.reshape(len(links), 12, *batch)
    orientations = np.moveaxis(blocks[:, :9].reshape(len(links), 3, 3, *batch), (1, 2), (-2, -1))
    origins = np.moveaxis(blocks[:, 9:], 1, -1)
    return dict(zip(links, zip(orientations, origins, strict=True), strict=True))


def screws(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Unit twists (..., 6, n) of the joint coordinates in the base frame, moving the child against the parent.

    Rows: angular velocity, then the velocity of the body point at the base's origin.
    """
    numbers = program(record, _screws)(record, flat(record, values))
    return np.moveaxis(numbers.reshape(len(record.coordinates), 6, *np.shape(values)[:-1]), (0, 1), (-1, -2))


def child_frame(joint: Joint, parent: Frame, values: FloatArray) -> Frame:
    """Frame of the child link, given the parent's (3, 3), (3,) and the joint's values (k,)."""
    own = joint_geometry(joint)
    turned, shift = joint.type.motion(own.axes, own.advance, joint_state(joint.type, values[:, None])[:, 0].tolist())
    orientation = parent[0] @ np.array(turned, dtype=float) @ np.array(own.turn, dtype=float)
    origin = parent[1] + parent[0] @ (joint.at + np.array(shift, dtype=float))
    return orientation, origin - orientation @ joint.child_at


def flat(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Joint values (N, n) of (..., n).

    Errors:
        UsageError: as many as the mechanism has are wanted.
    """
    count = len(record.coordinates)
    if np.ndim(values) == 0 or np.shape(values)[-1] != count:
        raise UsageError(f"joint values of shape {np.shape(values)}; {count} of them are wanted")
    return np.reshape(np.asarray(values, dtype=float), (-1, count))


def placed_links(record: MechanismRecord) -> list[str]:
    """All links in the order in which the spanning tree places them, the base first."""
    return [record.base, *(joint.child if forward else joint.parent for joint, forward in joint_graph(record).tree)]


def frame_numbers(configuration: Configuration) -> Outputs:
    """Twelve numbers for each link as it is placed, "frame link,k": its orientation row by row, and its origin."""
    return {
        f"frame {place},{k}": number
        for place, (rotation, origin) in enumerate(configuration.frames.values())
        for k, number in enumerate((*rotation[0], *rotation[1], *rotation[2], *origin))
    }


def _screws(configuration: Configuration) -> Outputs:
    twists = [twist for joint in configuration.graph.joints for twist in configuration.twists(joint, STILL)]
    return {
        f"{column} {k}": number
        for column, (angular, velocity) in enumerate(twists)
        for k, number in enumerate((*angular, *velocity))
    }
