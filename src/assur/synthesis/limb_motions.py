"""Limbs that have the required motion, by both routes: the rules on the chain, the twists at poses of that motion."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from assur.joints.spherical import SPHERICAL
from assur.synthesis.limbs import LimbType
from assur.synthesis.poses import edges_at_poses, twists_at_will
from assur.synthesis.positions import turned
from assur.synthesis.required import RequiredMotion
from assur.topology.agreement import RoutesDisagreeError, agreed, by_twists
from assur.topology.chains import BASE, PLATFORM, Chain
from assur.topology.facts import Known
from assur.topology.notation import parse_chain, plain_text
from assur.topology.screws.edges import Edge, along, closure, null_basis, rank
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
        edges: in each position, with other lengths of links in each; the driven columns are inputs.
    """

    type: LimbType
    chains: tuple[Chain, ...]
    known: Known
    motions: tuple[Motion, ...]
    edges: tuple[tuple[Edge, ...], ...]

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
    chain = parse_chain(plain_text(turned(limb.chain, turns[0])))
    first = _by_rules(chain, motion)
    orientations = np.concatenate([motion.orientations(ANGLES)] * len(turns))
    edges = edges_at_poses(limb.chain, orientations, np.random.default_rng(crc32(repr(limb.key).encode())))
    moves = _moves(edges) if edges else None
    by_twist = _reason_by_twists(moves, motion)
    if isinstance(first, Motion) and _reason_by_rules(first, motion) != by_twist:
        said = _reason_by_rules(first, motion) or "the motion"
        return LimbVerdict(disagreement=f"{chain.text}: the rules say {said}, the twists {by_twist or 'the motion'}")
    if edges is None or moves is None or by_twist:
        return LimbVerdict(reason=by_twist)
    if _idles(limb, moves, motion):
        return LimbVerdict(reason="an idle joint")
    try:
        known = _known(chain.text, first, np.split(moves.platform, len(turns))[0])
    except RoutesDisagreeError as error:
        return LimbVerdict(disagreement=error.message)
    chains = (chain, *(parse_chain(plain_text(turned(limb.chain, turn))) for turn in turns[1:]))
    rules = (first, *(_by_rules(chain, motion) for chain in chains[1:]))
    driven = _with_inputs(edges, limb.driven_columns)
    placed = tuple(tuple(_placed(edge, place, turn, len(turns)) for edge in driven) for place, turn in enumerate(turns))
    return LimbVerdict(
        CandidateLimb(limb, chains, known, tuple(rule for rule in rules if isinstance(rule, Motion)), placed)
    )


def limb_by_itself(limb: LimbType, turns: Sequence[FloatArray]) -> CandidateLimb:
    """A limb whose motion nothing holds, where only whole mechanisms can tell whether it is of use.

    Args:
        limb: in its first position.
        turns: (3, 3) into each position.

    Errors:
        RoutesDisagreeError: rules and twists differ on its POC set.
    """
    chains = tuple(parse_chain(plain_text(turned(limb.chain, turn))) for turn in turns)
    twists = twists_at_will(limb.chain, np.random.default_rng(limb.freedoms), len(ANGLES))
    return CandidateLimb(limb, chains, known_at_will(chains[0], twists), (), ())


def known_at_will(chain: Chain, twists: FloatArray) -> Known:
    """The POC set of a limb that nothing holds, by the rules and by its twists (N, 6, f) at a general point.

    Errors:
        RoutesDisagreeError: they differ.
    """
    return _known(chain.text, serial(chain, "free", chain.text), twists)


def _by_rules(chain: Chain, motion: RequiredMotion) -> Motion | Refusal:
    """The rules' answer for a limb whose end link takes the orientations that are wanted."""
    free = serial(chain, "free" if motion.rotations else "translation", chain.text)
    if isinstance(free, Refusal) or free.limb is None or not motion.rotations:
        return free
    return motion_of(free.limb, Orientations(1, motion.rotations)) if len(motion.rotations) == 1 else free


def _reason_by_rules(limb_motion: Motion, motion: RequiredMotion) -> Reason:
    if limb_motion.orientations.dim < len(motion.rotations):
        return "not the motion"
    if limb_motion.passive:
        return "a passive freedom"
    moves = all(limb_motion.translations.contains(direction) for direction in motion.translations)
    turns = all(limb_motion.rotations.contains(direction) for direction in motion.rotations)
    return "" if moves and turns else "not the motion"


@dataclass(frozen=True, eq=False)
class _Moves:
    """The limb's own motions at N poses: rates (N, c, F) of its joints, and the twists (N, 6, F) of the platform."""

    rates: FloatArray
    platform: FloatArray


def _moves(edges: tuple[Edge, ...]) -> _Moves:
    """What the loops of a limb leave its joints, and its platform."""
    rates = null_basis(closure(edges))
    return _Moves(rates, along(edges, BASE, PLATFORM) @ rates)


def _reason_by_twists(moves: _Moves | None, motion: RequiredMotion) -> Reason:
    if moves is None:
        return "not the motion"
    count, _, freedoms = moves.platform.shape
    if rank(moves.platform) < freedoms:
        return "a passive freedom"
    motion_twists = np.broadcast_to(motion.twists, (count, 6, motion.dim))
    return "" if rank(np.concatenate([moves.platform, motion_twists], axis=-1)) == freedoms else "not the motion"


def _idles(limb: LimbType, moves: _Moves, motion: RequiredMotion) -> bool:
    """Whether a freedom stays at rest in all of the motion; of a ball joint or rods, all of them."""
    moved = moves.rates @ np.linalg.pinv(moves.platform) @ motion.twists
    rates = np.max(np.abs(moved), axis=(0, 2))  # (c,)
    parts = np.split(rates, np.cumsum([joint.freedoms for joint in limb.chain.joints])[:-1])
    return any(
        np.max(part) < STILL if element.freedoms >= SPHERICAL.freedoms else np.min(part) < STILL
        for element, part in zip(limb.chain.joints, parts, strict=True)
    )


def _known(text: str, rules: Motion | Refusal, twists: FloatArray) -> Known:
    """The POC set; the twists stand at a general point, so that is where the routes are compared."""
    basis = np.linalg.qr(twists)[0]
    if isinstance(rules, Refusal):
        return Known(by_twists(basis), "twists", rules.reason)
    agreed(text, rules.restated, basis)
    return Known(rules.poc, "both")


def _with_inputs(edges: Sequence[Edge], columns: Sequence[int]) -> tuple[Edge, ...]:
    """The edges with the driven ones of their columns, counted through all of them, as inputs."""
    starts = np.cumsum([0, *(edge.freedoms for edge in edges)])
    return tuple(
        dataclasses.replace(
            edge, inputs=tuple(column - int(start) for column in columns if 0 <= column - start < edge.freedoms)
        )
        for edge, start in zip(edges, starts[:-1], strict=True)
    )


def _placed(edge: Edge, place: int, turn: FloatArray, places: int) -> Edge:
    """An edge at its share of the poses, turned into a position."""
    part = np.split(edge.twists, places)[place]
    turned_parts = [np.einsum("ij,njf->nif", turn, half) for half in (part[:, :3], part[:, 3:])]
    return dataclasses.replace(edge, twists=np.concatenate(turned_parts, axis=1))
