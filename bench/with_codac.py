"""Codac on the paper's mechanism: the workspace paved and the direct problem solved, both with proof.

Nothing here is ours but lengths and signs: inequalities and loop equations are written down anew in Codac's numbers, so
its bounds are a second route to those of `assur.workspace.certified`.

To be imported in a process of its own only: `import codac` makes the whole thread round upwards, and leaves it so. All
that is computed there afterwards is a little wrong, and interval arithmetic like ours, which takes it that floats are
rounded to nearest, proves nothing any more.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import codac
import numpy as np

LENGTHS = ("b", "d", "l1", "l2", "l3", "l4", "l6", "l7", "l8")
FAR = 1000.0  # mm; no link is that long, so every pose has |y|, |z| below it
TURN = 3.15  # rad; a little more than half a turn
WIDER = 1e-7  # by so much a contracted box is made wider, so that Krawczyk's operator can map it into itself
SMALLEST = 1e-9


def version() -> str:
    return str(codac.__version__)


def exactly(lengths: Mapping[str, float]) -> list[Any]:
    """Lengths as intervals that hold just these floats."""
    return [codac.Interval(lengths[name]) for name in LENGTHS]


def workspace(
    lengths: Mapping[str, float], signs: Sequence[float], box: Mapping[str, Sequence[float]], size: float
) -> tuple[float, float, int, np.ndarray, np.ndarray]:
    """Pave the section of the box across y, which nothing depends on, down to boxes of `size` mm.

    Answers with bounds of the volume, the number of boxes about the boundary, and the middles (2, N) of boxes inside
    and outside. `signs` are those of sin(alpha) and sin(beta).

    One separator for each inequality, which is the fastest of four ways tried, all with the same boxes. Not `sivia`: it
    counts boxes where a root has no value as inside (23.50e6 mm^3 at 1 mm; the whole region has 22.81e6). Here the
    inequalities of the cosines keep these out. Codac's sums are floats, rounded to about 1e-15 of them.
    """
    b, d, l1, l2, _, l4, l6, l7, l8 = exactly(lengths)
    s_alpha, s_beta = map(float, signs)
    pose = codac.VectorVar(2)
    x, z = pose[0], pose[1]
    n_alpha = 1.0 - codac.sqr((x + (b - d)) / l4)
    n_beta = 1.0 - codac.sqr((x - (b - d)) / l6)
    w = z - s_alpha * l4 * codac.sqrt(n_alpha) - l1
    v = z - l8 - s_beta * l6 * codac.sqrt(n_beta) - l7 - l1
    some = codac.Interval(0.0, codac.oo)
    wanted = ((n_alpha, some), (n_beta, some), (w, l2 * codac.Interval(-1, 1)), (v, l6 * codac.Interval(-1, 1)))
    one, two, three, four = (codac.SepInverse(codac.AnalyticFunction([pose], what), where) for what, where in wanted)
    section = codac.IntervalVector([list(box[name]) for name in ("x", "z")])
    found = codac.pave(section, (one & two) & (three & four), size)
    kinds = (codac.PavingInOut.inner, codac.PavingInOut.bound, codac.PavingInOut.outer_complem)
    inside, boundary, outside = (found.boxes(kind) for kind in kinds)
    low, high = box["y"]
    least = (high - low) * sum(item.volume() for item in inside)
    most = least + (high - low) * sum(item.volume() for item in boundary)
    return least, most, len(boundary), _middles(inside), _middles(outside)


def _middles(boxes: Sequence[Any]) -> np.ndarray:
    return np.array([[float(item.mid()[k]) for k in range(2)] for item in boxes]).T


def direct(lengths: Mapping[str, float], inputs: Sequence[float]) -> tuple[np.ndarray, np.ndarray, int]:
    """Poses (N, 3), low and high, each proved to be one solution and together all; and boxes that were looked at.

    Contraction and halving over y, z, alpha, beta; a box is done when Krawczyk's operator maps it into itself.

    Errors:
        ArithmeticError: a box was left undecided.
    """
    equations, pose_of = loop(lengths, inputs)
    contractor = codac.CtcFixpoint(codac.CtcInverse(equations, codac.IntervalVector([[0, 0]] * 4)))
    scale = np.array([FAR, FAR, TURN, TURN])
    open_boxes = [codac.IntervalVector([[-size, size] for size in scale])]
    proved: list[tuple[Any, Any]] = []
    looked = 0
    while open_boxes:
        box = open_boxes.pop()
        looked += 1
        contractor.contract(box)
        if box.is_empty():
            continue
        wider = codac.IntervalVector(box).inflate(WIDER)
        mapped = krawczyk(equations, wider)
        if mapped is not None and mapped.is_interior_subset(wider):
            if not any(mapped.is_subset(domain) for domain, _ in proved):
                proved.append((wider, krawczyk(equations, mapped) & mapped))
            continue
        if box.max_diam() < SMALLEST:
            raise ArithmeticError(f"undecided: {box}")
        widths = [box[k].diam() for k in range(4)] / scale
        open_boxes += box.bisect(int(np.argmax(widths)), 0.49)
    poses = [pose_of.eval(solution) for _, solution in proved]
    low, high = (np.array([[getattr(p[k], end)() for k in range(3)] for p in poses]) for end in ("lb", "ub"))
    return low, high, looked


def loop(lengths: Mapping[str, float], inputs: Sequence[float]) -> tuple[Any, Any]:
    """The loop equations in y, z, alpha, beta, all zero at a solution, and the pose there."""
    b, d, l1, l2, l3, l4, l6, l7, l8 = exactly(lengths)
    y_a1, y_a2, y_a3 = map(codac.Interval, map(float, inputs))
    unknown = codac.VectorVar(4)
    y, z, alpha, beta = (unknown[k] for k in range(4))
    w = z - l4 * codac.sin(alpha) - l1
    v = z - l8 - l6 * codac.sin(beta) - l7 - l1
    rows = (
        l4 * codac.cos(alpha) - l6 * codac.cos(beta) - 2.0 * (b - d),
        codac.sqr(y + 0.5 * l3 - y_a1) + codac.sqr(w) - codac.sqr(l2),
        codac.sqr(y - 0.5 * l3 - y_a2) + codac.sqr(w) - codac.sqr(l2),
        codac.sqr(y - y_a3) + codac.sqr(v) - codac.sqr(l6),
    )
    pose = codac.vec(l4 * codac.cos(alpha) - (b - d), y, z)
    return codac.AnalyticFunction([unknown], codac.vec(*rows)), codac.AnalyticFunction([unknown], pose)


def krawczyk(equations: Any, box: Any) -> Any:
    """Krawczyk's operator over a box; None where the middle of the derivative has no inverse."""
    slopes = equations.diff(box)
    middles = np.array([[slopes(i, j).mid() for j in range(4)] for i in range(4)])
    if not np.all(np.isfinite(middles)) or abs(np.linalg.det(middles)) == 0:
        return None
    inverse = codac.IntervalMatrix(codac.Matrix(np.linalg.inv(middles)))
    one = codac.IntervalMatrix(codac.Matrix(np.eye(4)))
    middle = codac.IntervalVector(box.mid())
    return middle - inverse * equations.eval(middle) + (one - inverse * slopes) * (box - middle)
