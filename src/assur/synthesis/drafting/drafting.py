"""From chains in notation to the file of a sound mechanism: layouts are tried until one has the facts of the chains."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from assur.errors import UsageError
from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.naming import described_signs
from assur.kinematics.rates.restraint import WELL
from assur.model.pose import LENGTHS
from assur.synthesis.drafting.attempts import Attempt, DraftQuestion, turns_alone
from assur.synthesis.drafting.copying import mechanism_name
from assur.synthesis.drafting.facts import MOTION
from assur.synthesis.drafting.homes import CLEAR, LEAST, remarks
from assur.synthesis.drafting.inputs import inputs_for
from assur.synthesis.drafting.layout import layouts_for
from assur.synthesis.drafting.limbs_apart import limbs_apart
from assur.topology.analysis import Mode
from assur.topology.chains import Chain, ChainJoint, InnerLoop
from assur.topology.facts import Topology
from assur.topology.poc import PocSet

ENOUGH = 5
"""Where so many layouts of a group are not sound or are singular, the others are not tried."""
NOWHERE = 1e-6
"""A home that is nearer to singular is so by its kind: six equal limbs evenly about an axis, whatever their sizes."""

GOOD = 0.3
"""A home that is so far from singular is taken at once, where inputs and platform are free to move."""

FREE = 0.6
"""The share of what they should move from home that is enough."""

HELD = 0.8 * WELL
"""The condition of what holds the platform that is low enough: rounding lengths may raise it."""

PROBLEMS: dict[Problem, str] = {"inverse": "working mode", "direct": "assembly mode"}
"""Problem -> whose modes are branches of it."""


def _refuse_what_no_draft_has(chains: Sequence[Chain]) -> None:
    for number, chain in enumerate(chains, 1):
        if not chain.is_limb:
            ends = f"from {chain.start} to {chain.end}"
            raise UsageError(f"chain {number} leads {ends}; only limbs from base to platform are drafted")
        for joint in chain.joints:
            if isinstance(joint, ChainJoint) and joint.through:
                raise UsageError(
                    f"limb {number}: the axis of {joint.name} runs through further points, which no draft places",
                    hint="draft R[x]@A R[y] with one label a joint; assur topology --chain takes several",
                )


@dataclass(frozen=True)
class Drafted:
    """A file's text, the topology that it has, and what its reader should know."""

    text: str
    topology: Topology
    notes: tuple[str, ...] = ()


def drafted(
    chains: Sequence[Chain],
    path: Path,
    *,
    actuate: Sequence[str] | None = None,
    mode: Mode = "home",
    coordinates: bool = False,
) -> Drafted:
    """The file of a mechanism of some chains, with default dimensions.

    Its parameters are lengths, offsets and angles of links, and its home closes near the values that it gives. By
    coordinates all link frames are parallel at home and all joint values zero; parameters say where the joints are
    there, in every link the same ones, so that the loops close whatever these are.

    Args:
        chains: limbs from base to platform; of one that is a loop and nothing else, each branch is a limb.
        path: of the file, whose stem is the mechanism's name; nothing is written.
        actuate: actuated joints as "limb.joint", counted from 1; by default the first of each branch that determine it.
        coordinates: whether the parameters are coordinates of joints at home instead.
        mode: "home", or "translation": the platform keeps its orientation.

    Errors:
        UsageError: an open chain, a structure that does not move, inputs that do not determine it, or no layout that is
            sound and has the facts of the chains; then it says which differ.
        RoutesDisagreeError and others of the topology.

    Example:
        >>> from assur.topology.notation import parse_chains
        >>> found = drafted(parse_chains(["R[z] R[z] R[z]"] * 3), Path("my.toml"))
        >>> str(found.topology.poc), 'pose = ["x", "y", "phi"]' in found.text
        ('t²(⊥R1) r¹(∥R1)', True)
    """
    name = mechanism_name(path)
    chains, actuate = limbs_apart(chains, actuate)
    _refuse_what_no_draft_has(chains)
    if len(chains) == 1 and not any(isinstance(element, InnerLoop) for element in chains[0].elements):
        raise UsageError(
            "one open chain closes no loop; a parallel mechanism needs two limbs or more, or an inner loop",
            hint='give --chain again, or --limb "..." --count 3, or branches in braces: "{P[y] R[x] R[x] | ...}"',
        )
    inputs, topology = inputs_for(chains, actuate, mode)
    asked = DraftQuestion(chains, path, inputs, topology, mode, coordinates)
    reasons: dict[str, None] = {}
    made = _found(asked, reasons)
    if made is None and not coordinates and any(reason.startswith(MOTION) for reason in reasons):
        made = _found(dataclasses.replace(asked, coordinates=True), reasons)  # lengths would have to be special
    if made is not None:
        return _drafted(made, topology)
    listed = "; ".join(list(reasons)[-3:])  # of layouts whose home was moved, where any was reached
    raise UsageError(
        f"no default dimensions for {name} are sound and have the topology of its chains: {listed}",
        hint="assur topology --chain ... shows what the chains can do; axes may be special, or a P(4S) may skew",
    )


