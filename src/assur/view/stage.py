"""The stage: the mechanism, its letters, its ghosts and its layers as nodes of the scene that the browser shows."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import MechanismRecord
from assur.scene.layers import Layer
from assur.view.drawing import Drawing, cloud, drawing, places
from assur.view.link import Camera

FloatArray = NDArray[np.float64]
GHOST = (70, 95, 140)
GHOSTS = 12
"""Ghosts that are shown at most; the list of modes has all."""

FAINT = 0.3
STEADY = (1.0, -1.25, 0.75)
"""The side from which the mechanism is seen first."""

OPENING = math.radians(45.0)
"""Angle between the lower and the upper edge of the picture."""

ROOM = 0.85
"""Share of the smaller side of the picture that the mechanism takes at most when it is seen first."""


class Stage:
    """Draws on the scene of a viser server; every node's name begins with what it belongs to."""

    def __init__(self, server: Any, clicked: Callable[[int], None]) -> None:
        self.server, self.scene, self.clicked = server, server.scene, clicked
        self.drawing: Drawing | None = None
        self._frames: dict[str, Any] = {}
        self._ghosts: list[tuple[str, Any]] = []
        self._layers: list[Any] = []
        self._letters: list[Any] = []
        self.scene.set_up_direction("+z")
        self.scene.configure_default_lights(enabled=True, cast_shadow=True)
        self.scene.add_light_hemisphere(
            "/light", sky_color=(255, 255, 255), ground_color=(170, 165, 160), intensity=1.1
        )
        server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="medium")
        server.gui.main_panel.dock_right()  # beside the scene, not over it
        server.initial_camera.fov = OPENING

    @property
    def scale(self) -> float:
        """The view's unit per unit of the mechanism."""
        return self.drawing.scale if self.drawing else 1.0

    def build(self, record: MechanismRecord, values: FloatArray) -> None:
        """Every link anew, made for joint values (n,), as dimensions may have changed."""
        found = drawing(record, values)
        with self.server.atomic():
            self._clear()
            self.drawing = found
            for link in record.links:
                self._frames[link] = self.scene.add_frame(f"/now/{link}", show_axes=False)
            for k, solid in enumerate(found.solids):
                self.scene.add_mesh_simple(
                    f"/now/{solid.link}/solid{k}", solid.vertices, solid.faces, color=solid.colour, side="double"
                )
            for k, letter in enumerate(found.letters):
                node = self.scene.add_label(
                    f"/now/{letter.link}/letter{k}", letter.name, position=letter.at, anchor="bottom-left"
                )
                self._letters.append(node)
        self.move(record, values)

    def move(self, record: MechanismRecord, values: FloatArray) -> None:
        """The links to where they are at joint values (n,)."""
        if self.drawing is None:
            return
        with self.server.atomic():
            for link, (turn, origin) in places(record, values, self.drawing.scale).items():
                self._frames[link].wxyz, self._frames[link].position = turn, origin

    def ghosts(self, record: MechanismRecord, others: Sequence[FloatArray], *, visible: bool) -> None:
        """Other assemblies (n,) as shades that a click makes current."""
        shown = np.array(others[:GHOSTS])
        with self.server.atomic():
            for _, node in self._ghosts:
                node.remove()
            self._ghosts = []
            if self.drawing is None or not len(shown):
                return
            stand = places(record, shown, self.drawing.scale)
            for k, solid in enumerate(self.drawing.solids):
                if solid.link == record.base:
                    continue
                turn, origin = stand[solid.link]
                node = self.scene.add_batched_meshes_simple(
                    f"/ghosts/solid{k}", solid.vertices, solid.faces, batched_wxyzs=turn, batched_positions=origin,
                    batched_colors=GHOST, opacity=FAINT, lod="off", cast_shadow=False, receive_shadow=False,
                    visible=visible,
                )  # fmt: skip
                node.on_click(lambda event: self.clicked(int(event.instance_index or 0)))
                self._ghosts.append((solid.link, node))

    def layers(self, found: Sequence[Layer]) -> list[Any]:
        """Surfaces and lines; their nodes, in the same order, none of which is visible yet."""
        for node in self._layers:
            node.remove()
        self._layers = [self._layer(k, layer) for k, layer in enumerate(found)]
        return self._layers

    def show_letters(self, visible: bool) -> None:
        """Letters, or none."""
        for node in self._letters:
            node.visible = visible

    def show_ghosts(self, visible: bool) -> None:
        """Ghosts, or none."""
        for _, node in self._ghosts:
            node.visible = visible

    def first_camera(self, record: MechanismRecord, values: FloatArray) -> Camera:
        """Where the reader stands first, in the view's own unit: all of the mechanism at (n,) is in the picture."""
        if self.drawing is None:
            return Camera((3.0, -3.0, 2.0), (0.0, 0.0, 0.0))
        return framed(cloud(self.drawing, record, values))

    def look(self, camera: Camera) -> None:
        """From a camera in the view's unit, for those who come and those who are there."""
        for target in (self.server.initial_camera, *(client.camera for client in self.server.get_clients().values())):
            target.position, target.look_at = camera.position, camera.look_at

    def _layer(self, k: int, layer: Layer) -> Any:
        scale = self.scale
        colour = tuple(int(layer.colour[i : i + 2], 16) for i in (1, 3, 5))
        if layer.lines:
            points = scale * layer.vertices[layer.faces]
            return self.scene.add_line_segments(
                f"/layers/{k}", points, colour, thickness=2.5, thickness_units="screen", visible=False
            )
        return self.scene.add_mesh_simple(
            f"/layers/{k}", scale * layer.vertices, layer.faces, color=colour, opacity=layer.opacity, side="double",
            cast_shadow=False, receive_shadow=False, visible=False,
        )  # fmt: skip

    def _clear(self) -> None:
        for node in (*(node for _, node in self._ghosts), *self._layers, *self._frames.values()):
            node.remove()
        self._ghosts, self._layers, self._letters = [], [], []
        self._frames = {}


def framed(points: FloatArray) -> Camera:
    """The camera that sees points (n, 3) as large as there is room for in a square picture.

    >>> seen = framed(np.array([[1.0, -1.0, 5.0], [1.0, 1.0, 5.0], [-1.0, 1.0, 5.0], [-1.0, -1.0, 5.0]]))
    >>> bool(np.max(np.abs(np.array(seen.look_at) - [0.0, 0.0, 5.0])) < 1e-12)
    True
    """
    back = np.array(STEADY) / np.linalg.norm(STEADY)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    axes = np.array([right, np.cross(back, right), back])
    seen = points @ axes.T
    middle = (np.min(seen, axis=0) + np.max(seen, axis=0)) / 2
    aside = np.max(np.abs(seen - middle)[:, :2], axis=1)
    distance = float(np.max((seen - middle)[:, 2] + aside / (ROOM * math.tan(OPENING / 2))))
    return Camera(_three(middle @ axes + distance * back), _three(middle @ axes))


def _three(values: FloatArray) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])
