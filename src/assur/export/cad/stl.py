"""STL: the triangles of one solid, in mm and in the frame of its link, watertight."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold, OpType

from assur.kinematics.validation.check import METRES
from assur.model.mechanism import MechanismRecord
from assur.scene.bodies import bodies, fused, solid

RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def stl_files(record: MechanismRecord) -> dict[str, bytes]:
    """Files by name: LINK.stl of each link, and LINK.pins.stl of the pins that are put into it.

    >>> from assur.model.registry import load_record
    >>> list(stl_files(load_record("fivebar")))[:3]
    ['base.stl', 'base.pins.stl', 'crank1.stl']
    """
    millimetre = 1e3 * METRES[record.unit]
    found = {}
    for body in bodies(record):
        if body.fused:
            found[f"{body.link}.stl"] = stl(fused(body).scale((millimetre,) * 3), body.link)
        if body.pins:
            pins = Manifold.batch_boolean([solid(item.shape) for item in body.pins], OpType.Add)
            found[f"{body.link}.pins.stl"] = stl(pins.scale((millimetre,) * 3), f"{body.link} pins")
    return found


def stl(whole: Manifold, name: str) -> bytes:
    """A solid as binary STL; the header, which readers skip, has its name."""
    data = whole.to_mesh()
    corners = np.asarray(data.vert_properties[:, :3])[np.asarray(data.tri_verts)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    rows = np.zeros(len(corners), dtype=RECORD)
    rows["corners"] = corners
    rows["normal"] = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    head = f"assur {name}, mm".encode("ascii", "replace")[:80].ljust(80)
    return head + np.uint32(len(rows)).tobytes() + rows.tobytes()
