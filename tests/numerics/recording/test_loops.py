"""Compiled loops have the bits of NumPy, for any number of elements and threads."""

import numpy as np
import pytest

from assur.errors import UsageError
from assur.numerics.recording import loops
from assur.numerics.recording.loops import GROUP, LINE, SHARE, compiled, empty_rows
from assur.numerics.recording.tape import Recorder, Tape


@pytest.fixture(scope="module")
def tape() -> Tape:
    recorder = Recorder()
    x, y, p = recorder.varying("x"), recorder.varying("y"), recorder.uniform("p")
    root = recorder.sqrt(x * x * p - y)
    large = x > y
    outputs = {
        "root": root,
        "share": (x - y) / (root * root + 0.1),
        "there": large & (root >= p),
        "not": ~large,
        "constant": p * p,
        "again": root,
        "given": x,
    }
    return recorder.tape(outputs)


@pytest.fixture(scope="module")
def loop(tape):
    return compiled(tape)


@pytest.mark.parametrize("count", [0, 1, GROUP - 1, GROUP, GROUP + 1, 2 * SHARE + 7, 5 * SHARE + 1])
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_bits_are_those_of_numpy_for_any_length_and_number_of_threads(tape, loop, count, threads):
    given = np.random.default_rng(count).normal(size=(2, count)) * 10
    found = loop(given, [0.7], threads=threads)
    wanted = tape.evaluate(given, [0.7])
    assert list(found) == list(wanted)
    for name, value in wanted.items():
        assert found[name].dtype == (bool if name in tape.logical else float)
        np.testing.assert_array_equal(found[name], np.broadcast_to(np.asarray(value), count))


def rows_from(start, count, length):
    """Rows that begin so many numbers after a line of the caches."""
    return empty_rows(1, count * length + start)[0, start:].reshape(count, length)


@pytest.mark.parametrize("start", [0, 2, 7])
@pytest.mark.parametrize("streaming", [True, False])
@pytest.mark.parametrize(
    ("length", "shift", "part"),
    [(3001, 0, (0, 3001)), (3001, 3, (0, 2998)), (2997, 1, (5, 2000)), (3000, 8, (16, 2991)), (3000, 5, (3, 60))],
)
def test_parts_of_an_answer_and_nothing_beside_them(tape, loop, streaming, start, length, shift, part):
    given = np.random.default_rng(1).normal(size=(2, 3001))
    names = ["share", "root", "root", "given"]
    rows = np.array([loop.places[name] for name in names]), np.array([loop.places["not"]])
    numbers, truths = rows_from(start, 4, length), np.ones((1, length), dtype=bool)
    numbers.fill(np.pi)
    assert loop.fill(given, [0.7], (numbers, truths), rows, part, shift=shift, streaming=streaming) == 0
    wanted = tape.evaluate(given, [0.7])
    inside = slice(shift + part[0], shift + part[1])
    for row, name in zip(numbers, names, strict=True):
        np.testing.assert_array_equal(row[inside], wanted[name][slice(*part)])
    np.testing.assert_array_equal(truths[0, inside], wanted["not"][slice(*part)])
    outside = np.ones(length, dtype=bool)
    outside[inside] = False
    assert np.all(numbers[:, outside] == np.pi)
    assert np.all(truths[:, outside])


@pytest.mark.parametrize("count", [100_003, 100_008])
def test_large_answers_are_streamed_with_the_same_bits(loop, monkeypatch, count):
    given = np.random.default_rng(4).normal(size=(2, count))
    ordinary = loop(given, [0.7])
    monkeypatch.setattr(loops, "STREAMED", 1)
    streamed = loop(given, [0.7])
    for name, values in ordinary.items():
        np.testing.assert_array_equal(values, streamed[name])


@pytest.mark.parametrize("start", [0, 2, 7])
def test_an_answer_is_streamed_from_its_first_line_wherever_it_begins(loop, monkeypatch, start):
    given, parts = np.zeros((2, 3001)), []
    code = loop._code

    def noted(*arguments):
        parts.append((arguments[-2][:2], arguments[-1]))
        return code(*arguments)

    monkeypatch.setitem(loop.__dict__, "_code", noted)
    rows = np.array([loop.places["root"]]), np.zeros(0, dtype=np.intp)
    answer = rows_from(start, 1, 3000), np.empty((0, 3000), dtype=bool)
    loop.fill(given, [0.7], answer, rows, (1, 3000), streaming=True)
    line = 1 + -(start + 1) % 8
    assert parts == [part for part in (((1, line), False), ((line, 3000), True)) if part[0][0] < part[0][1]]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("place", [0, 7, GROUP, 1999])
def test_tells_what_is_not_finite(loop, bad, place):
    given = np.zeros((2, 2000))
    given[1, place] = bad
    rows = np.array([loop.places["root"]]), np.zeros(0, dtype=np.intp)
    answer = np.empty((1, 2000)), np.empty((0, 2000), dtype=bool)
    assert loop.fill(given, [0.7], answer, rows, (0, 2000)) > 0
    assert loop.fill(given, [0.7], answer, rows, (place + 1, 2000)) == 0


def test_what_is_not_a_number_stays_so(tape, loop):
    found = loop([[np.nan, np.inf], [0.0, 1.0]], [0.7])
    with np.errstate(invalid="ignore"):
        wanted = tape.evaluate([np.array([np.nan, np.inf]), np.array([0.0, 1.0])], [0.7])
    for name in ("root", "share", "there", "not"):
        np.testing.assert_array_equal(found[name], wanted[name])


def test_a_loop_is_loaded_once_it_ran(tape):
    fresh = compiled(tape)
    assert not fresh.loaded
    fresh([[1.0], [2.0]], [0.7])
    assert fresh.loaded


@pytest.mark.parametrize("count", [1, 7, 8, 1001])
def test_empty_rows_begin_at_a_line(count):
    numbers = empty_rows(3, count)
    assert numbers.shape == (3, count)
    assert numbers.ctypes.data % LINE == 0
    assert numbers.flags.c_contiguous


def test_without_numba_there_is_no_loop(tape, monkeypatch):
    monkeypatch.setattr(loops.importlib.util, "find_spec", lambda _: None)
    with pytest.raises(UsageError, match="numba"):
        compiled(tape)


def test_machine_code_is_kept_in_the_chosen_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    recorder = Recorder()
    x = recorder.varying("x")
    run = compiled(recorder.tape({"y": x * x + 12345.678}))
    assert run([[2.0]], [])["y"][0] == 4 + 12345.678
    kept = {path.suffix for path in tmp_path.rglob("*") if path.is_file()}
    assert kept - {".pyc"} == {".nbc", ".nbi", ".py"}  # bytecode too where nothing puts it elsewhere


@pytest.mark.parametrize("count", [1, 255, 256, 1000])
def test_many_outputs_are_worked_on_in_long_groups(count):
    recorder = Recorder()
    x = recorder.varying("x")
    tape = recorder.tape({f"y{k}": x * k + 1 for k in range(30)} | {f"large{k}": x > k for k in range(3)})
    given = np.random.default_rng(count).normal(size=(1, count))
    found, wanted = compiled(tape)(given, []), tape.evaluate(given, [])
    for name, values in wanted.items():
        np.testing.assert_array_equal(found[name], values)
