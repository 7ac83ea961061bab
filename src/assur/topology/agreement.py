"""The two routes side by side: what the rules say of a POC set, and what the twists say."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError
from assur.topology.directions import span
from assur.topology.poc import Mark, PocSet
from assur.topology.screws.twists import dimensions, fixed_directions

FloatArray = NDArray[np.float64]

SAME = 1e-6
"""Sine of the angle below which a direction of the rules is the one of the twists."""


SPECIAL = (
    "dimensions may be special in a way that axes and labels do not say: a parallelogram that is not declared (as a "
    "generalised joint in a file, as P(4R) in notation), a Bennett or another paradoxical loop, which no POC set "
    "represents; or assur has an error"
)


class RoutesDisagreeError(AssurError):
    """Rules and twists give different answers for a chain. One of them is wrong there; neither is chosen."""

    exit_code = 5


def agreed(what: str, rules: PocSet, basis: FloatArray) -> PocSet:
    """The POC set of the rules, if the twists confirm its numbers and every direction that it calls fixed.

    Where the rules name no direction and the twists find it fixed, it is set by the location of joints, and the mark
    says so.

    Args:
        what: the chain, for the error.
        rules: by the symbolic route.
        basis: (N, 6, k) motion space at the same point O', at N >= 2 configurations.

    Errors:
        RoutesDisagreeError: they differ.
    """
    t, r, dim = dimensions(basis)
    if (rules.t, rules.r, rules.dim) != (t, r, dim):
        raise RoutesDisagreeError(
            f"{what}: the rules say t{rules.t} r{rules.r} with dim {rules.dim}, the twists t{t} r{r} with dim {dim}",
            hint=SPECIAL,
        )
    marks, counts = (rules.t_mark, rules.r_mark), (t, r)
    for part, mark, count, fixed in zip("tr", marks, counts, fixed_directions(basis), strict=True):
        if mark.axes and not (len(mark.axes) == count and _same(mark, fixed)):
            raise RoutesDisagreeError(
                f"{what}: the rules say {part}({mark.relation} {', '.join(mark.names)}), the twists do not",
                hint="the directions of its axes at home may not be what they seem; or assur has an error",
            )
    moved, turned = (_located(*group) for group in zip(marks, counts, fixed_directions(basis), strict=True))
    return dataclasses.replace(rules, t_mark=moved, r_mark=turned)


def _located(mark: Mark, count: int, fixed: FloatArray) -> Mark:
    """The mark, or "located" where no axis names its directions and they stay fixed all the same."""
    return Mark("located") if mark.relation == "moving" and len(fixed) == count else mark


def _same(mark: Mark, fixed: FloatArray) -> bool:
    """Whether the axes of a mark lie among the directions that stay fixed."""
    axes = span(mark.axes)
    return bool(np.max(np.abs(axes - axes @ fixed.T @ fixed), initial=0.0) < SAME)


def by_twists(basis: FloatArray) -> PocSet:
    """A POC set by the twists alone: its numbers, and the directions that stay fixed, without names of joints."""
    t, r, dim = dimensions(basis)
    moved, turned = fixed_directions(basis)
    return PocSet(t, r, dim, _mark(t, moved), _mark(r, turned))


def _mark(count: int, fixed: FloatArray) -> Mark:
    if count in (0, 3):
        return Mark()
    if len(fixed) < count:
        return Mark("moving")
    return Mark("fixed", (), tuple((float(x), float(y), float(z)) for x, y, z in fixed))
