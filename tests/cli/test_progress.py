"""Progress bars: on a terminal's standard error, and nowhere else."""

import io
import re
import time

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


def test_a_bar_says_how_much_time_is_left(monkeypatch):
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "100")
    clock = iter(range(0, 10**6, 10))  # every look at the clock finds it ten seconds on
    monkeypatch.setattr("rich.console.monotonic", lambda: float(next(clock)))
    with progress("thinking", Plain()) as step:
        for done in range(5):
            step(done, 9)
    shown = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", stream.getvalue())
    assert re.search(r"\d:\d\d:\d\d left \d:\d\d:\d\d", shown)


@pytest.mark.parametrize(("json", "lines"), [(False, 1), (True, 0)])
def test_elsewhere_one_line_says_that_it_takes_long(monkeypatch, json, lines):
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setattr("assur.cli.progress.LONG", 0.01)
    with progress("thinking", Plain(json=json)) as step:
        step(1, 301)
        end = time.monotonic() + (0.05 if json else 5.0)
        while not stream.getvalue() and time.monotonic() < end:
            time.sleep(0.01)
    assert stream.getvalue().count("\n") == lines
    said = "thinking: still at work after 0.01 s, 1 of 301 steps done, about 3 s left\n"
    assert stream.getvalue() == (said if lines else "")
