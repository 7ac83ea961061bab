"""The folder of layers: workspace, singular surfaces and sections, computed when they are asked for."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from assur.scene.layers import layers

if TYPE_CHECKING:
    from assur.view.window import Window

COMPUTE = "compute workspace and singular surfaces"


class Overlays:
    """A button, and a box for each layer that was found."""

    def __init__(self, window: Window) -> None:
        self.window = window
        self.boxes: list[Any] = []
        self._folder = window.gui.add_folder("Layers", expand_by_default=False)
        with self._folder:
            self.button = window.gui.add_button(COMPUTE)
        self.button.on_click(lambda _: threading.Thread(target=self.compute, daemon=True).start())

    def compute(self) -> None:
        """Find every layer of the working mode that is shown; dropped where the dimensions change meanwhile."""
        state = self.window.state
        record = state.record
        self.button.label, self.button.disabled = "computing ...", True
        try:
            found = layers(record, state.modes[0] or None)
        finally:
            self.button.label, self.button.disabled = COMPUTE, False
        if record is not self.window.state.record:
            return
        self.clear()
        with self._folder:
            for layer, node in zip(found, self.window.stage.layers(found), strict=True):
                box = self.window.gui.add_checkbox(layer.label, initial_value=layer.kind != "section")
                node.visible = bool(box.value)
                box.on_update(lambda event, node=node: setattr(node, "visible", bool(event.target.value)))
                self.boxes.append(box)

    def clear(self) -> None:
        """Forget the layers."""
        for box in self.boxes:
            box.remove()
        self.boxes = []
