"""The folder of what is kept: a picture, and a link that restores what is shown."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from PIL import Image

from assur.view import link
from assur.view.host import Host
from assur.view.link import Viewpoint
from assur.view.stage import triple

SECONDS = 20.0
"""How long a browser may take for a picture."""


class Keeper:
    """A button and a line of text; a link that is pasted into the line is followed."""

    def __init__(self, window: Host) -> None:
        self.window = window
        with window.gui.add_folder("Keep"):
            self.button = window.gui.add_button("screenshot")
            hint = "Restores camera, dimensions, mode and pose; paste one to go there."
            self.line = window.gui.add_text("link", "", hint=hint)
        self.button.on_click(self._picture)
        self.line.on_update(self._pasted)

    def refresh(self) -> None:
        """The link of what is shown now."""
        self.line.value = self.link()

    def link(self) -> str:
        """The address that restores what is shown, seen as the first browser sees it."""
        viewpoint = None
        for client in list(self.window.served.viser.get_clients().values())[:1]:
            seen = client.camera
            position, look_at, up = (triple(part) for part in (seen.position, seen.look_at, seen.up_direction))
            viewpoint = Viewpoint(position, look_at, up).times(1 / self.window.stage.scale)
        return f"{self.window.served.url}?{link.query(self.window.snapshot, viewpoint)}"

    def _pasted(self, event: Any) -> None:
        if event.client is not None:
            self.window.go(str(self.line.value))

    def _picture(self, event: Any) -> None:
        if event.client is None:
            return
        seen = event.client.camera
        pixels = event.client.get_render(seen.image_height, seen.image_width, transport_format="png", timeout=SECONDS)
        written = io.BytesIO()
        Image.fromarray(np.asarray(pixels)).save(written, "PNG")
        event.client.send_file_download(f"{self.window.original.name}.png", written.getvalue(), save_immediately=True)
