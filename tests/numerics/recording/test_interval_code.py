"""The interpreter's own steps: in the order of the program's names, and a program that uses its places again."""

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval
from assur.numerics.recording import interval_code, interval_plan
from assur.numerics.recording.interval_program import IntervalProgram
from assur.numerics.recording.tape import Recorder

NAMES = {"varying": "_VARYING", "store": "_STORE", "+": "_PLUS", "-": "_MINUS", "*": "_TIMES", "/": "_OVER"}


def test_steps_have_the_numbers_of_their_names():
    for number, name in enumerate(interval_plan.STEPS):
        own = NAMES.get(name, "_" + name.upper().replace(" ", "_"))
        assert getattr(interval_code, own) == number


@pytest.mark.parametrize("name", ["SHARE", "SHARE_OF_SUM", "LEAST", "GREATEST", "STEPS"])
def test_what_code_on_disk_depends_on_stands_in_its_own_file(monkeypatch, name):
    """Numba compares that file alone; where another says something else it is not imported."""
    place = interval_plan if name == "STEPS" else rounding
    assert getattr(interval_code, name) == getattr(place, name)
    assert f"\n{name} = " in Path(interval_code.__file__).read_text(encoding="utf-8")
    monkeypatch.setattr(place, name, 2 * getattr(place, name))
    spec = importlib.util.spec_from_file_location("again", interval_code.__file__)
    with pytest.raises(ImportError, match=f"{name} is not that of {place.__name__}"):
        spec.loader.exec_module(importlib.util.module_from_spec(spec))


def test_where_no_folder_can_be_written_the_code_is_made_without(tmp_path):
    """Numba finds no folder for a file that is not there."""
    text = Path(interval_code.__file__).read_text(encoding="utf-8")
    module = ModuleType("elsewhere")
    exec(compile(text, tmp_path / "gone" / "interval_code.py", "exec"), module.__dict__)
    assert module._down(1.0) == rounding.down(1.0) < 1.0
    assert interval_code._down.stats.cache_path is not None
    assert module._down.stats.cache_path is None
    assert not list(tmp_path.iterdir())


def test_a_long_program_needs_few_places():
    recorder = Recorder()
    x, y = recorder.varying("x"), recorder.varying("y")
    total = x
    for _ in range(300):
        total = recorder.sqrt(total * total + y)
    tape = recorder.tape({"f": total, "x": x})
    assert interval_plan.interval_plan(tape).places < 8 < len(interval_plan.interval_plan(tape).steps)
    numbers = [Interval.of([0.1, -2.0], [0.2, 1.0]), Interval.of([0.0, -1.0], [1.0, 3.0])]
    one, two = (IntervalProgram(tape)(numbers, [], engine)["f"] for engine in ("compiled", "numpy"))
    np.testing.assert_array_equal(one.low, two.low)
    np.testing.assert_array_equal(one.high, two.high)
