import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import UsageError
from assur.figures.layers import layout, rows


@st.composite
def graphs(draw):
    """Nodes that need only nodes before them."""
    count = draw(st.integers(2, 9))
    needs = {"n0": ()}
    for k in range(1, count):
        wanted = draw(st.lists(st.integers(0, k - 1), max_size=3, unique=True))
        needs[f"n{k}"] = tuple(f"n{j}" for j in wanted)
    return needs


@given(graphs())
def test_rows_go_down_and_boxes_keep_apart(needs):
    last = list(needs)[-1]
    row = rows(needs, ["n0"], [last])
    assert all(row[want] < row[name] for name, wants in needs.items() for want in wants)
    width = dict.fromkeys(needs, 20.0)
    plan = layout(needs, row, width, 5.0)
    for a, b in itertools.combinations(needs, 2):
        if row[a] == row[b]:
            assert abs(plan.centre[a] - plan.centre[b]) >= 25.0 - 1e-6
    for (start, end), steps in plan.routes.items():
        assert len(steps) == row[end] - row[start] - 1


def test_a_crossing_that_can_be_avoided_is():
    needs = {"a": (), "b": (), "c": ("b",), "d": ("a",)}
    row = {"a": 0, "b": 0, "c": 1, "d": 1}
    plan = layout(needs, row, dict.fromkeys(needs, 10.0), 5.0)
    assert (plan.centre["a"] - plan.centre["b"]) * (plan.centre["d"] - plan.centre["c"]) > 0


def test_steps_that_need_one_another():
    with pytest.raises(UsageError, match="a, b"):
        rows({"a": ("b",), "b": ("a",)}, [], [])
