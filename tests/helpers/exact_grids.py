"""Places of a grid in fractions, each rounded once."""

from fractions import Fraction

import numpy as np


def exact_axis(low, high, count):
    """Places (count,) between two numbers, taken as they are written."""
    first, last = Fraction(str(low)), Fraction(str(high))
    return np.array([float(first + k * (last - first) / (count - 1)) for k in range(count)])
