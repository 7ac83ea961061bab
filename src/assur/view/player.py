"""The folder of the trajectory: waypoints, a time bar, and what plays."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError
from assur.view.explain import Reason
from assur.view.host import Host
from assur.view.trajectory import Trajectory, around, through

FloatArray = NDArray[np.float64]
PERIOD = 8.0
"""Seconds that a trajectory takes."""

RATE = 25
"""Pictures a second at most."""

PLAY, STOP = "play", "stop"


class Player:
    """Remembers poses, plans the way through them, and plays it: round and round, or as far as it can be gone."""

    def __init__(self, window: Host) -> None:
        self.window = window
        self.way: Trajectory | None = None
        self.waypoints: list[FloatArray] = []
        self._going = threading.Event()
        with window.gui.add_folder("Trajectory", expand_by_default=False):
            hint = "A way through the poses that you keep; a small round where none is kept."
            self.buttons = window.gui.add_button_group("poses", ("keep", "forget"), hint=hint)
            self.button = window.gui.add_button(PLAY)
            self.time = window.gui.add_slider("time", min=0.0, max=1.0, step=0.001, initial_value=0.0, disabled=True)
            window.notes["trajectory"] = window.gui.add_html("", visible=False)
        self.buttons.on_click(lambda event: self.keep() if event.target.value == "keep" else self.forget())
        self.button.on_click(lambda _: self.stop() if self._going.is_set() else self.play())
        self.time.on_update(self._scrubbed)

    def keep(self) -> None:
        """The pose that is shown is the last waypoint."""
        self.stop()
        self.waypoints.append(self.window.snapshot.pose)
        self.way = None
        self._show()

    def forget(self) -> None:
        """No waypoint and no way."""
        self.stop()
        self.waypoints, self.way = [], None
        self._show()

    def play(self) -> None:
        """On from where the time bar stands, anew where the way ends there or is left."""
        if self._going.is_set():
            return
        if self.way and not np.array_equal(self.way.at(float(self.time.value)), self.window.snapshot.values):
            self.way = None  # something else moved it meanwhile
        self._going = threading.Event()  # one for each run, so that a run that was stopped does not go on with the next
        self._going.set()
        self._show()
        self.window.worker.ask("trajectory", self._plan)
        threading.Thread(target=self._run, args=(self._going,), daemon=True).start()

    def stop(self) -> None:
        """Stand still."""
        self._going.clear()
        self._show()

    def _show(self) -> None:
        self.button.label = STOP if self._going.is_set() else PLAY
        self.time.disabled = self.way is None

    def _plan(self) -> None:
        if self.way is not None:
            return
        snapshot = self.window.snapshot
        self.window.explain("trajectory", None)
        try:
            self.way = through(snapshot, self.waypoints) if self.waypoints else around(snapshot)
        except AssurError as error:
            self.stop()
            self.window.explain("trajectory", Reason("input", error.message))
            return
        except Exception:  # a bug: the worker shows it, and the next "play" begins anew
            self.stop()
            raise
        self.time.value = 0.0
        self._show()

    def _run(self, going: threading.Event) -> None:
        begun: float | None = None
        while going.is_set():
            time.sleep(1 / RATE)
            way = self.way
            if way is None or not going.is_set():
                continue
            if begun is None:
                first = float(self.time.value) if self.time.value < way.end else 0.0
                begun = time.monotonic() - PERIOD * first
            share = (time.monotonic() - begun) / PERIOD
            if way.reason is not None and share >= way.end:
                self.window.worker.ask("time", partial(self._at, way.end))
                self.stop()
            else:
                self.window.worker.ask("time", partial(self._at, share % 1.0))

    def _at(self, share: float) -> None:
        way = self.way
        if way is None:
            return
        reached = min(share, way.end)
        self.time.value = reached
        self.window.now(replace(self.window.snapshot, values=way.at(reached), reason=None), "time")
        if way.reason is not None and reached >= way.end:
            where = f"stopped at {100 * way.end:.3g} % of the way: {way.reason}"
            self.window.explain("trajectory", Reason(way.reason.kind, where))

    def _scrubbed(self, event: Any) -> None:
        if event.client is not None and self.way is not None:
            self.stop()
            self.window.worker.ask("time", partial(self._at, float(self.time.value)))
