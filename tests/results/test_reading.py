import os
import socket

import pytest

from assur.errors import MechanismFileError, UsageError
from assur.results.reading import file_content, file_text


@pytest.fixture
def special(tmp_path):
    """Name -> the path of what is no file, and the word for it."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("pipe")
    with socket.socket(socket.AF_UNIX) as line:
        line.bind(str(tmp_path / "socket"))
        yield {
            "a pipe": [tmp_path / "pipe", tmp_path / "link"],
            "a socket": [tmp_path / "socket"],
            "a device": ["/dev/zero", "/dev/null"],
            "a folder": [tmp_path],
        }


def test_what_is_no_file_is_refused_before_it_is_read(special):
    for word, paths in special.items():
        for path in paths:
            with pytest.raises(UsageError, match=f"it is {word}, not a file"):
                file_content(type(next(iter(special["a folder"])))(path))


def test_a_file_has_a_largest_size(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"x" * 11)
    assert file_content(path, 11) == b"x" * 11
    with pytest.raises(UsageError, match="larger than 10 bytes"):
        file_content(path, 10)


def test_a_file_that_becomes_a_pipe_is_not_waited_for(tmp_path, monkeypatch):
    path, regular = tmp_path / "pipe", tmp_path / "a"
    os.mkfifo(path)
    regular.write_text("x")
    monkeypatch.setattr(type(path), "stat", lambda *_, **__: os.lstat(regular))
    with pytest.raises(UsageError, match="it is a pipe"):
        file_content(path)


def test_what_has_no_size_before_it_is_read_is_read_up_to_the_limit():
    from pathlib import Path

    assert Path("/proc/self/status").stat().st_size == 0
    with pytest.raises(UsageError, match="larger than 10 bytes"):
        file_content(Path("/proc/self/status"), 10)


def test_text_is_utf_8(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"one\ntwo \xff")
    with pytest.raises(MechanismFileError, match=r"a:2: byte 0xff; allowed: UTF-8 text"):
        file_text(path)
