"""Which joints are actuated: the first P, R or C of each branch from the base, or those that are named by number."""

from __future__ import annotations

from collections.abc import Sequence

from assur.errors import UsageError
from assur.topology.chains import BASE, Chain, ChainJoint, Element, InnerLoop, Parallelogram


def default_inputs(chains: Sequence[Chain]) -> tuple[str, ...]:
    """Names of the first P, R, H or C joint of each branch, looking from the base; of a C its translation is meant.

    An inner loop at the base has several branches, so a limb may have several inputs.
    """
    return tuple(name for chain in chains if chain.start == BASE for name in _first(chain.elements))


def _first(elements: Sequence[Element]) -> list[str]:
    for element in elements:
        if isinstance(element, InnerLoop):
            names = [name for branch in element.branches for name in _first(branch)]
            if names:
                return names
        elif isinstance(element, ChainJoint) and element.type.axial:
            return [element.name]
    return []


def numbered_inputs(chains: Sequence[Chain], numbers: Sequence[str]) -> tuple[str, ...]:
    """Names of joints given as "limb.joint", counted from 1 in the order of the text, branches flattened.

    Errors:
        UsageError: not of that form, no such joint, the same one twice, or a joint that cannot be actuated.

    >>> from assur.topology.notation import parse_chains
    >>> numbered_inputs(parse_chains(["U[x,y] P[z] S", "{R[x] R[x] | R[x] R[x]} R[y]"]), ["1.2", "2.3"])
    ('P1', 'R3')
    """
    names: list[str] = []
    for number in numbers:
        name = _named(chains, number.strip())
        if name in names:
            raise UsageError(f"--actuate names the joint {number} twice; each once")
        names.append(name)
    return tuple(names)


def _named(chains: Sequence[Chain], number: str) -> str:
    limb, dot, joint = number.partition(".")
    if not (dot and limb.isdecimal() and joint.isdecimal()):
        raise UsageError(
            f"'{number}' names no joint to actuate; write limb.joint, both counted from 1",
            hint="1.2 is the second joint of the first limb, the branches of inner loops one after the other",
        )
    if not 1 <= int(limb) <= len(chains):
        raise UsageError(f"'{number}': there is no limb {limb}; limbs run from 1 to {len(chains)}")
    joints = chains[int(limb) - 1].joints
    if not 1 <= int(joint) <= len(joints):
        raise UsageError(f"'{number}': limb {limb} has joints 1 to {len(joints)}")
    chosen = joints[int(joint) - 1]
    if isinstance(chosen, Parallelogram):
        if chosen.kind != "4R":
            raise UsageError(
                f"'{number}' is a parallelogram with {chosen.freedoms} freedoms; only a P(4R) can be actuated"
            )
    elif chosen.type.ball:
        raise UsageError(f"'{number}' is a spherical joint, which cannot be actuated; any other joint can")
    return chosen.name
