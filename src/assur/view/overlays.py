"""The folder of layers: workspace, singular surfaces and sections, computed when they are asked for.

The workspace is computed in a thread of its own, so that the mechanism can be moved meanwhile; it ends at its next step
where it is cancelled or the dimensions change. A section at another height is cut from it by the worker.
"""

from __future__ import annotations

import html
import re
import threading
from typing import Any

from assur.model.mechanism import MechanismRecord
from assur.page.force_layers import force_layers
from assur.page.stiffness_layers import stiffness_layers
from assur.scene.layers import Layer, layers, layers_note, region, section_layer
from assur.view.dials import Dial
from assur.view.host import Host
from assur.workspace.region import Workspace

COMPUTE, CANCEL = "compute workspace and singular surfaces", "cancel"
IN_SPACE = 3
"""Coordinates of a workspace that has sections with an area."""

AT_REST = {
    "forces at rest": "what joints pass and actuators exert under gravity, here",
    "stiffness": "how the platform gives way under a force in any direction, here; not to scale",
    "slowest vibration": "how links bend in it at its largest, thicker where they store more energy, here",
}
"""Boxes of what belongs to the configuration that is shown, with their hints."""

SMALL = '<small style="display:block;padding:0 8px">{}</small>'
LAST = 1e12
"""Place of what stands at the end of a folder, whatever is added to it later."""


class CancelledError(Exception):
    """What is being computed is not wanted any more."""


class Overlays:
    """A button, boxes for what is at rest and for each layer, the height of a section, notes on what is seen."""

    def __init__(self, window: Host) -> None:
        self.window = window
        self.boxes: list[Any] = []
        self.height: Any = None
        self._request: object | None = None
        with window.gui.add_folder("Layers", expand_by_default=False) as self._folder:
            self.button = window.gui.add_button(COMPUTE)
            self.progress = window.gui.add_progress_bar(0.0, visible=False)
            self.note = window.gui.add_html("", visible=False, order=LAST)
            self.forces, self.stiffness, self.vibration = (
                window.gui.add_checkbox(label, initial_value=False, hint=hint) for label, hint in AT_REST.items()
            )
            self.told = window.gui.add_html("", visible=False)
        self.button.on_click(lambda _: self._pressed())
        for box in (self.forces, self.stiffness, self.vibration):
            box.on_update(lambda _: window.worker.ask("at rest", self.show_at_rest))

    def compute(self) -> None:
        """Find every layer of the working mode that is shown."""
        request = self._request = object()
        snapshot = self.window.snapshot

        def tick(done: int, total: int) -> None:
            if request is not self._request:
                raise CancelledError
            self.progress.value = 100.0 * done / total

        self.button.label, self.progress.value, self.progress.visible = CANCEL, 0.0, True
        try:
            workspace = region(snapshot.record, snapshot.modes[0] or None, tick=tick)
            made = layers(snapshot.record, workspace)
        except CancelledError:
            self._end(request)
        except Exception as error:  # this thread has nobody else who would hear of it
            self._end(request)
            self.window.failed(error)
        else:  # by the worker, which changes dimensions too
            self.window.worker.ask("layers", lambda: self._show(request, snapshot.record, workspace, made))

    def show_at_rest(self) -> None:
        """What is asked for of forces, stiffness, vibration where the mechanism stands; or why there is none."""
        snapshot = self.window.snapshot
        made: list[Layer] = []
        lines: list[str] = []
        if self.forces.value:
            made += force_layers(snapshot.record, snapshot.values, "here")
            lines += [] if made else ["no masses are stated, or nothing holds the platform here"]
        if self.stiffness.value or self.vibration.value:
            whole = stiffness_layers(snapshot.record, snapshot.values, "here")
            own = [*(whole[:1] if self.stiffness.value else ()), *(whole[1:2] if self.vibration.value else ())]
            made += own
            lines += [] if own else ["no stiffness or no masses are stated, or nothing holds the platform here"]
        self.window.stage.at_rest(made)
        lines += [f'<span style="color:{layer.colour}">{html.escape(layer.label)}</span>' for layer in made]
        self.told.visible = bool(lines)
        self.told.content = SMALL.format("<br>".join(lines))

    def clear(self) -> None:
        """Forget the layers, and what is being computed."""
        self._request = None
        for handle in (*self.boxes, *([self.height] if self.height else [])):
            handle.remove()
        self.boxes, self.height, self.note.visible = [], None, False
        self.window.stage.layers(())

    def _pressed(self) -> None:
        if self._request is None:
            threading.Thread(target=self.compute, daemon=True).start()
        else:
            self._request = None

    def _end(self, request: object) -> None:
        """The button as it was, unless something newer is being computed."""
        if self._request is None or self._request is request:
            self._request = None
            self.button.label, self.progress.visible = COMPUTE, False

    def _show(
        self, request: object, record: MechanismRecord, workspace: Workspace | None, made: tuple[Layer, ...]
    ) -> None:
        fresh = request is self._request
        self._end(request)
        if not fresh:
            return
        self.clear()
        self._say(layers_note(record, workspace))
        if not made:
            return
        with self._folder:
            for layer, node in zip(made, self.window.stage.layers(made), strict=True):
                short = re.split("[:,]", layer.label)[0]
                box = self.window.gui.add_checkbox(short, initial_value=layer.kind != "section", hint=layer.label)
                node.visible = bool(box.value)
                box.on_update(lambda event, node=node: setattr(node, "visible", bool(event.target.value)))
                self.boxes.append(box)
            if workspace is not None and len(workspace.box.names) == IN_SPACE:
                self._offer_section(record, workspace)

    def _offer_section(self, record: MechanismRecord, workspace: Workspace) -> None:
        """A slider for the height of a section, and a box; only the last height that is asked for is cut."""
        name = workspace.box.names[-1]
        low, high = float(workspace.box.low[-1]), float(workspace.box.high[-1])
        dial = Dial(name, low, high, False, record.unit, limits=True)
        height = self.height = self.window.gui.add_slider(
            f"section {name} [{record.unit}]", min=low, max=high, step=dial.step, initial_value=(low + high) / 2,
            hint=f"a section of the workspace at this {name}, cut when it is moved",
        )  # fmt: skip
        box = self.window.gui.add_checkbox("this section", initial_value=False)
        self.boxes.append(box)

        def cut() -> None:
            if height is self.height:  # else it is of layers that are gone
                self._cut(record, workspace, float(height.value), shown=bool(box.value))

        def moved(_: Any) -> None:
            box.value = True
            self.window.worker.ask("section", cut)

        height.on_update(moved)
        box.on_update(lambda _: self.window.worker.ask("section", cut))

    def _cut(self, record: MechanismRecord, workspace: Workspace, value: float, *, shown: bool) -> None:
        name = workspace.box.names[-1]
        layer = section_layer(record, workspace.section(min(max(value, workspace.box.low[-1]), workspace.box.high[-1])))
        self.window.stage.section(layer if shown else None)
        self._say(layer.label if layer else f"nothing is reached at {name} = {value:g} {record.unit}")

    def _say(self, text: str) -> None:
        self.note.content = SMALL.format(html.escape(text))
        self.note.visible = bool(text)
