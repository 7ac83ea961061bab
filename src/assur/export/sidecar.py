"""What URDF leaves out, as JSON: the loops, the inputs, our joint values at home, and where our frames lie.

The form, all lengths in m and angles in rad, quaternions w x y z:

- `format` 1, `mechanism`, `urdf` (the name of the file beside it), `unit` {"length": "m", "angle": "rad"};
- `links`: URDF link -> {`frame`}: the place of our frame's origin in the URDF link's frame, whose axes are parallel;
- `joints`: URDF joint -> {`joint`, `home`}: the joint of the mechanism, and its value at the URDF's zero; of a part
  of a ball joint {`joint`, `part`}, where Rx Ry Rz of the three parts is the rotation away from home;
- `couplings`: of screws, {`slide`, `hinge`, `ratio`}: away from home, slide = ratio times hinge;
- `loops`: one for each joint that is not in the tree: {`joint`, `type`, `parent`, `child`, `steps`}. `parent` and
  `child` are {`link`, `position`, `orientation`}: a frame in a URDF link's frame. The loop is closed where the
  parent's frame, moved by the steps one after another, lies on the child's. A step is {`name`, `kind`, `axis`, `home`}:
  a hinge or slide along an axis, at zero at home; or a ball, which may turn anyhow;
- `inputs`: [{`name`, `joint`, `sign`, `offset`}]: printed input = sign times (URDF value + home) + offset;
- `platform`: {`link`, `position`}: the point whose coordinates are the pose.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.export.bodies import Bodies, bodies
from assur.export.names import link_name
from assur.export.steps import ElementaryJoint, joint_steps
from assur.export.urdf import anchor, single_steps, tree_links
from assur.joint_graph.frames import child_frame, frames
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics import rotations
from assur.results.json_text import plain

FloatArray = NDArray[np.float64]


def sidecar(record: MechanismRecord, urdf_name: str) -> dict[str, Any]:
    """The data of the file beside a URDF file of that name; see the module for the form.

    >>> from assur.model.registry import load_record
    >>> data = sidecar(load_record("fivebar"), "fivebar.urdf")
    >>> [loop["joint"] for loop in data["loops"]], sorted(data["joints"])
    (['P'], ['A1', 'A2', 'B1', 'B2'])
    """
    model = bodies(record)
    links = tree_links(record)
    steps = [step for link in links for step in model.bodies[link].steps]
    screws = [joint.name for joint in record.joints.values() if joint.type.screw]
    data = {
        "format": 1,
        "mechanism": record.name,
        "urdf": urdf_name,
        "unit": {"length": "m", "angle": "rad"},
        "links": {link_name(link): {"frame": -anchor(model.bodies[link]) + 0.0} for link in links},
        "joints": {single.name: _joint(step, single) for step in steps for single in single_steps(step)},
        "couplings": [
            {"slide": f"{name}.advance", "hinge": name, "ratio": record.joints[name].pitch * model.metre / (2 * np.pi)}
            for name in screws
        ],
        "loops": [_loop(record, joint, model) for joint in joint_graph(record).cut],
        "inputs": [
            {
                "name": item.name,
                "joint": record.coordinate_label(item.coordinate),
                "sign": item.sign,
                "offset": item.offset * (model.metre if item.coordinate.kind == "length" else 1.0),
            }
            for item in record.drives
        ],
        "platform": {"link": link_name(record.platform.link), "position": _place(record, model)},
    }
    result: dict[str, Any] = plain(data)
    return result


def _joint(step: ElementaryJoint, single: ElementaryJoint) -> dict[str, Any]:
    if step.kind == "ball":
        return {"joint": step.joint, "part": single.name.rpartition(".")[2]}
    return {"joint": step.joint, "home": step.home}


def _place(record: MechanismRecord, model: Bodies) -> FloatArray:
    return model.metre * record.platform.point - anchor(model.bodies[record.platform.link])


def _loop(record: MechanismRecord, joint: Joint, model: Bodies) -> dict[str, Any]:
    """A cut joint: the child's frame at home, at the joint's point, seen from both links."""
    placed = frames(record, model.home)
    parent = placed[joint.parent]
    reached = child_frame(joint, parent, model.home[joint_graph(record).slices[joint.name]])
    steps = joint_steps(record, joint, model.home, forward=True, metre=model.metre)
    turn = parent[0].T @ reached[0]
    point = model.metre * (parent[0].T @ (reached[1] - parent[1])) + turn @ steps[0].at
    return {
        "joint": joint.name,
        "type": joint.type.name,
        "parent": _frame(model, joint.parent, point, turn),
        "child": _frame(model, joint.child, steps[0].at, np.eye(3)),
        "steps": [
            {"name": step.name, "kind": step.kind}
            | ({} if step.kind == "ball" else {"axis": step.axis, "home": step.home})
            for step in steps
        ],
    }


def _frame(model: Bodies, link: str, point: FloatArray, turn: FloatArray) -> dict[str, Any]:
    return {
        "link": link_name(link),
        "position": point - anchor(model.bodies[link]),
        "orientation": rotations.to_quaternion(turn),
    }
