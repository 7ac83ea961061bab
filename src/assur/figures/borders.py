"""Borders: by which margin a workspace ends at a point, and which factors vanish there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.labels import label
from assur.kinematics.closed_form.mode_reading import mode_reading_at
from assur.kinematics.status import scale
from assur.workspace.fields import at_points, values_at

FloatArray = NDArray[np.float64]
VANISHES = 1e-5
NEWTON = 8
STEP = 1e-6


def kinds(context: Context, points: FloatArray) -> list[str]:
    """Per pose (n, m) on the border of the workspace: the margin that is zero there, or "" on that of the box."""
    found = context.workspace
    form = context.record.closed_form
    scales = {item.name: scale(context.record, item.scale) for item in (form.inverse_margins if form else ())}
    names = list(found.margins)
    values = values_at(found.margins, tuple(points[:, : len(found.box.names)].T))
    sizes = np.array([np.abs(np.broadcast_to(values[k], len(points))) / scales.get(k, 1.0) for k in names])
    low, high = np.array(found.box.intervals).T
    on_box = np.any(np.minimum(points - low, high - points) < 1e-6 * (high - low), axis=1)
    least = np.argmin(sizes, axis=0)
    return ["" if box else names[j] for j, box in zip(least, on_box, strict=True)]


def vanishing(context: Context, margin: str, pose: FloatArray) -> list[str]:
    """LaTeX of the factors that vanish where a margin is zero, nearest to a pose (m,) on the border."""
    form = context.record.closed_form
    if form is None:
        return []
    there = on_margin(context, margin, pose)
    read = mode_reading_at(context.record, context.workspace.mode, context.workspace.slice.poses(there[None]))
    return [
        label(item.latex, item.name)
        for item in form.factor_list
        if item.kind != "other" and abs(float(np.ravel(read.relative_factors[item.name])[0])) < VANISHES
    ]


def on_margin(context: Context, margin: str, pose: FloatArray) -> FloatArray:
    """The pose (m,) moved across the border until the margin is zero (Newton along its gradient)."""
    found = context.workspace
    field, size = found.margins[margin], len(found.box.names)
    step = STEP * np.ptp(np.array(found.box.intervals), axis=1)
    there = np.array(pose, dtype=float)
    for _ in range(NEWTON):
        around = there + np.concatenate([np.zeros((1, size)), np.diag(step), -np.diag(step)])
        values = at_points(field, size, around)
        gradient = (values[1 : size + 1] - values[size + 1 :]) / (2 * step)
        square = float(gradient @ gradient)
        if square == 0.0:
            break
        there = there - values[0] * gradient / square
    return there


def border_words(context: Context, margin: str, pose: FloatArray) -> str:
    """E.g. "$M_1 = 0$ ($u_1$, $u_2$)": the margin, and in brackets the factors that vanish with it."""
    form = context.record.closed_form
    latex = {item.name: label(item.latex, item.name) for item in (form.inverse_margins if form else ())}
    name = f"${latex[margin]} = 0$" if latex.get(margin) else margin
    factors = ", ".join(f"${text}$" for text in vanishing(context, margin, pose))
    return f"{name} ({factors})" if factors else name
