import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.symbolic.blocks import Block, Structure
from assur.topology.symbolic.bundles import bundles
from assur.topology.symbolic.meeting import Line
from examples import examples

lines = st.lists(st.tuples(st.integers(0, 4), st.sampled_from([None, 0, 1, 2])), min_size=3, max_size=12)


def _structure(lines):
    """Lines with a direction out of five and a point out of three, each pair of them at most once."""
    blocks = {}
    for index, (direction, point) in enumerate(lines):
        through = frozenset() if point is None else frozenset({point})
        blocks.setdefault(direction, []).append(Line(index, f"R{index}", through))
    return Structure(tuple(Block((float(key), 1.0, 0.0), tuple(items)) for key, items in blocks.items()))


def _rank(lines, rng):
    directions, points = rng.normal(size=(5, 3)), rng.normal(size=(3, 3))
    twists = []
    for direction, point in lines:
        place = rng.normal(size=3) if point is None else points[point]
        twists.append([*directions[direction], *np.cross(place, directions[direction])])
    return np.linalg.matrix_rank(np.array(twists), tol=1e-8)


@examples(400)
@given(lines, st.integers(0, 10**6))
def test_the_number_of_independent_lines_is_their_rank(lines, seed):
    once = [line for index, line in enumerate(lines) if line[1] is None or line not in lines[:index]]
    if len({direction for direction, _ in once}) < 3:
        return
    assert bundles(_structure(once)).rank == _rank(once, np.random.default_rng(seed))
