"""Limbs that have the required motion, by both routes: the rules on the chain, the twists at poses of that motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from assur.joints.spherical import SPHERICAL
from assur.synthesis.limbs import LimbType
from assur.synthesis.poses import twists_at_poses
from assur.synthesis.positions import turned
from assur.synthesis.required import RequiredMotion
from assur.topology.agreement import RoutesDisagreeError, agreed, by_twists
from assur.topology.chains import Chain
from assur.topology.facts import Known
from assur.topology.notation import parse_chain, plain_text
from assur.topology.screws.edges import rank
from assur.topology.symbolic.motion import Motion, motion_of
from assur.topology.symbolic.orientations import Orientations
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import serial

FloatArray = NDArray[np.float64]

ANGLES = np.array([0.31, -0.43, 0.52])
"""Angles (rad) of the platform at its poses, where it turns; as many poses where it does not."""

STILL = 1e-7
"""Joint rates below this, at unit rates of the platform, are rounding errors of zero."""

Reason = Literal["", "a passive freedom", "not the motion", "an idle joint"]
"""Why a limb is of no use; nothing where it is."""


@dataclass(frozen=True, eq=False)
class CandidateLimb:
    """A limb that has the required motion.

    Attributes:
        type: the limb in its first position.
        chains: the limb in each position.
        known: its POC set in the first position, O' on its last axis, and by which routes it is known.
        motions: what the rules say in each position; empty where they refuse.
        twists: (N, 6, f) in each position, with other lengths of links in each.
    """

    type: LimbType
    chains: tuple[Chain, ...]
    known: Known
    motions: tuple[Motion, ...]
    twists: tuple[FloatArray, ...]

    @property
    def text(self) -> str:
        """The limb in the plain form, in its first position."""
        return self.chains[0].text

    @cached_property
    def needs_mode(self) -> bool:
        """Whether it moves otherwise when the platform does not keep its orientation."""
        free = serial(self.chains[0])
        if isinstance(free, Refusal):
            return True
        poc = self.known.poc
        return (free.poc.t, free.poc.r, free.poc.dim) != (poc.t, poc.r, poc.dim)


@dataclass(frozen=True, eq=False)
class LimbVerdict:
    """What became of a limb type: the limb, or why it is of no use, or how the two routes disagree on it."""

    limb: CandidateLimb | None = None
    reason: Reason = ""
    disagreement: str = ""


def verdict(limb: LimbType, motion: RequiredMotion, turns: Sequence[FloatArray]) -> LimbVerdict:
    """Whether a limb has the required motion, all its freedoms are independent, and no joint of it stays at rest.

    Args:
        limb: in its first position.
        motion: required of the platform.
        turns: (3, 3) into each position.
    """
    chains = tuple(parse_chain(plain_text(turned(limb.chain, turn))) for turn in turns)
    rules = [_by_rules(chain, motion) for chain in chains]
    orientations = np.concatenate([motion.orientations(ANGLES)] * len(turns))
    twists = twists_at_poses(limb.chain, orientations, np.random.default_rng(crc32(repr(limb.key).encode())))
    by_twist = _reason_by_twists(twists, limb, motion)
    first = rules[0]
    if isinstance(first, Motion) and _reason_by_rules(first, motion) != by_twist:
        said = _reason_by_rules(first, motion) or "the motion"
        return LimbVerdict(
            disagreement=f"{chains[0].text}: the rules say {said}, the twists {by_twist or 'the motion'}"
        )
    if twists is None or by_twist:
        return LimbVerdict(reason=by_twist)
    if _idles(limb, twists, motion):
        return LimbVerdict(reason="an idle joint")
    parts = np.split(twists, len(turns))
    try:
        known = _known(chains[0].text, first, parts[0])
    except RoutesDisagreeError as error:
        return LimbVerdict(disagreement=error.message)
    placed = tuple(_turned_twists(part, turn) for part, turn in zip(parts, turns, strict=True))
    return LimbVerdict(
        CandidateLimb(limb, chains, known, tuple(rule for rule in rules if isinstance(rule, Motion)), placed)
    )


def _by_rules(chain: Chain, motion: RequiredMotion) -> Motion | Refusal:
    """The rules' answer for a limb whose end link takes the orientations that are wanted."""
    free = serial(chain, "free" if motion.rotations else "translation", chain.text)
    if isinstance(free, Refusal) or free.limb is None or not motion.rotations:
        return free
    return motion_of(free.limb, Orientations(1, motion.rotations))


def _reason_by_rules(limb_motion: Motion, motion: RequiredMotion) -> Reason:
    if limb_motion.orientations.dim < len(motion.rotations):
        return "not the motion"
    if limb_motion.passive:
        return "a passive freedom"
    moves = all(limb_motion.translations.contains(direction) for direction in motion.translations)
    turns = all(limb_motion.rotations.contains(direction) for direction in motion.rotations)
    return "" if moves and turns else "not the motion"


def _reason_by_twists(twists: FloatArray | None, limb: LimbType, motion: RequiredMotion) -> Reason:
    if twists is None:
        return "not the motion"
    if rank(twists) < limb.freedoms:
        return "a passive freedom"
    motion_twists = np.broadcast_to(motion.twists, (len(twists), 6, motion.dim))
    return "" if rank(np.concatenate([twists, motion_twists], axis=-1)) == limb.freedoms else "not the motion"


def _idles(limb: LimbType, twists: FloatArray, motion: RequiredMotion) -> bool:
    """Whether a freedom stays at rest in all of the motion; of a ball joint, all three."""
    rates = np.max(np.abs(np.linalg.pinv(twists) @ motion.twists), axis=(0, 2))  # (f,)
    parts = np.split(rates, np.cumsum([joint.freedoms for joint in limb.chain.joints])[:-1])
    return any(
        np.max(part) < STILL if element.freedoms == SPHERICAL.freedoms else np.min(part) < STILL
        for element, part in zip(limb.chain.joints, parts, strict=True)
    )


def _known(text: str, rules: Motion | Refusal, twists: FloatArray) -> Known:
    """The POC set; the twists stand at a general point, so that is where the routes are compared."""
    basis = np.linalg.qr(twists)[0]
    if isinstance(rules, Refusal):
        return Known(by_twists(basis), "twists", rules.reason)
    agreed(text, rules.restated, basis)
    return Known(rules.poc, "both")


def _turned_twists(twists: FloatArray, turn: FloatArray) -> FloatArray:
    turned_parts = [np.einsum("ij,njf->nif", turn, part) for part in (twists[:, :3], twists[:, 3:])]
    return np.concatenate(turned_parts, axis=1)
