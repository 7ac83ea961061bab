import mpmath
import numpy as np
import pytest

from assur.kinematics.certified.enclosed import _rotation
from assur.numerics import rotations
from assur.numerics.intervals.interval import as_interval


def next_rotation(values):
    """The orthogonal factor of the polar decomposition, by Newton's iteration X = (X + X^-T) / 2 with 50 digits."""
    x = mpmath.matrix(values.tolist())
    for _ in range(8):
        x = (x + (x**-1).T) / 2
    return x


@pytest.mark.parametrize("error", [0.0, 1e-12, 1e-6])
def test_the_turn_of_a_joint_is_the_rotation_next_to_its_floats(error):
    """Floats are no rotation: without bounds the exact one would be left out."""
    rng = np.random.default_rng(3)
    for vector in rng.normal(size=(50, 3)):
        floats = rotations.from_vector(vector) + error * rng.uniform(-1, 1, (3, 3))
        with mpmath.workdps(50):
            exact = next_rotation(floats)
            missed = 0
            for i, row in enumerate(_rotation(floats)):
                for j, entry in enumerate(row):
                    assert mpmath.mpf(float(entry.low)) <= exact[i, j] <= mpmath.mpf(float(entry.high))
                    assert entry.width < 20 * error + 1e-14
                    missed += mpmath.mpf(float(floats[i, j])) != exact[i, j]
        assert missed


def test_what_stands_alone_stays_exact():
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert _rotation(quarter) == ((0, -1, 0), (1, 0, 0), (0, 0, 1))
    c, s = np.cos(0.3), np.sin(0.3)
    found = _rotation(np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]))
    assert [row[1] for row in found] == [0, 1, 0]
    assert [type(entry) for entry in found[1]] == [int] * 3
    assert all(0 < as_interval(found[i][j]).width < 1e-14 for i in (0, 2) for j in (0, 2))
