"""A curve as a small drawing inside the page, in the page's own colours."""

from __future__ import annotations

from html import escape

import numpy as np

from assur.results.kinds import Curve
from assur.results.typeset_text import short

WIDTH, HEIGHT, MARGIN = 320.0, 240.0, 34.0


def curve_svg(curve: Curve) -> str:
    """SVG of a curve on its first two coordinates, one scale for both, with the ranges along the axes.

    >>> curve_svg(Curve("c", ("x", "y"), np.array([[0.0, 0.0], [1.0, 2.0]]))).startswith("<svg")
    True
    """
    points = curve.points[:, :2]
    low, high = points.min(axis=0), points.max(axis=0)
    span = np.maximum(high - low, 1e-300)
    scale = min((WIDTH - 2 * MARGIN) / span[0], (HEIGHT - 2 * MARGIN) / span[1])
    middle = (low + high) / 2
    across = WIDTH / 2 + scale * (points[:, 0] - middle[0])
    down = HEIGHT / 2 - scale * (points[:, 1] - middle[1])
    path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in zip(across, down, strict=True)) + ("Z" if curve.closed else "")
    first, second = curve.coordinates[:2]
    unit = f" {curve.unit}" if curve.unit else ""
    labels = (
        (WIDTH / 2, HEIGHT - 10, "middle", f"{first}: {short(low[0], 4)} to {short(high[0], 4)}{unit}"),
        (WIDTH / 2, 16.0, "middle", f"{second}: {short(low[1], 4)} to {short(high[1], 4)}{unit}"),
    )
    texts = "".join(
        f'<text x="{x:g}" y="{y:g}" text-anchor="{side}">{escape(said)}</text>' for x, y, side, said in labels
    )
    return (
        f'<svg viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" aria-label="{escape(curve.name)}">'
        f'<path d="{path}"/>{texts}</svg>'
    )
