"""A mechanism whose links have their frames elsewhere, which must decide nothing."""

from dataclasses import replace

import numpy as np

from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord


def with_moved_frames(record: MechanismRecord, seed: int) -> MechanismRecord:
    """The same with the origins of all links but the base shifted by chance; joint values and poses are as before."""
    rng = np.random.default_rng(seed)
    shift = {link: rng.uniform(-1, 1, 3) * characteristic_length(record) for link in record.links}
    shift[record.base] = np.zeros(3)
    joints = {
        name: replace(
            joint, at=joint.at + shift[joint.parent], child_at=joint.child_at + shift[joint.child], written=None
        )
        for name, joint in record.joints.items()
    }
    point = record.platform.point + shift[record.platform.link]
    return replace(record, joints=joints, platform=replace(record.platform, point=point, written=None))
