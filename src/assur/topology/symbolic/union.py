"""The union of Eq. (1): the POC set of a serial chain, from its joints."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from assur.topology.chains import Chain, Element, InnerLoop
from assur.topology.symbolic.blocks import structure
from assur.topology.symbolic.elementary import Elementary, Slide, Turn, elementary
from assur.topology.symbolic.helices import coupled
from assur.topology.symbolic.intersection import parallel
from assur.topology.symbolic.motion import Limb, Mode, Motion, check_mode, lone_helix, motion_of, seen_from_end
from assur.topology.symbolic.orientations import EVERY, UNTURNED
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import translations
from assur.topology.symbolic.spans import Span


def serial(chain: Chain | Sequence[Element], mode: Mode = "free", name: str = "the chain") -> Motion | Refusal:
    """The motion of a chain's end link, by the rules of POC theory.

    Args:
        chain: a chain, or its elements, from base to end link.
        mode: "free", or "translation" where the end link keeps its orientation.
        name: what the derivation calls it.

    Returns:
        The motion at a generic configuration of the chain, or why the rules give none.

    Errors:
        UsageError: another mode.

    >>> from assur.topology.chains import ChainJoint
    >>> from assur.joints.prismatic import PRISMATIC
    >>> from assur.joints.revolute import REVOLUTE
    >>> x = (1.0, 0.0, 0.0)
    >>> limb = [ChainJoint(PRISMATIC, (x,)), *[ChainJoint(REVOLUTE, (x,))] * 3]
    >>> print(serial(limb).poc)
    t³ r¹(∥R1)
    """
    check_mode(mode)
    elements = chain.elements if isinstance(chain, Chain) else tuple(chain)
    loops: list[Motion] = []
    conditions: list[str] = []

    def loop(element: InnerLoop) -> tuple[Elementary, ...] | Refusal:
        motion = inner_loop(element)
        if isinstance(motion, Refusal):
            return motion
        loops.append(motion)
        conditions.extend(motion.conditions)
        turns_both = motion.rotations.dim and motion.translations.turning
        back = inner_loop(element, seen_from_end) if turns_both else motion
        return back if isinstance(back, Refusal) else as_chain(motion, back.translations, element.name)

    pieces = elementary(elements, loop)
    if isinstance(pieces, Refusal):
        return pieces
    if len(pieces) == 1 and isinstance(pieces[0], Turn) and pieces[0].pitch and pieces[0].direction:
        return lone_helix(pieces[0], pieces[0].direction)
    gathered = structure(pieces)
    refusal = coupled(pieces, translations(gathered))
    if refusal is not None:
        return refusal
    limb = Limb(
        chain=pieces,
        structure=gathered,
        freedoms=sum(part.span.dim if isinstance(part, Slide) else 1 for part in pieces),
        conditions=(*conditions, *_conditions(pieces, mode)),
        centre=_centre(pieces),
        labels=frozenset(
            label for part in pieces if isinstance(part, Turn) for label in part.labels if label[0] != "#"
        ),
        parts=lambda: tuple(motion.derivation for motion in loops),
        name=name,
    )
    return motion_of(limb, UNTURNED if mode == "translation" else EVERY)


def inner_loop(loop: InnerLoop, seen: Callable[[Limb], Limb] | None = None) -> Motion | Refusal:
    """The motion of an inner loop's output link, or of its base as seen from there."""
    branches = []
    for number, branch in enumerate(loop.branches, 1):
        motion = serial(branch, name=f"branch {number}")
        if isinstance(motion, Motion) and motion.limb is not None and seen is not None:
            motion = motion_of(seen(motion.limb))
        if isinstance(motion, Refusal):
            return motion
        branches.append(motion)
    return parallel(branches, name=loop.name or "the inner loop")


def as_chain(motion: Motion, behind: Span, name: str) -> tuple[Elementary, ...] | Refusal:
    """The slides, and the one turn, that an inner loop is worth in its chain.

    Its rotation must be about one direction that stays fixed in the base of the loop, and so in its output link. What
    slides in directions fixed in the output link stands behind the turn.

    Args:
        motion: of its output link.
        behind: its translations as seen from there.
        name: what the slides and the turn are called.
    """
    moved, turned = motion.translations, motion.rotations
    if turned.dim > 1:
        return Refusal("an inner loop has several rotations")
    if turned.dim != motion.orientations.dim or (turned.dim and not turned.is_fixed):
        return Refusal("an inner loop has a rotation whose axis turns")
    if motion.helical:
        return Refusal("an inner loop has a rotation that is coupled with a translation along its axis")
    name = name or next(iter((*motion.poc.r_mark.names, *motion.poc.t_mark.names)), "the inner loop")
    turns = tuple(Turn(axis, name, located=False) for axis in turned.fixed)
    if all(moved.contains(direction) for direction in behind.fixed):
        return (Slide(moved, name), *turns) if moved.dim else turns
    if all(behind.contains(direction) for direction in moved.fixed):
        return (*turns, Slide(behind, name))
    return Refusal("an inner loop translates along a direction of its base and along one of its output link")


def _conditions(chain: Sequence[Elementary], mode: Mode) -> tuple[str, ...]:
    rods = [part.name for part in chain if isinstance(part, Turn) and not part.finite]
    kept = ["the orientation is kept"] if mode == "translation" else []
    return (*(f"{name} is a parallelogram" for name in rods), *kept)


def _centre(chain: Sequence[Elementary]) -> str:
    """The label that all turns have, where nothing slides."""
    labels = {part.point if isinstance(part, Turn) else "" for part in chain}
    label = labels.pop() if len(labels) == 1 else ""
    return "" if label.startswith("#") else label
