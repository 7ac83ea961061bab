"""A disk on which one operation fails, is torn, or is the last one before a kill."""

import errno

from assur.results.disk import Disk


class Killed(BaseException):  # no error: nothing can be done about it
    """Stands for SIGKILL: from then on no operation does anything, also none that cleans up."""


class FaultyDisk(Disk):
    """Operations are counted from 0; the one of a number does not do what it should.

    Args:
        number: which one; none where None.
        way: "fails" (an error, as of a full disk), "torn" (half of it is done, then a kill), "last" (it is done, then a
            kill), "interrupted" (it is done, then Ctrl-C).
        real: whether what is synced really is; a kill of the process alone does not need that.
    """

    def __init__(self, number=None, way="fails", real=False):
        self.number, self.way, self.real = number, way, real
        self.count, self.dead, self.log = 0, False, []

    def _operate(self, kind, path, work, half=lambda: None):
        if self.dead:
            raise Killed
        number, self.count = self.count, self.count + 1
        self.log.append((kind, path))
        if number != self.number:
            work()
        elif self.way == "fails":
            raise OSError(errno.ENOSPC, "No space left on device", str(path))
        elif self.way == "interrupted":
            work()
            raise KeyboardInterrupt
        else:
            self.dead = True
            (half if self.way == "torn" else work)()
            raise Killed

    def make_folder(self, folder):
        self._operate("folder", folder, lambda: super(FaultyDisk, self).make_folder(folder))

    def make_file(self, path, size):
        make = super().make_file
        self._operate("make", path, lambda: make(path, size), lambda: make(path, 0))

    def resize(self, path, size):
        resize = super().resize
        self._operate("resize", path, lambda: resize(path, size), lambda: resize(path, size // 2))

    def write(self, path, pieces):
        write = super().write
        for place, piece in pieces:
            raw = bytes(piece)
            half = [(place, raw[: len(raw) // 2])]
            self._operate("write", path, lambda: write(path, [(place, raw)]), lambda: write(path, half))  # noqa: B023

    def sync(self, path):
        sync = super().sync
        self._operate("sync", path, lambda: sync(path) if self.real else None)

    def sync_folder(self, folder):
        sync = super().sync_folder
        self._operate("sync folder", folder, lambda: sync(folder) if self.real else None)

    def rename(self, old, new):
        rename = super().rename
        self._operate("rename", new, lambda: rename(old, new))

    def remove(self, path):
        remove = super().remove
        self._operate("remove", path, lambda: remove(path))