def _found(asked: DraftQuestion, reasons: dict[str, None]) -> Attempt | None:
    """The first layout that is sound, has the facts of the chains and is far enough from singular, else the best one.

    Args:
        asked: what it must be.
        reasons: why layouts are none; they are added.
    """
    enough = _lengths_enough(asked.topology.poc)
    singular: list[Attempt] = []
    for moved, layouts in itertools.product((False, True), layouts_for(asked.chains)):
        sound: list[Attempt] = []
        for number, layout in enumerate(layouts):
            if number >= ENOUGH and all(made.clearance < NOWHERE or made.held > WELL for made in sound):
                break
            made = asked.attempt(layout, moved=moved, unchecked=bool(sound))  # which of many is best comes first
            if made.fault or made.record is None:
                reasons[made.fault] = None
                continue
            free = made.travel >= FREE and made.held <= WELL
            if made.clearance >= GOOD and free and _lengths(made) >= enough:
                if asked.agrees(made, reasons):
                    return asked.tied(made)
                continue
            sound.append(made)
        for made in _best_first(sound, enough):
            if not _is_clear(made):
                singular.append(made)
            elif asked.agrees(made, reasons):
                if _is_clear(tied := asked.tied(made)):  # its formulas may change lengths
                    return tied
                singular.append(tied)
    agreeing = (made for made in _best_first(singular, enough) if asked.agrees(made, reasons))
    best = next(agreeing, None)
    return None if best is None else asked.tied(best)


def _lengths_enough(poc: PocSet) -> int:
    """How many lengths a pose should have: where the platform tilts, those that do not come with its rotations."""
    if turns_alone(poc):
        return 0
    own = poc.dim - poc.r if poc.r > 1 else poc.dim
    return min(poc.t, max(own, 1))


def _drafted(made: Attempt, topology: Topology) -> Drafted:
    return Drafted(_with_names(made), topology, () if made.record is None else remarks(made.record, made.travel))


def _with_names(made: Attempt) -> str:
    """The text, with what the + of each sign means that the joint graph gives to modes, as comments at its end."""
    if made.record is None:
        return made.text
    lines = []
    for problem, name in PROBLEMS.items():
        if not sign_names(made.record, problem):
            signs = described_signs(made.record, problem)
            lines += [f"#     {name}, {sign.name} ({sign.letter}): {sign.meaning}" for sign in signs]
    head = "# Modes that are not named above bear the signs of the joint graph. + is as drawn:"
    return "\n".join([made.text.rstrip(), "", head, *lines, ""]) if lines else made.text


def _is_clear(made: Attempt) -> bool:
    """Whether home is far enough from singular, in its constraints too, and from folds."""
    return made.clearance >= CLEAR and made.held <= WELL and made.travel >= LEAST


def _best_first(made: Sequence[Attempt], enough: int) -> list[Attempt]:
    """Attempts, first by lengths in their pose as far as there are enough, then by how far home is from singular.

    Far enough is by what inputs and platform move before a fold: of two halves of a loop that lean alike a sine may be
    large beside it.
    """

    def order(attempt: Attempt) -> tuple[float, ...]:
        far = attempt.clearance
        held, free = max(attempt.held, HELD), min(attempt.travel, FREE)
        return (-min(_lengths(attempt), enough), -min(far, CLEAR), held, -free, -min(far, GOOD))

    return sorted(made, key=order)


def _lengths(made: Attempt) -> int:
    """How many coordinates of the pose are lengths, which people like better than angles that come with them."""
    return 0 if made.record is None else sum(name in LENGTHS for name in made.record.platform.pose)
