"""Progress bars: on a terminal's standard error, and nowhere else."""

from __future__ import annotations

import io

import pytest

from assur.cli.options import Plain
from assur.cli.progress import progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(
    ("stream", "json", "seen"), [(Terminal(), False, True), (Terminal(), True, False), (io.StringIO(), False, False)]
)
def test_only_a_person_at_a_terminal_sees_one(monkeypatch, stream, json, seen):
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    with progress("thinking", Plain(json=json)) as step:
        step(1, 2)
    assert ("thinking" in stream.getvalue()) is seen
