"""Evidence on the search box and the workspace: E11, E17."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from assur.audit.audit import reference_of
from assur.audit.reach import extreme
from assur.audit.rows import Evidence
from assur.workspace.region import workspace

RESOLUTION = 48


def search_box(record):
    """E11: what x can be, exactly and by random search; y has no bound; z by search and by a line search."""
    exact = {name: Fraction(repr(value)) for name, value in vars(record.values).items()}
    width, l4, l6 = exact["b"] - exact["d"], exact["l4"], exact["l6"]
    low, high = max(-l4 - width, width - l6), min(l4 - width, width + l6)  # |cos| <= 1 in Eqs. (18), (19)
    mode = record.modes.default_working
    modes = {mode, *(signs + mode[2:] for signs in ("++", "+-", "-+", "--"))}
    exactly = (float(low), float(high))
    same = all(np.allclose(_ends(record, "x", item), exactly, rtol=0, atol=1e-6) for item in modes)
    unbounded = bool(np.all(np.isnan(_ends(record, "y", mode))))
    z_low, z_high = _ends(record, "z", mode)
    agree = bool(np.allclose((z_low, z_high), _z_by_lines(record, *exactly), rtol=0, atol=1e-2))
    box = {entry.quantity: (entry.low.value, entry.high.value) for entry in reference_of(record).entries["range"]}
    cuts = bool(box["x"][0] > low and box["x"][1] > high and box["z"][0] > z_low)
    return Evidence(
        same and unbounded and agree and cuts,
        f"|cos α| <= 1 and |cos β| <= 1 in Eqs. (18), (19) give {float(low):g} <= x <= {float(high):g} "
        f"{record.unit} exactly, and random search ends there for every choice of sin α and sin β: the "
        f"box reaches to {box['x'][1]:g} and cuts off {float(low):g} to {box['x'][0]:g}. y has no bound "
        f"but the strokes. In mode {mode} z goes from {z_low:.2f} to {z_high:.2f}, by random search and "
        "by a search along lines.",
        {"x": exactly, "z": (z_low, z_high)},
    )


def stroke(record):
    """E17: the workspace in the box with |yA| <= a and without a stroke, and its parallel-singular surfaces."""
    p = record.values
    limits = {item.name: (-p.a, p.a) for item in record.inputs}
    free, kept = workspace(record, resolution=RESOLUTION), workspace(record, resolution=RESOLUTION, strokes=limits)
    share = kept.volume / free.volume
    areas = [{locus.factor: locus.area for locus in found.loci} for found in (free, kept)]
    needed = p.l3 + 2 * p.l2  # w = 0 stretches links 9, 11 and 10 along Y
    holds = share < 0.1 and needed > 2 * p.a and areas[1]["w"] == 0.0 and areas[1]["v"] < 0.01 * areas[0]["v"]
    return Evidence(
        bool(holds and areas[0]["w"] > 0.0),
        f"Without a stroke the working mode reaches {free.volume / 1e6:.1f} million {free.unit} of the box, with "
        f"|yA| <= a = {p.a:g} {record.unit} only {kept.volume / 1e6:.2f} million ({share:.0%}). w = 0 needs "
        f"yA1 - yA2 = l3 + 2 l2 = {needed:g} {record.unit}, and the sliders are at most {2 * p.a:g} apart; of v = 0 "
        f"{areas[1]['v'] / areas[0]['v']:.1%} of the area is left.",
        {"share": share, "areas": areas},
    )


def _ends(record, name, mode):
    """Least and greatest value that a mode reaches, NaN where there is no bound."""
    return np.array([extreme(record, name, side, mode) for side in (-1.0, 1.0)], dtype=float)


def _z_by_lines(record, low, high):
    """Least and greatest z with sin(alpha), sin(beta) > 0: at each x the heights w and v end at l2 and l6."""
    p = record.values
    x = np.linspace(low, high, 400001)
    first = p.l1 + p.l4 * np.sqrt(np.maximum(1 - ((x + p.b - p.d) / p.l4) ** 2, 0))
    second = p.l1 + p.l7 + p.l8 + p.l6 * np.sqrt(np.maximum(1 - ((x + p.d - p.b) / p.l6) ** 2, 0))
    lows, highs = np.maximum(first - p.l2, second - p.l6), np.minimum(first + p.l2, second + p.l6)
    real = lows <= highs
    return float(np.min(lows[real])), float(np.max(highs[real]))
