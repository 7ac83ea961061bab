"""Evidence on the search box: E11."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from assur.audit.reach import extreme
from assur.audit.rows import Evidence


def search_box(record):
    """E11: what x can be, exactly and by random search; y has no bound; z by search and by a line search."""
    exact = {name: Fraction(repr(value)) for name, value in vars(record.values).items()}
    width, l4, l6 = exact["b"] - exact["d"], exact["l4"], exact["l6"]
    low, high = max(-l4 - width, width - l6), min(l4 - width, width + l6)  # |cos| <= 1 in Eqs. (18), (19)
    mode = record.modes.default_working
    modes = {mode, *(signs + mode[2:] for signs in ("++", "+-", "-+", "--"))}
    ends = [(extreme(record, "x", -1.0, item), extreme(record, "x", 1.0, item)) for item in sorted(modes)]
    same = all(abs(first - low) < 1e-6 and abs(last - high) < 1e-6 for first, last in ends)
    unbounded = extreme(record, "y", -1.0, mode) is None and extreme(record, "y", 1.0, mode) is None
    z_low, z_high = extreme(record, "z", -1.0, mode), extreme(record, "z", 1.0, mode)
    lines = _z_by_lines(record, float(low), float(high))
    agree = abs(z_low - lines[0]) < 1e-2 and abs(z_high - lines[1]) < 1e-2
    box = record.box
    return Evidence(
        same and unbounded and agree and box["x"][0] > low and box["x"][1] > high and box["z"][0] > z_low,
        f"|cos α| <= 1 and |cos β| <= 1 in Eqs. (18), (19) give {float(low):g} <= x <= {float(high):g} {record.unit} exactly, and "
        f"random search ends there for every choice of sin α and sin β: the box reaches to {box['x'][1]:g} and cuts off "
        f"{float(low):g} to {box['x'][0]:g}. y has no bound but the strokes. In mode {mode} z goes from {z_low:.2f} to {z_high:.2f}, "
        "by random search and by a search along lines.",
        {"x": (float(low), float(high)), "z": (z_low, z_high)},
    )


def _z_by_lines(record, low, high):
    """Least and greatest z with sin(alpha), sin(beta) > 0: at each x the heights w and v end at l2 and l6."""
    p = record.values
    x = np.linspace(low, high, 400001)
    first = p.l1 + p.l4 * np.sqrt(np.maximum(1 - ((x + p.b - p.d) / p.l4) ** 2, 0))
    second = p.l1 + p.l7 + p.l8 + p.l6 * np.sqrt(np.maximum(1 - ((x + p.d - p.b) / p.l6) ** 2, 0))
    lows, highs = np.maximum(first - p.l2, second - p.l6), np.minimum(first + p.l2, second + p.l6)
    real = lows <= highs
    return float(np.min(lows[real])), float(np.max(highs[real]))
