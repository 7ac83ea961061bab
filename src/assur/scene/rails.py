"""Rails on the base: where sliders run, as long as they and their strokes need."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.scene.companion import Companion
from assur.scene.companion import length as formula_value
from assur.scene.skeleton import JointMark, Skeleton

FloatArray = NDArray[np.float64]
LEAST = 0.2
"""Half the length of a rail without strokes, as a share of the mechanism's size."""


def rails(skeleton: Skeleton, companion: Companion) -> list[tuple[FloatArray, FloatArray]]:
    """Ends (3,) of the rails on the base, each once though several sliders may run on it."""
    marks = [mark for mark in skeleton.marks if mark.grounded and mark.slides]
    half = _half(skeleton, companion, marks) if marks else 0.0
    half = max([half, *(1.06 * float(np.linalg.norm(mark.at - mark.rail)) for mark in marks)])
    ends: list[tuple[FloatArray, FloatArray]] = []
    for mark in marks:
        start, end = mark.rail - half * mark.axes[0], mark.rail + half * mark.axes[0]
        if not any(np.allclose(np.sort([start, end], axis=0), np.sort(rail, axis=0)) for rail in ends):
            ends.append((start, end))
    return ends


def _half(skeleton: Skeleton, companion: Companion, marks: list[JointMark]) -> float:
    """Half the length of a drawn rail: the companion's, else what the sliders and their strokes need."""
    if companion.rail:
        return formula_value(skeleton.record, companion.rail)
    strokes = [max(map(abs, actuated.stroke)) for actuated in skeleton.record.drives if actuated.stroke]
    reach = [float(np.linalg.norm(mark.at - mark.rail)) for mark in marks]
    return 1.2 * max([*strokes, *reach, LEAST * skeleton.size])
