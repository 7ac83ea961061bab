"""Where the platform certainly is while dimensions and inputs stay within their tolerances: bounds by intervals.

Unknown are the passive joints q, off by d are dimensions and inputs. Independent equations F(q, d) = 0 of the loops,
as many as joints are unknown, have bounds J and G of their derivatives over boxes of q and d. With Y about the inverse
of J and m the nominal q, every zero near by lies in

    m - Y F(m, 0) - Y G d + (I - Y J) (q - m),

and if that lies inside the box of q there is exactly one for each d (Krawczyk's test with parameters). The mean value
theorem then bounds the pose: x(m, 0) + (x_d - x_q J^-1 G) d. In an overconstrained mechanism the equations that are
left out hold for dimensions that assemble; of these the bounds are. A rod's spin is held, it moves nothing else.

Where x certainly rises with d_k all over the box, it is largest at the end of d_k. So the bounds of each coordinate are
drawn in: what has a sign is put at its end, the rest is bounded again there, and the zero is the same one as it lies
in the box in which there is one. Nothing has to be split, however many dimensions are off.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import joint_scales
from assur.kinematics.closure import closing_system
from assur.machine.accuracy.proved_zeros import ProvedZeros, proved_zeros
from assur.machine.accuracy.toleranced_loops import TolerancedLoops, centred
from assur.model.mechanism import MechanismRecord
from assur.work import stage

FloatArray = NDArray[np.float64]
DEPENDENT = 1e-7
"""Length of a row, the largest entry of all being 1, below which an equation counts as dependent on those before."""


@dataclass(frozen=True, eq=False)
class ProvedPoses:
    """Bounds (low, high) of each coordinate of the pose, in the mechanism's unit and rad; and why there are none."""

    bounds: Mapping[str, tuple[float, float]]
    resists: str = ""


@stage("proved poses")
def proved_poses(record: MechanismRecord, values: FloatArray, off: Mapping[str, float]) -> ProvedPoses:
    """Bounds of the pose at joint values (n,) near home's assembly while copies and inputs are off by at most `off`.

    Angles of a quaternion have none.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> own = proved_poses(record, home_values(record), {"l1": 0.05, "rod1.l2": 0.02})
    >>> low, high = own.bounds["y"]
    >>> round(high - low, 3)
    0.053
    """
    names = tuple(off)
    bounds = np.array([off[name] for name in names])
    chosen = _independent(record, values)
    if chosen is None:
        return ProvedPoses({}, "the inputs do not hold the platform firmly enough")
    equations, unknown = chosen
    centre = centred(record, values)[unknown]
    graph = TolerancedLoops(record, values, names, equations, unknown)
    whole = proved_zeros(graph, centre, bounds)
    if whole is None:
        return ProvedPoses({}, "the tolerances are too wide, or a singularity is too near")
    return ProvedPoses(
        {name: (_end(whole, name, -1.0, bounds), _end(whole, name, 1.0, bounds)) for name in whole.bounds}
    )


def _end(whole: ProvedZeros, name: str, sense: float, bounds: FloatArray) -> float:
    """The largest that a coordinate can be, or the least where `sense` is -1.

    What it certainly rises or falls with is put at its end, and again, as more of the rest then has a sign.
    """
    proof, side = whole, 1 if sense > 0.0 else 0
    end = whole.bounds[name][side]
    while True:
        slopes, graph = proof.slopes[name], proof.graph
        signs = sense * (slopes.positive.astype(float) - slopes.negative.astype(float))
        free = signs == 0.0
        if np.all(free):
            return end
        ends = dict(zip(graph.names, (signs * bounds).tolist(), strict=True))
        names = tuple(own for own, left in zip(graph.names, free, strict=True) if left)
        fixed = {**graph.fixed, **{own: off for own, off in ends.items() if own not in names}}
        centre = proof.centre + proof.moved @ (signs * bounds)
        bounds = bounds[free]
        at_ends = proved_zeros(replace(graph, names=names, fixed=fixed), centre, bounds)
        if at_ends is None or not np.all(at_ends.unique.within(whole.unique)):
            return end
        proof, end = at_ends, sense * min(sense * end, sense * at_ends.bounds[name][side])


def _independent(record: MechanismRecord, values: FloatArray) -> tuple[list[int], list[int]] | None:
    """Equations of the loops and unknown joints, as many, by elimination in floats; what is left of joints is idle."""
    driven = {item.coordinate.index for item in record.drives}
    passive = [k for k in range(len(values)) if k not in driven]
    slopes = closing_system(record, values[None], None)[1][0][:, passive] * joint_scales(record)[passive]
    left = slopes / max(float(np.max(np.abs(slopes), initial=0.0)), 1e-300)
    rows: list[int] = []
    columns: list[int] = []
    while True:
        row, column = np.unravel_index(int(np.argmax(np.abs(left))), left.shape)
        if abs(left[row, column]) <= DEPENDENT:
            return (sorted(rows), [passive[k] for k in sorted(columns)]) if rows else None
        rows.append(int(row))
        columns.append(int(column))
        left = left - np.outer(left[:, column], left[row]) / left[row, column]
        left[row], left[:, column] = 0.0, 0.0
