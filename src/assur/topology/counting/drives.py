"""Drives where nobody chose any: an admissible set of joints near the base, spread over the limbs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice, product

import numpy as np
from numpy.typing import NDArray

from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.counting.actuation import driven_columns, spanning
from assur.topology.counting.mobility import motions
from assur.topology.screws.edges import Edge, column_names, rank
from assur.topology.screws.linkage import Linkage

FloatArray = NDArray[np.float64]

COMBINATIONS = 60_000
"""Sets with one joint for each limb that are tried before limbs may have several."""

FREE = 6
"""Freedoms of a limb that holds the platform back in nothing."""

UNUSUAL = 1000
"""By how many places from the base a P, R, H or C is preferred to another joint, or to the second axis of a joint."""


@dataclass(frozen=True)
class _Candidate:
    """A component that may be driven: its column, the limb (or branch) that it is in, how far it is from the base.

    `holds`: whether its limb holds the platform back, so that it may be there for that alone.
    """

    column: int
    group: tuple[int, ...]
    distance: int
    holds: bool


def admissible_drives(
    edges: Sequence[Edge], linkage: Linkage, chains: Sequence[Chain], finite: FloatArray | None = None
) -> tuple[tuple[str, int], ...] | None:
    """Components (joint, index) that determine the platform, as `Linkage.inputs` has them.

    As many as the platform has freedoms: motions that leave it at rest need no drive, unless they move every joint
    that could have one. One for each limb, or branch of an inner loop, where that is possible, P, R, H and C joints
    before others, and of such sets the one that drives the fewest limbs which hold the platform back, as the UP of a
    3UPS&UP, and is nearest to the base, the first limbs first. Where it is not, the nearest joint of each limb, then
    the second, and so on, as they are needed.

    Args:
        edges: parallelograms as one, with twists at generic configurations.
        linkage: that they were made of.
        chains: its limbs, with the names of its joints.
        finite: as for `motions`.

    Returns:
        None where joints that may be driven do not determine the platform.
    """
    least = motions(edges, linkage.base, linkage.platform, inputs=(), finite=finite)
    driven = driven_columns(edges, least.internal[..., :0])
    every = motions(edges, linkage.base, linkage.platform, inputs=driven, finite=finite)
    for moving in (least, every):
        candidates = _candidates(edges, chains, driven_columns(edges, moving.internal))
        needed = moving.useful.shape[-1]
        chosen = _one_each(candidates, needed, moving.useful) or _in_turn(candidates, needed, moving.useful)
        if len(chosen) == needed:
            return _components(edges, sorted(chosen))
    return None


def _components(edges: Sequence[Edge], columns: Sequence[int]) -> tuple[tuple[str, int], ...]:
    """Columns as joints and components; of a parallelogram its first hinge."""
    owners = [(edge.joints[0], index) for edge in edges for index in range(edge.freedoms)]
    return tuple(owners[column] for column in columns)


def _one_each(candidates: Sequence[_Candidate], needed: int, useful: FloatArray) -> list[int]:
    """Columns of the nearest set that spans all motions (N, c, d) with one candidate of a limb at most; else none."""
    groups: dict[tuple[int, ...], list[_Candidate]] = {}
    for candidate in candidates:
        groups.setdefault(candidate.group, []).append(candidate)
    sets = (some for parts in combinations(groups.values(), needed) for some in product(*parts))
    tried = sorted(islice(sets, COMBINATIONS), key=_less_likely)
    columns = np.array([[candidate.column for candidate in some] for some in tried], dtype=int).reshape(
        len(tried), needed
    )
    good = np.flatnonzero(spanning(useful, columns))
    return [int(column) for column in columns[good[0]]] if len(good) else []


def _less_likely(candidates: Sequence[_Candidate]) -> tuple[int, ...]:
    """How many joints are unusual drives, how many limbs hold the platform back, how far all are from the base."""
    distances = [candidate.distance for candidate in candidates]
    unusual = sum(distance // UNUSUAL for distance in distances)
    return unusual, sum(candidate.holds for candidate in candidates), sum(distances)


def _in_turn(candidates: Sequence[_Candidate], needed: int, useful: FloatArray) -> list[int]:
    """Columns that span all motions: of each limb the nearest that adds something, then of each limb the next."""
    before: dict[tuple[int, ...], int] = {}
    turns = []
    for candidate in sorted(candidates, key=lambda candidate: candidate.distance):
        turns.append(
            (candidate.distance >= UNUSUAL, before.setdefault(candidate.group, 0), candidate.group, candidate.column)
        )
        before[candidate.group] += 1
    chosen: list[int] = []
    for *_, column in sorted(turns):
        if rank(useful[:, [*chosen, column]], scale=1.0) > len(chosen):
            chosen.append(column)
    return chosen if len(chosen) == needed else []


def _candidates(edges: Sequence[Edge], chains: Sequence[Chain], columns: Sequence[int]) -> list[_Candidate]:
    places = {
        name: (group, distance)
        for number, chain in enumerate(chains)
        for name, group, distance in _places(chain.elements, (number,), 0)
    }
    holds: dict[tuple[int, ...], bool] = {(number,): _holds(chain) for number, chain in enumerate(chains)}
    names = [edge.name for edge in edges for _ in range(edge.freedoms)]
    second = [name.endswith(".2") and name not in places for name in column_names(edges)]
    candidates = []
    for column in columns:
        # in a graph without limbs each joint is by itself, in the order in which they are written
        group, distance = places.get(names[column], ((len(chains) + column,), column))
        holding = holds.get(group[:1], False)
        candidates.append(_Candidate(column, group, distance + UNUSUAL * second[column], holding))
    return sorted(candidates, key=lambda candidate: (candidate.group, candidate.distance))


def _holds(chain: Chain) -> bool:
    """Whether a limb has an inner loop or fewer freedoms than a platform by itself."""
    looped = any(isinstance(element, InnerLoop) for element in chain.elements)
    return looped or sum(joint.freedoms for joint in chain.joints) < FREE


def _places(
    elements: Sequence[Element], group: tuple[int, ...], start: int
) -> Iterator[tuple[str, tuple[int, ...], int]]:
    """The joints of some elements: name, limb or branch, and how many joints stand between it and the base."""
    for index, element in enumerate(elements):
        if isinstance(element, InnerLoop):
            for number, branch in enumerate(element.branches):
                yield from _places(branch, (*group, index, number), start)
            start += max(len(branch) for branch in element.branches)
        else:
            yield element.name, group, start + (0 if _is_usual(element) else UNUSUAL)
            start += 1


def _is_usual(joint: ChainJoint | Parallelogram) -> bool:
    return isinstance(joint, ChainJoint) and joint.type.axial
