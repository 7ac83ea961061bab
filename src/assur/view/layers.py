"""Layers as triangles and segments: those of the page (`assur.page.layers`), unpacked."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import MechanismRecord
from assur.page import layers as packed
from assur.page.quantised import STEPS

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Layer:
    """A surface or lines where the platform's point can be.

    Attributes:
        kind: "workspace", "singular" or "section".
        label: what it is, with its numbers.
        colour, opacity: "#rrggbb", and between 0 and 1.
        vertices: (n, 3) in the base frame. faces: (k, 3) triangles or (k, 2) segments.
    """

    kind: str
    label: str
    colour: str
    opacity: float
    vertices: FloatArray
    faces: NDArray[np.int64]

    @property
    def lines(self) -> bool:
        """Whether it is made of segments."""
        return bool(self.faces.shape[1] == 2)


def layers(record: MechanismRecord, tick: Callable[[int, int], None] | None = None) -> tuple[Layer, ...]:
    """Workspace, sections and singular surfaces of the default working mode; none where the file gives no box.

    >>> from assur.model.registry import load_record
    >>> [(item.kind, item.lines) for item in layers(load_record("fivebar"))][0]
    ('workspace', False)
    """
    return tuple(unpacked(item) for item in packed.layers(record, tick=tick))


def unpacked(item: Mapping[str, Any]) -> Layer:
    """A layer from the page's form (`assur.page.quantised`), exact to half a step of its box."""
    low, high = np.array(item["low"]), np.array(item["high"])
    steps = np.frombuffer(base64.b64decode(item["vertices"]), dtype="<u2").reshape(-1, 3)
    kind = "<u4" if item["wide"] else "<u2"
    corners = 2 if item["primitive"] == "segments" else 3
    faces = np.frombuffer(base64.b64decode(item["faces"]), dtype=kind).reshape(-1, corners).astype(np.int64)
    vertices = low + steps / STEPS * (high - low)
    return Layer(item["kind"], item["label"], item["colour"], float(item["opacity"]), vertices, faces)
