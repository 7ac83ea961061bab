"""What a folder of the window may ask of the window that it stands in."""

from __future__ import annotations

from typing import Any, Protocol

from assur.model.mechanism import MechanismRecord
from assur.view.explain import Reason
from assur.view.server import Served
from assur.view.snapshot import Snapshot
from assur.view.stage import Stage
from assur.view.worker import Worker


class Host(Protocol):
    """A window, as its folders see it; `gui` is viser's, `notes` are the red lines below controls, by label."""

    original: MechanismRecord
    served: Served
    gui: Any
    notes: dict[str, Any]
    stage: Stage
    worker: Worker

    @property
    def snapshot(self) -> Snapshot:
        """What is shown."""

    def go(self, query: str) -> None:
        """Show what a link says."""

    def now(self, snapshot: Snapshot, label: str) -> None:
        """Show another snapshot, for what was done with the control of a label."""

    def explain(self, label: str, reason: Reason | None) -> None:
        """Say below the control of a label why it stopped."""

    def failed(self, error: Exception) -> None:
        """Tell everybody what went wrong."""
