"""Where the joints of a closed form stand, as numbers of the joint graph (`assur.joint_graph.state`)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from assur.model.mechanism import MechanismRecord
from assur.numerics.vectors import Matrix, minus, plus


def kernel_state(record: MechanismRecord, joints: Mapping[str, Any]) -> tuple[dict[str, list[Any]], dict[str, Matrix]]:
    """Numbers of each joint but screws, whose turns a closed form may tell otherwise, and matrices of ball joints."""
    state: dict[str, list[Any]] = {}
    rotations: dict[str, Matrix] = {}
    for name, joint in record.joints.items():
        if joint.type.ball:
            rotations[name] = joints[name]
            state[name] = _quaternion(joints[name])
            continue
        values = [joints[name]] if name in joints else [joints[f"{name}.{part}"] for part in joint.type.components]
        state[name] = [number for value in values for number in (value if isinstance(value, tuple) else (value,))]
    return state, rotations


def screws(record: MechanismRecord) -> Iterator[str]:
    """Joints with a screw, of which a state needs the angle beside its cosine."""
    return (name for name, joint in record.joints.items() if any(step.kind == "screw" for step in joint.type.steps))


def _quaternion(rows: Matrix) -> list[Any]:
    """A quaternion of any length of a rotation that is no half turn."""
    trace = plus(plus(rows[0][0], rows[1][1]), rows[2][2])
    off = minus(rows[2][1], rows[1][2]), minus(rows[0][2], rows[2][0]), minus(rows[1][0], rows[0][1])
    return [plus(trace, 1), *off]
