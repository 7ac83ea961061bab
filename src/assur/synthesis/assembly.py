"""Limbs put together: first by classes of equal motion, by the rules; then one by one, confirmed by twists."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain as joined
from itertools import combinations_with_replacement, islice, product

import numpy as np

from assur.synthesis.confirmed import confirmed
from assur.synthesis.designs import Design
from assur.synthesis.expected import Expected, expected
from assur.synthesis.limb_motions import Limb
from assur.synthesis.wanted import WantedMotion
from assur.topology.directions import span
from assur.topology.facts import Known
from assur.topology.notation import parse_chains
from assur.topology.orientations import Orientations, orientations
from assur.topology.poc import PocSet
from assur.topology.refusals import Refusal
from assur.topology.spans import Span

MEMBERS = 20
"""Of mechanisms with different limbs so many are listed for each combination of classes, the simplest first."""

AMONG = 20_000
"""They are looked for among about so many mechanisms, of the simplest limbs of each class."""

TRIES = 10 * MEMBERS
"""So many of these are tried."""

Class = tuple[Limb, ...]
"""Limbs with the same motion, the simplest first."""


@dataclass
class Tally:
    """How many combinations there are, and what became of them.

    Attributes:
        classes: sets of classes that were looked at by the rules, one class for each limb.
        combinations: mechanisms that they stand for.
        with_motion: those of them that the rules say have the wanted motion.
        confirmed: those that were looked at one by one.
        coupling_degrees: number of mechanisms with each κ, by the rules.
        unfixed: those whose driven joints, locked, leave a freedom.
        disagreements: those on which the two routes differ, in words.
    """

    classes: int = 0
    combinations: int = 0
    with_motion: int = 0
    confirmed: int = 0
    coupling_degrees: Counter[int] = field(default_factory=Counter)
    unfixed: int = 0
    disagreements: list[str] = field(default_factory=list)


def classes(limbs: Sequence[Limb]) -> tuple[Class, ...]:
    """The limbs by their motion; a limb on which the rules refuse is a class of its own."""
    found: dict[object, list[Limb]] = {}
    for limb in sorted(limbs, key=_simplicity):
        found.setdefault(_motion_key(limb), []).append(limb)
    ordered = sorted(found.values(), key=lambda members: (members[0].type.freedoms, _simplicity(members[0])))
    return tuple(map(tuple, ordered))


def assemble(
    chosen: Sequence[Class], motion: WantedMotion, coupling: tuple[int, int], symmetric: bool, tally: Tally
) -> Iterator[Design]:
    """The mechanisms with one limb of each of these classes: those of equal limbs all, of the others the simplest.

    Args:
        chosen: one class for each position; equal ones stand side by side. Only one class, if limbs must be equal.
        motion: wanted of the platform.
        coupling: least and largest κ.
        symmetric: whether all limbs must be equal.
        tally: counts what is done.
    """
    equal = len({id(members) for members in chosen}) == 1
    total = len(chosen[0]) if symmetric else _number(chosen)
    tally.classes += 1
    tally.combinations += total
    rules = _by_rules(chosen, motion)
    if isinstance(rules, Expected):
        if not rules.reaches:
            return
        tally.with_motion += total
        tally.coupling_degrees[rules.coupling_degree] += total
        if not coupling[0] <= rules.coupling_degree <= coupling[1]:
            return
    if equal:
        for limb in chosen[0]:
            found = _design([limb] * len(chosen), rules, motion, coupling, tally)
            if found:
                yield found
    if not symmetric:
        yield from _mixed(chosen, rules, motion, coupling, tally)


def _mixed(
    chosen: Sequence[Class],
    rules: Expected | Refusal,
    motion: WantedMotion,
    coupling: tuple[int, int],
    tally: Tally,
) -> Iterator[Design]:
    """The simplest mechanisms of limbs that are not all equal."""
    different = [limbs for limbs in _members(chosen) if len({id(limb) for limb in limbs}) > 1]
    tried = sorted(different, key=_simplicity_of_all)[:TRIES]
    designs = (_design(limbs, rules, motion, coupling, tally) for limbs in tried)
    yield from islice((design for design in designs if design), MEMBERS)


def _members(chosen: Sequence[Class]) -> Iterator[tuple[Limb, ...]]:
    """One of the simplest limbs of each class; the order within a class makes no difference."""
    simplest = int(AMONG ** (1 / len(chosen)))
    counts = Counter(map(id, chosen))
    groups = {id(members): members[:simplest] for members in chosen}
    choices = [combinations_with_replacement(groups[key], count) for key, count in counts.items()]
    for parts in product(*choices):
        yield tuple(joined.from_iterable(parts))


def _number(chosen: Sequence[Class]) -> int:
    counts = Counter(map(id, chosen))
    sizes = {id(members): len(members) for members in chosen}
    return math.prod(math.comb(sizes[key] + count - 1, count) for key, count in counts.items())


def _by_rules(chosen: Sequence[Class], motion: WantedMotion) -> Expected | Refusal:
    """What the rules say of the classes, by their first members."""
    first = [members[0] for members in chosen]
    if not all(limb.motions for limb in first):
        return Refusal(next(limb.known.refusal for limb in first if not limb.motions))
    return expected([limb.motions[place] for place, limb in enumerate(first)], motion)


def _design(
    limbs: Sequence[Limb],
    rules: Expected | Refusal,
    motion: WantedMotion,
    coupling: tuple[int, int],
    tally: Tally,
) -> Design | None:
    """The mechanism of these limbs, if the twists confirm it and its driven joints fix the platform."""
    tally.confirmed += 1
    found = confirmed(limbs)
    text = " | ".join(limb.chains[place].text for place, limb in enumerate(limbs))
    if found.dof != motion.dim:
        if isinstance(rules, Expected):
            tally.disagreements.append(f"{text}: the rules say F = {motion.dim}, the twists {found.dof}")
        return None
    if found.left:
        tally.unfixed += 1
        return None
    loops = found.loops
    if isinstance(rules, Expected):
        order = [found.names.index(name) for loop in loops.loops for name in loop.edges]
        said = (rules.xi(order, [limb.type.freedoms for limb in limbs]), rules.coupling_degree)
        counted = (tuple(loop.xi for loop in loops.loops), loops.coupling_degree)
        if said != counted:
            tally.disagreements.append(f"{text}: the rules say ξ = {said[0]}, κ = {said[1]}, the twists {counted}")
            return None
    if loops.coupling_degree is None or not coupling[0] <= loops.coupling_degree <= coupling[1]:
        return None
    return Design(
        limbs=tuple(limbs),
        chains=parse_chains([limb.chains[place].text for place, limb in enumerate(limbs)]),
        known=_known(rules, motion),
        loops=loops,
        dof=found.dof,
        mode="translation" if any(limb.needs_mode for limb in limbs) else "home",
    )


def _known(rules: Expected | Refusal, motion: WantedMotion) -> Known:
    if isinstance(rules, Refusal):
        poc = PocSet(len(motion.translations), len(motion.rotations), motion.dim)
        return Known(poc, "twists", rules.reason)
    return Known(rules.platform.poc, "both")


def _simplicity(limb: Limb) -> tuple[int, int, str]:
    return (limb.type.joints, limb.type.parallelograms, limb.text)


def _simplicity_of_all(limbs: Sequence[Limb]) -> tuple[int, int, int, tuple[str, ...]]:
    """As `Design.order`, of limbs with the same motions."""
    joints = sum(limb.type.joints for limb in limbs)
    parallelograms = sum(limb.type.parallelograms for limb in limbs)
    return (joints, parallelograms, len({id(limb) for limb in limbs}), tuple(limb.text for limb in limbs))


def _motion_key(limb: Limb) -> object:
    """Equal for limbs with the same motion in their first position."""
    if not limb.motions:
        return limb.text
    found = limb.motions[0]
    taken = orientations(found.limb.structure) if found.limb and found.rotations.turning else found.orientations
    return (limb.type.freedoms, _span_key(found.translations), _span_key(found.rotations), _axes_key(taken))


def _axes_key(taken: Orientations) -> tuple[object, ...]:
    """The axes without their sense; those that turn in the base may be fixed in the end link."""
    return (taken.dim, *(_span_key(Span((axis,))) for axis in taken.axes))


def _span_key(found: Span) -> tuple[object, ...]:
    """A subspace by its projector, which does not depend on the basis."""
    basis = span(found.fixed)
    projector = np.round(basis.T @ basis, 6) + 0.0
    return (tuple(projector.ravel().tolist()), found.turning, found.plane)
