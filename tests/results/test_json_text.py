import json
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.results.json_text import json_text, plain


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_float_reads_back_the_same(number):
    assert json.loads(json_text({"a": np.float64(number)}))["a"] == number


@pytest.mark.parametrize("missing", [float("nan"), float("inf"), -np.inf, np.array(np.nan)])
def test_numbers_that_do_not_exist_are_null(missing):
    assert json.loads(json_text({"a": missing})) == {"a": None}


def test_everything_becomes_plain():
    class Level(IntEnum):
        high = 2

    @dataclass(frozen=True)
    class Pair:
        first: int
        second: np.ndarray

    data = plain({"p": Pair(1, np.eye(2)), "e": Level.high, "f": Path("a/b"), "b": np.True_, "t": (np.int8(3),)})
    assert data == {"p": {"first": 1, "second": [[1.0, 0.0], [0.0, 1.0]]}, "e": "high", "f": "a/b", "b": True, "t": [3]}
