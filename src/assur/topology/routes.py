"""Both routes to every POC set of a mechanism: the rules answer, the twists confirm; or the twists answer alone."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.results.answers.solution_order import Loop
from assur.topology.agreement import SPECIAL, RoutesDisagreeError, agreed, by_twists
from assur.topology.chains import Chain, InnerLoop
from assur.topology.facts import Known
from assur.topology.screws.configurations import configurations
from assur.topology.screws.limb_linkage import limb_linkage, limb_values
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.shared_points import common_end
from assur.topology.screws.twists import dimensions, edges, motion_space
from assur.topology.symbolic.derivation import PocDerivation
from assur.topology.symbolic.intersection import parallel, xi_of_next
from assur.topology.symbolic.motion import Mode, Motion, motion_of
from assur.topology.symbolic.orientations import EVERY, Orientations
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import serial

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Rules:
    """What the rules say of the limbs of a mechanism and of its platform.

    Attributes:
        free: the limbs' motions by themselves (in translation mode where that was asked for).
        still: the same, held to the orientations that the platform takes.
        platform: the platform's motion.
    """

    free: tuple[Motion | Refusal, ...]
    still: tuple[Motion | Refusal, ...]
    platform: Motion | Refusal

    def derivations(self) -> tuple[PocDerivation, ...]:
        """Of the platform with its limbs, or of the limbs where the rules refuse the platform."""
        whole = (self.platform,) if isinstance(self.platform, Motion) else self.free
        return tuple(motion.derive() for motion in whole if isinstance(motion, Motion) and motion.derive is not None)


def by_rules(chains: Sequence[Chain] | None, *, still: bool, held: bool, at: str = "", at_end: bool = True) -> Rules:
    """The rules' answers.

    Args:
        chains: the limbs; None where the joint graph has none.
        still: whether the platform does not turn, so that limbs are in translation mode.
        held: whether this is because it was asked for, and not by the mechanism's own making.
        at: label of the common end of the limbs where O' is; empty for a general point of the platform.
        at_end: of one limb alone, whether O' is where its own entry has it.
    """
    if chains is None:
        return Rules(
            (),
            (),
            Refusal("the joint graph has no limbs: it does not reduce to chains, inner loops and parallelograms"),
        )
    free = tuple(_motion(chain, "translation" if held else "free", number) for number, chain in enumerate(chains, 1))
    platform = _platform(free, "translation" if held else "free", at, at_end=at_end)
    if still and not held:
        return Rules(free, tuple(_motion(chain, "translation", n) for n, chain in enumerate(chains, 1)), platform)
    taken = platform.orientations if isinstance(platform, Motion) and len(chains) > 1 and not held else EVERY
    return Rules(free, tuple(_held(limb, taken) for limb in free), platform)


def _held(limb: Motion | Refusal, taken: Orientations) -> Motion | Refusal:
    """A limb whose end link takes only some orientations, where that leaves it another number of elements."""
    if isinstance(limb, Refusal) or limb.limb is None or taken == EVERY:
        return limb
    kept = motion_of(limb.limb, taken)
    same = isinstance(kept, Motion) and (kept.poc.t, kept.poc.r, kept.dim) == (limb.poc.t, limb.poc.r, limb.dim)
    return limb if same else kept


def _motion(chain: Chain, mode: Mode, number: int) -> Motion | Refusal:
    return serial(chain, mode, name=f"limb {number}")


def _platform(limbs: Sequence[Motion | Refusal], mode: Mode, at: str, *, at_end: bool) -> Motion | Refusal:
    motions = [limb for limb in limbs if isinstance(limb, Motion)]
    for number, limb in enumerate(limbs, 1):
        if isinstance(limb, Refusal):
            return Refusal(f"limb {number}: {limb.reason}")
    return motions[0] if len(motions) == 1 and at_end else parallel(motions, mode, at=at)


def told_point(chains: Sequence[Chain], *, held: bool) -> str:
    """The label of the limbs' common end, or empty for a general point where the rules tell only how that one moves."""
    label = common_end(chains)
    at_label, anywhere = (by_rules(chains, still=False, held=held, at=at).platform for at in (label, ""))
    return "" if isinstance(at_label, Refusal) and isinstance(anywhere, Motion) else label


def both(what: str, rules: Motion | Refusal, space: FloatArray) -> Known:
    """A POC set by both routes, or by the twists alone where the rules refuse.

    Args:
        what: for the error, where they disagree.
        rules: the rules' answer.
        space: (N, 6, k) motion space at the same O'.

    Errors:
        RoutesDisagreeError: they disagree.
    """
    if isinstance(rules, Refusal):
        return Known(by_twists(space), "twists", rules.reason)
    return Known(agreed(what, rules.poc, space), "both")


@dataclass(frozen=True, eq=False)
class KnownLimb:
    """A limb's POC set, and its motion by the rules where that holds at the mechanism's configurations too."""

    known: Known
    motion: Motion | None


