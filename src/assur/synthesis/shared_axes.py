"""Lines that limbs share: first axes that are one line of the base, last axes that are one line of the platform."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Literal

from assur.topology.chains import Chain, ChainJoint
from assur.topology.directions import Vector
from assur.topology.notation import parse_chains, plain_text

End = Literal["", "base", "platform"]
"""The link in which a line stands; on none where it is empty."""

LABELS: dict[End, str] = {"base": "O", "platform": "Q"}


Lines = Mapping[End, tuple[int, ...]]
"""Links in which a line stands, and the limbs that turn about it."""


def axes_at(chain: Chain, end: End) -> tuple[Vector, ...]:
    """The axes of the joint next to a link, if it turns about axes: first that one which is next to the link.

    >>> from assur.topology.notation import parse_chain
    >>> axes_at(parse_chain("R[x] P[z] U[x,y]"), "platform"), axes_at(parse_chain("R[x] P[z] S"), "platform")
    (((0.0, 1.0, 0.0), (1.0, 0.0, 0.0)), ())
    """
    joint = _joint(chain, end)
    if joint is None or not joint.type.turning:
        return ()
    return joint.axes if end == "base" else joint.axes[::-1]


def with_common_lines(chains: Sequence[Chain], lines: Lines) -> tuple[Chain, ...]:
    """The limbs, those of them that share a line of a link with a label for it.

    >>> from assur.topology.notation import parse_chains
    >>> shared = with_common_lines(parse_chains(["U[x,y] P[z] R[y]", "R[x] P[z] S"]), {"base": (0, 1)})
    >>> [chain.text for chain in shared]
    ['U[x@O,y] P[z] R[y]', 'R[x]@O P[z] S']
    """
    return parse_chains([plain_text(chain) for chain in on_common_lines(chains, lines)])


def on_common_lines(chains: Sequence[Chain], lines: Lines) -> list[Chain]:
    """The same without names of joints through the mechanism, which take as long as to place it."""
    labelled = list(chains)
    for end, numbers in lines.items():
        for number in numbers:
            labelled[number] = _labelled(labelled[number], end)
    return labelled


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
