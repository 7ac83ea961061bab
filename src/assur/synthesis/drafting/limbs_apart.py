"""A chain that is an inner loop and nothing else: its branches are limbs of their own."""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.chains import Chain, Element, InnerLoop
from assur.topology.counting.inputs import numbered_inputs
from assur.topology.notation import parse_chains, plain_text


def limbs_apart(
    chains: Sequence[Chain], actuate: Sequence[str] | None
) -> tuple[Sequence[Chain], tuple[str, ...] | None]:
    """The chains, those that are one loop from base to platform taken apart, and what is driven by its new numbers.

    A loop that nothing follows has the platform as its output link, so that each of its branches leads there.

    >>> from assur.topology.notation import parse_chain
    >>> chains, driven = limbs_apart([parse_chain("{P[y] R[x] | P[y] R[x]}"), parse_chain("U P S")], ["1.3", "2.2"])
    >>> [chain.text for chain in chains], driven
    (['P[y] R[x]', 'P[y] R[x]', 'U P S'], ('2.1', '3.2'))
    """
    limbs = [limb for chain in chains for limb in _branches(chain.elements)]
    if len(limbs) == len(chains):
        return chains, tuple(actuate) if actuate else None
    apart = parse_chains([plain_text(Chain(limb)) for limb in limbs])
    if not actuate:
        return apart, None
    named = numbered_inputs(chains, actuate)
    numbers = {
        joint.name: f"{limb}.{place}"
        for limb, elements in enumerate(limbs, 1)
        for place, joint in enumerate(Chain(elements).joints, 1)
    }
    return apart, tuple(numbers[name] for name in named)


def _branches(elements: tuple[Element, ...]) -> list[tuple[Element, ...]]:
    if len(elements) == 1 and isinstance(elements[0], InnerLoop):
        return [limb for branch in elements[0].branches for limb in _branches(branch)]
    return [elements]