def limb_known(
    what: str, rules: Sequence[Motion | Refusal], linkage: Linkage, chain: Chain, values: FloatArray
) -> KnownLimb:
    """The POC set of one limb alone, O' at its end, by both routes.

    Args:
        what: for the error, where they disagree.
        rules: the rules' answers, as the platform lets the limb move and for the limb by itself.
        linkage: of the mechanism.
        chain: the limb.
        values: (N, n) configurations of the mechanism.
    """
    limb = limb_linkage(linkage, chain)
    space = _space(limb, limb_values(linkage, limb, values))
    for motion in rules:
        if isinstance(motion, Motion) and dimensions(space) == (motion.poc.t, motion.poc.r, motion.poc.dim):
            return KnownLimb(both(what, motion, space), motion)
    if isinstance(rules[1], Refusal):
        return KnownLimb(both(what, rules[1], space), None)
    # the mechanism may hold the limb where it is special; by itself it is not
    return limb_alone(what, rules[1], linkage, chain)


def limb_alone(what: str, rules: Motion | Refusal, linkage: Linkage, chain: Chain) -> KnownLimb:
    """The POC set of one limb as it moves by itself, by both routes; arguments as for `limb_known`."""
    limb = limb_linkage(linkage, chain)
    return KnownLimb(both(what, rules, _space(limb, configurations(limb))), None)


def _space(limb: Linkage, values: FloatArray) -> FloatArray:
    """(N, 6, k) motion space of the end link."""
    return motion_space(edges(limb, values), limb.base, limb.platform)


def as_the_limbs_are(rules: Rules, limbs: Sequence[KnownLimb]) -> Rules:
    """The rules' answers, without one for the platform where the mechanism keeps a limb special.

    The rules take a limb to move as it does by itself, once it is displaced. A mechanism may keep it where it has fewer
    motions: the limbs R[z]@A P[x] R[z]@A stand with their axes on one line, and three of them never leave that.
    """
    special = [number for number, limb in enumerate(limbs, 1) if limb.motion is None]
    if not special or isinstance(rules.platform, Refusal) or rules.platform.from_home:
        return rules
    reason = f"the mechanism keeps limb {special[0]} in a special position, where it has other motions than by itself"
    return dataclasses.replace(rules, platform=Refusal(reason))


def check_xi(chains: Sequence[Chain], limbs: Sequence[Motion | None], loops: Sequence[Loop], *, held: bool) -> None:
    """Compare xi of Eq. (4) by the rules with the rank of the closure, for every loop that closes whole limbs.

    Args:
        chains: the limbs.
        limbs: their motions at the mechanism's configurations; nothing is compared where one is not known, nor in a
            loop of limbs that have fewer motions there than by themselves, because fewer limbs may not hold them so.
        loops: in their order.
        held: whether the platform was asked to keep its orientation.

    Errors:
        RoutesDisagreeError: they disagree.
    """
    motions = [limb for limb in limbs if limb is not None]
    if len(motions) < len(chains):
        return
    names = [{joint.name for joint in chain.joints} for chain in chains]
    passed = [{joint.name for joint in chain.elements if not isinstance(joint, InnerLoop)} for chain in chains]
    taken: set[str] = set()
    inside: list[int] = []
    for number, loop in enumerate(loops, 1):
        taken |= set(loop.joints)
        new = [index for index, name in enumerate(names) if name <= taken and index not in inside]
        # a loop may pass a limb and leave one of its branches to later loops: no POC set stands for such a part
        part = [
            names_of_part
            for name, names_of_part in zip(names, passed, strict=True)
            if name & taken and not name <= taken
        ]
        broken = any(not names_of_part or names_of_part & taken for names_of_part in part)
        whole = not broken and all(passed[index] and passed[index] <= set(loop.joints) for index in new)
        free = held or all(_by_itself(motions[index]) for index in (*inside, *new))
        if whole and free and (len(inside), len(new)) in ((0, 2), (len(inside) or -1, 1)):
            first, last = (inside or new[:1]), new[-1]
            before, after = (_together(motions, some, held) for some in (first, [*first, last]))
            if isinstance(before, Motion) and isinstance(after, Motion):
                _compare(number, loop, xi_of_next(before, motions[last], after))
        inside += new


def _by_itself(limb: Motion) -> bool:
    """Whether a limb moves in its mechanism as it does by itself, and so in a part of the mechanism too."""
    alone = motion_of(limb.limb) if limb.limb else limb
    return isinstance(alone, Motion) and alone.dim == limb.dim


def _together(motions: Sequence[Motion], chosen: Sequence[int], held: bool) -> Motion | Refusal:
    some = [motions[index] for index in chosen]
    return some[0] if len(some) == 1 else parallel(some, "translation" if held else "free")


def _compare(number: int, loop: Loop, xi: int) -> None:
    if xi != loop.xi:
        raise RoutesDisagreeError(
            f"loop {number} ({', '.join(loop.joints)}): the rules say xi = {xi}, the rank of the closure {loop.xi}",
            hint=SPECIAL,
        )
