"""The stage: the mechanism, its letters, its ghosts and its layers as nodes of the scene that the browser shows."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import MechanismRecord
from assur.scene.layers import Layer
from assur.view.drawing import SolidDrawing, cloud, drawing, places
from assur.view.link import Viewpoint

FloatArray = NDArray[np.float64]
GHOST = (70, 95, 140)
GHOSTS = 4
"""Ghosts that are shown at most: more of them hide one another. The list of modes has all."""

FAINT = 0.3
SKY, GROUND, BRIGHT = (255, 255, 255), (170, 165, 160), 2.2
"""Light from above and from below, and how much of it."""

STEADY = (1.0, -1.25, 0.75)
"""The side from which the mechanism is seen first."""

OPENING = math.radians(45.0)
"""Angle between the lower and the upper edge of the picture."""

THROUGH = 0.45
"""How opaque links are in which arrows of forces are seen."""

ROOM, NARROW = 0.92, 0.8
"""Share of a picture that the mechanism takes at most when it is seen first, and how wide that is for its height.

Beside the panel a small window leaves that much.
"""


class Stage:
    """Draws on the scene of a viser server; every node's name begins with what it belongs to."""

    def __init__(self, server: Any, clicked: Callable[[int], None]) -> None:
        self.server, self.scene, self.clicked = server, server.scene, clicked
        self.drawing: SolidDrawing | None = None
        self._frames: dict[str, Any] = {}
        self._ghosts: list[tuple[str, Any]] = []
        self._layers: list[Any] = []
        self._letters: list[Any] = []
        self._section: Any = None
        self._solids: list[Any] = []
        self._at_rest: list[Any] = []
        self.scene.set_up_direction("+z")
        self._light()
        server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="medium")
        server.gui.main_panel.dock_right()  # beside the scene, not over it
        server.initial_camera.fov = OPENING

    def _light(self) -> None:
        """Lamps alone, neither surroundings nor shadows.

        Those are most of the work of a first picture without a graphics card, and nothing is seen until they are done.
        """
        self.scene.configure_environment_map(hdri=None)
        self.scene.configure_default_lights(enabled=True, cast_shadow=False)
        self.scene.add_light_hemisphere("/light", sky_color=SKY, ground_color=GROUND, intensity=BRIGHT)

    @property
    def scale(self) -> float:
        """The view's unit per unit of the mechanism."""
        return self.drawing.scale if self.drawing else 1.0

    def build(self, record: MechanismRecord, values: FloatArray) -> None:
        """Every link anew, made for joint values (n,), as dimensions may have changed."""
        drawn = drawing(record, values)
        with self.server.atomic():
            self._clear()
            self.drawing = drawn
            for link in record.links:
                self._frames[link] = self.scene.add_frame(f"/now/{link}", show_axes=False)
            for k, solid in enumerate(drawn.solids):
                node = self.scene.add_mesh_simple(
                    f"/now/{solid.link}/solid{k}", solid.vertices, solid.faces, color=solid.colour
                )
                self._solids.append(node)
            for k, letter in enumerate(drawn.letters):
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
            for link in record.links:
                mesh = self._whole(link)
                if link == record.base or mesh is None:
                    continue
                turn, origin = stand[link]
                node = self.scene.add_batched_meshes_simple(
                    f"/ghosts/{link}", *mesh, batched_wxyzs=turn, batched_positions=origin, batched_colors=GHOST,
                    opacity=FAINT, lod="off", cast_shadow=False, receive_shadow=False, visible=visible,
                )  # fmt: skip
                node.on_click(lambda event: self.clicked(int(event.instance_index or 0)))
                self._ghosts.append((link, node))

    def _whole(self, link: str) -> tuple[FloatArray, NDArray[np.int64]] | None:
        """Vertices and faces of all that is drawn of a link, whatever its colours; None where nothing is."""
        solids = [solid for solid in self.drawing.solids if solid.link == link] if self.drawing else []
        if not solids:
            return None
        starts = np.cumsum([0, *(len(solid.vertices) for solid in solids[:-1])])
        faces = [solid.faces + start for solid, start in zip(solids, starts, strict=True)]
        return np.concatenate([solid.vertices for solid in solids]), np.concatenate(faces)

    def layers(self, layers: Sequence[Layer]) -> list[Any]:
        """Surfaces and lines; their nodes, in the same order, none of which is visible yet."""
        self.section(None)
        for node in self._layers:
            node.remove()
        self._layers = [self._layer(str(k), layer) for k, layer in enumerate(layers)]
        return self._layers

    def section(self, layer: Layer | None) -> None:
        """The outline of a section, in the place of the last one; or none."""
        if self._section is not None:
            self._section.remove()
        self._section = None if layer is None else self._layer("section", layer, visible=True)

    def at_rest(self, layers: Sequence[Layer]) -> None:
        """Forces, stiffness and vibration in the place of the last ones, seen through the links; or none."""
        for node in self._at_rest:
            node.remove()
        self._at_rest = [self._layer(f"rest{k}", layer, visible=True) for k, layer in enumerate(layers)]
        for node in self._solids:
            node.opacity = THROUGH if layers else None

    def show_letters(self, visible: bool) -> None:
        """Letters, or none."""
        for node in self._letters:
            node.visible = visible

    def show_ghosts(self, visible: bool) -> None:
        """Ghosts, or none."""
        for _, node in self._ghosts:
            node.visible = visible

    def first_viewpoint(self, record: MechanismRecord, values: FloatArray) -> Viewpoint:
        """Where the reader stands first, in the view's own unit: all of the mechanism at (n,) is in the picture."""
        if self.drawing is None:
            return Viewpoint((3.0, -3.0, 2.0), (0.0, 0.0, 0.0))
        return framed(cloud(self.drawing, record, values))

    def look(self, viewpoint: Viewpoint) -> None:
        """From a viewpoint in the view's unit, for those who come and those who are there."""
        for target in (self.server.initial_camera, *(client.camera for client in self.server.get_clients().values())):
            target.position, target.look_at = viewpoint.position, viewpoint.look_at

    def _layer(self, name: str, layer: Layer, *, visible: bool = False) -> Any:
        scale = self.scale
        colour = tuple(int(layer.colour[i : i + 2], 16) for i in (1, 3, 5))
        if layer.lines:
            points = scale * layer.vertices[layer.faces]
            return self.scene.add_line_segments(
                f"/layers/{name}", points, colour, thickness=2.5, thickness_units="screen", visible=visible
            )
        return self.scene.add_mesh_simple(
            f"/layers/{name}", scale * layer.vertices, layer.faces, color=colour, opacity=layer.opacity, side="double",
            cast_shadow=False, receive_shadow=False, visible=visible,
        )  # fmt: skip

    def _clear(self) -> None:
        for node in (*(node for _, node in self._ghosts), *self._layers, *self._frames.values()):
            node.remove()
        self.section(None)
        self._solids = []
        self.at_rest(())
        self._ghosts, self._layers, self._letters = [], [], []
        self._frames = {}


def framed(points: FloatArray) -> Viewpoint:
    """The viewpoint that sees points (n, 3) as large as there is room for in a picture that is `NARROW`.

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
    aside = np.max(np.abs(seen - middle)[:, :2] / [NARROW, 1.0], axis=1)
    distance = float(np.max((seen - middle)[:, 2] + aside / (ROOM * math.tan(OPENING / 2))))
    return Viewpoint(triple(middle @ axes + distance * back), triple(middle @ axes))


def triple(values: Any) -> tuple[float, float, float]:
    """Three numbers, as viser takes a point or a direction."""
    return float(values[0]), float(values[1]), float(values[2])
