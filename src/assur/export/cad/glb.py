"""glTF 2.0, binary: one node per link, one named mesh per part, and a closed motion as an animation.

A root node turns our Z upwards into glTF's Y upwards and our length unit into the metre; everything below it is in
the mechanism's unit and in the frames of its links, which the animation moves. After the specification of the
Khronos Group, "glTF 2.0", sections 3.6 (accessors), 3.11 (animations) and 4.4 (binary form).
"""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.kinematics.validation.check import METRES
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations
from assur.scene.mesh import rgb
from assur.scene.part import Part
from assur.scene.parts import machine

FloatArray = NDArray[np.float64]
FLOAT, UNSIGNED = 5126, 5125
VERTICES, FACES = 34962, 34963
SECONDS = 6.0
"""How long the motion takes, once round."""

UPWARDS = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]
"""Quaternion (x, y, z, w) that turns Z upwards into Y upwards."""


class _Buffer:
    """The binary chunk, with the views and accessors that say what is in it."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: NDArray[Any], *, target: int | None = None) -> int:
        """Append rows (n,) or (n, k) of float32 or uint32; the index of their accessor, which has their bounds."""
        kind = UNSIGNED if values.dtype == np.uint32 else FLOAT
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": values.nbytes}
        self.views.append(view if target is None else {**view, "target": target})
        self.data += values.tobytes()
        rows = values.reshape(len(values), -1)
        self.accessors.append(
            {
                "bufferView": len(self.views) - 1,
                "componentType": kind,
                "count": len(values),
                "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[rows.shape[1]],
                "min": rows.min(axis=0).tolist(),
                "max": rows.max(axis=0).tolist(),
            }
        )
        return len(self.accessors) - 1


def glb(record: MechanismRecord, values: FloatArray, seconds: float = SECONDS) -> bytes:
    """The mechanism as a GLB file, moving through joint values (k, n) in equal times; it stands in the first.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("fivebar")
    >>> glb(record, home_values(record)[None])[:4]
    b'glTF'
    """
    buffer = _Buffer()
    made = machine(record)
    colours = list(dict.fromkeys(item.colour for item in made))
    nodes: list[dict[str, Any]] = [
        {"name": record.name, "rotation": UPWARDS, "scale": [METRES[record.unit]] * 3, "children": []}
    ]
    meshes: list[dict[str, Any]] = []
    places = _places(record, values)
    for link, (turns, origins) in places.items():
        nodes[0]["children"].append(len(nodes))
        own = [item for item in made if item.link == link]
        first = len(nodes) + 1
        node = {"name": link, "translation": origins[0].tolist(), "rotation": turns[0].tolist()}
        nodes.append({**node, "children": list(range(first, first + len(own)))} if own else node)
        for item in own:
            nodes.append({"name": item.name, "mesh": len(meshes)})
            meshes.append(_mesh(buffer, item, colours.index(item.colour)))
    document = {
        "asset": {"version": "2.0", "generator": "assur"},
        "scene": 0,
        "scenes": [{"name": record.title, "nodes": [0]}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [_material(colour) for colour in colours],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [],
    }
    if len(values) > 1:
        document["animations"] = [_animation(buffer, nodes, places, seconds)]
    document["buffers"] = [{"byteLength": len(buffer.data)}]
    return _packed(document, bytes(buffer.data))


def _places(record: MechanismRecord, values: FloatArray) -> dict[str, tuple[NDArray[np.float32], NDArray[np.float32]]]:
    """Per link, unit quaternions (k, 4) as (x, y, z, w) without jumps of sign, and origins (k, 3)."""
    found = {}
    for link, (rotation, origin) in frames(record, values).items():
        turn = np.roll(rotations.to_quaternion(rotation), -1, axis=-1)
        signs = np.cumprod(np.where(np.sum(turn[1:] * turn[:-1], axis=1) < 0, -1.0, 1.0))
        turn[1:] *= signs[:, None]
        found[link] = (turn.astype(np.float32), np.array(origin, dtype=np.float32))
    return found


def _mesh(buffer: _Buffer, part: Part, material: int) -> dict[str, Any]:
    """A part as one primitive: vertices that agree in place and normal are one."""
    drawn = part.shape.mesh(part.colour)
    rows = np.concatenate([drawn.corners, drawn.normals], axis=2).reshape(-1, 6).astype(np.float32)
    flat = drawn.corners.astype(np.float32)
    area = np.linalg.norm(np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]), axis=1)
    vertices, index = np.unique(rows, axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)[area > 0].astype(np.uint32).ravel()
    attributes = {
        "POSITION": buffer.add(np.ascontiguousarray(vertices[:, :3]), target=VERTICES),
        "NORMAL": buffer.add(np.ascontiguousarray(vertices[:, 3:]), target=VERTICES),
    }
    primitive = {"attributes": attributes, "indices": buffer.add(faces, target=FACES), "material": material}
    return {"name": part.name, "primitives": [primitive]}


def _material(colour: str) -> dict[str, Any]:
    """A dull material; glTF wants linear light, a colour "#rrggbb" is encoded (IEC 61966-2-1)."""
    encoded = rgb(colour)
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    surface = {"baseColorFactor": [*linear.tolist(), 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.6}
    return {"name": colour, "pbrMetallicRoughness": surface}


def _animation(
    buffer: _Buffer,
    nodes: list[dict[str, Any]],
    places: dict[str, tuple[NDArray[np.float32], NDArray[np.float32]]],
    seconds: float,
) -> dict[str, Any]:
    """Channels for the links that move."""
    count = len(next(iter(places.values()))[0])
    times = buffer.add(np.linspace(0.0, seconds, count).astype(np.float32))
    at = {nodes[k]["name"]: k for k in nodes[0]["children"]}
    channels: list[dict[str, Any]] = []
    samplers: list[dict[str, Any]] = []
    for link, (turns, origins) in places.items():
        for path, rows in (("rotation", turns), ("translation", origins)):
            if np.ptp(rows, axis=0).max() > 0:
                channels.append({"sampler": len(samplers), "target": {"node": at[link], "path": path}})
                samplers.append({"input": times, "output": buffer.add(rows), "interpolation": "LINEAR"})
    return {"name": "closed motion", "channels": channels, "samplers": samplers}


def _packed(document: dict[str, Any], data: bytes) -> bytes:
    """Header, the JSON chunk and the binary chunk, each a multiple of four bytes long."""
    text = json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(data))
    return head + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
