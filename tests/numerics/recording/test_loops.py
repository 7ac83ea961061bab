"""Compiled loops have the bits of NumPy, for any number of elements and threads."""

import numpy as np
import pytest

from assur.numerics.recording.loops import STRIP, compiled
from assur.numerics.recording.tape import Recorder, Tape


@pytest.fixture(scope="module")
def tape() -> Tape:
    recorder = Recorder()
    x, y, p = recorder.varying("x"), recorder.varying("y"), recorder.uniform("p")
    root = recorder.sqrt(x * x * p - y)
    outputs = {"root": root, "share": (x - y) / (root * root + 0.1), "there": (x > y) & (root >= p), "constant": p * p}
    return recorder.tape(outputs)


@pytest.mark.parametrize("count", [0, 1, STRIP - 1, STRIP, STRIP + 1, 64 * STRIP + 7, 300 * STRIP + 1])
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_bits_are_those_of_numpy_for_any_length_and_number_of_threads(tape, count, threads):
    given = np.random.default_rng(count).normal(size=(2, count)) * 10
    found = compiled(tape)(given, [0.7], threads=threads)
    wanted = tape.evaluate(given, [0.7])
    for row, value in zip(found, wanted.values(), strict=True):
        np.testing.assert_array_equal(row, np.broadcast_to(np.asarray(value, dtype=float), count))


def test_what_is_not_a_number_stays_so(tape):
    found = compiled(tape)([[np.nan, np.inf], [0.0, 1.0]], [0.7])
    wanted = tape.evaluate([np.array([np.nan, np.inf]), np.array([0.0, 1.0])], [0.7])
    np.testing.assert_array_equal(found[0], wanted["root"])
    np.testing.assert_array_equal(found[1], wanted["share"])


def test_machine_code_is_kept_in_the_chosen_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    recorder = Recorder()
    x = recorder.varying("x")
    run = compiled(recorder.tape({"y": x * x + 12345.678}))
    assert run([[2.0]], [])[0, 0] == 4 + 12345.678
    kept = [path.suffix for path in tmp_path.rglob("*") if path.is_file()]
    assert sorted(set(kept)) == [".nbc", ".nbi", ".py"]
