"""The folder of the trajectory: poses that are kept, a time bar, and what plays."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError
from assur.view.explain import Reason
from assur.view.trajectory import Trajectory, around, through

if TYPE_CHECKING:
    from assur.view.window import Window

FloatArray = NDArray[np.float64]
PERIOD = 8.0
"""Seconds that a trajectory takes."""

RATE = 25
"""Pictures a second at most."""


class Player:
    """Keeps poses, plans the way through them, and plays it."""

    def __init__(self, window: Window) -> None:
        self.window = window
        self.way: Trajectory | None = None
        self.kept: list[FloatArray] = []
        self._playing = threading.Event()
        with window.gui.add_folder("Trajectory", expand_by_default=False):
            self.buttons = window.gui.add_button_group("", ("keep pose", "forget", "play", "stop"))
            self.time = window.gui.add_slider("time", min=0.0, max=1.0, step=0.001, initial_value=0.0, disabled=True)
            window.notes["trajectory"] = window.gui.add_html("", visible=False)
        self.buttons.on_click(lambda event: self.command(str(event.target.value)))
        self.time.on_update(self._scrubbed)

    def command(self, name: str) -> None:
        """What a button asks for: "keep pose", "forget", "play" (a round where no pose is kept), "stop"."""
        if name == "keep pose":
            self.kept.append(self.window.state.pose)
            self.way = None
        elif name == "forget":
            self.forget()
        elif name == "stop":
            self.stop()
        elif not self._playing.is_set():
            self._playing.set()
            self.window.worker.ask("trajectory", self._plan)
            threading.Thread(target=self._run, daemon=True).start()

    def stop(self) -> None:
        """Stand still."""
        self._playing.clear()

    def forget(self) -> None:
        """No pose and no way."""
        self.stop()
        self.kept, self.way = [], None
        self.time.disabled = True

    def _plan(self) -> None:
        if self.way is None:
            state = self.window.state
            try:
                self.way = through(state, self.kept) if self.kept else around(state)
            except AssurError as error:
                self.stop()
                self.window.explain("trajectory", Reason("input", error.message))
                return
            except Exception:  # a bug: the worker shows it, and the next "play" begins anew
                self.stop()
                raise
            self.time.disabled = False
        self.window.explain("trajectory", self.way.reason)

    def _run(self) -> None:
        begun: float | None = None
        while self._playing.is_set():
            time.sleep(1 / RATE)
            if self._playing.is_set() and self.way is not None:
                begun = time.monotonic() - PERIOD * float(self.time.value) if begun is None else begun
                share = (time.monotonic() - begun) / PERIOD % 1.0
                self.window.worker.ask("time", partial(self._at, share))

    def _at(self, share: float) -> None:
        if self.way is not None:
            self.time.value = share
            self.window.now(replace(self.window.state, values=self.way.at(share), reason=None), "time")

    def _scrubbed(self, event: Any) -> None:
        if event.client is not None and self.way is not None:
            self.stop()
            self.window.worker.ask("time", partial(self._at, float(self.time.value)))
