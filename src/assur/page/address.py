"""The part of a page's address that says how its joints stand, as the page itself writes it."""

from __future__ import annotations

import base64

import numpy as np
from numpy.typing import NDArray


def joints_hash(values: NDArray[np.float64]) -> str:
    """Joint values (n,) as 32-bit numbers in base64; the page closes the loops from there.

    >>> joints_hash(np.array([1.0, -0.5]))
    '#joints=AACAPwAAAL8'
    """
    packed = base64.urlsafe_b64encode(values.astype("<f4").tobytes()).decode("ascii")
    return f"#joints={packed.rstrip('=')}"
