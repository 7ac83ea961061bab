"""Linear equations by chosen pivots: what they solve, what they leave out, and that examples decide."""

import numpy as np

from assur.numerics.elimination import Elimination, chosen_pivots


def test_redundant_rows_have_no_pivot_and_the_rest_is_solved():
    random = np.random.default_rng(3)
    rows = random.normal(size=(6, 4, 7)) * (random.uniform(size=(4, 7)) < 0.6)
    matrices = np.concatenate([rows, rows[:, :1] + 2 * rows[:, 2:3], random.normal(size=(6, 2, 7))], axis=1)
    first, second = chosen_pivots(matrices, (range(5), range(5, 7)))
    assert (len(first), len(second)) == (4, 2)
    (free,) = set(range(7)) - {column for _, column in (*first, *second)}
    matrix = random.permutation(matrices)[0]
    right = matrix @ random.normal(size=7)
    triangle = Elimination({(i, j): number for (i, j), number in np.ndenumerate(matrix) if number}, (*first, *second))
    found = triangle.solved(dict(enumerate(right)), {free: 0.7})
    assert found[free] == 0.7
    np.testing.assert_allclose(matrix @ [found[k] for k in range(7)], right, atol=1e-12)


def test_a_pivot_is_large_at_every_example():
    matrices = np.array([[[1.0, 0.5]], [[1e-3, 0.5]]])
    assert chosen_pivots(matrices, (range(1),)) == (((0, 1),),)


def test_the_first_pivots_alone_solve_their_rows():
    triangle = Elimination({(0, 0): 2.0, (1, 0): 1.0, (1, 1): 5.0}, ((0, 0), (1, 1)))
    assert triangle.solved({0: 4.0, 1: 9.0}, count=1) == {0: 2.0}
