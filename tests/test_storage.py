import os
import signal
import subprocess
import sys

import pytest

from assur import storage

KILLED = """
import pathlib, sys, os, signal
from assur.storage import beside
with beside(pathlib.Path(sys.argv[1])) as stream:
    stream.write(b"half")
    stream.flush()
    os.kill(os.getpid(), signal.SIGKILL)
"""


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_what_a_killed_write_left_is_swept_by_the_next_one(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old")
    done = subprocess.run([sys.executable, "-c", KILLED, path], check=False, timeout=60)
    assert done.returncode == -signal.SIGKILL
    assert path.read_text() == "old"
    assert len(names(tmp_path)) == 2
    storage.replace_file(path, b"new")
    assert (names(tmp_path), path.read_text()) == (["a.txt"], "new")


def test_what_is_being_written_and_what_is_not_ours_stays(tmp_path):
    path = tmp_path / "a.txt"
    others = [".a.txt.swp", ".a.txt.abcdefgh", ".a.txt.0123456789abcdef.assur.bak", ".b.txt.0123456789abcdef.assur"]
    for name in others:
        (tmp_path / name).write_text("another's")
    (tmp_path / ".a.txt.0123456789abcdef.assur").symlink_to(tmp_path / ".a.txt.swp")
    with storage.beside(path) as stream:
        stream.write(b"first")
        storage.replace_file(path, b"second")
        assert path.read_text() == "second"
    assert path.read_text() == "first"
    assert names(tmp_path) == sorted([*others, ".a.txt.0123456789abcdef.assur", "a.txt"])


def test_what_is_renamed_was_on_the_disk_first(tmp_path, monkeypatch):
    done = []
    synced, replaced = os.fsync, type(tmp_path).replace

    def fsync(handle):
        done.append("folder" if os.path.isdir(f"/proc/self/fd/{handle}") else "file")  # noqa: PTH112
        synced(handle)

    def replace(self, target):
        done.append("renamed")
        return replaced(self, target)

    monkeypatch.setattr(os, "fsync", fsync)
    monkeypatch.setattr(type(tmp_path), "replace", replace)
    storage.replace_file(tmp_path / "a.txt", b"new")
    assert done == ["file", "renamed", "folder"]


@pytest.mark.parametrize("step", ["os.fsync", "pathlib.Path.chmod", "pathlib.Path.replace"])
def test_whatever_fails_leaves_what_was_there(tmp_path, monkeypatch, step):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(step, fail)
    with pytest.raises(OSError, match="No space left"):
        storage.replace_file(path, b"new")
    assert (names(tmp_path), path.read_text()) == (["a.txt"], "old")


def test_a_name_of_255_characters_can_be_written(tmp_path):
    path = tmp_path / ("a" * 255)
    storage.replace_file(path, b"new")
    assert names(tmp_path) == [path.name]
