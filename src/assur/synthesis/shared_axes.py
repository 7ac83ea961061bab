"""Lines that limbs share: first axes that are one line of the base, last axes that are one line of the platform."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

from assur.topology.chains import Chain, ChainJoint
from assur.topology.directions import Vector, parallel
from assur.topology.notation import parse_chains, plain_text

End = Literal["", "base", "platform"]
"""The link in which the line stands; on none where it is empty."""

LABELS: dict[End, str] = {"base": "O", "platform": "Q"}


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


def with_common_line(chains: Sequence[Chain], end: End) -> tuple[Chain, ...]:
    """The limbs, those of them that can share a line of a link with a label for it.

    >>> from assur.topology.notation import parse_chains
    >>> shared = with_common_line(parse_chains(["U[x,y] P[z] R[y]", "R[x] P[z] S"]), "base")
    >>> [chain.text for chain in shared]
    ['U[x@O,y] P[z] R[y]', 'R[x]@O P[z] S']
    """
    numbers = sharing(chains, end) if end else ()
    labelled = [_labelled(chain, end) if number in numbers else chain for number, chain in enumerate(chains)]
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
