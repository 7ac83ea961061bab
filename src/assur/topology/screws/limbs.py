"""The limbs of a joint graph: joints in series, and loops inside a limb, by series-parallel reduction.

A link with two joints puts them in series; two paths between the same two links are the branches of an inner
loop. What remains between base and platform are the limbs. A graph that does not reduce has no limbs in the
sense of POC theory, and only the twists can say what its platform does.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop


@dataclass(frozen=True)
class LinkagePath:
    """Elements from one link to another, in order."""

    start: str
    end: str
    elements: tuple[Element, ...]

    def reversed(self) -> LinkagePath:
        """The same path from its other end."""
        return LinkagePath(self.end, self.start, tuple(_turned(element) for element in reversed(self.elements)))


def _turned(element: Element) -> Element:
    """An element passed through from its other side."""
    if isinstance(element, InnerLoop):
        turned = tuple(tuple(_turned(inner) for inner in reversed(branch)) for branch in element.branches)
        return InnerLoop(turned, element.name)
    if isinstance(element, ChainJoint):
        return replace(element, axes=element.axes[::-1], through=element.through[::-1])
    return element


def limbs(paths: Iterable[LinkagePath], base: str, platform: str) -> tuple[Chain, ...] | None:
    """Chains from base to platform, in the order of the first path of each; None where the graph does not reduce.

    Links that carry nothing (an arm with a free end) are dropped.

    >>> from assur.topology.chains import ChainJoint
    >>> from assur.joints.revolute import REVOLUTE
    >>> joint = lambda name: (ChainJoint(REVOLUTE, ((0.0, 0.0, 1.0),), name=name),)
    >>> crank, rod = LinkagePath("base", "crank", joint("A")), LinkagePath("crank", "rod", joint("B"))
    >>> [chain.joints[1].name for chain in limbs([crank, rod], "base", "rod")]
    ['B']
    """
    left = list(paths)
    while True:
        reduced = _series(left, {base, platform})
        if reduced is None:
            reduced = _parallel(left, {base, platform})
        if reduced is None:
            break
        left = reduced
    oriented = [path if path.start == base else path.reversed() for path in left]
    if any((path.start, path.end) != (base, platform) for path in oriented):
        return None
    return tuple(Chain(path.elements) for path in oriented)


def _series(paths: list[LinkagePath], ends: set[str]) -> list[LinkagePath] | None:
    """Two paths joined at a link that only they touch, or an end that hangs free dropped."""
    touching: dict[str, list[int]] = {}
    for index, path in enumerate(paths):
        touching.setdefault(path.start, []).append(index)
        touching.setdefault(path.end, []).append(index)
    for link, indices in touching.items():
        if link in ends or len(indices) > 2:
            continue
        if len(indices) == 1 or indices[0] == indices[1]:
            return [path for index, path in enumerate(paths) if index != indices[0]]
        first, second = (paths[index] for index in indices)
        first = first if first.end == link else first.reversed()
        second = second if second.start == link else second.reversed()
        joined = LinkagePath(first.start, second.end, (*first.elements, *second.elements))
        return [joined if i == indices[0] else path for i, path in enumerate(paths) if i != indices[1]]
    return None


def _parallel(paths: list[LinkagePath], ends: set[str]) -> list[LinkagePath] | None:
    """The paths between one pair of links, not base and platform, made one path through an inner loop."""
    between: dict[frozenset[str], list[int]] = {}
    for index, path in enumerate(paths):
        between.setdefault(frozenset((path.start, path.end)), []).append(index)
    for pair, indices in between.items():
        if len(indices) < 2 or pair == ends:
            continue
        first = paths[indices[0]]
        branches = [paths[i] if paths[i].start == first.start else paths[i].reversed() for i in indices]
        loop = InnerLoop(tuple(branch.elements for branch in branches))
        merged = LinkagePath(first.start, first.end, (loop,))
        return [merged if i == indices[0] else path for i, path in enumerate(paths) if i not in indices[1:]]
    return None
