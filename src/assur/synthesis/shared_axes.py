"""Lines that limbs share: first axes that are one line of the base, last axes that are one line of the platform."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Literal

from assur.topology.chains import Chain, ChainJoint
from assur.topology.directions import Vector, parallel
from assur.topology.notation import parse_chains, plain_text

End = Literal["", "base", "platform"]
"""The link in which a line stands; on none where it is empty."""

LABELS: dict[End, str] = {"base": "O", "platform": "Q"}


Lines = Mapping[End, tuple[int, ...] | None]
"""Links in which a line stands, and the limbs that may turn about it; None: all."""


def common_lines(chains: Sequence[Chain]) -> Iterator[Lines]:
    """What limbs could share, the simplest first: nothing, one line, one of the base and one of the platform.

    On a line are all limbs with parallel axes next to the link, or those of them that are equal; on both lines none is.

    >>> from assur.topology.notation import parse_chains
    >>> list(common_lines(parse_chains(["U[x,y] P[z] R[y]", "R[x] P[z] S", "S P[z] R[x]"])))
    [{}, {'base': None}]
    """
    yield {}
    able = {end: numbers for end in LABELS if (numbers := sharing(chains, end))}
    yield from ({end: None} for end in able)
    equal = {end: _equal(chains, numbers) for end, numbers in able.items()}
    yield from ({end: numbers} for end, sets in equal.items() for numbers in sets)
    if len(able) == len(LABELS):
        for chosen in product(*([None, *equal[end]] for end in LABELS)):
            lines: Lines = dict(zip(LABELS, chosen, strict=True))
            if not set.intersection(*map(set, on_lines(chains, lines).values())):
                yield lines


def on_lines(chains: Sequence[Chain], lines: Lines) -> dict[End, tuple[int, ...]]:
    """The limbs that turn about each line: of those that may, the ones whose axes next to the link are parallel."""
    able = {end: sharing(chains, end) for end in lines}
    return {end: tuple(n for n in able[end] if may is None or n in may) for end, may in lines.items()}


def _equal(chains: Sequence[Chain], numbers: Sequence[int]) -> list[tuple[int, ...]]:
    """Those of some limbs that are equal, two or more, but not all."""
    alike: dict[str, list[int]] = {}
    for number in numbers:
        alike.setdefault(chains[number].text, []).append(number)
    return [tuple(some) for some in alike.values() if 1 < len(some) < len(numbers)]


def sharing(chains: Sequence[Chain], end: End) -> tuple[int, ...]:
    """Which limbs can turn about one line of a link: two or more whose joints next to it have parallel axes.

    None where there is a second set of such limbs.

    >>> from assur.topology.notation import parse_chains
    >>> sharing(parse_chains(["U[x,y] P[z] R[y]", "R[x] P[z] S", "S P[z] R[x]"]), "base")
    (0, 1)
    """
    sets: list[list[int]] = []
    axes = [_axis(chain, end) for chain in chains]
    for number, axis in enumerate(axes):
        if axis is None:
            continue
        for numbers in sets:
            other = axes[numbers[0]]
            if other is not None and parallel(axis, other):
                numbers.append(number)
                break
        else:
            sets.append([number])
    several = [numbers for numbers in sets if len(numbers) > 1]
    return tuple(several[0]) if len(several) == 1 else ()


def with_common_lines(chains: Sequence[Chain], lines: Lines) -> tuple[Chain, ...]:
    """The limbs, those of them that share a line of a link with a label for it.

    >>> from assur.topology.notation import parse_chains
    >>> shared = with_common_lines(parse_chains(["U[x,y] P[z] R[y]", "R[x] P[z] S"]), {"base": None})
    >>> [chain.text for chain in shared]
    ['U[x@O,y] P[z] R[y]', 'R[x]@O P[z] S']
    """
    labelled = list(chains)
    for end, numbers in on_lines(chains, lines).items():
        for number in numbers:
            labelled[number] = _labelled(labelled[number], end)
    return parse_chains([plain_text(chain) for chain in labelled])


def sharing_ends(chain: Chain) -> tuple[bool, bool]:
    """Whether the first and the last axis of a limb run through labelled points."""
    first, last = _joint(chain, "base"), _joint(chain, "platform")
    at_base = first is not None and bool(first.points_on(0))
    return at_base, last is not None and bool(last.points_on(len(last.axes) - 1))


def without_labels(chain: Chain) -> Chain:
    """The same series, with nothing said of points."""
    bare = (
        replace(joint, point="", through=()) if isinstance(joint, ChainJoint) else joint for joint in chain.elements
    )
    return Chain(tuple(bare), chain.text)


def _joint(chain: Chain, end: End) -> ChainJoint | None:
    element = chain.elements[0 if end == "base" else -1]
    return element if isinstance(element, ChainJoint) else None


def _axis(chain: Chain, end: End) -> Vector | None:
    """The axis of the joint next to a link, if it turns about one."""
    joint = _joint(chain, end)
    if joint is None or not joint.type.turning or not joint.axes:
        return None
    return joint.axes[0 if end == "base" else -1]


def _labelled(chain: Chain, end: End) -> Chain:
    joint, label = _joint(chain, end), LABELS[end]
    if joint is None:
        return chain
    if len(joint.axes) == 1:
        marked = replace(joint, point=label)
    else:
        marked = replace(joint, through=((label,), ()) if end == "base" else ((), (label,)))
    elements = (marked, *chain.elements[1:]) if end == "base" else (*chain.elements[:-1], marked)
    return Chain(elements)
