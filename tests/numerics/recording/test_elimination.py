"""Straight-line solution of sparse systems beside NumPy's."""

from __future__ import annotations

import numpy as np
import pytest

from assur.errors import UsageError
from assur.numerics.recording.elimination import solved
from assur.numerics.recording.folding import Folding


def _sparse(seed, size=12, density=0.3, count=5):
    """Matrices (count, size, size) that share their zeros, and are regular."""
    rng = np.random.default_rng(seed)
    places = (rng.random((size, size)) < density) | np.eye(size, dtype=bool)
    return rng.normal(size=(count, size, size)) * places, places


@pytest.mark.parametrize("seed", range(6))
def test_a_recorded_solution_is_numpys_at_other_matrices_too(seed):
    samples, places = _sparse(seed)
    rng = np.random.default_rng(100 + seed)
    folding = Folding()
    entries = {(int(i), int(j)): folding.varying(f"{i} {j}") for i, j in np.argwhere(places)}
    right = [folding.varying(f"right {i}") for i in range(len(places))]
    found = solved(entries, right, samples)
    tape = folding.tape({str(j): value for j, value in found.items()})
    matrix, wanted = samples[0] * rng.uniform(0.9, 1.1, places.shape), rng.normal(size=len(places))
    given = [matrix[place] for place in entries] + list(wanted)
    answer = tape.evaluate(given, list(folding.numbers))
    expected = np.linalg.solve(matrix, wanted)
    np.testing.assert_allclose(
        [answer[str(j)] for j in range(len(places))], expected, atol=1e-9 * np.linalg.cond(matrix), rtol=0
    )


@pytest.mark.parametrize("scaled", [False, True])
def test_redundant_equations_and_free_unknowns_are_left_out(scaled):
    rng = np.random.default_rng(3)
    matrix = rng.normal(size=(9, 5)) @ rng.normal(size=(5, 7))
    right = matrix @ rng.normal(size=7)
    samples = np.stack([matrix, matrix])
    if scaled:
        samples *= np.linspace(0.3, 3.0, 9)[:, None] * np.linspace(2.0, 0.5, 7)
    entries = {(i, j): float(matrix[i, j]) for i in range(9) for j in range(7)}
    found = solved(entries, list(right), samples)
    assert len(found) == np.linalg.matrix_rank(matrix) == 5
    unknowns = np.array([found.get(j, 0.0) for j in range(7)])
    np.testing.assert_allclose(matrix @ unknowns, right, atol=1e-9)


def test_what_vanishes_at_all_samples_costs_nothing():
    folding = Folding()
    entries = {(i, j): folding.varying(f"{i} {j}") for i in range(2) for j in range(2)}
    found = solved(entries, [folding.varying("a"), folding.varying("b")], np.array([[[2.0, 0.0], [0.0, 3.0]]]))
    names = [item.name for item in folding.tape({"0": found[0], "1": found[1]}).operations]
    assert names.count("/") == names.count("*") == 2
    assert not {"+", "-"} & set(names)


def test_a_pivot_that_is_small_at_one_sample_is_not_taken():
    """The corner is cheap, but vanishes at the second sample."""
    samples = np.array([[[1.0, 1.0], [1.0, -1.0]], [[1e-9, 1.0], [1.0, -1.0]]])
    entries = {(i, j): float(samples[1, i, j]) for i in range(2) for j in range(2)}
    found = solved(entries, [1.0, 0.0], samples)
    np.testing.assert_allclose([found[0], found[1]], np.linalg.solve(samples[1], [1.0, 0.0]), rtol=1e-12)


def test_no_pivot_at_all_samples_is_refused():
    samples = np.array([[[1.0, 0.0]], [[0.0, 1.0]]])
    with pytest.raises(UsageError, match="no pivot"):
        solved({(0, 0): 1.0, (0, 1): 1.0}, [1.0], samples)
