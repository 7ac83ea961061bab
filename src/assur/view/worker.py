"""The worker: one thread that does what is asked, the newest wish of each kind only, and idle work when nothing is."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Protocol

Task = Callable[[], None]


class Idle(Protocol):
    """Work for when nothing is asked: called again and again until it returns False."""

    def __call__(self) -> bool:
        """Do one piece; whether there is more."""


class Worker:
    """Runs tasks one at a time in the order of their kinds; a newer task of a kind takes the place of the waiting one.

    >>> done = []
    >>> worker = Worker(lambda: False, print)
    >>> for number in range(3):
    ...     worker.ask("drag", lambda number=number: done.append(number))
    >>> worker.start()
    >>> worker.stop()
    >>> done
    [2]
    """

    def __init__(self, idle: Idle, failed: Callable[[Exception], None], pause: float = 0.25) -> None:
        self._waiting: dict[str, Task] = {}
        self._changed = threading.Condition()
        self._stopping = self._busy = False
        self._idle, self._failed, self._pause = idle, failed, pause
        self._thread = threading.Thread(target=self._run, name="assur view", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def ask(self, kind: str, task: Task) -> None:
        """Wish for something; what of the same kind still waits is dropped."""
        with self._changed:
            self._waiting[kind] = task
            self._changed.notify()

    def waits(self, kind: str) -> bool:
        """Whether a wish of that kind waits."""
        with self._changed:
            return kind in self._waiting

    @property
    def busy(self) -> bool:
        """Whether a wish waits or is being done."""
        with self._changed:
            return bool(self._waiting) or self._busy

    def stop(self, timeout: float = 10.0) -> None:
        """Finish what waits, then end."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        self._thread.join(timeout)

    def _run(self) -> None:
        more = True
        while True:
            with self._changed:
                if not self._waiting and not self._stopping:
                    self._changed.wait(self._pause if more else None)
                task = self._waiting.pop(next(iter(self._waiting))) if self._waiting else None
                self._busy = task is not None
                if task is None and self._stopping:
                    return
            try:
                if task is None:
                    more = self._idle()
                else:
                    task()
                    more = True
            except Exception as error:  # one failed wish must not end the view; it is shown instead
                self._failed(error)
                more = task is not None
            finally:
                self._busy = False
