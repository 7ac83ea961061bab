"""The Pareto front of what a synthesis lists: what no other mechanism beats in one respect and equals in the rest."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from assur.results.plain_text import count as plural
from assur.synthesis.designs import Design

Values = tuple[int, int, int, int]
"""κ, redundant constraints, joints, and minus the zeros of the decoupling: each the better the smaller it is."""

_BEST = ("smallest κ", "fewest redundant constraints", "fewest joints", "most zeros of the decoupling")
_BETTER = ("a smaller κ", "fewer redundant constraints", "fewer joints", "more zeros")


@dataclass(frozen=True, eq=False)
class FrontPoint:
    """Mechanisms that are worth the same, and that no other beats.

    Attributes:
        ranks: of all of them.
        design: the best of them.
        reason: what it is the best in, and what the rest would cost, in one sentence without a full stop.
    """

    ranks: tuple[int, ...]
    design: Design
    reason: str


def values(design: Design) -> Values:
    """What a mechanism is compared by."""
    return (design.coupling_degree, design.redundant.collapsed, design.joints, -design.zeros)


def front(designs: Sequence[Design]) -> tuple[FrontPoint, ...]:
    """The mechanisms that no other beats, those of the same worth together.

    Args:
        designs: the best first.
    """
    ranks: dict[Values, list[int]] = defaultdict(list)
    for rank, design in enumerate(designs, 1):
        ranks[values(design)].append(rank)
    respects = 4 if any(design.decoupling for design in designs) else 3
    points = {point: ranks[point][0] for point in ranks if not any(_beats(other, point) for other in ranks)}
    return tuple(
        FrontPoint(tuple(ranks[point]), designs[rank - 1], "; ".join(_reasons(point, points, respects)))
        for point, rank in points.items()
    )


def _beats(first: Values, second: Values) -> bool:
    return first != second and all(a <= b for a, b in zip(first, second, strict=True))


def _reasons(point: Values, points: Mapping[Values, int], respects: int = 4) -> Iterator[str]:
    """What a point of the front is the best in; then for each other respect the nearest point that is better there.

    Of redundant drives no zeros are known, so that there are three respects.

    >>> for reason in _reasons((0, 4, 9, 0), {(0, 4, 9, 0): 1, (1, 0, 11, 0): 8}):
    ...     print(reason)
    smallest κ, fewest joints, most zeros of the decoupling
    fewer redundant constraints (rank 8: 0) cost κ 1 and 2 joints more
    """
    least = [min(column) for column in zip(*points, strict=True)]
    best = [_BEST[place] for place in range(respects) if point[place] == least[place]]
    yield ", ".join(best) if best else "between the others"
    for place, better in enumerate(_BETTER):
        others = [other for other in points if other[place] < point[place]]
        if others:
            near = min(others, key=lambda other: (_distance(point, other), points[other]))
            yield f"{better} (rank {points[near]}: {abs(near[place])}) cost{'s' * (place == 0)} {_cost(point, near)}"


def _distance(point: Values, other: Values) -> tuple[int, int]:
    """How many respects get worse, and by how much."""
    worse = [b - a for a, b in zip(point, other, strict=True) if b > a]
    return len(worse), sum(worse)


def _cost(point: Values, other: Values) -> str:
    degree, redundant, joints, zeros = (b - a for a, b in zip(point, other, strict=True))
    costs = (
        (degree, f"κ {other[0]}"),
        (redundant, f"{plural(redundant, 'redundant constraint')} more"),
        (joints, f"{plural(joints, 'joint')} more"),
        (zeros, f"{plural(zeros, 'zero')} less"),
    )
    return " and ".join(text for worse, text in costs if worse > 0)
