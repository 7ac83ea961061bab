"""What a drafted mechanism is driven by: the joints that were named, or the first ones that determine it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from assur.errors import UsageError
from assur.topology.analysis import Mode, analyse
from assur.topology.chains import Chain
from assur.topology.counting.inputs import default_inputs, numbered_inputs
from assur.topology.facts import Topology
from assur.topology.screws.placing import place


def inputs_for(chains: Sequence[Chain], actuate: Sequence[str] | None, mode: Mode) -> tuple[tuple[str, ...], Topology]:
    """Names of actuated joints that determine a mechanism, as many as there are freedoms unless more are named; its
    topology with these.

    By default the first P, R, H or C of each branch from the base; where these do not determine it, an admissible set
    near the base, of what a draft can drive.

    Errors:
        UsageError: a mechanism that does not move; named joints that do not determine it, or no set that does.

    >>> from assur.topology.notation import parse_chains
    >>> inputs_for(parse_chains(["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"]), None, "home")[0]
    ('P1', 'P2', 'P3')
    """
    names = numbered_inputs(chains, actuate) if actuate else default_inputs(chains)
    topology = analyse(
        place(chains, actuated=names), chains, mode=mode, inputs_by="given" if actuate else "first joints"
    )
    asked = topology.actuation
    if not asked.needed:
        raise UsageError(_what_stands_still(topology), hint=_why_rigid(chains))
    idle = sorted({joint for joints in topology.internal_joints for joint in joints if joint in names})
    if idle or asked.needed > topology.poc.dim:
        moving = ", ".join(idle) or "driven joints"
        raise UsageError(
            f"the platform has dimension {topology.poc.dim}, {topology.poc}, but {moving} can move "
            "while it stands still: limbs move by themselves, so that no pose tells where the mechanism is",
            hint="leave joints out of a limb, or add a limb",
        )
    driven = _first_components(topology.inputs)
    if driven is not None and (asked.verdict == "valid" or (actuate and asked.verdict == "redundant")):
        return (names if actuate else driven), topology
    if actuate:
        raise UsageError(f"the actuated joints do not determine the mechanism: {asked.verdict}", hint=asked.hint)
    limb_of = {joint.name: number for number, chain in enumerate(chains) for joint in chain.joints}
    usable = [components for components in map(_first_components, asked.sets) if components is not None]
    if not usable:
        raise UsageError(
            f"no {asked.needed} joints that a draft could drive determine the mechanism",
            hint="an S is never driven, of a C only its translation, of another joint only its first component",
        )
    chosen = min(usable, key=lambda components: max(Counter(limb_of[name] for name in components).values()))
    return chosen, analyse(place(chains, actuated=chosen), chains, mode=mode)


def _what_stands_still(topology: Topology) -> str:
    """That nothing moves, or nothing but limbs by themselves."""
    if not topology.dof:
        return "the chains make a structure that does not move: 0 degrees of freedom"
    moving = ", ".join(joint for joints in topology.internal_joints for joint in joints)
    return f"the platform does not move; by themselves move {moving}"


def _why_rigid(chains: Sequence[Chain]) -> str:
    """What may be wrong with chains that do not move."""
    if any(joint.general for chain in chains for joint in chain.joints):
        return "axes without brackets are general, none parallel to another: a planar limb is R[z] R[z] R[z]"
    return "a limb has too few freedoms, or axes that do not go together; @O behind axes lets them share a point"


def _first_components(names: Sequence[str]) -> tuple[str, ...] | None:
    """The joints of a set of components, None where one is not a joint's first."""
    pairs = [name.partition(".") for name in names]
    if any(component not in ("", "1") for _, _, component in pairs):
        return None
    return tuple(joint for joint, _, _ in pairs)
