"""Source of loops: what stands before the loop and inside, and that it is the tape in plain Python too."""

import math

import numpy as np
import pytest

from assur.numerics.recording import source as module
from assur.numerics.recording.source import GROUP, digest, places_of, source
from assur.numerics.recording.tape import Recorder


@pytest.fixture
def tape():
    recorder = Recorder()
    x, p = recorder.varying("x"), recorder.uniform("p")
    root = recorder.sqrt(p * p + 1)
    return recorder.tape({"y": -(x * root) / 2 + abs(x), "z": x - root, "more": (x > p) & ~(x >= 2 * p), "w": x - root})


def test_what_is_uniform_stands_before_the_loop(tape):
    before, inside = source(tape).split("for first in range")
    assert before.count("sqrt(") == 1
    assert "sqrt(" not in inside


def test_equal_outputs_are_stored_once(tape):
    assert places_of(tape) == {"y": 1, "z": 2, "more": 3, "w": 2}
    assert source(tape).count("group[32 + i] =") == 1


def test_the_lines_are_the_tape_in_plain_python(tape):
    before, inside = module._statements(tape)
    for x, p in ((1.5, 0.25), (-2.0, 3.0), (0.4, 0.25)):
        names = {"uniform": [p], "group": np.full(GROUP, x), "i": 0, "inf": math.inf, "odd": 0, "sqrt": math.sqrt}
        exec("\n".join([*before, *inside]).replace("not ", "1 - "), names)
        wanted = tape.evaluate([x], [p])
        for output, k in tape.outputs.items():
            assert names[f"v{k}"] == wanted[output]


def test_another_version_of_what_is_called_is_another_text(tape, monkeypatch):
    text = source(tape)
    monkeypatch.setattr(module, "_storing_version", lambda: "other")
    assert digest(source(tape)) != digest(text)
